// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/luts/anisotropic_albedo.h>

#include "rules.h"

#include <algorithm>
#include <array>
#include <cmath>

REGAIN_NAMESPACE_BEGIN
namespace luts {

double anisotropic_albedo(const SlopeLaw& law, double stretch_x, double stretch_y,
                          const Vec3<double>& w, int nodes)
{
    const QuadratureRule& rule = rule_of(nodes);
    const double pi = std::acos(-1.0), alpha = law.alpha();
    const auto projected_area = [&](double x, double y, double z) {
        x *= stretch_x, y *= stretch_y;
        const double length = std::sqrt(x * x + y * y + z * z);
        return length * law.projected_area(std::min(1.0, z / length));
    };
    const double sigma_o = projected_area(w.x, w.y, w.z);

    // Along the slopes rho (p, q), (p, q) being (cos phi, sin phi) stretched.
    double sum = 0;
    const auto along = [&](double phi, double dphi) {
        const double p = stretch_x * std::cos(phi), q = stretch_y * std::sin(phi);
        const double a = p * p + q * q, b = (p * w.x + q * w.y) / w.z;
        const auto slope = [&](double rho, double drho) {
            const double scale = 1 / (1 + rho * rho * a);
            const double facing = w.z + rho * (p * w.x + q * w.y);
            const double mu_i = 2 * facing * scale - w.z;
            if (facing <= 0 || mu_i <= 0) return;
            const double sigma_i = projected_area(2 * facing * scale * rho * p - w.x,
                                                  2 * facing * scale * rho * q - w.y, mu_i);
            sum += dphi * drho * rho * law.density(rho) * facing * mu_i /
                   (sigma_o * mu_i + sigma_i * w.z - w.z * mu_i);
        };
        // Those that reflect upwards end at the far root of a rho^2 - 2 b rho - 1 = 0. Pieces and
        // nodes are those of upward_slopes.h; true slopes of 1 matter, and the law's own.
        const double root = std::sqrt(b * b + a);
        const double edge = std::min(b > 0 ? (b + root) / a : 1 / (root - b), law.longest());
        const double bend = law.heavy_tailed() ? std::max(1.0, 1 / std::sqrt(a)) : alpha;
        for (std::size_t i = 0; i < rule.x.size(); ++i)
        {
            const double x = rule.x[i], weight = rule.weight[i];
            const double near_edge = x * x * x, d_near_edge = 3 * x * x * weight;
            if (edge <= alpha)
            {
                slope(edge * (1 - near_edge), edge * d_near_edge);
                continue;
            }
            slope(alpha * x, alpha * weight);
            if (bend > alpha)
            {
                const double range = std::log(std::min(edge, bend) / alpha);
                const bool last = edge <= bend;
                const double rho = alpha * std::exp(range * (last ? 1 - near_edge : x));
                slope(rho, rho * range * (last ? d_near_edge : weight));
            }
            if (edge > bend)
            {
                const double outer = bend / edge, v = outer + (1 - outer) * near_edge;
                slope(bend / v, (1 - outer) * d_near_edge * bend / (v * v));
            }
        }
    };

    // Nodes gather across w, where at grazing angles the edge comes in from far away, and along the
    // axes, next to which stretched slopes grow steeply.
    const double across = std::atan2(w.y * stretch_y, w.x * stretch_x) + 0.5 * pi;
    std::array<double, 7> limits{across, across + pi, 0, 0.5 * pi, pi, 1.5 * pi};
    for (double& phi : limits) phi -= 2 * pi * std::floor(phi / (2 * pi));
    std::sort(limits.begin(), limits.end() - 1);
    limits.back() = limits.front() + 2 * pi;
    for (std::size_t i = 0; i + 1 < limits.size(); ++i)
    {
        const double length = limits[i + 1] - limits[i];
        if (length < 1e-7) continue;
        for (std::size_t j = 0; j < rule.x.size(); ++j)
        {
            const double x = rule.x[j], smooth = x * x * x * (10 - 15 * x + 6 * x * x),
                         slope = 30 * x * x * (1 - x) * (1 - x);
            along(limits[i] + length * smooth, length * slope * rule.weight[j]);
        }
    }
    return sum;
}

}  // namespace luts
REGAIN_NAMESPACE_END
