// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/luts/balance.h>

#include "balance_nodes.h"
#include "upward_slopes.h"

#include <algorithm>
#include <cmath>

REGAIN_NAMESPACE_BEGIN
namespace luts {
namespace {

constexpr int cells = 96, most_rounds = 500;

}  // namespace

Balance::Balance(const SlopeLaw& law, int nodes) : _alpha(law.alpha()), _g(cells + 1, 1.0)
{
    constexpr std::size_t size = cells + 1;
    const CosineNodes cosines(_alpha, cells);
    // The kernel, from each node to the interpolated function at the others.
    std::vector<double> kernel(size * size);
    for (std::size_t o = 0; o < size; ++o)
    {
        // At mu = 0 there is no lobe; close by is its limit.
        const double at = std::max(static_cast<double>(o), 0.3);
        integrate_upward_slopes(law, cosines.cosine(at), nodes,
                                [&](double weight, double, double mu) {
                                    const CubicStencil s(cosines.place(mu), cells);
                                    for (std::size_t i = 0; i < 4; ++i)
                                        kernel[o * size + s.node[i]] += weight * s.weight[i];
                                });
    }
    for (int round = 0; round < most_rounds; ++round)
    {
        double moved = 0;
        std::vector<double> next(size);
        for (std::size_t o = 0; o < size; ++o)
        {
            double sum = 0;
            for (std::size_t i = 0; i < size; ++i) sum += kernel[o * size + i] * _g[i];
            next[o] = std::sqrt(_g[o] / sum);
            moved = std::max(moved, std::abs(next[o] / _g[o] - 1));
        }
        _g = next;
        if (moved < 1e-11) break;
    }
}

double Balance::at(double mu) const
{
    const CubicStencil s(CosineNodes(_alpha, cells).place(mu), cells);
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) sum += s.weight[i] * _g[s.node[i]];
    return sum;
}

}  // namespace luts
REGAIN_NAMESPACE_END
