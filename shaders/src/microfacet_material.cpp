// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/luts/builtin.h>
#include <regain/shaders/microfacet_material.h>

REGAIN_NAMESPACE_BEGIN
namespace shaders {

namespace {

std::vector<Compensation> every_compensation()
{
    std::vector<Compensation> all(std::begin(all_methods), std::end(all_methods));
    all.insert(all.end(), std::begin(all_kulla_conty_forms), std::end(all_kulla_conty_forms));
    all.push_back(RandomWalk{});
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
    return std::holds_alternative<RandomWalk>(compensation) ? "walk" : "burley-sheen";
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

MicrofacetMaterial::MicrofacetMaterial(const SchlickMetal& metal)
    : surface(SchlickSurface{ColorD(metal.F0), ColorD(metal.F82)}),
      alpha_x(static_cast<double>(metal.alpha_x)),
      alpha_y(static_cast<double>(metal.alpha_y)),
      method(metal.method)
{}

void MicrofacetMaterial::bind_tables() { _tables = luts::ggx_tables(); }

}  // namespace shaders
REGAIN_NAMESPACE_END
