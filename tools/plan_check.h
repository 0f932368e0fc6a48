// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Whether plans keep what they promise: materials at random, planned, and measured against the
/// random walk.

#pragma once

#include <regain/shaders/planner.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace regain::tools {

struct CheckedPlan
{
    std::string material;  ///< what it is, in words
    std::string methods;
    double tolerance = 0;
    double predicted = 0;
    double measured = 0;  ///< largest difference from the walk, over directions and channels
    double noise = 0;     ///< what that may be off by chance, one sigma at most

    bool is_worse() const { return measured > predicted; }
};

struct PlanCheck
{
    int materials = 200;
    /// Of each direction, for what is no integral; the walk takes four times that.
    std::uint64_t samples = 65536;
    std::uint32_t seed = 1;
};

/// Metals, glass, plastic and mixes of metals, of all distributions, some with two widths, at
/// tolerances from 0.003 to 0.1; those that plans leave to the reference itself, or know nothing
/// about, are drawn again. `done` is called after each.
std::vector<CheckedPlan> checked_plans(
    const shaders::MethodCosts&, const PlanCheck&, const std::function<void()>& done = [] {});

}  // namespace regain::tools
