// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// How large tables are: bytes of the numbers that a closure with them may read.

#pragma once

#include <regain/closures/dielectric_tables.h>
#include <regain/closures/table.h>

#include <cstddef>
#include <cstdint>

namespace regain::tools {

inline std::size_t bytes_of(const TableView& t)
{
    const int nodes = t ? t.width * (t.height > 0 ? t.height : 1) * t.depth : 0;
    return sizeof(std::uint16_t) * static_cast<std::size_t>(nodes);
}
inline std::size_t bytes_of(const MicrofacetTables& t)
{
    std::size_t sum = 0;
    for (const TableView* view : {&t.E_ss, &t.E_avg, &t.falloff, &t.dip, &t.balance, &t.q_ms,
                                  &t.mu_ms, &t.spread, &t.forward, &t.tilt})
        sum += bytes_of(*view);
    return sum;
}
inline std::size_t bytes_of(const DielectricTables& t)
{
    std::size_t sum = 0;
    for (int side = 0; side < 2; ++side)
        sum += bytes_of(t.E[side]) + bytes_of(t.R[side]) + bytes_of(t.later[side]);
    return sum;
}

}  // namespace regain::tools
