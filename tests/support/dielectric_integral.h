// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Integrals of what a rough dielectric answers over all directions on both sides, good to 1e-5 for
/// lobes of any width. They are taken over the slopes of the facets, in polar coordinates stretched
/// by the widths of the lobe, so that the nodes lie where the lobe is:
///     dwi = 4 (wo.m) dm reflected,  dwi = |wo.m + eta_o wi.m|^2 / (eta_o^2 |wi.m|) dm refracted
/// (Walter et al. 2007, Eqs. 14 and 17), dm = m_z^3 dp dq. Along each ray from slope 0 the range is
/// cut where a facet turns away from wo, reflects totally, or scatters along the horizon. Nothing
/// of the closures is used but their vectors.

#pragma once

#include <regain/closures/vector.h>
#include <regain/luts/quadrature.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace regain::tests {

/// A facet and where it sends wo; directions as the closure sees them.
struct FacetPaths
{
    double facing = 0;  ///< wo.m
    double refracted_cosine = 0;
    Vec3<double> reflected, refracted;
    double reflected_jacobian = 0, refracted_jacobian = 0;  ///< dwi / dm; 0 where impossible
};

/// eta_o: index ahead of wo over index behind it. wo.z > 0.
inline FacetPaths facet_paths(const Vec3<double>& wo, const Vec3<double>& m, double eta_o)
{
    FacetPaths paths;
    const double c = paths.facing = wo.dot(m);
    paths.reflected = m * (2 * c) - wo;
    if (c > 0 && paths.reflected.z > 0) paths.reflected_jacobian = 4 * c;

    const double cos2 = 1 - (1 - c * c) / (eta_o * eta_o);
    if (c > 0 && cos2 > 0)
    {
        const double t = paths.refracted_cosine = std::sqrt(cos2);
        paths.refracted = m * (c / eta_o - t) - wo * (1 / eta_o);
        const double slide = c - eta_o * t;
        if (paths.refracted.z < 0) paths.refracted_jacobian = slide * slide / (eta_o * eta_o * t);
    }
    return paths;
}

/// The integral over facets of f(m, dm): the sum over nodes, each of the solid angle dm. wo.z > 0.
template <class F>
void for_each_facet(const Vec3<double>& wo, double eta_o, double alpha_x, double alpha_y,
                    int azimuths, int nodes, const F& f)
{
    static thread_local luts::QuadratureRule rule, round;
    if (static_cast<int>(rule.x.size()) != nodes) rule = luts::gauss_legendre(nodes);
    if (static_cast<int>(round.x.size()) != azimuths) round = luts::gauss_legendre(azimuths);

    const double kappa2 = 1 - eta_o * eta_o, pi = std::acos(-1.0);
    const double azimuth = std::atan2(wo.y * alpha_y, wo.x * alpha_x);
    for (int quarter = 0; quarter < 4; ++quarter)
        for (std::size_t j = 0; j < round.x.size(); ++j)
        {
            // Nodes gather where the ray points along the edge of the facets that face wo.
            const double x = round.x[j], offset = 0.5 * pi * x * x, dphi = pi * x;
            const double base = quarter < 2 ? 0.5 * pi : -0.5 * pi;
            const double phi = azimuth + base + (quarter % 2 == 0 ? offset : -offset);
            const double dp = alpha_x * std::cos(phi), dq = alpha_y * std::sin(phi);
            const auto normal = [&](double r) {
                // Slopes are rho = r / (1 - r) times the widths.
                return Vec3<double>(dp * r, dq * r, 1 - r).normalized();
            };

            // What changes sign where the range is to be cut.
            const auto cut = [&](double r, int which) {
                const Vec3<double> m = normal(r);
                const double c = wo.dot(m);
                if (which == 0) return c;
                if (which == 1) return c > 0 ? c * c - kappa2 : -1.0;
                const FacetPaths paths = facet_paths(wo, m, eta_o);
                if (which == 2) return paths.reflected.z;
                return paths.refracted_cosine > 0 ? -paths.refracted.z : -1.0;
            };
            std::vector<double> edges{0.0, 0.5, 1.0};
            constexpr int steps = 48;
            for (int which = 0; which < 4; ++which)
                for (int i = 0; i < steps; ++i)
                {
                    double a = double(i) / steps, b = double(i + 1) / steps;
                    if ((cut(a, which) > 0) == (cut(b, which) > 0)) continue;
                    const bool first = cut(a, which) > 0;
                    for (int k = 0; k < 50; ++k)
                    {
                        const double mid = 0.5 * (a + b);
                        ((cut(mid, which) > 0) == first ? a : b) = mid;
                    }
                    edges.push_back(0.5 * (a + b));
                }
            std::sort(edges.begin(), edges.end());

            for (std::size_t e = 0; e + 1 < edges.size(); ++e)
            {
                const double a = edges[e], width = edges[e + 1] - a;
                if (width < 1e-14) continue;
                for (std::size_t i = 0; i < rule.x.size(); ++i)
                {
                    // Nodes gather at both ends, where square roots begin.
                    const double y = rule.x[i];
                    const double r = a + width * y * y * (3 - 2 * y), w = 6 * y * (1 - y) * width;
                    const Vec3<double> m = normal(r);
                    const double rho = r / (1 - r), drho = w / ((1 - r) * (1 - r));
                    const double dm = rule.weight[i] * round.weight[j] * dphi * rho * drho *
                                      alpha_x * alpha_y * m.z * m.z * m.z;
                    if (wo.dot(m) > 0) f(m, dm);
                }
            }
        }
}

/// Sums of f(wi) over the directions wi that are reflected and refracted.
struct DielectricIntegral
{
    double reflected = 0, transmitted = 0;
};

/// eta: index on the -z side over index on the +z side; wo on either side.
template <class F>
DielectricIntegral integrate_dielectric(const Vec3<double>& wo, double eta, double alpha_x,
                                        double alpha_y, int azimuths, int nodes, const F& f)
{
    const double side = wo.z < 0 ? -1 : 1, eta_o = wo.z < 0 ? 1 / eta : eta;
    const auto turned = [&](const Vec3<double>& w) { return Vec3<double>(w.x, w.y, side * w.z); };
    const Vec3<double> up = turned(wo);
    DielectricIntegral sum;
    for_each_facet(
        up, eta_o, alpha_x, alpha_y, azimuths, nodes, [&](const Vec3<double>& m, double dm) {
            const FacetPaths paths = facet_paths(up, m, eta_o);
            if (paths.reflected_jacobian > 0)
                sum.reflected += f(turned(paths.reflected)) * paths.reflected_jacobian * dm;
            if (paths.refracted_jacobian > 0)
                sum.transmitted += f(turned(paths.refracted)) * paths.refracted_jacobian * dm;
        });
    return sum;
}

}  // namespace regain::tests
