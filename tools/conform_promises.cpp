// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "conform_promises.h"

#include "any_closure.h"

#include <algorithm>
#include <cmath>

namespace regain::tools {
namespace {

using conformance::Promises;
using shaders::DistributionKind;

// The white furnace of mirrors, docs/support.md "How exact".
double mirror_furnace(DistributionKind distribution)
{
    return shaders::has_gamma(distribution) ? 3e-3 : 1e-3;
}

// Tinted albedos against the walk, Table 1 of docs/figures.md: the worst of each method.
std::optional<double> tint_of(const shaders::Compensation& method, DistributionKind distribution)
{
    // Of STD's tail, which needs more bounces than they know of: docs/support.md, "How exact".
    const bool tail = distribution == DistributionKind::std;
    if (const auto* form = std::get_if<KullaContyForm>(&method))
        return *form == KullaContyForm::printed ? 0.09 : tail ? 0.08 : 0.05;
    if (std::holds_alternative<shaders::Directional>(method) ||
        std::holds_alternative<shaders::Tail>(method))
        return 1.2e-2;
    // Light beyond so many facets.
    if (const auto* walk = std::get_if<shaders::RandomWalk>(&method); walk && walk->bounded)
        return tail ? 2e-2 : 1e-3;
    if (std::holds_alternative<shaders::Balanced>(method)) return tail ? 0.06 : 1.6e-2;
    const auto* gain = std::get_if<Method>(&method);
    if (!gain) return std::nullopt;
    switch (*gain)
    {
        case Method::turquin: return tail ? 0.15 : 0.07;
        case Method::turquin_eq12: return 0.09;
        case Method::turquin_eq13: return tail ? 0.15 : 0.08;
        case Method::turquin_eq14: return tail ? 0.15 : 0.07;
        case Method::series: return tail ? 0.08 : 0.05;
        case Method::none:
        case Method::normalise: break;  // they do not try
    }
    return std::nullopt;
}

double largest_gain(const ClosureSpec& spec, const Imath::V3d& wo)
{
    const auto closure = make_closure(spec, true);
    closure->prepare(wo);
    const ColorD gain = closure->gain().gain;
    return std::max({gain.x, gain.y, gain.z});
}

// Of a gain that depends on wi, over many of them.
double largest_pair_gain(const ClosureSpec& spec, const Imath::V3d& wo)
{
    const auto closure = make_closure(spec, true);
    closure->prepare(wo);
    double largest = 1;
    constexpr int cosines = 200;
    for (int i = 1; i <= cosines; ++i)
    {
        const double mu = std::pow(static_cast<double>(i) / cosines, 3);
        const ColorD gain = closure->gain(Imath::V3d(std::sqrt(1 - mu * mu), 0, mu)).gain;
        largest = std::max({largest, gain.x, gain.y, gain.z});
    }
    return 1.01 * largest;
}

// Directional albedo of the lobe alone, by tables.
double bare_albedo(ClosureSpec spec, const Imath::V3d& wo)
{
    spec.method = Method::none;
    const auto closure = make_closure(spec, true);
    closure->prepare(wo);
    const Albedo<double> albedo = closure->albedo();
    return albedo.reflect.y + albedo.transmit.y;
}

// Of what the tables know of anisotropic lobes, docs/methods.md, "Anisotropy"; nothing beyond that.
std::optional<double> anisotropic_error(const ClosureSpec& spec, double mu)
{
    const double wider = std::max(spec.alpha_x, spec.alpha_y),
                 narrower = std::min(spec.alpha_x, spec.alpha_y);
    if (wider > 20 * narrower) return std::nullopt;
    if (spec.lobe == Lobe::dielectric && !spec.interface.thin_walled)
    {
        const double index = std::max(spec.interface.eta, 1 / spec.interface.eta);
        if (shaders::has_gamma(spec.distribution) || spec.interface.mode != ScatterMode::RT ||
            index < 1.1 || index > 3 || wider < 0.05 || mu < 0.03)
            return std::nullopt;
    }
    else if (wider < 0.01 || mu < 0.01)
        return std::nullopt;
    if (spec.lobe != Lobe::dielectric && !shaders::has_gamma(spec.distribution)) return 6e-3;
    return wider > 10 * narrower ? 2e-2 : 1e-2;
}

}  // namespace

Promises promises_of(const ClosureSpec& spec, const Imath::V3d& wo)
{
    Promises p;
    const double mu = std::abs(wo.z);
    const bool isotropic = spec.alpha_x == spec.alpha_y;
    const double alpha = std::max(spec.alpha_x, spec.alpha_y);
    const auto* gain = std::get_if<Method>(&spec.method);
    const bool walks = std::holds_alternative<shaders::RandomWalk>(spec.method);
    const bool glass = spec.lobe == Lobe::dielectric && !spec.interface.thin_walled;
    const bool tail = std::holds_alternative<shaders::Tail>(spec.method);
    const bool adds = std::holds_alternative<KullaContyForm>(spec.method) || (tail && glass);
    const bool balances = std::holds_alternative<shaders::Balanced>(spec.method);
    const bool compensates = adds || balances ||
                             std::holds_alternative<shaders::Directional>(spec.method) || tail ||
                             (gain && *gain != Method::none);
    const bool beta = glass && spec.interface.shadowing == TransmissionShadowing::beta;

    if (spec.combination)
    {
        // As exact as the table of how much the coat reflects, which is good from outside; one
        // closure's samples are weighed against the density of both.
        p.albedo = p.surplus = spec.combination->first->interface.eta < 1 ? 5e-2 : 5e-3;
        p.weight = std::nullopt;
        return p;
    }
    if (spec.plain)
    {
        if (spec.lobe == Lobe::burley_diffuse) p.surplus = std::nullopt;
        if (spec.lobe == Lobe::sheen) p.surplus = 2e-3;  // what is divided by is fitted
        // Oren and Nayar's own, where it is nearly smooth, at grazing angles.
        if (spec.lobe == Lobe::oren_nayar_diffuse) p.surplus = 2e-2;
        // By the cosine, where the model rises at grazing directions.
        p.weight = spec.lobe == Lobe::burley_diffuse ? 6.3 : spec.lobe == Lobe::sheen ? 3 : 4;
        return p;
    }
    if (spec.lobe == Lobe::sheen)
    {
        p.weight = std::nullopt;
        return p;
    }
    // Exact conductors are looked up by two moments of Schlick's curve.
    if (spec.lobe == Lobe::conductor && std::holds_alternative<ConductorParameters>(spec.fresnel))
        p.albedo = 1.2e-2;
    else if (spec.distribution != DistributionKind::ggx)
        p.albedo = 5e-3;
    else if (spec.lobe == Lobe::generalized_schlick)
        p.albedo = 2.5e-3;
    // Sums of the beta form are looked up as logarithms.
    if (beta && compensates) p.single = 2e-3;
    // Where light passes undeflected the added lobe is all there is, steep between the nodes.
    if (beta && adds && spec.interface.eta == 1) p.single = 1.5e-2;
    if (std::holds_alternative<shaders::BurleySheen>(spec.method))
    {
        // It adds what it adds.
        p.surplus = p.weight = std::nullopt;
        if (!isotropic) p.albedo = std::nullopt;
        return p;
    }
    // Without tables albedo() is a mean of samples: docs/support.md, "How exact".
    if (spec.lobe == Lobe::dielectric && shaders::has_gamma(spec.distribution))
    {
        p.albedo = spec.distribution == DistributionKind::std ? 1.5e-2 : 1e-2;
        p.albedo_noise = *p.albedo;
    }
    // The mean of the gain over some samples.
    if (balances)
    {
        if (spec.distribution == DistributionKind::std) p.albedo = 1.5e-2;
        p.albedo_noise = std::max(*p.albedo, 5e-3);
    }
    // How much of what an interface sends back and on is reflected.
    if (glass && spec.interface.mode != ScatterMode::RT) p.albedo = 0.05;
    p.tint = isotropic && !glass ? tint_of(spec.method, spec.distribution) : std::nullopt;
    p.furnace = glass ? 5e-3 : mirror_furnace(spec.distribution);
    const bool in_range = glass ? mu >= 0.02 : mu >= 1e-3;
    if (walks)
    {
        p.furnace = 5e-4;
        // Of a conductor, as well as the table knows E_ss; of an interface with STD's tail, as
        // float tells directions apart where facets stand upright.
        if (spec.distribution == (glass ? DistributionKind::std : DistributionKind::beckmann))
            p.pdf = 1e-3;
        // Looked up as that of the series.
        if (!glass && !std::holds_alternative<ConstantParameters>(spec.fresnel))
            p.albedo = spec.distribution == DistributionKind::std ? 0.08 : 0.05;
        if (std::get<shaders::RandomWalk>(spec.method).bounded)
        {
            // By the tables of single scattering.
            p.pdf = glass                                        ? 3e-3
                    : spec.distribution == DistributionKind::ggx ? 1e-3
                    : shaders::has_gamma(spec.distribution)      ? 1e-2
                                                                 : 5e-3;
            if (!glass) p.albedo = 0.02;
        }
    }
    if (!walks && (!in_range || !isotropic || alpha < 1e-3)) p.furnace = std::nullopt;
    if (!isotropic)
    {
        const std::optional<double> error = anisotropic_error(spec, mu);
        if (p.albedo && error)
            *p.albedo += *error;
        else
            p.albedo = std::nullopt;
        if (compensates) p.surplus = error;
    }
    else if (compensates)
        p.surplus = p.furnace;
    // Where it is little, what the beta form returns alone is not known to any digits, and
    // neither is a multiple of it.
    if (beta && compensates && (!in_range || bare_albedo(spec, wo) < 0.1))
        p.furnace = p.albedo = std::nullopt;
    // The bare lobe's weights are at most 1; those of an added lobe at most 1.5 times what it
    // returns, or of Beckmann's beta form and of a tail, which is sampled without its tilt, twice.
    const bool twice = tail || (beta && spec.distribution == DistributionKind::beckmann);
    if (balances)
        p.weight = largest_pair_gain(spec, wo);
    else if (!isotropic && (adds || tail))
    {
        // What single azimuths lose is sampled by half; in a tail little of it is left in float.
        p.weight = std::max(largest_gain(spec, wo), 6.0);
        p.single = std::max(p.single, 5e-3);
    }
    else if (compensates)
        p.weight = std::max(largest_gain(spec, wo), twice ? 2 : adds ? 1.5 : 1.0);
    return p;
}

}  // namespace regain::tools
