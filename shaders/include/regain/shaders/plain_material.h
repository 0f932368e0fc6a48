// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A material of one closure without microfacets, chosen at run time: the diffuse closures, the
/// cloths, what light goes straight through. Names, parameters and defaults are MaterialX's
/// (pbrlib 1.39); none has anything to compensate, and none reads a table.
///
///     PlainMaterial m{OrenNayarSurface{ColorD(0.5), 0.8}};
///     m.with_closure(1.0f, [](const auto& closure) { ... });
///
/// Colours are linear, in [0, 1], roughnesses in [0, 1]; the closures clamp them.

#pragma once

#include <regain/closures/burley_diffuse.h>
#include <regain/closures/conty_kulla_sheen.h>
#include <regain/closures/count.h>
#include <regain/closures/oren_nayar_diffuse.h>
#include <regain/closures/translucent.h>
#include <regain/closures/transparent.h>
#include <regain/closures/zeltner_sheen.h>

#include <variant>

REGAIN_NAMESPACE_BEGIN
namespace shaders {

using ColorD = Imath::Color3<double>;

/// oren_nayar_diffuse_bsdf.
struct OrenNayarSurface
{
    ColorD color{0.18};
    double roughness = 0;
    bool energy_compensation = false;
};

/// burley_diffuse_bsdf.
struct BurleyDiffuseSurface
{
    ColorD color{0.18};
    double roughness = 0;
};

/// subsurface_bsdf, of which nothing but the colour is taken: light leaves where it enters. A stand
/// in, for what goes on below the surface is not simulated.
struct SubsurfaceSurface
{
    ColorD color{0.18};
};

/// translucent_bsdf.
struct TranslucentSurface
{
    ColorD color{1.0};
};

/// OSL's transparent_bsdf.
struct TransparentSurface
{
    ColorD color{1.0};
};

enum class ClothMode { conty_kulla, zeltner };

/// sheen_bsdf.
struct ClothSurface
{
    ColorD color{1.0};
    double roughness = 0.3;
    ClothMode mode = ClothMode::conty_kulla;
};

class PlainMaterial
{
public:
    using Surface = std::variant<OrenNayarSurface, BurleyDiffuseSurface, SubsurfaceSurface,
                                 TranslucentSurface, TransparentSurface, ClothSurface>;
    Surface surface;

    /// visit(closure); the strength of compensation means nothing here. Visit answers one type.
    template <class Real, class Visit>
    decltype(auto) with_closure(Real, const Visit& visit) const
    {
        REGAIN_COUNTED(closures);
        using Color = Color3<Real>;
        if (const auto* s = std::get_if<BurleyDiffuseSurface>(&surface))
            return visit(BurleyDiffuse<Real>(Color(s->color), Real(s->roughness)));
        if (const auto* s = std::get_if<SubsurfaceSurface>(&surface))
            return visit(OrenNayarDiffuse<Real>(Color(s->color)));
        if (const auto* s = std::get_if<TranslucentSurface>(&surface))
            return visit(Translucent<Real>(Color(s->color)));
        if (const auto* s = std::get_if<TransparentSurface>(&surface))
            return visit(Transparent<Real>(Color(s->color)));
        if (const auto* s = std::get_if<ClothSurface>(&surface))
        {
            if (s->mode == ClothMode::zeltner)
                return visit(ZeltnerSheen<Real>(Color(s->color), Real(s->roughness)));
            return visit(ContyKullaSheen<Real>(Color(s->color), Real(s->roughness)));
        }
        const auto& s = *std::get_if<OrenNayarSurface>(&surface);
        return visit(
            OrenNayarDiffuse<Real>(Color(s.color), Real(s.roughness), s.energy_compensation));
    }

    const char* lobe_name() const
    {
        constexpr const char* names[] = {"diffuse",     "diffuse",     "subsurface",
                                         "translucent", "transparent", "sheen"};
        return names[surface.index()];
    }

    /// What is shown in the place of what was asked for, for a warning; null where that is itself.
    const char* stand_in() const
    {
        return std::holds_alternative<SubsurfaceSurface>(surface)
                   ? "subsurface scattering is shown as diffuse reflection of the same colour"
                   : nullptr;
    }
};

}  // namespace shaders
REGAIN_NAMESPACE_END
