// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Where balances are solved for: nodes along the cosine, and cubics between nodes.

#pragma once

#include <regain/closures/version.h>

#include <algorithm>
#include <array>
#include <cmath>

REGAIN_NAMESPACE_BEGIN
namespace luts {

/// Nodes 0 to `cells` along the cosine, for a lobe of one alpha: even in sqrt(mu) up to mu ~ alpha,
/// where most is lost, then in the logarithm, and near the normal in theta, in which the loss of
/// long tails is linear.
class CosineNodes
{
public:
    CosineNodes(double alpha, int cells)
        : _scale(0.25 * alpha), _cells(cells), _range(std::log1p(std::sqrt(1 / _scale)))
    {}

    /// Place of mu in [0, 1] among the nodes, in [0, cells], and its inverse.
    double place(double mu) const
    {
        const double t = mu / (1 + std::sqrt(std::max(0.0, (1 - mu) * (1 + mu))));
        return _cells * std::log1p(std::sqrt(t / _scale)) / _range;
    }
    double cosine(double place) const
    {
        const double root = std::expm1(place / _cells * _range);
        const double t = _scale * root * root;
        return std::min(2 * t / (1 + t * t), 1.0);
    }

private:
    double _scale;
    int _cells;
    double _range;
};

/// Four nodes about a place in [0, cells] and their weights, of Lagrange's cubic.
struct CubicStencil
{
    std::array<std::size_t, 4> node;
    std::array<double, 4> weight;

    /// At the ends the nodes are the last four; where the function is even about both ends, those
    /// beyond are mirrored.
    CubicStencil(double place, int cells, bool even = false)
    {
        int low = static_cast<int>(place) - 1;
        low = even ? std::min(low, cells - 2) : std::clamp(low, 0, cells - 3);
        const double x = place - low;
        weight = {-(x - 1) * (x - 2) * (x - 3) / 6, x * (x - 2) * (x - 3) / 2,
                  -x * (x - 1) * (x - 3) / 2, x * (x - 1) * (x - 2) / 6};
        for (int i = 0; i < 4; ++i)
        {
            const int n = std::abs(low + i);
            node[static_cast<std::size_t>(i)] =
                static_cast<std::size_t>(n > cells ? 2 * cells - n : n);
        }
    }
};

}  // namespace luts
REGAIN_NAMESPACE_END
