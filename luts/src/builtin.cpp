// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/luts/builtin.h>

REGAIN_NAMESPACE_BEGIN
namespace luts {
namespace {

// Written by `regain bake --embed` from the EXR files in data/.
#include "builtin/ggx_E_avg.inc"
#include "builtin/ggx_E_ss.inc"
#include "builtin/ggx_fresnel_blend.inc"

}  // namespace

MicrofacetTables ggx_tables()
{
    MicrofacetTables tables;
    tables.E_ss = ggx_E_ss;
    tables.E_avg = ggx_E_avg;
    tables.fresnel_blend = ggx_fresnel_blend;
    return tables;
}

TableView builtin_table(const std::string& name)
{
    if (name == "ggx_E_ss") return ggx_E_ss;
    if (name == "ggx_E_avg") return ggx_E_avg;
    if (name == "ggx_fresnel_blend") return ggx_fresnel_blend;
    return {};
}

}  // namespace luts
REGAIN_NAMESPACE_END
