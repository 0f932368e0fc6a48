// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What the tests of dielectrics share: sums over samples, the textbook's interface, and tables of
/// a single interface.

#pragma once

#include "closures.h"
#include "dielectric_integral.h"
#include "properties.h"

#include <regain/closures/dielectric_gain.h>

#include <vector>

namespace regain::tests {

template <class Real>
using Glass = Dielectric<GGX<Real>>;

template <class Real>
Glass<Real> glass(double alpha, double eta,
                  TransmissionShadowing shadowing = TransmissionShadowing::correlated,
                  ScatterMode mode = ScatterMode::RT)
{
    const Color3<Real> white(Real(1));
    return {GGX<Real>(Real(alpha)), Real(eta), mode, white, white, shadowing};
}

inline Vec3<double> sided(double mu, double azimuth = 0)
{
    auto w = direction<double>(std::abs(mu), azimuth);
    if (mu < 0) w.z = -w.z;
    return w;
}

/// The Hammersley points of the unit cube, i of n.
inline Vec3<double> hammersley(int i, int n)
{
    const auto radical_inverse = [i](int base) {
        double digit = 1, value = 0;
        for (int rest = i; rest > 0; rest /= base) value += (digit /= base) * (rest % base);
        return value;
    };
    return {radical_inverse(3), (i + 0.5) / n, radical_inverse(2)};
}

/// Shares of all samples that come to nothing, that are delta; mean weights.
struct SampleSums
{
    double nothing = 0, delta = 0;
    double reflected = 0, transmitted = 0;              ///< mean weight, first channel
    double delta_reflected = 0, delta_transmitted = 0;  ///< of which by delta lobes
};

template <class Prepared>
SampleSums sum_samples(const Prepared& prepared, int n)
{
    using Real = decltype(prepared.pdf({}));
    SampleSums sums;
    for (int i = 0; i < n; ++i)
    {
        const auto s = prepared.sample(Vec3<Real>(hammersley(i, n)));
        if (!s.valid) sums.nothing += 1.0 / n;
        if (s.delta) sums.delta += 1.0 / n;
        (s.transmitted ? sums.transmitted : sums.reflected) += s.weight.x / n;
        if (s.delta)
            (s.transmitted ? sums.delta_transmitted : sums.delta_reflected) += s.weight.x / n;
    }
    return sums;
}

/// pdf and eval of a prepared closure (first channel) over all directions.
template <class Prepared>
DielectricIntegral integrals(const Prepared& prepared, const Vec3<double>& wo, double eta,
                             double alpha_x, double alpha_y, double tolerance = 1e-5)
{
    using Real = decltype(prepared.pdf({}));
    return integrate_dielectric(wo, eta, alpha_x, alpha_y, tolerance, [&](const auto& wi) {
        const Vec3<Real> w(wi);
        return Vec2<double>(prepared.pdf(w), prepared.eval(w).x);
    });
}

/// E^R and E^T of a GGX interface by the textbook's formulas, none of them the closures'.
inline Vec2<double> textbook_albedo(double mu, double alpha, double eta_o, bool beta)
{
    const auto wo = direction<double>(mu);
    const auto lambda = [&](const Vec3<double>& w) {
        const double tan2 = (w.x * w.x + w.y * w.y) / (w.z * w.z);
        return 0.5 * (std::sqrt(1 + alpha * alpha * tan2) - 1);
    };
    const double Lo = lambda(wo), pi = std::acos(-1.0);
    const auto E = integrate_facets(wo, eta_o, alpha, alpha, 1e-5, [&](const Vec3<double>& m) {
        const FacetPaths paths = facet_paths(wo, m, eta_o);
        const double c = paths.facing, t = paths.refracted_cosine;
        const double s = (c - eta_o * t) / (c + eta_o * t), p = (eta_o * c - t) / (eta_o * c + t);
        const double F = t > 0 ? 0.5 * (s * s + p * p) : 1;
        const double root = m.z * m.z * (alpha * alpha - 1) + 1;
        const double seen = c * alpha * alpha / (pi * root * root) / mu;  // D (wo.m) / cos_o
        DielectricIntegral value;
        if (paths.reflected.z > 0)
            value.reflected.x = seen * F / (1 + Lo + lambda(paths.reflected));
        if (t > 0 && paths.refracted.z < 0)
        {
            const double Li = lambda(paths.refracted);
            const double G =
                beta
                    ? std::exp(std::lgamma(1 + Lo) + std::lgamma(1 + Li) - std::lgamma(2 + Lo + Li))
                    : 1 / (1 + Lo + Li);
            value.transmitted.x = seen * (1 - F) * G;
        }
        return value;
    });
    return {E.reflected.x, E.transmitted.x};
}

/// Tables that hold one alpha and index, from either side, by quadrature of the textbook's
/// interface.
class TablesOfOne
{
public:
    TablesOfOne(double alpha, double eta, bool beta = false)
    {
        const double outside = eta < 1 ? 1 / eta : eta;
        for (int side = 0; side < 2; ++side)
        {
            const double eta_o = side == 0 ? outside : 1 / outside;
            for (int i = 0; i < width; ++i)
            {
                const double x = double(i) / (width - 1);
                double low = 1e-4, high = 1;
                for (int k = 0; k < 60; ++k)
                {
                    const double mu = 0.5 * (low + high);
                    const double at =
                        side == 0 ? stretched_cosine(mu, alpha)
                                  : regain::detail::critical_cosine_coordinate(mu, alpha, eta_o);
                    (at < x ? low : high) = mu;
                }
                const double mu = 0.5 * (low + high);
                const auto E = textbook_albedo(mu, alpha, eta_o, beta);
                const double share =
                    E.x / (E.x + E.y) - regain::detail::fresnel_weight(alpha, eta_o) *
                                            DielectricFresnel<double>(eta_o).reflectance(mu);
                for (int k = 0; k < 4; ++k)
                {
                    _E[side][k * width + i] = stored(E.x + E.y);
                    _R[side][k * width + i] = stored(0.5 * (share + 1));
                }
            }
        }
    }

    DielectricTables tables() const
    {
        DielectricTables t;
        for (int side = 0; side < 2; ++side)
        {
            t.E[side] = {_E[side], width, 2, 2};
            t.R[side] = {_R[side], width, 2, 2, -1.0f, 2.0f / 65535};
        }
        return t;
    }

private:
    static constexpr int width = 63;
    static std::uint16_t stored(double v) { return std::uint16_t(std::lround(65535 * v)); }
    std::uint16_t _E[2][4 * width], _R[2][4 * width];
};

}  // namespace regain::tests
