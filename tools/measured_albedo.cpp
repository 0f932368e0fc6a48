// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "measured_albedo.h"

#include "hemisphere.h"
#include "random_numbers.h"

#include <cmath>

namespace regain::tools {
namespace {

constexpr int fine_nodes = 64, coarse_nodes = 32;

double largest(const ColorD& c) { return std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z)}); }

template <class Real>
Vec3<Real> rounded(const Imath::V3d& w)
{
    return {static_cast<Real>(w.x), static_cast<Real>(w.y), static_cast<Real>(w.z)};
}

MeasuredAlbedo difference(const MeasuredAlbedo& a, const MeasuredAlbedo& b)
{
    return {a.reflect - b.reflect, a.transmit - b.transmit, std::nullopt};
}

void add(MeasuredAlbedo& sum, const MeasuredAlbedo& part, double weight)
{
    sum.reflect += part.reflect * weight;
    sum.transmit += part.transmit * weight;
}

// What the delta lobes reflect and transmit: their directions have no density, so that eval does
// not know them. Which of them is chosen depends on u.
template <class Prepared>
MeasuredAlbedo delta_part(const Prepared& prepared)
{
    using Vector = std::decay_t<decltype(prepared.wo())>;
    using Real = typename Vector::BaseType;
    constexpr int n = 32;
    MeasuredAlbedo sum;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
        {
            const auto s = prepared.sample(
                {static_cast<Real>((i + 0.5) / n), static_cast<Real>((j + 0.5) / n)});
            if (!(s.valid && s.delta)) continue;
            (s.transmitted ? sum.transmit : sum.reflect) += ColorD(s.weight) * (1.0 / (n * n));
        }
    return sum;
}

template <class Closure>
MeasuredAlbedo by_quadrature(const Closure& closure, const Imath::V3d& wo, int nodes)
{
    using Real = typename Closure::Real;
    const auto prepared = closure.prepare(rounded<Real>(wo));
    const auto& distribution = closure.lobe().distribution();
    if (distribution.is_delta()) return delta_part(prepared);
    MeasuredAlbedo albedo;
    albedo.reflect = integrate_reflection(
        wo, distribution.alpha_x(), distribution.alpha_y(), nodes,
        [&](const Imath::V3d& wi) { return prepared.eval(rounded<Real>(wi)); });
    return albedo;
}

// The mean of `samples` weights and its standard error; `draw` makes one sample.
template <class Draw>
MeasuredAlbedo mean_weight(std::uint64_t samples, const Draw& draw)
{
    // Running means and squares (Welford): sums of 1e8 equal weights would lose digits.
    MeasuredAlbedo mean;
    ColorD squares(0.0);
    for (std::uint64_t i = 1; i <= samples; ++i)
    {
        const auto s = draw();
        const ColorD weight(s.weight), zero(0.0);
        const ColorD before = mean.reflect + mean.transmit;
        const double part = 1.0 / static_cast<double>(i);
        mean.reflect += ((s.transmitted ? zero : weight) - mean.reflect) * part;
        mean.transmit += ((s.transmitted ? weight : zero) - mean.transmit) * part;
        squares += (weight - before) * (weight - mean.reflect - mean.transmit);
    }
    const double n = static_cast<double>(samples);
    mean.error = std::sqrt(largest(squares) / (n * (n - 1)));
    return mean;
}

