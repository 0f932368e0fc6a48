// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The closures that run on both machines. A kind is one type of closure:
///
///     variants               static: how many there are, told apart at run time
///     name(variant)          static, on the host
///     closure(surface, variant)   static, on either machine
///     walks                  static: its answers hang on comparisons of random numbers with what
///                            was rounded, many of them, so that a few come out otherwise
///
/// A new closure is added to one of the lists at the end, and runs everywhere.

#pragma once

#include "question.h"

#include <regain/closures/analytic_tables.h>
#include <regain/closures/artist_fresnel.h>
#include <regain/closures/balanced_gain.h>
#include <regain/closures/beckmann.h>
#include <regain/closures/bounded_dielectric_walk.h>
#include <regain/closures/bounded_walk.h>
#include <regain/closures/burley_diffuse.h>
#include <regain/closures/conductor_fresnel.h>
#include <regain/closures/constant_fresnel.h>
#include <regain/closures/conty_kulla_sheen.h>
#include <regain/closures/dielectric_gain.h>
#include <regain/closures/dielectric_kulla_conty.h>
#include <regain/closures/dielectric_tail.h>
#include <regain/closures/dielectric_walk.h>
#include <regain/closures/directional_gain.h>
#include <regain/closures/fitted_tail.h>
#include <regain/closures/ggx.h>
#include <regain/closures/gtr.h>
#include <regain/closures/host_queries.h>
#include <regain/closures/kulla_conty.h>
#include <regain/closures/layer.h>
#include <regain/closures/method_gain.h>
#include <regain/closures/microfacet_reflection.h>
#include <regain/closures/oren_nayar_diffuse.h>
#include <regain/closures/schlick_fresnel.h>
#include <regain/closures/sheen.h>
#include <regain/closures/std.h>
#include <regain/closures/thin_dielectric.h>
#include <regain/closures/translucent.h>
#include <regain/closures/transparent.h>
#include <regain/closures/walk.h>
#include <regain/closures/zeltner_sheen.h>

#include <string>

