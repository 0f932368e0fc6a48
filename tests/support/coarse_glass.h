// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#pragma once

#include <regain/closures/dielectric_tables.h>

#include <cstdint>

namespace regain::tests {

/// Dielectric tables of a host that measured one number each, E^S = 0.75, R / E^S = 0.25: for
/// distributions whose own are not shipped.
inline DielectricTables coarse_dielectric_tables()
{
    static const std::uint16_t E[] = {49151, 49151, 49151, 49151, 49151, 49151, 49151, 49151},
                               R[] = {16384, 16384, 16384, 16384, 16384, 16384, 16384, 16384};
    DielectricTables t;
    for (int side = 0; side < 2; ++side)
    {
        t.E[side] = {E, 2, 2, 2};
        t.R[side] = {R, 2, 2, 2};
    }
    return t;
}

}  // namespace regain::tests