template <class Closure>
MeasuredAlbedo measure(const Closure& closure, const Imath::V3d& wo, const AlbedoSettings& settings)
{
    using Real = typename Closure::Real;
    switch (settings.how)
    {
        case AlbedoMethod::table: {
            const auto albedo = closure.albedo(rounded<Real>(wo));
            return {ColorD(albedo.reflect), ColorD(albedo.transmit), std::nullopt};
        }
        case AlbedoMethod::quadrature: {
            MeasuredAlbedo fine = by_quadrature(closure, wo, fine_nodes);
            const MeasuredAlbedo off = difference(fine, by_quadrature(closure, wo, coarse_nodes));
            fine.error = std::max(largest(off.reflect), largest(off.transmit));
            return fine;
        }
        case AlbedoMethod::monte_carlo: break;
    }
    RandomNumbers random(settings.seed);
    const auto prepared = closure.prepare(rounded<Real>(wo));
    return mean_weight(settings.samples, [&] {
        const Real u = random.template next<Real>(), v = random.template next<Real>();
        return prepared.sample({u, v});
    });
}

// 2 int E mu dmu over the cosine and the mean over the azimuth, by a rule of `nodes` cosines.
template <class E>
MeasuredAlbedo averaged(bool isotropic, int nodes, const E& albedo_at)
{
    const luts::QuadratureRule& rule = gauss_rule(nodes);
    // The lobe is symmetric about both axes, and smooth and periodic in the azimuth.
    const int azimuths = isotropic ? 1 : nodes / 2;
    const double quarter = std::acos(0.0);
    MeasuredAlbedo sum;
    for (int k = 0; k < azimuths; ++k)
        for (std::size_t i = 0; i < rule.x.size(); ++i)
        {
            // mu = x^3 gathers cosines at grazing angles, where the albedo dips.
            const double x = rule.x[i], mu = x * x * x;
            const double phi = isotropic ? 0 : quarter * (k + 0.5) / azimuths;
            add(sum, albedo_at(direction_at(mu, phi)),
                rule.weight[i] * 3 * x * x * 2 * mu / azimuths);
        }
    return sum;
}

template <class Closure>
MeasuredAlbedo measure_average(const Closure& closure, const AlbedoSettings& settings)
{
    using Real = typename Closure::Real;
    const bool isotropic = !closure.traits().anisotropic;
    switch (settings.how)
    {
        case AlbedoMethod::table:
            return averaged(isotropic, 32, [&](const Imath::V3d& wo) {
                const auto albedo = closure.albedo(rounded<Real>(wo));
                return MeasuredAlbedo{ColorD(albedo.reflect), ColorD(albedo.transmit),
                                      std::nullopt};
            });
        case AlbedoMethod::quadrature: {
            const auto by = [&](int cosines, int nodes) {
                return averaged(isotropic, cosines, [&](const Imath::V3d& wo) {
                    return by_quadrature(closure, wo, nodes);
                });
            };
            MeasuredAlbedo fine = by(24, fine_nodes / 2);
            const MeasuredAlbedo off = difference(fine, by(16, coarse_nodes / 2));
            fine.error = std::max(largest(off.reflect), largest(off.transmit));
            return fine;
        }
        case AlbedoMethod::monte_carlo: break;
    }
    RandomNumbers random(settings.seed);
    const double turn = 4 * std::acos(0.0);
    return mean_weight(settings.samples, [&] {
        // Cosine-weighted directions.
        const double mu = std::sqrt(1 - random.next<double>());
        const double phi = turn * random.next<double>();
        const Real u = random.template next<Real>(), v = random.template next<Real>();
        return closure.sample(rounded<Real>(direction_at(mu, phi)), {u, v});
    });
}

}  // namespace

Imath::V3d direction_at(double mu, double phi)
{
    const double sine = std::sqrt((1 - mu) * (1 + mu));
    return {sine * std::cos(phi), sine * std::sin(phi), mu};
}

MeasuredAlbedo measured_albedo(const ClosureSpec& spec, const Imath::V3d& wo,
                               const AlbedoSettings& settings)
{
    return with_closure(spec, [&](const auto& closure) { return measure(closure, wo, settings); });
}

MeasuredAlbedo measured_average_albedo(const ClosureSpec& spec, const AlbedoSettings& settings)
{
    return with_closure(spec,
                        [&](const auto& closure) { return measure_average(closure, settings); });
}

}  // namespace regain::tools
