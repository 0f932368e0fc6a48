// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/luts/balance.h>

#include "upward_slopes.h"

#include <algorithm>
#include <array>
#include <cmath>

REGAIN_NAMESPACE_BEGIN
namespace luts {
namespace {

constexpr int cells = 96;
constexpr double bend = 0.25;
constexpr int most_rounds = 500;

// Place of a cosine among the nodes, in [0, cells]: even in sqrt(mu) up to mu ~ alpha, where most
// is lost, then in the logarithm, and near the normal in theta, in which the loss of long tails is
// linear.
double place(double mu, double alpha)
{
    const double t = mu / (1 + std::sqrt(std::max(0.0, (1 - mu) * (1 + mu))));
    return cells * std::log1p(std::sqrt(t / (alpha * bend))) /
           std::log1p(std::sqrt(1 / (alpha * bend)));
}

double cosine(double place, double alpha)
{
    const double root = std::expm1(place / cells * std::log1p(std::sqrt(1 / (alpha * bend))));
    const double t = alpha * bend * root * root;
    return std::min(2 * t / (1 + t * t), 1.0);
}

// Four nodes about a place and their weights, of Lagrange's cubic.
struct Stencil
{
    std::size_t first;
    std::array<double, 4> weight;

    explicit Stencil(double place)
    {
        const int low = std::clamp(static_cast<int>(place) - 1, 0, cells - 3);
        first = static_cast<std::size_t>(low);
        const double x = place - low;
        weight = {-(x - 1) * (x - 2) * (x - 3) / 6, x * (x - 2) * (x - 3) / 2,
                  -x * (x - 1) * (x - 3) / 2, x * (x - 1) * (x - 2) / 6};
    }
};

}  // namespace

Balance::Balance(const SlopeLaw& law, int nodes) : _alpha(law.alpha()), _g(cells + 1, 1.0)
{
    constexpr std::size_t size = cells + 1;
    // The kernel, from each node to the interpolated function at the others.
    std::vector<double> kernel(size * size);
    for (std::size_t o = 0; o < size; ++o)
    {
        // At mu = 0 there is no lobe; close by is its limit.
        const double at = std::max(static_cast<double>(o), 0.3);
        integrate_upward_slopes(law, cosine(at, _alpha), nodes,
                                [&](double weight, double, double mu) {
                                    const Stencil s(place(mu, _alpha));
                                    for (std::size_t i = 0; i < 4; ++i)
                                        kernel[o * size + s.first + i] += weight * s.weight[i];
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
    const Stencil s(place(mu, _alpha));
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) sum += s.weight[i] * _g[s.first + i];
    return sum;
}

}  // namespace luts
REGAIN_NAMESPACE_END
