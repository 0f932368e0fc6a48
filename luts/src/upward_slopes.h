// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The quadrature of albedo_integral.h.

#pragma once

#include "rules.h"

#include <regain/luts/slope_law.h>

#include <algorithm>
#include <cmath>

REGAIN_NAMESPACE_BEGIN
namespace luts {

/// Integrates over all slopes that reflect upwards; `add` is given the weight of one of them, in
/// units of the albedo, wo.m, and the cosine that it reflects to. mu in (0, 1].
template <class Add>
void integrate_upward_slopes(const SlopeLaw& law, double mu, int nodes, const Add& add)
{
    const QuadratureRule& rule = rule_of(nodes);
    const double pi = std::acos(-1.0);
    const double alpha = law.alpha();
    const double sin_o = std::sqrt(std::max(0.0, (1 - mu) * (1 + mu)));
    const double tan_o = sin_o / mu, sigma_o = law.projected_area(mu);

    // One slope of length rho and its component p along wo: its share of the integrand over
    // P22 dp dq. The factor 1 / cos theta_o is merged with G2, whose numerator has it too.
    const auto slope = [&](double p, double rho, double area) {
        const double facing = mu + sin_o * p;  // wo.m sqrt(1 + rho^2)
        const double scale = 1 / (1 + rho * rho);
        const double mu_i = 2 * facing * scale - mu;
        if (facing <= 0 || mu_i <= 0) return;
        const double sigma_i = law.projected_area(std::min(mu_i, 1.0));
        add(area * law.density(rho) * facing * mu_i / (sigma_o * mu_i + sigma_i * mu - mu * mu_i),
            facing * std::sqrt(scale), std::min(mu_i, 1.0));
    };

    // Radially: inside a slope of alpha the slope itself serves, in which the integrand is smooth
    // at the origin. Outside it the reciprocal, in which the tail times the growing wo.m is smooth.
    // A heavy tail matters at slopes of 1, too: between alpha and 1 its logarithm serves.
    const double bend = law.heavy_tailed() ? 1.0 : alpha;
    const auto along = [&](double phi, double dphi) {
        const double c = std::cos(phi), b = tan_o * c;
        // The far root of rho^2 - 2 b rho - 1 = 0, in the form that does not cancel.
        const double root = std::sqrt(b * b + 1);
        const double edge = std::min(b > 0 ? b + root : 1 / (root - b), law.longest());
        for (std::size_t i = 0; i < rule.x.size(); ++i)
        {
            // Nodes gather at the edge, where light leaves at grazing angles.
            const double x = rule.x[i], near_edge = x * x * x, d_near_edge = 3 * x * x;
            const double weight = rule.weight[i] * dphi;
            const auto at = [&](double rho, double drho) {
                slope(rho * c, rho, weight * drho * rho);
            };
            if (edge <= alpha)
            {
                at(edge * (1 - near_edge), edge * d_near_edge);
                continue;
            }
            at(alpha * x, alpha);
            if (bend > alpha)
            {
                const double range = std::log(std::min(edge, bend) / alpha);
                const bool last = edge <= bend;
                const double rho = alpha * std::exp(range * (last ? 1 - near_edge : x));
                at(rho, rho * range * (last ? d_near_edge : 1));
            }
            if (edge > bend)
            {
                const double outer = bend / edge;
                const double w = outer + (1 - outer) * near_edge;
                at(bend / w, (1 - outer) * d_near_edge * bend / (w * w));
            }
        }
    };

    // Over the half circle, which stands for both, nodes gathered about pi / 2, where at grazing
    // angles the edge comes in from far away.
    for (int side = 0; side < 2; ++side)
        for (std::size_t j = 0; j < rule.x.size(); ++j)
        {
            const double x = rule.x[j];
            const double offset = 0.5 * pi * x * x * x, dphi = 0.5 * pi * 3 * x * x;
            along(0.5 * pi + (side == 0 ? -offset : offset), 2 * rule.weight[j] * dphi);
        }
}

}  // namespace luts
REGAIN_NAMESPACE_END
