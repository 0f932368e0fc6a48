// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Integrals over all directions into which a rough surface reflects wo,
///
///   int f(wi) dwi = int f(wi(m)) 4 (wo.m) m_z^3 dp dq,    m = (p, q, 1) / |(p, q, 1)|
///
/// over the slopes p = m_x / m_z, q = m_y / m_z of the half-vector: there a lobe has the same shape
/// at every alpha and angle. The slopes that reflect wo upwards fill the disc of radius
/// 1 / cos theta_o about t = (wo_x, wo_y) / cos theta_o. It is integrated in polar coordinates
/// about slope 0, where a microfacet distribution peaks, in slopes divided by alpha.
///
/// f is any function of wi, so that what is integrated are the answers of a closure and nothing
/// else: the mapping knows alpha only to put its nodes where the light is.

#pragma once

#include "json_fields.h"

#include <regain/luts/quadrature.h>

#include <algorithm>
#include <cmath>

namespace regain::tools {

/// The Gauss-Legendre rule of n nodes, computed once.
const luts::QuadratureRule& gauss_rule(int n);

/// Angles in slope space about which the integrand changes fast, and between which it is smooth:
/// where the edge of the disc comes in from far away, at right angles to t; and where the longer
/// axis of an anisotropic lobe is crossed.
std::vector<double> slope_sectors(const Imath::V2d& t, double alpha_x, double alpha_y);

/// wo is unit; the result is 0 for one below the horizon. `nodes` along each of two pieces of a
/// radius and across each of 4 to 8 sectors.
template <class F>
ColorD integrate_reflection(const Imath::V3d& wo, double alpha_x, double alpha_y, int nodes,
                            const F& f)
{
    ColorD sum(0.0);
    if (!(wo.z > 0)) return sum;

    const luts::QuadratureRule& rule = gauss_rule(nodes);
    const Imath::V2d t(wo.x / wo.z, wo.y / wo.z);

    // One slope (p, q), with all that depends on it but the area of slopes.
    const auto at = [&](double p, double q) {
        const double inv_length2 = 1 / (1 + p * p + q * q);
        const double facing = wo.x * p + wo.y * q + wo.z;  // wo.m |(p, q, 1)|
        const double twice = 2 * facing * inv_length2;
        const Imath::V3d wi(twice * p - wo.x, twice * q - wo.y, twice - wo.z);
        if (!(facing > 0 && wi.z > 0)) return ColorD(0.0);
        return ColorD(f(wi)) * (4 * facing * inv_length2 * inv_length2);
    };

    // Along one direction d of stretched slopes. With r = |slope / alpha|: inside 1 the integrand
    // is smooth in r; outside it, in w = 1 / r, r dr = dw / w^3. Nodes gather at the edge, where
    // light leaves at grazing angles.
    const auto along = [&](double phi) {
        const Imath::V2d d(alpha_x * std::cos(phi), alpha_y * std::sin(phi));
        const double a = d.dot(d), b = t.dot(d), root = std::sqrt(b * b + a);
        const double edge = b > 0 ? (b + root) / a : 1 / (root - b);
        const double inner = std::min(edge, 1.0), outer = 1 / edge;
        ColorD ray(0.0);
        for (std::size_t i = 0; i < rule.x.size(); ++i)
        {
            const double x = rule.x[i], near = x * x * x, d_near = 3 * x * x;
            if (outer < 1)
            {
                ray += at(x * d.x, x * d.y) * (rule.weight[i] * x);
                const double w = outer + (1 - outer) * near;
                ray += at(d.x / w, d.y / w) * (rule.weight[i] * (1 - outer) * d_near / (w * w * w));
            }
            else
            {
                const double r = inner * (1 - near);
                ray += at(r * d.x, r * d.y) * (rule.weight[i] * inner * d_near * r);
            }
        }
        return ray;
    };

    // Across each sector, nodes gathered at both of its sides.
    const std::vector<double> sides = slope_sectors(t, alpha_x, alpha_y);
    for (std::size_t s = 0; s + 1 < sides.size(); ++s)
        for (std::size_t j = 0; j < rule.x.size(); ++j)
        {
            const double x = rule.x[j], x2 = x * x, width = sides[s + 1] - sides[s];
            const double place = x2 * x * (10 - 15 * x + 6 * x2);
            const double d_place = 30 * x2 * (1 - x) * (1 - x);
            sum += along(sides[s] + width * place) * (rule.weight[j] * width * d_place);
        }
    return sum * (alpha_x * alpha_y);
}

}  // namespace regain::tools
