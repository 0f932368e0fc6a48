// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/luts/builtin.h>

REGAIN_NAMESPACE_BEGIN
namespace luts {
namespace {

// Written by `regain bake --embed` from the EXR files in data/.
#include "builtin/ggx_E_avg.inc"
#include "builtin/ggx_E_ss.inc"
#include "builtin/ggx_balance.inc"
#include "builtin/ggx_dip.inc"
#include "builtin/ggx_falloff.inc"
#include "builtin/ggx_forward.inc"
#include "builtin/ggx_mu_ms.inc"
#include "builtin/ggx_q_ms.inc"
#include "builtin/ggx_spread.inc"
#include "builtin/ggx_tilt.inc"

}  // namespace

MicrofacetTables ggx_tables()
{
    MicrofacetTables tables;
    tables.E_ss = ggx_E_ss;
    tables.E_avg = ggx_E_avg;
    tables.falloff = ggx_falloff;
    tables.dip = ggx_dip;
    tables.balance = ggx_balance;
    tables.q_ms = ggx_q_ms;
    tables.mu_ms = ggx_mu_ms;
    tables.spread = ggx_spread;
    tables.forward = ggx_forward;
    tables.tilt = ggx_tilt;
    return tables;
}

TableView builtin_table(const std::string& name)
{
    if (name == "ggx_E_ss") return ggx_E_ss;
    if (name == "ggx_E_avg") return ggx_E_avg;
    if (name == "ggx_falloff") return ggx_falloff;
    if (name == "ggx_dip") return ggx_dip;
    if (name == "ggx_balance") return ggx_balance;
    if (name == "ggx_q_ms") return ggx_q_ms;
    if (name == "ggx_mu_ms") return ggx_mu_ms;
    if (name == "ggx_spread") return ggx_spread;
    if (name == "ggx_forward") return ggx_forward;
    if (name == "ggx_tilt") return ggx_tilt;
    return {};
}

}  // namespace luts
REGAIN_NAMESPACE_END
