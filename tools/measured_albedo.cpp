// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "measured_albedo.h"

#include "errors.h"
#include "hemisphere.h"
#include "interface_integral.h"

#include <fmt/format.h>

#include <cmath>

namespace regain::tools {
namespace {

constexpr int fine_nodes = 64, coarse_nodes = 32;

double largest(const ColorD& c) { return std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z)}); }

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
// not know them. Which of two is chosen depends on the third number, and their pdfs are the
// probabilities of the choice.
MeasuredAlbedo delta_part(const AnyClosure& prepared)
{
    constexpr int n = 32;
    constexpr double last = 1 - 0x1p-24;
    MeasuredAlbedo sum;
    const auto count = [&](const Sample<double>& s) {
        (s.transmitted ? sum.transmit : sum.reflect) += s.weight * (s.pdf / (n * n));
    };
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
        {
            const double u = (i + 0.5) / n, v = (j + 0.5) / n;
            const auto first = prepared.sample({u, v, 0}), second = prepared.sample({u, v, last});
            if (first.valid && first.delta) count(first);
            const bool same = first.valid && first.transmitted == second.transmitted;
            if (second.valid && second.delta && !same) count(second);
        }
    return sum;
}

// `nodes` as in hemisphere.h; an interface's integral is refined until it is as good.
MeasuredAlbedo by_quadrature(AnyClosure& closure, const ClosureSpec& spec, const Imath::V3d& wo,
                             int nodes)
{
    closure.prepare(wo);
    const Traits traits = closure.traits();
    MeasuredAlbedo albedo;
    if (traits.delta) albedo = delta_part(closure);
    // A lobe without microfacets is as wide as they come.
    const double widest = spec.has_microfacets() ? 0 : 1, least = 1e-9;
    const double ax = std::max({spec.alpha_x, widest, least}),
                 ay = std::max({spec.alpha_y, widest, least});
    const auto eval = [&](const Imath::V3d& wi) { return closure.eval(wi); };

    if (!spec.has_two_sides())
    {
        albedo.reflect += integrate_reflection(wo, ax, ay, nodes, eval);
        return albedo;
    }
    if (spec.plain || spec.interface.thin_walled)
    {
        // A lobe on one side is as one on the other, turned.
        const auto turned = [](const Imath::V3d& w) { return Imath::V3d(w.x, w.y, -w.z); };
        const bool below = wo.z < 0;
        const Imath::V3d up = below ? turned(wo) : wo;
        albedo.reflect += integrate_reflection(
            up, ax, ay, nodes, [&](const Imath::V3d& wi) { return eval(below ? turned(wi) : wi); });
        albedo.transmit += integrate_reflection(
            up, ax, ay, nodes, [&](const Imath::V3d& wi) { return eval(below ? wi : turned(wi)); });
        return albedo;
    }
    const InterfaceIntegral both =
        integrate_interface(wo, spec.interface.eta, ax, ay, std::max(nodes, 48), eval);
    albedo.reflect += both.reflected;
    albedo.transmit += both.transmitted;
    return albedo;
}

// Mean and standard error of what `draw` returns, of which each is an Albedo.
template <class Draw>
MeasuredAlbedo mean_of(std::uint64_t samples, const Draw& draw)
{
    // Running means and squares (Welford): sums of 1e8 equal weights would lose digits.
    MeasuredAlbedo mean;
    ColorD squares(0.0);
    for (std::uint64_t i = 1; i <= samples; ++i)
    {
        const Albedo<double> s = draw();
        const ColorD before = mean.reflect + mean.transmit, weight = s.reflect + s.transmit;
        const double part = 1.0 / static_cast<double>(i);
        mean.reflect += (s.reflect - mean.reflect) * part;
        mean.transmit += (s.transmit - mean.transmit) * part;
        squares += (weight - before) * (weight - mean.reflect - mean.transmit);
    }
    const double n = static_cast<double>(samples);
    mean.error = std::sqrt(largest(squares) / (n * (n - 1)));
    return mean;
}

