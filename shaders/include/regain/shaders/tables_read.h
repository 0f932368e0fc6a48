// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Which tables of a mirror a method reads: those of GGX come all together, whatever is used.

#pragma once

#include <regain/shaders/microfacet_material.h>

REGAIN_NAMESPACE_BEGIN
namespace shaders {

/// Of those, what eval and sample by the method read.
inline MicrofacetTables tables_read(const Compensation& method, const MicrofacetTables& t)
{
    MicrofacetTables read;
    const auto* gain = std::get_if<Method>(&method);
    const auto* walk = std::get_if<RandomWalk>(&method);
    if ((gain && *gain == Method::none) || (walk && !walk->bounded) ||
        std::holds_alternative<BurleySheen>(method))
        return read;
    const bool tail = std::holds_alternative<Tail>(method),
               balanced = std::holds_alternative<Balanced>(method);
    read.E_ss = t.E_ss;
    read.anisotropy = t.anisotropy;
    if (walk || (gain && (*gain == Method::turquin_eq12 || *gain == Method::series)))
        read.E_avg = t.E_avg;
    if (tail || balanced || std::holds_alternative<Directional>(method))
        read.q_ms = t.q_ms, read.mu_ms = t.mu_ms;
    if (balanced) read.balance = t.balance, read.balance_anisotropy = t.balance_anisotropy;
    if (tail) read.falloff = t.falloff, read.dip = t.dip, read.tilt = t.tilt;
    if (tail || walk) read.spread = t.spread, read.forward = t.forward;
    return read;
}

}  // namespace shaders
REGAIN_NAMESPACE_END
