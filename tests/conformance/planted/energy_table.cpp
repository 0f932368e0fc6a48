// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "energy_table.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace regain::planted {

EnergyTable::EnergyTable(const std::function<double(double, double)>& albedo)
{
    for (int j = 0; j < nodes; ++j)
        for (int i = 0; i < nodes; ++i)
        {
            // Next to the ends, where a mirror or the horizon itself is.
            const double y = std::max(1e-2, j / (nodes - 1.0)), alpha = y * y;
            const double x = std::max(1e-2, i / (nodes - 1.0)), x2 = x * x;
            _values.push_back(albedo(alpha, std::min(1.0, alpha * x2 / (1 - x2 * (1 - alpha)))));
        }
}

double EnergyTable::at(double alpha, double mu, LookUp how) const
{
    double x = std::sqrt(mu / (mu + alpha * (1 - mu))), y = std::sqrt(alpha);
    if (how == LookUp::transposed) std::swap(x, y);
    // As if the nodes were the middles of texels.
    const auto place = [how](double u) {
        const double p = how == LookUp::half_a_texel_off ? u * nodes - 0.5 : u * (nodes - 1);
        return std::clamp(p, 0.0, nodes - 1.0);
    };
    const double px = place(x), py = place(y);
    const int i = std::min(nodes - 2, static_cast<int>(px)),
              j = std::min(nodes - 2, static_cast<int>(py));
    const auto value = [&](int a, int b) {
        return _values[static_cast<std::size_t>(b * nodes + a)];
    };
    const double fx = px - i, fy = py - j;
    return (1 - fy) * ((1 - fx) * value(i, j) + fx * value(i + 1, j)) +
           fy * ((1 - fx) * value(i, j + 1) + fx * value(i + 1, j + 1));
}

}  // namespace regain::planted