// What one sample says of the albedo.
Albedo<double> drawn(const AnyClosure& prepared, const Imath::V3d& u, std::optional<int> order)
{
    const ColorD zero(0.0);
    const Sample<double> s = prepared.sample(u);
    if (!s.valid || (order && prepared.bounces(u) != *order)) return {zero, zero};
    return s.transmitted ? Albedo<double>{zero, s.weight} : Albedo<double>{s.weight, zero};
}

// 2 int E mu dmu over the cosine and the mean over the azimuth, by a rule of `nodes` cosines on
// either side of `edge`, about which the albedo bends; 0: there is none.
template <class E>
MeasuredAlbedo averaged(bool isotropic, bool below, double edge, int nodes, const E& albedo_at)
{
    const luts::QuadratureRule& rule = gauss_rule(nodes);
    // The lobe is symmetric about both axes, and smooth and periodic in the azimuth.
    const int azimuths = isotropic ? 1 : nodes / 2;
    const double quarter = std::acos(0.0), side = below ? -1 : 1;
    MeasuredAlbedo sum;
    const auto at = [&](double mu, double weight) {
        for (int k = 0; k < azimuths; ++k)
        {
            const double phi = isotropic ? 0 : quarter * (k + 0.5) / azimuths;
            add(sum, albedo_at(direction_at(side * mu, phi)), weight * 2 * mu / azimuths);
        }
    };
    const double end = edge > 0 ? edge : 1;
    for (std::size_t i = 0; i < rule.x.size(); ++i)
    {
        // mu = x^3 gathers cosines at grazing angles, where the albedo dips.
        const double x = rule.x[i];
        at(end * x * x * x, rule.weight[i] * 3 * x * x * end);
        if (edge > 0) at(edge + (1 - edge) * x * x, rule.weight[i] * 2 * x * (1 - edge));
    }
    return sum;
}

// The cosine below which an interface reflects everything, as seen from this side; 0 if none.
double critical_cosine(const ClosureSpec& spec, bool below)
{
    if (spec.lobe != Lobe::dielectric || spec.interface.thin_walled) return 0;
    const double eta = below ? 1 / spec.interface.eta : spec.interface.eta;
    return eta < 1 ? std::sqrt((1 - eta) * (1 + eta)) : 0;
}

// Samples and values of transmitted light are wanted as energy.
ClosureSpec as_energy(ClosureSpec spec)
{
    spec.transport = Transport::importance;
    return spec;
}

}  // namespace

Imath::V3d direction_at(double mu, double phi)
{
    const double sine = std::sqrt((1 - mu) * (1 + mu));
    return {sine * std::cos(phi), sine * std::sin(phi), mu};
}

namespace {

// The added lobe of a dielectric goes where no facet refracts to, so the facets do not cover it.
bool adds_to_dielectric(const ClosureSpec& spec)
{
    return spec.lobe == Lobe::dielectric && (std::holds_alternative<KullaContyForm>(spec.method) ||
                                             std::holds_alternative<shaders::Tail>(spec.method));
}

}  // namespace

AlbedoMethod default_albedo_method(const ClosureSpec& spec)
{
    return spec.is_stochastic() || adds_to_dielectric(spec) || spec.combination
               ? AlbedoMethod::monte_carlo
               : AlbedoMethod::quadrature;
}

void require_possible(const ClosureSpec& spec, const AlbedoSettings& settings)
{
    if (settings.how == AlbedoMethod::quadrature && adds_to_dielectric(spec))
        throw BadInput(fmt::format(
            "how 'quadrature' does not reach all directions of the lobe that {} adds to a "
            "dielectric; accepted: monte-carlo, table",
            shaders::name(spec.method)));
    if (settings.how == AlbedoMethod::quadrature && spec.combination)
        throw BadInput(
            fmt::format("how 'quadrature' is made for one lobe, and {} combines several; accepted: "
                        "monte-carlo, "
                        "table",
                        name(spec.lobe)));
    if (!spec.is_stochastic()) return;
    if (settings.how == AlbedoMethod::quadrature)
        throw BadInput(
            "how 'quadrature' takes an eval that is no estimate; accepted for the "
            "method walk: monte-carlo, table");
    if (settings.order && settings.how != AlbedoMethod::monte_carlo)
        throw BadInput("'order' takes how 'monte-carlo'");
}

