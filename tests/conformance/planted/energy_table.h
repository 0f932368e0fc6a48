// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A small square table of the energy that a lobe of F = 1 scatters once, over
///
///   x = sqrt(mu / (mu + alpha (1 - mu))),   y = sqrt(alpha),
///
/// nodes at both ends, between them straight lines; and two ways to look the wrong place up.

#pragma once

#include <functional>
#include <vector>

namespace regain::planted {

enum class LookUp { right, transposed, half_a_texel_off };

class EnergyTable
{
public:
    static constexpr int nodes = 20;

    /// albedo(alpha, mu), which is asked once a node.
    explicit EnergyTable(const std::function<double(double, double)>& albedo);

    double at(double alpha, double mu, LookUp how = LookUp::right) const;

private:
    std::vector<double> _values;  // alpha by alpha
};

}  // namespace regain::planted
