// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/luts/builtin.h>

REGAIN_NAMESPACE_BEGIN
namespace luts {
namespace {

// Written by `regain bake --embed` from the EXR files in data/.
#include "builtin/ggx_E_avg.inc"
#include "builtin/ggx_E_ss.inc"
#include "builtin/ggx_dip.inc"
#include "builtin/ggx_falloff.inc"

}  // namespace

MicrofacetTables ggx_tables()
{
    MicrofacetTables tables;
    tables.E_ss = ggx_E_ss;
    tables.E_avg = ggx_E_avg;
    tables.falloff = ggx_falloff;
    tables.dip = ggx_dip;
    return tables;
}

TableView builtin_table(const std::string& name)
{
    if (name == "ggx_E_ss") return ggx_E_ss;
    if (name == "ggx_E_avg") return ggx_E_avg;
    if (name == "ggx_falloff") return ggx_falloff;
    if (name == "ggx_dip") return ggx_dip;
    return {};
}

}  // namespace luts
REGAIN_NAMESPACE_END
