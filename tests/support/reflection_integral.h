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

#include <cmath>

namespace regain::tests {

/// Sum of f(wi) over the hemisphere of directions wi with wi.z > 0, for a lobe of widths alpha_x,
/// alpha_y; wo.z > 0. Value needs +, * double.
template <class F>
auto integrate_reflections(const Vec3<double>& wo, double alpha_x, double alpha_y, int nodes,
                           const F& f)
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

    // Quarter turns about the azimuth of wo, nodes gathered where the edge of the disc comes in.
    const double azimuth = std::atan2(wo.y * alpha_y, wo.x * alpha_x), pi = std::acos(-1.0);
    for (int quarter = 0; quarter < 4; ++quarter)
        for (std::size_t j = 0; j < rule.x.size(); ++j)
        {
            const double x = rule.x[j], offset = 0.5 * pi * x * x * x, dphi = 1.5 * pi * x * x;
            const double base = quarter < 2 ? 0.5 * pi : -0.5 * pi;
            const double phi = azimuth + base + (quarter % 2 == 0 ? offset : -offset);

            // Along this ray slopes are rho (ax cos, ay sin); those with wi.z > 0 end where
            // |slope|^2 - 2 slope.tan_o - 1 = 0.
            const double dp = alpha_x * std::cos(phi), dq = alpha_y * std::sin(phi);
            const double a = dp * dp + dq * dq, b = (dp * wo.x + dq * wo.y) / wo.z;
            const double root = std::sqrt(b * b + a);
            const double edge = b > 0 ? (b + root) / a : 1 / (root - b);

            const double area = alpha_x * alpha_y * rule.weight[j] * dphi;
            for (std::size_t i = 0; i < rule.x.size(); ++i)
            {
                const double y = rule.x[i], near_edge = y * y * y, slope = 3 * y * y;
                if (edge > 1)
                {
                    sum += at(dp * y, dq * y) * (rule.weight[i] * area * y);
                    const double w = 1 / edge + (1 - 1 / edge) * near_edge, rho = 1 / w;
                    sum += at(dp * rho, dq * rho) *
                           (rule.weight[i] * area * rho * rho * rho * (1 - 1 / edge) * slope);
                }
                else
                {
                    const double rho = edge * (1 - near_edge);
                    sum += at(dp * rho, dq * rho) * (rule.weight[i] * area * rho * edge * slope);
                }
            }
        }
    return sum;
}

}  // namespace regain::tests
