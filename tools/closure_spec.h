// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A closure as the commands name it. What the design knows but the library does not have yet is
/// refused by name.

#pragma once

#include "fresnel_spec.h"

#include <regain/shaders/microfacet_material.h>
#include <regain/shaders/plain_material.h>

#include <memory>
#include <optional>

namespace regain::tools {

enum class Lobe {
    conductor,
    generalized_schlick,
    dielectric,
    sheen,
    oren_nayar_diffuse,
    burley_diffuse,
    subsurface,
    translucent,
    transparent,
    layer,
    mix,
    add,
    multiply
};
enum class Precision { single, twice };
enum class Transport { importance, radiance };

struct ClosureSpec;

enum class CombinationKind { layer, mix, add, multiply };

/// layer: first over second. mix: `weight` of the first, and the rest of the second. multiply: the
/// first alone.
struct Combination
{
    CombinationKind kind = CombinationKind::add;
    std::shared_ptr<const ClosureSpec> first, second;
    ColorD weight{1.0};  ///< of mix and multiply
};

struct ClosureSpec
{
    Lobe lobe = Lobe::conductor;
    shaders::DistributionKind distribution = shaders::DistributionKind::ggx;
    double gamma = 2;                       ///< of gtr and std
    double alpha_x = 0.05, alpha_y = 0.05;  ///< MaterialX's default
    FresnelSpec fresnel = ConductorParameters{};
    shaders::InterfaceSurface interface;          ///< of dielectric; its eta is that of `fresnel`
    shaders::SheenSurface sheen;                  ///< Burley's
    std::optional<shaders::PlainMaterial> plain;  ///< of all without microfacets but that
    std::optional<Combination> combination;       ///< of layer, mix, add, multiply
    shaders::Compensation method = Method::none;
    double strength = 1;
    double thin_film = 0;  ///< nanometres of a film that is asked for, and left out
    Precision precision = Precision::single;
    Transport transport = Transport::importance;

    /// Where it is neither `plain` nor a combination.
    shaders::MicrofacetMaterial material() const;

    /// eval is an estimate that takes random numbers.
    bool is_stochastic() const
    {
        if (combination)
            return combination->first->is_stochastic() ||
                   (combination->second && combination->second->is_stochastic());
        return std::holds_alternative<shaders::RandomWalk>(method) && strength > 0;
    }
    bool has_microfacets() const { return lobe != Lobe::sheen && !plain && !combination; }
    /// How many numbers sample reads, 2 or 3.
    std::size_t random_numbers() const;
    /// What is not simulated as asked, of the closure and its parts; empty where nothing is.
    std::string note() const;
    /// wo may be on either side of the surface.
    bool has_two_sides() const
    {
        if (combination)
            return combination->first->has_two_sides() ||
                   (combination->second && combination->second->has_two_sides());
        return lobe == Lobe::dielectric || lobe == Lobe::translucent || lobe == Lobe::transparent;
    }
};

std::string_view name(Lobe lobe);

/// Also of a name that no lobe has.
bool lobe_has_microfacets(std::string_view lobe);

/// Reads the fields that describe a closure: closure, distribution, gamma, alpha, fresnel (or the
/// lobe's parameters by MaterialX's names), scatter_mode, transmission_shadowing, thin_walled,
/// tint, color, roughness, energy_compensation, mode, weight, method, strength, precision,
/// transport, thinfilm_thickness and thinfilm_ior, which are noted and have no effect; or the parts
/// of a combination: top and base of layer, fg, bg and mix of mix, in1 and in2 of add and multiply.
/// Does not finish the fields. Throws BadInput; also where `closure` is missing, if it is needed.
ClosureSpec read_closure_spec(Fields& fields, bool closure_needed);

/// Calls `visit` with the distribution at the precision of Real.
template <class Real, class Visit>
decltype(auto) with_distribution(const ClosureSpec& spec, const Visit& visit)
{
    using shaders::DistributionKind;
    const Real ax = Real(spec.alpha_x), ay = Real(spec.alpha_y), gamma = Real(spec.gamma);
    switch (spec.distribution)
    {
        case DistributionKind::beckmann: return visit(Beckmann<Real>(ax, ay));
        case DistributionKind::gtr: return visit(GTR<Real>(ax, ay, gamma));
        case DistributionKind::std: return visit(STD<Real>(ax, ay, gamma));
        case DistributionKind::ggx: break;
    }
    return visit(GGX<Real>(ax, ay));
}

}  // namespace regain::tools
