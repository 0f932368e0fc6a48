// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Integrals of what a rough dielectric answers over all directions on both sides, for lobes of any
/// width. They are taken over the slopes of the facets, in polar coordinates stretched
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
#include <functional>
#include <vector>

namespace regain::tests {

/// A facet and where it sends wo; directions as the closure sees them.
struct FacetPaths
{
    double facing = 0;  ///< wo.m
    double refracted_cosine = 0;
    Vec3<double> reflected{0.0}, refracted{0.0};
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

/// Two quantities at a time, over the directions that are reflected and those that are refracted.
struct DielectricIntegral
{
    Vec2<double> reflected{0, 0}, transmitted{0, 0};

    double operator[](int i) const { return i < 2 ? reflected[i] : transmitted[i - 2]; }
    void add(const DielectricIntegral& other, double weight)
    {
        reflected += other.reflected * weight;
        transmitted += other.transmitted * weight;
    }
};

// Along the ray of azimuth phi in the stretched plane of slopes, rho drho. `at(m)` is the integrand
// per dm.
template <class F>
DielectricIntegral along_ray(const Vec3<double>& wo, double eta_o, double alpha_x, double alpha_y,
                             double phi, const F& at)
{
    static const luts::QuadratureRule rule = luts::gauss_legendre(14);
    const double dp = alpha_x * std::cos(phi), dq = alpha_y * std::sin(phi);
    const double kappa2 = 1 - eta_o * eta_o;
    // Slopes are rho = r / rest times the widths, rest = 1 - r.
    const auto facet = [&](double r, double rest) {
        return Vec3<double>(dp * r, dq * r, rest).normalized();
    };
    const auto normal = [&](double r) { return facet(r, 1 - r); };

    // Bits that change where the range is to be cut.
    const auto state = [&](double r) {
        const Vec3<double> m = normal(r);
        const double c = wo.dot(m);
        if (c <= 0) return 0;
        const FacetPaths paths = facet_paths(wo, m, eta_o);
        return 1 + 2 * (c * c > kappa2) + 4 * (paths.reflected.z > 0) + 8 * (paths.refracted.z < 0);
    };
    std::vector<double> edges{0.0, 0.5, 1.0};
    constexpr int steps = 64;
    int before = state(0);
    for (int i = 0; i < steps; ++i)
    {
        const int after = state(double(i + 1) / steps);
        // A few edges may lie in one step; where rounding decides a state they seem to be many.
        double a = double(i) / steps;
        int seen = before;
        for (int found = 0; found < 4 && seen != after; ++found)
        {
            double b = double(i + 1) / steps;
            for (int k = 0; k < 46; ++k)
            {
                const double middle = 0.5 * (a + b);
                (state(middle) == seen ? a : b) = middle;
            }
            edges.push_back(0.5 * (a + b));
            a = b;
            seen = state(b);
        }
        before = after;
    }
    std::sort(edges.begin(), edges.end());

    DielectricIntegral sum;
    const auto add = [&](double r, double rest, double w) {
        const Vec3<double> m = facet(r, rest);
        if (wo.dot(m) > 0)
            sum.add(at(m), alpha_x * alpha_y * m.z * m.z * m.z * r / (rest * rest * rest) * w);
    };
    for (std::size_t e = 0; e + 1 < edges.size(); ++e)
    {
        const double a = edges[e], width = edges[e + 1] - a;
        if (width < 1e-13 || state(a + 0.5 * width) == 0) continue;
        const bool last = e + 2 == edges.size();
        const double end = last ? 0.5 * width : 0, body = width - end;
        for (std::size_t i = 0; i < rule.x.size(); ++i)
        {
            // Nodes gather at both ends, where square roots begin.
            const double y = rule.x[i], r = a + body * y * y * (3 - 2 * y);
            add(r, 1 - r, rule.weight[i] * 6 * y * (1 - y) * body);
        }
        if (!last) continue;
        // What steep facets refract goes like rest^(2g - 4) for D like rho^-2g, g > 3/2: nearly a
        // pole for the longest tails, of which no power of ten may be left out.
        constexpr double powers[] = {0, 3, 9, 18, 36};
        for (int piece = 0; piece < 4; ++piece)
            for (std::size_t i = 0; i < rule.x.size(); ++i)
            {
                const double length = powers[piece + 1] - powers[piece];
                const double rest = end * std::exp(-(powers[piece] + length * rule.x[i]));
                add(1 - rest, rest, rule.weight[i] * length * rest);
            }
    }
    return sum;
}

/// The integral over the facets that face wo, wo.z > 0, of at(m) per dm, within about `tolerance`.
template <class F>
DielectricIntegral integrate_facets(const Vec3<double>& wo, double eta_o, double alpha_x,
                                    double alpha_y, double tolerance, const F& at)
{
    static const luts::QuadratureRule rule = luts::gauss_legendre(5);
    const auto arc = [&](double from, double to) {
        DielectricIntegral sum;
        for (std::size_t i = 0; i < rule.x.size(); ++i)
            sum.add(along_ray(wo, eta_o, alpha_x, alpha_y, from + (to - from) * rule.x[i], at),
                    rule.weight[i] * (to - from));
        return sum;
    };
    // Halves an arc until its halves say the same.
    const std::function<DielectricIntegral(double, double, const DielectricIntegral&, int)>
        refined = [&](double from, double to, const DielectricIntegral& whole, int depth) {
            const double middle = 0.5 * (from + to);
            const DielectricIntegral left = arc(from, middle), right = arc(middle, to);
            double difference = 0;
            for (int k = 0; k < 4; ++k)
                difference = std::max(difference, std::abs(left[k] + right[k] - whole[k]));
            DielectricIntegral sum;
            if (difference < tolerance || depth == 0)
            {
                sum.add(left, 1);
                sum.add(right, 1);
            }
            else
            {
                sum.add(refined(from, middle, left, depth - 1), 1);
                sum.add(refined(middle, to, right, depth - 1), 1);
            }
            return sum;
        };
    const double azimuth = std::atan2(wo.y * alpha_y, wo.x * alpha_x), pi = std::acos(-1.0);
    DielectricIntegral sum;
    for (int i = 0; i < 4; ++i)
    {
        const double from = azimuth + 0.5 * pi * i, to = azimuth + 0.5 * pi * (i + 1);
        sum.add(refined(from, to, arc(from, to), 9), 1);
    }
    return sum;
}

/// The integral of f(wi), of two quantities, over the directions on both sides. eta: index on the
/// -z side over index on the +z side; wo on either side.
template <class F>
DielectricIntegral integrate_dielectric(const Vec3<double>& wo, double eta, double alpha_x,
                                        double alpha_y, double tolerance, const F& f)
{
    const double side = wo.z < 0 ? -1 : 1, eta_o = wo.z < 0 ? 1 / eta : eta;
    const auto turned = [&](const Vec3<double>& w) { return Vec3<double>(w.x, w.y, side * w.z); };
    const Vec3<double> up = turned(wo);
    return integrate_facets(up, eta_o, alpha_x, alpha_y, tolerance, [&](const Vec3<double>& m) {
        const FacetPaths paths = facet_paths(up, m, eta_o);
        DielectricIntegral value;
        if (paths.reflected_jacobian > 0)
            value.reflected = f(turned(paths.reflected)) * paths.reflected_jacobian;
        if (paths.refracted_jacobian > 0)
            value.transmitted = f(turned(paths.refracted)) * paths.refracted_jacobian;
        return value;
    });
}

}  // namespace regain::tests
