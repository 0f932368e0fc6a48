// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What a method of compensation is likely to err by, and cost, on a closure that was not measured:
/// read between the closures that were.

#pragma once

#include <regain/shaders/method_costs.h>

#include <algorithm>
#include <optional>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace shaders::planning {

/// Of the channels.
inline double largest(const ColorD& c) { return std::max({c.x, c.y, c.z}); }

struct Prediction
{
    ColorD error{0.0};            ///< of the directional albedo, largest, per channel
    double eval = 0, sample = 0;  ///< over a white GGX mirror without compensation
};

/// Empty where nothing near enough was measured: thin walls, transmission alone, an index within a
/// tenth of 1, tails longer than any that were measured; or where there is no such combination.
std::optional<Prediction> predicted(const MethodCosts&, const MicrofacetMaterial&,
                                    const Compensation&);

/// Methods that there is a prediction for, `none` first, in the order of compensation_names().
std::vector<Compensation> predictable_methods(const MethodCosts&, const MicrofacetMaterial&);

/// Reflectance at normal incidence of what only reflects, per channel.
ColorD normal_reflectance(const MicrofacetMaterial&);

}  // namespace shaders::planning
REGAIN_NAMESPACE_END
