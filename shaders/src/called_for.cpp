// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "called_for.h"

#include "method_prediction.h"

REGAIN_NAMESPACE_BEGIN
namespace shaders {

std::vector<std::string> CalledFor::names() const
{
    std::vector<std::string> all;
    const std::pair<bool, const char*> effects[] = {
        {transmission, "transmission"},
        {tint, "tint"},
        {anisotropy, "anisotropy"},
        {tail, "tail"},
        {multiple_scattering, "multiple scattering"},
        {layering, "layering"},
        {inside, "inside"},
    };
    for (const auto& [is, effect] : effects)
        if (is) all.emplace_back(effect);
    return all;
}

namespace planning {
namespace {

bool has_tint(const ColorD& c) { return largest(c) - std::min({c.x, c.y, c.z}) > 1e-6; }

}  // namespace

CalledFor called_for_by(const ClosureTree::Material& material)
{
    CalledFor c;
    if (const auto* plain = std::get_if<PlainMaterial>(&material))
    {
        c.transmission = std::holds_alternative<TranslucentSurface>(plain->surface) ||
                         std::holds_alternative<TransparentSurface>(plain->surface);
        c.tint = std::visit([](const auto& s) { return has_tint(s.color); }, plain->surface);
        return c;
    }
    const auto& m = std::get<MicrofacetMaterial>(material);
    c.tint = has_tint(normal_reflectance(m));
    if (std::holds_alternative<SheenSurface>(m.surface)) return c;
    c.anisotropy = m.alpha_x != m.alpha_y;
    c.tail = has_gamma(m.distribution);
    if (const auto* s = std::get_if<SchlickSurface>(&m.surface))
        c.tint = c.tint || has_tint(s->F82) || has_tint(s->F90);
    if (const auto* i = std::get_if<InterfaceSurface>(&m.surface))
    {
        c.transmission = i->mode != ScatterMode::R;
        c.tint = (i->mode != ScatterMode::T && has_tint(i->reflection_tint)) ||
                 (i->mode != ScatterMode::R && has_tint(i->transmission_tint));
        c.inside = c.transmission && !i->thin_walled;
    }
    return c;
}

void add(CalledFor& sum, const CalledFor& c)
{
    sum.transmission |= c.transmission;
    sum.tint |= c.tint;
    sum.anisotropy |= c.anisotropy;
    sum.tail |= c.tail;
    sum.multiple_scattering |= c.multiple_scattering;
    sum.layering |= c.layering;
    sum.inside |= c.inside;
}

bool is_black(const ClosureTree::Material& material)
{
    const ColorD black(0.0);
    if (const auto* plain = std::get_if<PlainMaterial>(&material))
        return std::visit([&](const auto& s) { return s.color == black; }, plain->surface);
    const auto& m = std::get<MicrofacetMaterial>(material);
    if (const auto* s = std::get_if<SheenSurface>(&m.surface))
        return s->weight == 0 || s->color == black;
    if (const auto* s = std::get_if<SchlickSurface>(&m.surface))
        return s->F0 == black && s->F90 == black;
    const auto* i = std::get_if<InterfaceSurface>(&m.surface);
    return i && (i->mode == ScatterMode::T || i->reflection_tint == black) &&
           (i->mode == ScatterMode::R || i->transmission_tint == black);
}

MicrofacetMaterial simplified(MicrofacetMaterial m)
{
    if (m.distribution == DistributionKind::gtr && m.gamma == 2)
        m.distribution = DistributionKind::ggx;
    return m;
}

std::string closure_name(const ClosureTree::Material& material)
{
    if (const auto* plain = std::get_if<PlainMaterial>(&material))
    {
        constexpr const char* names[] = {"oren_nayar_diffuse", "burley_diffuse", "subsurface",
                                         "translucent",        "transparent",    "sheen"};
        return names[plain->surface.index()];
    }
    constexpr const char* names[] = {"generalized_schlick", "conductor", "dielectric", "sheen"};
    return names[std::get<MicrofacetMaterial>(material).surface.index()];
}

}  // namespace planning
}  // namespace shaders
REGAIN_NAMESPACE_END
