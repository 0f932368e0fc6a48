// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The closures of a material wherever it may be shaded: of a tree of constants at one place, of
/// others over a lattice of texture coordinates.

#pragma once

#include <regain/shaders/varying_tree.h>

#include <functional>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace shaders::planning {

/// A closure and the largest weight that layers can leave it there.
struct PlacedLobe
{
    ClosureTree::Node node = -1;
    ClosureTree::Material material;
    ColorD weight{0.0};
    bool covers = false;  ///< another one gets what it lets by
};

struct PlannedPlace
{
    int i = 0, j = 0, across = 1;  ///< of across x across places, along u and v
    std::vector<PlacedLobe> lobes;
};

/// Calls visit with the closures of each place; a closure that is in several places of the tree is
/// there once, with the sum of its weights. They are always the same ones, in the same order.
void at_planned_points(const VaryingTree&, const std::function<void(const PlannedPlace&)>& visit);

}  // namespace shaders::planning
REGAIN_NAMESPACE_END
