// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "closure_spec.h"

#include "errors.h"

#include <fmt/format.h>

namespace regain::tools {
namespace {

using Names = std::string_view;
using shaders::DistributionKind;

constexpr std::array<Names, 13> lobes{"conductor",
                                      "generalized_schlick",
                                      "dielectric",
                                      "sheen",
                                      "oren_nayar_diffuse",
                                      "burley_diffuse",
                                      "subsurface",
                                      "translucent",
                                      "transparent",
                                      "layer",
                                      "mix",
                                      "add",
                                      "multiply"};
constexpr std::array<Names, 3> sheen_modes{"burley", "conty_kulla", "zeltner"};
constexpr std::array<Names, 4> distributions{"ggx", "beckmann", "gtr", "std"};
constexpr std::array<Names, 2> precisions{"float", "double"};
constexpr std::array<Names, 2> transports{"importance", "radiance"};
constexpr std::array<Names, 3> scatter_modes{"R", "T", "RT"};
constexpr std::array<Names, 1> reflection_alone{"R"};
constexpr std::array<Names, 2> shadowings{"correlated", "beta"};

// What the closures accept without clamping.
constexpr Range gtr_range{gtr_min_gamma, gtr_max_gamma}, std_range{std_min_gamma, std_max_gamma};
constexpr Range tint_range{0, 100}, weight_range{0, 1e6};
constexpr Range film_range{0, 1e6}, film_index_range{1, 10};

shaders::Compensation read_method(Names given)
{
    if (const auto method = shaders::compensation_named(given)) return *method;
    const auto& names = shaders::compensation_names();
    choose("method", given, names.data(), names.size());  // throws
    return Method::none;
}

FresnelSpec read_fresnel_of(Lobe lobe, Fields& fields)
{
    if (const Json* object = fields.object("fresnel"))
    {
        for (const char* parameter :
             {"ior", "extinction", "color0", "color82", "color90", "exponent"})
            fields.reject(parameter, "'fresnel' says the same; give one of the two");
        return read_fresnel(*object);
    }
    switch (lobe)
    {
        case Lobe::conductor: return read_conductor_parameters(fields);
        case Lobe::generalized_schlick: return read_schlick_parameters(fields);
        case Lobe::dielectric: return read_dielectric_parameters(fields);
        default: break;
    }
    return ConstantParameters{};
}

void read_distribution(Fields& fields, ClosureSpec& spec)
{
    if (const auto given = fields.text("distribution"))
        spec.distribution =
            static_cast<DistributionKind>(choose("distribution", *given, distributions));
    if (!shaders::has_gamma(spec.distribution))
        fields.reject("gamma", "it belongs to the distributions gtr and std");
    else
        spec.gamma =
            fields
                .number("gamma", spec.distribution == DistributionKind::gtr ? gtr_range : std_range)
                .value_or(spec.gamma);
    if (const auto alpha = fields.one_or_two("alpha", unit_range))
        spec.alpha_x = alpha->x, spec.alpha_y = alpha->y;
}

void read_interface(Fields& fields, ClosureSpec& spec)
{
    shaders::InterfaceSurface& i = spec.interface;
    const auto* eta = std::get_if<DielectricParameters>(&spec.fresnel);
    if (!eta) throw BadInput("the closure dielectric takes a 'fresnel' with eta, and no other");
    i.eta = eta->eta;
    if (const auto given = fields.text("scatter_mode"))
        i.mode = static_cast<ScatterMode>(choose("scatter_mode", *given, scatter_modes));
    i.thin_walled = fields.flag("thin_walled").value_or(false);
    i.reflection_tint = i.transmission_tint =
        fields.color("tint", unit_range).value_or(i.reflection_tint);
    if (i.thin_walled)
        fields.reject("transmission_shadowing",
                      "a thin sheet transmits as it reflects, and has no form to choose");
    else if (spec.is_stochastic() || std::holds_alternative<shaders::Tail>(spec.method))
    {
        // A walk is what the beta form is the first bounce of, and a tail goes on from there.
        i.shadowing = TransmissionShadowing::beta;
        if (fields.text("transmission_shadowing").value_or("beta") != "beta")
            throw BadInput(fmt::format("the method {} needs 'transmission_shadowing' beta",
                                       shaders::name(spec.method)));
    }
    else if (const auto given = fields.text("transmission_shadowing"))
        i.shadowing = static_cast<TransmissionShadowing>(
            choose("transmission_shadowing", *given, shadowings));
}

void read_reflection(Fields& fields, const ClosureSpec& spec)
{
    if (std::holds_alternative<DielectricParameters>(spec.fresnel))
        throw BadInput("a 'fresnel' with eta belongs to the closure dielectric");
    if (const auto given = fields.text("scatter_mode"))
        choose("scatter_mode of this closure", *given, reflection_alone);
    for (const char* field : {"transmission_shadowing", "thin_walled", "tint"})
        fields.reject(field, "it belongs to the closure dielectric");
}

// The films of MaterialX's closures are read, so that what a document says of them need not be
// taken out of it.
void read_thin_film(Fields& fields, ClosureSpec& spec)
{
    spec.thin_film = fields.number("thinfilm_thickness", film_range).value_or(0);
    fields.number("thinfilm_ior", film_index_range);
}

// Closures without microfacets.
void read_plain(Fields& fields, ClosureSpec& spec)
{
    const std::string why = fmt::format("the closure {} has no microfacets", name(spec.lobe));
    for (const char* field :
         {"distribution", "gamma", "alpha", "fresnel", "thinfilm_thickness", "thinfilm_ior"})
        fields.reject(field, why.c_str());
    if (fields.text("scatter_mode"))
        throw BadInput("'scatter_mode' belongs to the closure dielectric");
    read_reflection(fields, spec);

    if (spec.lobe == Lobe::sheen)
    {
        const auto given = fields.text("mode");
        const std::size_t mode = given ? choose("mode", *given, sheen_modes) : 0;
        if (mode == 0)
        {
            fields.reject("roughness", "it belongs to the modes conty_kulla and zeltner");
            spec.sheen.color = fields.color("color", tint_range).value_or(spec.sheen.color);
            spec.sheen.weight = fields.number("weight", unit_range).value_or(spec.sheen.weight);
            return;
        }
        fields.reject("weight", "it belongs to the mode burley");
        shaders::ClothSurface cloth;
        cloth.mode = mode == 1 ? shaders::ClothMode::conty_kulla : shaders::ClothMode::zeltner;
        cloth.color = fields.color("color", unit_range).value_or(cloth.color);
        cloth.roughness = fields.number("roughness", unit_range).value_or(cloth.roughness);
        spec.plain = shaders::PlainMaterial{cloth};
        return;
    }

    const auto color = fields.color("color", unit_range);
    const auto with_color = [&](auto surface) {
        surface.color = color.value_or(surface.color);
        return surface;
    };
    const auto with_roughness = [&](auto surface) {
        surface.roughness = fields.number("roughness", unit_range).value_or(surface.roughness);
        return with_color(surface);
    };
    switch (spec.lobe)
    {
        case Lobe::oren_nayar_diffuse: {
            auto surface = with_roughness(shaders::OrenNayarSurface{});
            surface.energy_compensation =
                fields.flag("energy_compensation").value_or(surface.energy_compensation);
            spec.plain = shaders::PlainMaterial{surface};
            break;
        }
        case Lobe::burley_diffuse:
            spec.plain = shaders::PlainMaterial{with_roughness(shaders::BurleyDiffuseSurface{})};
            break;
        case Lobe::subsurface:
            spec.plain = shaders::PlainMaterial{with_color(shaders::SubsurfaceSurface{})};
            break;
        case Lobe::translucent:
            spec.plain = shaders::PlainMaterial{with_color(shaders::TranslucentSurface{})};
            break;
        default: spec.plain = shaders::PlainMaterial{with_color(shaders::TransparentSurface{})};
    }
}

std::shared_ptr<const ClosureSpec> read_part(Fields& fields, const char* field)
{
    const Json* object = fields.object(field);
    if (!object) fields.missing("'" + std::string(field) + "'");
    Fields inside(*object, field);
    for (const char* of_all : {"precision", "transport"})
        inside.reject(of_all, "it belongs to the whole closure");
    auto part = std::make_shared<const ClosureSpec>(read_closure_spec(inside, true));
    inside.finish();
    return part;
}

void read_combination(Fields& fields, ClosureSpec& spec)
{
    for (const char* field : {"distribution", "gamma", "alpha", "fresnel", "method", "strength",
                              "thinfilm_thickness", "thinfilm_ior"})
        fields.reject(field, "it belongs to the parts of the combination");
    Combination c;
    c.kind =
        static_cast<CombinationKind>(static_cast<int>(spec.lobe) - static_cast<int>(Lobe::layer));
    switch (c.kind)
    {
        case CombinationKind::layer:
            c.first = read_part(fields, "top");
            c.second = read_part(fields, "base");
            break;
        case CombinationKind::mix: {
            c.first = read_part(fields, "fg");
            c.second = read_part(fields, "bg");
            const auto amount = fields.number("mix", unit_range);
            if (!amount) fields.missing("'mix'");
            c.weight = ColorD(*amount);
            break;
        }
        case CombinationKind::add:
            c.first = read_part(fields, "in1");
            c.second = read_part(fields, "in2");
            break;
        case CombinationKind::multiply: {
            c.first = read_part(fields, "in1");
            if (const auto weight = fields.grey_or_color("in2", weight_range))
                c.weight = *weight;
            else
                fields.missing("'in2'");
            break;
        }
    }
    spec.combination = std::move(c);
}

bool is_microfacet_lobe(Lobe lobe)
{
    return lobe == Lobe::conductor || lobe == Lobe::generalized_schlick || lobe == Lobe::dielectric;
}

}  // namespace

std::string_view name(Lobe lobe) { return lobes[static_cast<std::size_t>(lobe)]; }

bool lobe_has_microfacets(std::string_view lobe)
{
    for (std::size_t i = 0; i < lobes.size(); ++i)
        if (lobes[i] == lobe) return is_microfacet_lobe(static_cast<Lobe>(i));
    return true;
}

shaders::MicrofacetMaterial ClosureSpec::material() const
{
    shaders::MicrofacetMaterial m;
    m.distribution = distribution;
    m.gamma = gamma;
    m.alpha_x = alpha_x;
    m.alpha_y = alpha_y;
    m.method = method;
    if (lobe == Lobe::dielectric)
        m.surface = interface;
    else if (lobe == Lobe::sheen)
        m.surface = sheen;
    else if (const auto* schlick = std::get_if<SchlickParameters>(&fresnel))
        m.surface = *schlick;
    else if (const auto* conductor = std::get_if<ConductorParameters>(&fresnel))
        m.surface = *conductor;
    else if (const auto* constant = std::get_if<ConstantParameters>(&fresnel))
        // Schlick's curve between equal ends, to the bit.
        m.surface = SchlickParameters{constant->value, ColorD(1.0), constant->value, 5};
    return m;
}

std::size_t ClosureSpec::random_numbers() const
{
    if (combination) return 3;
    if (plain) return lobe == Lobe::oren_nayar_diffuse || lobe == Lobe::subsurface ? 3 : 2;
    const bool two = std::holds_alternative<Method>(method) && lobe != Lobe::dielectric &&
                     lobe != Lobe::sheen && !shaders::has_gamma(distribution);
    return two ? 2 : 3;
}

std::string ClosureSpec::note() const
{
    std::string all;
    const auto add = [&](const std::string& one) {
        if (!one.empty() && all.find(one) == std::string::npos)
            all += (all.empty() ? "" : "; ") + one;
    };
    if (plain && plain->stand_in()) add(plain->stand_in());
    if (thin_film > 0)
        add(fmt::format("no thin film is simulated: thinfilm_thickness {} has no effect",
                        thin_film));
    if (combination)
        for (const auto* part : {&combination->first, &combination->second})
            if (*part) add((*part)->note());
    return all;
}

ClosureSpec read_closure_spec(Fields& fields, bool closure_needed)
{
    ClosureSpec spec;
    if (const auto given = fields.text("closure"))
        spec.lobe = static_cast<Lobe>(choose("closure", *given, lobes));
    else if (closure_needed)
        fields.missing("'closure'");

    if (const auto given = fields.text("method")) spec.method = read_method(*given);
    spec.strength = fields.number("strength", unit_range).value_or(1);
    if (std::holds_alternative<shaders::RandomWalk>(spec.method) && spec.strength != 0 &&
        spec.strength != 1)
        throw BadInput(
            fmt::format("'strength' is {}; accepted: 0 or 1 for the method walk", spec.strength));

    if (spec.lobe >= Lobe::layer)
        read_combination(fields, spec);
    else if (!is_microfacet_lobe(spec.lobe))
        read_plain(fields, spec);
    else
    {
        read_distribution(fields, spec);
        read_thin_film(fields, spec);
        spec.fresnel = read_fresnel_of(spec.lobe, fields);
        if (spec.lobe == Lobe::dielectric)
            read_interface(fields, spec);
        else if (closure_needed || fields.has("closure"))
            read_reflection(fields, spec);
    }

    if (const auto given = fields.text("transport"))
        spec.transport = static_cast<Transport>(choose("transport", *given, transports));
    if (const auto given = fields.text("precision"))
        spec.precision = static_cast<Precision>(choose("precision", *given, precisions));
    return spec;
}

}  // namespace regain::tools