namespace regain::tests {

template <class... Kinds>
struct List
{};

/// What most kinds are.
struct OneClosure
{
    static constexpr int variants = 1;
    static constexpr bool walks = false;
};

template <class D>
REGAIN_HOST_DEVICE D distribution_of(const Surface& s)
{
    if constexpr (D::has_tail)
        return D(s.alpha_x, s.alpha_y, s.gamma);
    else
        return D(s.alpha_x, s.alpha_y);
}

// The Fresnel terms of metals, with their lobes' names.

struct ExactMetal
{
    using Fresnel = ConductorFresnel<float>;
    static std::string name() { return "conductor "; }
    REGAIN_HOST_DEVICE static Fresnel fresnel(const Surface&)
    {
        return Fresnel({0.16f, 0.42f, 1.5f}, {3.46f, 2.35f, 1.88f});
    }
};
struct SchlickMetal
{
    using Fresnel = SchlickFresnel<float>;
    static std::string name() { return "generalized_schlick "; }
    REGAIN_HOST_DEVICE static Fresnel fresnel(const Surface& s)
    {
        return Fresnel(s.color, s.color * 0.9f);
    }
};
struct ArtistsMetal
{
    using Fresnel = ArtistFresnel<float>;
    static std::string name() { return "artist's conductor "; }
    REGAIN_HOST_DEVICE static Fresnel fresnel(const Surface& s)
    {
        return Fresnel(s.color, Color3<float>(0.5f));
    }
};
struct WhiteMetal
{
    using Fresnel = ConstantFresnel<float>;
    static std::string name() { return "white mirror "; }
    REGAIN_HOST_DEVICE static Fresnel fresnel(const Surface&) { return Fresnel(); }
};

template <class D, class Metal>
REGAIN_HOST_DEVICE auto mirror_of(const Surface& s)
{
    return MicrofacetReflection(distribution_of<D>(s), Metal::fresnel(s), s.mirror);
}

// Metals.

template <class D, class Metal>
struct Gained : OneClosure
{
    static constexpr int variants = sizeof(all_methods) / sizeof(all_methods[0]);
    static std::string name(int v)
    {
        return Metal::name() + std::string(regain::name(all_methods[v]));
    }
    REGAIN_HOST_DEVICE static auto closure(const Surface& s, int v)
    {
        return compensated(mirror_of<D, Metal>(s), static_cast<Method>(v), s.mirror, s.strength);
    }
};
template <class D, class Metal>
struct DirectionallyGained : OneClosure
{
    static std::string name(int) { return Metal::name() + "directional"; }
    REGAIN_HOST_DEVICE static auto closure(const Surface& s, int)
    {
        return directional(mirror_of<D, Metal>(s), s.mirror, s.strength);
    }
};
template <class D, class Metal>
struct Balanced : OneClosure
{
    static std::string name(int) { return Metal::name() + "balanced"; }
    REGAIN_HOST_DEVICE static auto closure(const Surface& s, int)
    {
        return balanced(mirror_of<D, Metal>(s), s.mirror, s.strength);
    }
};
template <class D, class Metal>
struct WithMissingEnergy : OneClosure
{
    static constexpr int variants = 2;
    static std::string name(int v)
    {
        return Metal::name() + std::string(regain::name(all_kulla_conty_forms[v]));
    }
    REGAIN_HOST_DEVICE static auto closure(const Surface& s, int v)
    {
        return kulla_conty(mirror_of<D, Metal>(s), static_cast<KullaContyForm>(v), s.mirror,
                           s.strength);
    }
};
template <class D, class Metal>
struct WithTail : OneClosure
{
    static std::string name(int) { return Metal::name() + "tail"; }
    REGAIN_HOST_DEVICE static auto closure(const Surface& s, int)
    {
        return fitted_tail(mirror_of<D, Metal>(s), s.mirror, s.strength);
    }
};
template <class D, class Metal>
struct Walking : OneClosure
{
    static constexpr bool walks = true;
    static std::string name(int) { return Metal::name() + "walk"; }
    REGAIN_HOST_DEVICE static auto closure(const Surface& s, int)
    {
        return Walk(distribution_of<D>(s), Metal::fresnel(s), 1, s.mirror);
    }
};
template <class D, class Metal>
struct WalkingWithinBounds : OneClosure
{
    static constexpr bool walks = true;
    static std::string name(int) { return Metal::name() + "walk-bounded"; }
    REGAIN_HOST_DEVICE static auto closure(const Surface& s, int)
    {
        return BoundedWalk(distribution_of<D>(s), Metal::fresnel(s), 1, s.mirror);
    }
};
template <class D, class Metal>
struct UnderSheen : OneClosure
{
    static std::string name(int) { return Metal::name() + "burley-sheen"; }
    REGAIN_HOST_DEVICE static auto closure(const Surface& s, int)
    {
        return burley_sheen(mirror_of<D, Metal>(s), s.strength);
    }
};

/// Formulas in place of tables: they are compiled into the kernel.
template <class D, class Metal>
struct ByFormulas : OneClosure
{
    static std::string name(int) { return Metal::name() + "turquin, by formulas"; }
    REGAIN_HOST_DEVICE static auto closure(const Surface& s, int)
    {
        return compensated(MicrofacetReflection(distribution_of<D>(s), Metal::fresnel(s)),
                           Method::turquin, analytic_tables<D>(), s.strength);
    }
};

/// What a path from a light asks.
template <class D, class Metal>
struct Reversed : OneClosure
{
    static std::string name(int) { return Metal::name() + "turquin, reversed"; }
    REGAIN_HOST_DEVICE static auto closure(const Surface& s, int)
    {
        return for_light_path(
            compensated(mirror_of<D, Metal>(s), Method::turquin, s.mirror, s.strength));
    }
};

// Glass. The variants are the scatter modes, and those twice.

inline std::string name_of_mode(int mode)
{
    constexpr const char* modes[] = {"R", "T", "RT"};
    return std::string("dielectric ") + modes[mode];
}
inline std::string name_of_shadowing(int v)
{
    return name_of_mode(v % 3) + (v % 6 < 3 ? " correlated" : " beta");
}
REGAIN_HOST_DEVICE inline ScatterMode mode_of(int v) { return static_cast<ScatterMode>(v % 3); }
REGAIN_HOST_DEVICE inline const DielectricTables& glass_tables_of(const Surface& s, int v)
{
    return s.glass[v % 6 < 3 ? 0 : 1];
}
template <class D>
REGAIN_HOST_DEVICE Dielectric<D> glass_of(const Surface& s, int v)
{
    return Dielectric<D>(
        distribution_of<D>(s), s.eta, mode_of(v), s.color, Color3<float>(1.0f),
        v % 6 < 3 ? TransmissionShadowing::correlated : TransmissionShadowing::beta,
        glass_tables_of(s, v));
}

template <class D>
struct Glass : OneClosure
{
    static constexpr int variants = 12;
    static std::string name(int v) { return name_of_shadowing(v) + (v < 6 ? " none" : " turquin"); }
    REGAIN_HOST_DEVICE static auto closure(const Surface& s, int v)
    {
        return compensated(glass_of<D>(s, v), v < 6 ? Method::none : Method::turquin,
                           glass_tables_of(s, v), s.mirror, s.strength);
    }
};
template <class D>
struct GlassWithMissingEnergy : OneClosure
{
    static constexpr int variants = 6;
    static std::string name(int v) { return name_of_shadowing(v) + " kulla-conty"; }
    REGAIN_HOST_DEVICE static auto closure(const Surface& s, int v)
    {
        return kulla_conty(glass_of<D>(s, v), glass_tables_of(s, v), s.strength);
    }
};
template <class D>
struct GlassWithTail : OneClosure
{
    static constexpr int variants = 3;
    static std::string name(int v) { return name_of_mode(v) + " tail"; }
    REGAIN_HOST_DEVICE static auto closure(const Surface& s, int v)
    {
        return fitted_tail(glass_of<D>(s, v + 3), s.glass[1], s.strength);
    }
};
template <class D>
struct GlassWalking : OneClosure
{
    static constexpr bool walks = true;
    static std::string name(int) { return "dielectric walk"; }
    REGAIN_HOST_DEVICE static auto closure(const Surface& s, int)
    {
        return DielectricWalk<D>(distribution_of<D>(s), s.eta, s.color);
    }
};
template <class D>
struct GlassWalkingWithinBounds : OneClosure
{
    static constexpr bool walks = true;
    static std::string name(int) { return "dielectric walk-bounded"; }
    REGAIN_HOST_DEVICE static auto closure(const Surface& s, int)
    {
        return BoundedDielectricWalk<D>(distribution_of<D>(s), s.eta, s.color, Color3<float>(1.0f),
                                        1, s.glass[1], s.mirror);
    }
};
template <class D>
struct Sheet : OneClosure
{
    static constexpr int variants = 6;
    static std::string name(int v)
    {
        return "thin-walled " + name_of_mode(v % 3) + (v < 3 ? " none" : " turquin");
    }
    REGAIN_HOST_DEVICE static auto closure(const Surface& s, int v)
    {
        return compensated(ThinDielectric<D>(distribution_of<D>(s), s.eta, mode_of(v), s.color,
                                             Color3<float>(1.0f), s.mirror),
                           v < 3 ? Method::none : Method::turquin, s.mirror, s.strength);
    }
};

// What has no microfacets; alpha_x is its roughness.

struct Dull : OneClosure
{
    static constexpr int variants = 2;
    static std::string name(int v)
    {
        return v == 0 ? "oren_nayar_diffuse" : "oren_nayar_diffuse, compensated";
    }
    REGAIN_HOST_DEVICE static auto closure(const Surface& s, int v)
    {
        return OrenNayarDiffuse<float>(s.color, s.alpha_x, v == 1);
    }
};
struct Dusty : OneClosure
{
    static std::string name(int) { return "burley_diffuse"; }
    REGAIN_HOST_DEVICE static auto closure(const Surface& s, int)
    {
        return BurleyDiffuse<float>(s.color, s.alpha_x);
    }
};
struct BurleysCloth : OneClosure
{
    static std::string name(int) { return "sheen burley"; }
    REGAIN_HOST_DEVICE static auto closure(const Surface& s, int)
    {
        return Sheen<float>(s.strength, s.color);
    }
};
struct ContyKullasCloth : OneClosure
{
    static std::string name(int) { return "sheen conty_kulla"; }
    REGAIN_HOST_DEVICE static auto closure(const Surface& s, int)
    {
        return ContyKullaSheen<float>(s.color, s.alpha_x);
    }
};
struct ZeltnersCloth : OneClosure
{
    static std::string name(int) { return "sheen zeltner"; }
    REGAIN_HOST_DEVICE static auto closure(const Surface& s, int)
    {
        return ZeltnerSheen<float>(s.color, s.alpha_x);
    }
};
struct Paper : OneClosure
{
    static std::string name(int) { return "translucent"; }
    REGAIN_HOST_DEVICE static auto closure(const Surface& s, int)
    {
        return Translucent<float>(s.color);
    }
};
struct Gauze : OneClosure
{
    static std::string name(int) { return "transparent"; }
    REGAIN_HOST_DEVICE static auto closure(const Surface& s, int)
    {
        return Transparent<float>(s.color);
    }
};
struct Layered : OneClosure
{
    static std::string name(int) { return "layer of glass over a mix"; }
    REGAIN_HOST_DEVICE static auto closure(const Surface& s, int)
    {
        const auto coat = compensated(
            Dielectric<GGX<float>>(distribution_of<GGX<float>>(s), s.eta, ScatterMode::R,
                                   Color3<float>(1.0f), Color3<float>(1.0f),
                                   TransmissionShadowing::correlated, s.glass[0]),
            Method::turquin, s.glass[0], s.mirror, s.strength);
        return layer(coat, mix(OrenNayarDiffuse<float>(s.color, s.alpha_x),
                               Translucent<float>(s.color), 0.3f));
    }
};
struct Three : OneClosure
{
    static std::string name(int) { return "sum of three"; }
    REGAIN_HOST_DEVICE static auto closure(const Surface& s, int)
    {
        return sum(sum(Sheen<float>(s.strength), BurleyDiffuse<float>(s.color, s.alpha_x)),
                   mirror_of<GGX<float>, SchlickMetal>(s));
    }
};

// The lists, one for each source that is compiled.

template <class D, class Metal>
using MetalKinds = List<Gained<D, Metal>, DirectionallyGained<D, Metal>, Balanced<D, Metal>,
                        WithMissingEnergy<D, Metal>, WithTail<D, Metal>, Walking<D, Metal>,
                        WalkingWithinBounds<D, Metal>, UnderSheen<D, Metal>, Reversed<D, Metal>>;
template <class D>
using GlassKinds = List<Glass<D>, GlassWithMissingEnergy<D>, GlassWithTail<D>, GlassWalking<D>,
                        GlassWalkingWithinBounds<D>, Sheet<D>>;
template <class D>
using FormulaKinds = List<ByFormulas<D, SchlickMetal>>;

template <class... Lists>
struct Joined;
template <class... A>
struct Joined<List<A...>>
{
    using type = List<A...>;
};
template <class... A, class... B, class... More>
struct Joined<List<A...>, List<B...>, More...> : Joined<List<A..., B...>, More...>
{};

template <class D>
using MicrofacetKinds =
    typename Joined<MetalKinds<D, ExactMetal>, MetalKinds<D, SchlickMetal>, GlassKinds<D>>::type;

using ggx_kinds = Joined<MicrofacetKinds<GGX<float>>, FormulaKinds<GGX<float>>>::type;
using beckmann_kinds =
    Joined<MicrofacetKinds<Beckmann<float>>, FormulaKinds<Beckmann<float>>>::type;
using gtr_kinds = MicrofacetKinds<GTR<float>>;
using std_kinds = MicrofacetKinds<STD<float>>;
using plain_kinds =
    List<Dull, Dusty, BurleysCloth, ContyKullasCloth, ZeltnersCloth, Paper, Gauze, Layered, Three,
         Gained<GGX<float>, ArtistsMetal>, Gained<GGX<float>, WhiteMetal>>;

}  // namespace regain::tests