MeasuredAlbedo measured_albedo(AnyClosure& closure, const ClosureSpec& spec, const Imath::V3d& wo,
                               const AlbedoSettings& settings)
{
    switch (settings.how)
    {
        case AlbedoMethod::table: {
            closure.prepare(wo);
            const Albedo<double> albedo = closure.albedo();
            return {albedo.reflect, albedo.transmit, std::nullopt};
        }
        case AlbedoMethod::quadrature: {
            MeasuredAlbedo fine = by_quadrature(closure, spec, wo, fine_nodes);
            const MeasuredAlbedo off =
                difference(fine, by_quadrature(closure, spec, wo, coarse_nodes));
            fine.error = std::max(largest(off.reflect), largest(off.transmit));
            return fine;
        }
        case AlbedoMethod::monte_carlo: break;
    }
    SampleNumbers numbers(spec, settings.seed);
    closure.prepare(wo);
    return mean_of(settings.samples,
                   [&] { return drawn(closure, numbers.next(), settings.order); });
}

MeasuredAlbedo measured_albedo(const ClosureSpec& given, const Imath::V3d& wo,
                               const AlbedoSettings& settings)
{
    const ClosureSpec spec = as_energy(given);
    const auto closure = make_closure(spec, settings.how == AlbedoMethod::table);
    return measured_albedo(*closure, spec, wo, settings);
}

MeasuredAlbedo measured_average_albedo(const ClosureSpec& given, const AlbedoSettings& settings,
                                       bool below)
{
    const ClosureSpec spec = as_energy(given);
    const auto closure = make_closure(spec, settings.how == AlbedoMethod::table);
    const bool isotropic = !closure->traits().anisotropic;
    const double edge = critical_cosine(spec, below);
    switch (settings.how)
    {
        case AlbedoMethod::table:
            return averaged(isotropic, below, edge, 32, [&](const Imath::V3d& wo) {
                return measured_albedo(*closure, spec, wo, settings);
            });
        case AlbedoMethod::quadrature: {
            const auto by = [&](int cosines, int nodes) {
                return averaged(isotropic, below, edge, cosines, [&](const Imath::V3d& wo) {
                    return by_quadrature(*closure, spec, wo, nodes);
                });
            };
            MeasuredAlbedo fine = by(24, fine_nodes / 2);
            const MeasuredAlbedo off = difference(fine, by(16, coarse_nodes / 2));
            fine.error = std::max(largest(off.reflect), largest(off.transmit));
            return fine;
        }
        case AlbedoMethod::monte_carlo: break;
    }
    SampleNumbers numbers(spec, settings.seed);
    const double turn = 4 * std::acos(0.0), side = below ? -1 : 1;
    return mean_of(settings.samples, [&] {
        // Cosine-weighted directions.
        const double mu = std::sqrt(1 - numbers.number());
        closure->prepare(direction_at(side * mu, turn * numbers.number()));
        return drawn(*closure, numbers.next(), settings.order);
    });
}

MeasuredValue measured_value(const AnyClosure& prepared, const ClosureSpec& spec,
                             const Imath::V3d& wi, std::uint64_t n, std::uint64_t seed)
{
    SampleNumbers numbers(spec, seed);
    const MeasuredAlbedo mean = mean_of(n, [&] {
        return Albedo<double>{prepared.eval(wi, numbers.next()), ColorD(0.0)};
    });
    return {mean.reflect, n > 1 ? *mean.error : 0};
}

}  // namespace regain::tools
