// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// One of several offers for each closure of a material, so that all together cost least and the
/// sum of their errors is within a tolerance.

#pragma once

#include <regain/shaders/plain_material.h>

#include <cstddef>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace shaders::planning {

struct Offer
{
    ColorD error{0.0};
    double price = 0;
};

/// The place of the chosen one among the offers of each; each has one at least. Where the tolerance
/// cannot be kept, those of least error.
std::vector<std::size_t> cheapest_within(const std::vector<std::vector<Offer>>& offers,
                                         double tolerance);

}  // namespace shaders::planning
REGAIN_NAMESPACE_END
