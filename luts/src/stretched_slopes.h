// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The quadrature of upward_slopes.h for lobes of two widths, whose slopes are those of an
/// isotropic law, stretched along both axes.

#pragma once

#include "rules.h"

#include <regain/closures/vector.h>
#include <regain/luts/slope_law.h>

#include <algorithm>
#include <cmath>

REGAIN_NAMESPACE_BEGIN
namespace luts {

/// A law whose slopes along x are stretched, those along y shrunk by the same factor.
struct StretchedLaw
{
    SlopeLaw law;
    double stretch;

    double projected_area(const Vec3<double>& w) const
    {
        const double x = stretch * w.x, y = w.y / stretch;
        const double length = std::sqrt(x * x + y * y + w.z * w.z);
        return length * law.projected_area(std::min(1.0, w.z / length));
    }
};

/// Integrates over all slopes that reflect wo upwards; `add` is given the weight of one of them, in
/// units of the albedo, and the direction that it reflects to. wo is unit, wo.z in (0, 1].
template <class Add>
void integrate_stretched_slopes(const StretchedLaw& d, const Vec3<double>& wo, int nodes,
                                const Add& add)
{
    const QuadratureRule& rule = rule_of(nodes);
    const double pi = std::acos(-1.0), alpha = d.law.alpha();
    const double sigma_o = d.projected_area(wo);

    // One slope, before stretching (P, Q) of length rho.
    const auto slope = [&](double P, double Q, double rho, double area) {
        const double p = d.stretch * P, q = Q / d.stretch, scale = 1 / (1 + p * p + q * q);
        const double facing = wo.z + p * wo.x + q * wo.y, mu_i = 2 * facing * scale - wo.z;
        if (facing <= 0 || mu_i <= 0) return;
        const Vec3<double> wi(2 * facing * scale * p - wo.x, 2 * facing * scale * q - wo.y,
                              std::min(mu_i, 1.0));
        const double sigma_i = d.projected_area(wi);
        add(area * d.law.density(rho) * facing * mu_i /
                (sigma_o * mu_i + sigma_i * wo.z - wo.z * mu_i),
            wi);
    };

    // Along a ray as in upward_slopes.h; its end depends on the way.
    const double bend = d.law.heavy_tailed() ? 1.0 : alpha;
    const auto along = [&](double c, double s, double dphi) {
        const double p = d.stretch * c, q = s / d.stretch;
        const double a = p * p + q * q, b = (p * wo.x + q * wo.y) / wo.z;
        const double root = std::sqrt(b * b + a);
        const double edge = std::min(b > 0 ? (b + root) / a : 1 / (root - b), d.law.longest());
        for (std::size_t i = 0; i < rule.x.size(); ++i)
        {
            const double x = rule.x[i], near_edge = x * x * x, d_near_edge = 3 * x * x;
            const double weight = rule.weight[i] * dphi;
            const auto at = [&](double rho, double drho) {
                slope(rho * c, rho * s, rho, weight * drho * rho);
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
                const double outer = bend / edge, w = outer + (1 - outer) * near_edge;
                at(bend / w, (1 - outer) * d_near_edge * bend / (w * w));
            }
        }
    };

    // About the circle, half stretched: what lies about the narrow axis is neither crowded before
    // stretching nor what lies about the wide one after. Four pieces, from across wo, where nodes
    // gather, to along it and away from it.
    const double k = d.stretch;
    const auto turned = [&](double phi) { return std::atan2(std::sin(phi), k * std::cos(phi)); };
    const double ahead = std::atan2(wo.y / d.stretch, wo.x * d.stretch);
    for (const double side : {-1.0, 1.0})
        for (const bool away : {false, true})
        {
            const double end = turned(ahead + (away ? pi : 0));
            double span = turned(ahead + side * 0.5 * pi) - end;
            // The shorter way round.
            span -= 2 * pi * std::round(span / (2 * pi));
            for (std::size_t j = 0; j < rule.x.size(); ++j)
            {
                const double x = rule.x[j], angle = end + span * (1 - x * x * x);
                const double c = std::cos(angle), s = k * std::sin(angle), n = std::hypot(c, s);
                along(c / n, s / n, rule.weight[j] * std::abs(span) * 3 * x * x * k / (n * n));
            }
        }
}

}  // namespace luts
REGAIN_NAMESPACE_END
