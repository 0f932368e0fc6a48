// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Integrals of what a reflecting closure answers over all directions, good to 1e-6 for lobes of
/// any width and at grazing angles. They are taken over the slopes (p, q) of the half-vector,
///     dwi = 4 (wo.h) dh,   dh = h_z^3 dp dq,
/// stretched by the widths of the lobe, so that the nodes lie where the lobe is.

#pragma once

#include <regain/closures/vector.h>
#include <regain/luts/quadrature.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace regain::tests {

/// Sum of f(wi) over the hemisphere of directions wi with wi.z > 0, for a lobe of widths alpha_x,
/// alpha_y; wo.z > 0. Value needs +, * double. Of a long tail slopes of 1 matter, whatever the
/// widths are, and nodes are spent on them.
template <class F>
auto integrate_reflections(const Vec3<double>& wo, double alpha_x, double alpha_y, int nodes,
                           const F& f, bool long_tail = false)
{
    using Value = decltype(f(wo));
    static thread_local luts::QuadratureRule rule;
    if (static_cast<int>(rule.x.size()) != nodes) rule = luts::gauss_legendre(nodes);

    Value sum = f(wo) * 0.0;
    const auto at = [&](double p, double q) {
        const double h_z = 1 / std::sqrt(1 + p * p + q * q);
        const Vec3<double> h(p * h_z, q * h_z, h_z);
        const double facing = wo.dot(h);
        const Vec3<double> wi = h * (2 * facing) - wo;
        if (facing <= 0 || wi.z <= 0) return f(wo) * 0.0;
        return f(wi) * (4 * facing * h_z * h_z * h_z);
    };

    // Along the ray of phi slopes are rho (ax cos, ay sin); those with wi.z > 0 end where
    // |slope|^2 - 2 slope.tan_o - 1 = 0.
    const auto along = [&](double phi, double dphi) {
        const double dp = alpha_x * std::cos(phi), dq = alpha_y * std::sin(phi);
        const double a = dp * dp + dq * dq, b = (dp * wo.x + dq * wo.y) / wo.z;
        const double root = std::sqrt(b * b + a);
        const double edge = b > 0 ? (b + root) / a : 1 / (root - b);
        const double bend =
            long_tail ? std::max(1 / std::sqrt(alpha_x * alpha_y), std::max(1 / std::sqrt(a), 1.0))
                      : 1;
        const auto add = [&](double rho, double drho) {
            sum += at(dp * rho, dq * rho) * (alpha_x * alpha_y * dphi * drho * rho);
        };
        for (std::size_t i = 0; i < rule.x.size(); ++i)
        {
            const double y = rule.x[i], near_edge = y * y * y, slope = 3 * y * y * rule.weight[i];
            if (edge <= 1)
            {
                add(edge * (1 - near_edge), edge * slope);
                continue;
            }
            add(y, rule.weight[i]);
            if (bend > 1)
            {
                const double range = std::log(std::min(edge, bend));
                const bool last = edge <= bend;
                const double rho = std::exp(range * (last ? 1 - near_edge : y));
                add(rho, rho * range * (last ? slope : rule.weight[i]));
            }
            if (edge > bend)
            {
                const double outer = bend / edge, w = outer + (1 - outer) * near_edge;
                add(bend / w, bend / (w * w) * (1 - outer) * slope);
            }
        }
    };

    // Nodes gather where the edge of the disc comes in, across the azimuth of wo.
    const double azimuth = std::atan2(wo.y * alpha_y, wo.x * alpha_x), pi = std::acos(-1.0);
    if (alpha_x == alpha_y)
    {
        for (int quarter = 0; quarter < 4; ++quarter)
            for (std::size_t j = 0; j < rule.x.size(); ++j)
            {
                const double x = rule.x[j], offset = 0.5 * pi * x * x * x;
                const double base = quarter < 2 ? 0.5 * pi : -0.5 * pi;
                along(azimuth + base + (quarter % 2 == 0 ? offset : -offset),
                      1.5 * pi * x * x * rule.weight[j]);
            }
        return sum;
    }
    // Where the widths differ, next to the axes, too.
    std::vector<double> limits{azimuth + 0.5 * pi, azimuth + 1.5 * pi, 0, 0.5 * pi, pi, 1.5 * pi};
    for (double& phi : limits) phi -= 2 * pi * std::floor(phi / (2 * pi));
    std::sort(limits.begin(), limits.end());
    limits.push_back(limits.front() + 2 * pi);
    for (std::size_t k = 0; k + 1 < limits.size(); ++k)
    {
        const double length = limits[k + 1] - limits[k];
        if (length < 1e-7) continue;
        for (std::size_t j = 0; j < rule.x.size(); ++j)
        {
            const double x = rule.x[j];
            along(limits[k] + length * x * x * x * (10 - 15 * x + 6 * x * x),
                  length * 30 * x * x * (1 - x) * (1 - x) * rule.weight[j]);
        }
    }
    return sum;
}

}  // namespace regain::tests
