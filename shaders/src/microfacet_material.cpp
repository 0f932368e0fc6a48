// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/luts/library.h>
#include <regain/shaders/microfacet_material.h>

#include <string>

REGAIN_NAMESPACE_BEGIN
namespace shaders {

namespace {

std::vector<Compensation> every_compensation()
{
    std::vector<Compensation> all(std::begin(all_methods), std::end(all_methods));
    all.push_back(Directional{});
    all.push_back(Balanced{});
    all.insert(all.end(), std::begin(all_kulla_conty_forms), std::end(all_kulla_conty_forms));
    all.push_back(Tail{});
    all.push_back(RandomWalk{});
    all.push_back(RandomWalk{1, true});
    all.push_back(BurleySheen{});
    return all;
}

const std::vector<Compensation>& all_compensations()
{
    static const std::vector<Compensation> all = every_compensation();
    return all;
}

}  // namespace

std::string_view name(DistributionKind distribution)
{
    switch (distribution)
    {
        case DistributionKind::ggx: return "ggx";
        case DistributionKind::beckmann: return "beckmann";
        case DistributionKind::gtr: return "gtr";
        case DistributionKind::std: return "std";
    }
    return "";
}

std::optional<DistributionKind> distribution_named(std::string_view wanted)
{
    for (const DistributionKind d : all_distributions)
        if (name(d) == wanted) return d;
    return std::nullopt;
}

std::string_view name(const Compensation& compensation)
{
    if (const auto* method = std::get_if<Method>(&compensation)) return regain::name(*method);
    if (const auto* form = std::get_if<KullaContyForm>(&compensation)) return regain::name(*form);
    if (std::holds_alternative<Directional>(compensation)) return "directional";
    if (std::holds_alternative<Balanced>(compensation)) return "balanced";
    if (std::holds_alternative<Tail>(compensation)) return "tail";
    if (const auto* walk = std::get_if<RandomWalk>(&compensation))
        return walk->bounded ? "walk-bounded" : "walk";
    return "burley-sheen";
}

std::optional<Compensation> compensation_named(std::string_view wanted)
{
    for (const Compensation& c : all_compensations())
        if (name(c) == wanted) return c;
    return std::nullopt;
}

const std::vector<std::string_view>& compensation_names()
{
    static const std::vector<std::string_view> names = [] {
        std::vector<std::string_view> all;
        for (const Compensation& c : all_compensations()) all.push_back(name(c));
        return all;
    }();
    return names;
}

Compensation recommended_compensation(
    const std::variant<SchlickSurface, ConductorSurface, InterfaceSurface, SheenSurface>& surface)
{
    if (std::holds_alternative<SheenSurface>(surface)) return Method::none;
    const auto* interface = std::get_if<InterfaceSurface>(&surface);
    if (!interface) return Directional{};
    if (interface->thin_walled || interface->shadowing != TransmissionShadowing::beta)
        return Method::turquin;
    return Tail{};
}

MicrofacetMaterial::MicrofacetMaterial(const SchlickMetal& metal)
    : surface(SchlickSurface{ColorD(metal.F0), ColorD(metal.F82)}),
      alpha_x(static_cast<double>(metal.alpha_x)),
      alpha_y(static_cast<double>(metal.alpha_y)),
      method(metal.method)
{}

void MicrofacetMaterial::bind_tables(bool for_albedo)
{
    const auto refuse = [this](const std::string& why) {
        throw std::invalid_argument("the method " + std::string(name(method)) + " " + why);
    };
    const auto* gain = std::get_if<Method>(&method);
    const auto* walk = std::get_if<RandomWalk>(&method);
    const bool is_walk = walk != nullptr, bounded = walk && walk->bounded;
    if (std::holds_alternative<SheenSurface>(surface))
    {
        if (!gain || *gain != Method::none)
            refuse("does not go with sheen, which has no microfacets; accepted: none");
        return;
    }
    const auto* interface = std::get_if<InterfaceSurface>(&surface);
    if (interface)
    {
        const bool walks = !interface->thin_walled && interface->mode == ScatterMode::RT;
        const bool tail = std::holds_alternative<Tail>(method),
                   adds = tail || std::holds_alternative<KullaContyForm>(method);
        if (is_walk && !walks)
            refuse("takes a dielectric of scatter mode RT that is not thin-walled");
        if (interface->thin_walled && adds)
            refuse("does not go with thin-walled dielectrics; accepted: none, normalise, turquin");
        if (!is_walk && !adds && !(gain && DielectricGain<double>::supports(*gain)))
            refuse(
                "does not go with dielectrics; accepted: none, normalise, turquin, kulla-conty, "
                "kulla-conty-series, tail, walk, walk-bounded");
        if (tail && interface->mode != ScatterMode::R &&
            interface->shadowing != TransmissionShadowing::beta)
            refuse("continues the beta form of transmission shadowing, and takes no other");
    }
    _tables = {};
    _interface_tables = {};
    const bool gains = !(is_walk || std::holds_alternative<BurleySheen>(method) ||
                         (gain && *gain == Method::none));
    // Those of GGX mirrors cost nothing; others are files.
    if (!gains && !bounded && !for_albedo && distribution != DistributionKind::ggx) return;
    const std::string names(name(distribution));
    const bool split = interface && std::holds_alternative<Tail>(method);
    if (split)
    {
        _interface_tables = luts::dielectric_tables(names, TransmissionShadowing::beta, gamma);
        luts::add_later_split(_interface_tables, names, gamma);
    }
    else if (!interface || interface->thin_walled ||
             (interface->mode == ScatterMode::R && !std::holds_alternative<KullaContyForm>(method)))
    {
        _tables = luts::microfacet_tables(names);
        if (alpha_x != alpha_y && !is_walk) luts::add_anisotropy(_tables, names);
        // Of a bounded walk they sharpen the pdf.
        const bool tail = bounded || std::holds_alternative<Tail>(method);
        const bool balanced = std::holds_alternative<Balanced>(method);
        if (tail || balanced || std::holds_alternative<Directional>(method))
            luts::add_later_bounces(_tables, names);
        if (balanced) luts::add_balance(_tables, names);
        if (balanced && alpha_x != alpha_y) luts::add_balance_anisotropy(_tables, names);
        if (tail) luts::add_later_shape(_tables, names);
        // The gain of mode R is a mirror's, but how much it reflects is the interface's.
        if (for_albedo && interface && !interface->thin_walled && !has_gamma(distribution))
            _interface_tables = luts::dielectric_tables(names, interface->shadowing);
    }
    else if (bounded)
    {
        _tables = luts::microfacet_tables(names);
        luts::add_later_shape(_tables, names);
        // For one gamma there are no tables but those that somebody bakes.
        if (!has_gamma(distribution))
            _interface_tables = luts::dielectric_tables(names, TransmissionShadowing::beta);
    }
    else if (gains || (for_albedo && !is_walk))
        _interface_tables = luts::dielectric_tables(names, interface->shadowing, gamma);
    if (_interface_tables && !bounded && alpha_x != alpha_y)
        luts::add_anisotropy(_interface_tables, names,
                             split ? TransmissionShadowing::beta : interface->shadowing);
}

}  // namespace shaders
REGAIN_NAMESPACE_END
