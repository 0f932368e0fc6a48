// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "closure_spec.h"

#include "errors.h"

#include <fmt/format.h>

namespace regain::tools {
namespace {

using Names = std::string_view;

constexpr std::array<Names, 2> lobes{"conductor", "generalized_schlick"};
constexpr std::array<Names, 9> planned_lobes{
    "dielectric", "sheen",   "oren_nayar_diffuse", "burley_diffuse", "translucent", "layer", "mix",
    "add",        "multiply"};
constexpr std::array<Names, 1> distributions{"ggx"};
constexpr std::array<Names, 3> planned_distributions{"beckmann", "gtr", "std"};
constexpr std::array<Names, 7> planned_methods{
    "kulla-conty", "kulla-conty-series", "directional", "balanced", "tail", "walk", "burley-sheen"};
constexpr std::array<Names, 2> precisions{"float", "double"};
constexpr std::array<Names, 2> transports{"importance", "radiance"};
constexpr std::array<Names, 1> scatter_modes{"R"};
constexpr std::array<Names, 2> planned_scatter_modes{"T", "RT"};
constexpr std::array<Names, 0> nothing_planned{};

constexpr std::size_t method_count = std::size(all_methods);

std::array<Names, method_count> method_names()
{
    std::array<Names, method_count> names;
    for (std::size_t i = 0; i < method_count; ++i) names[i] = regain::name(all_methods[i]);
    return names;
}

Method read_method(Names given)
{
    if (const std::optional<Method> method = method_named(given)) return *method;
    choose("method", given, method_names(), planned_methods);  // throws
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
    if (lobe == Lobe::conductor) return read_conductor_parameters(fields);
    return read_schlick_parameters(fields);
}

}  // namespace

std::string_view name(Lobe lobe) { return lobes[static_cast<std::size_t>(lobe)]; }

ClosureSpec read_closure_spec(Fields& fields, bool closure_needed)
{
    ClosureSpec spec;
    if (const auto given = fields.text("closure"))
        spec.lobe = static_cast<Lobe>(choose("closure", *given, lobes, planned_lobes));
    else if (closure_needed)
        fields.missing("'closure'");

    if (const auto given = fields.text("distribution"))
        choose("distribution", *given, distributions, planned_distributions);
    fields.reject("gamma", "it belongs to the distributions gtr and std, not supported yet");
    if (const auto alpha = fields.one_or_two("alpha", unit_range))
        spec.alpha_x = alpha->x, spec.alpha_y = alpha->y;

    spec.fresnel = read_fresnel_of(spec.lobe, fields);

    // Nothing is transmitted by these lobes, so the two transports are the same.
    if (const auto given = fields.text("scatter_mode"))
        choose("scatter_mode", *given, scatter_modes, planned_scatter_modes);
    fields.reject("transmission_shadowing",
                  "it belongs to the closure dielectric, not supported yet");
    if (const auto given = fields.text("transport"))
        choose("transport", *given, transports, nothing_planned);

    if (const auto given = fields.text("method")) spec.method = read_method(*given);
    spec.strength = fields.number("strength", unit_range).value_or(1);
    if (const auto given = fields.text("precision"))
        spec.precision =
            static_cast<Precision>(choose("precision", *given, precisions, nothing_planned));
    return spec;
}

}  // namespace regain::tools
