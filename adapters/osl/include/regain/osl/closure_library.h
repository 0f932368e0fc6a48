// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// From components to closures, with their compensation:
///
///     ClosureLibrary library;             // once, before rendering; loads tables
///     CompositeBsdf bsdf;                 // one a thread
///     bsdf.clear();
///     problems |= library.flatten(Ci, globals, bsdf);
///     if (bsdf.prepare(-globals.I)) ...
///
/// A gain is a closure weight K(wo): what OSL shades with becomes Ci = sum_k w_k K_k(wo) f_k. It is
/// applied where the tree is read, for there wo is known, and is part of the albedos by which
/// layers let light through and BSDFs are picked. Directions and pdfs know nothing of it. Methods
/// that add a lobe are part of the closure.
///
/// Which tables there are is fixed when the library is made; shading looks among them by the
/// component's distribution, compensation and scatter mode, and neither loads nor allocates.

#pragma once

#include <regain/osl/closure_bsdf.h>
#include <regain/osl/tree_walk.h>
#include <regain/shaders/closure_tree.h>

#include <cstring>
#include <optional>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace osl {

struct LibrarySettings
{
    /// Of each kind of closure with microfacets; null: what docs/methods.md recommends.
    std::optional<shaders::Compensation> reflection, interface;
    std::vector<shaders::DistributionKind> distributions{shaders::DistributionKind::ggx};
    /// Tables for widths that are not equal are loaded, too.
    bool anisotropic = true;
    float strength = 1;  ///< of the compensation, in [0, 1]
};

/// A component as a closure: its material, with the tables bound, and where it is.
struct ReadComponent
{
    shaders::ClosureTree::Material material;
    ComponentFrame frame;
};

/// Adds the closure of any material. Where it is used all closures that there are get compiled:
/// keep that in a file of its own, or give flatten something that knows those a host uses.
struct MakeAny
{
    template <class Material>
    void operator()(const Material& material, float strength, const ComponentFrame& frame,
                    const ShaderGlobals& globals, const Imath::C3f& weight, bool asked,
                    CompositeBsdf& composite, Imath::C3f& albedo, Problems& problems) const
    {
        std::visit(
            [&](const auto& m) {
                m.with_closure(strength, [&](const auto& closure) {
                    add_closure(closure, frame, globals, weight, asked, composite, albedo,
                                problems);
                });
            },
            material);
    }
};

class ClosureLibrary
{
public:
    using Material = shaders::ClosureTree::Material;

    /// Nothing is bound: add() says what for.
    struct Empty
    {};
    explicit ClosureLibrary(Empty, float strength = 1) : _strength(strength) {}

    /// Throws what MicrofacetMaterial::bind_tables throws.
    explicit ClosureLibrary(const LibrarySettings& settings = {}) : _strength(settings.strength)
    {
        using namespace shaders;
        for (const DistributionKind d : settings.distributions)
        {
            MicrofacetMaterial m;
            m.distribution = d;
            m.alpha_x = 0.5;
            m.alpha_y = settings.anisotropic ? 0.4 : 0.5;
            const auto method_or_best = [&](const std::optional<Compensation>& method) {
                m.method = method ? *method : recommended_compensation(m.surface);
                add(m);
            };
            m.surface = ConductorSurface{};
            method_or_best(settings.reflection);
            m.surface = SchlickSurface{};
            method_or_best(settings.reflection);
            // Glass of a distribution with a tail has tables of single gammas, which are not
            // shipped.
            if (has_gamma(d)) continue;
            for (const ScatterMode mode : {ScatterMode::RT, ScatterMode::R, ScatterMode::T})
            {
                InterfaceSurface i;
                i.mode = mode;
                i.shadowing = TransmissionShadowing::beta;
                m.surface = i;
                method_or_best(settings.interface);
                // A sheet takes gains alone.
                i.thin_walled = true;
                m.surface = i;
                const bool gain =
                    settings.interface && std::holds_alternative<Method>(*settings.interface);
                m.method = gain ? *settings.interface : recommended_compensation(m.surface);
                add(m);
            }
        }
    }

    /// Binds the tables for closures of this surface's kind, its scatter mode, shadowing and
    /// distribution, by this method; colours, widths and indices come with components. Of several
    /// that a component does not choose between the first is taken. `for_albedo` is for closures
    /// that are layered or picked among: see MicrofacetMaterial::bind_tables, which also says what
    /// this throws.
    void add(const shaders::MicrofacetMaterial& kind, bool for_albedo = true)
    {
        shaders::MicrofacetMaterial bound = kind;
        bound.bind_tables(for_albedo);
        _kinds.push_back(bound);
    }

    /// For hosts whose strings are not ustrings: answers the characters, or null of none.
    void read_strings_by(const char* (*reader)(const StringParam&)) { _text = reader; }

    /// Adds what the tree consists of to `composite`; make(material, strength, frame, globals,
    /// weight, asked, composite, albedo, problems) does what MakeAny does, and may know fewer
    /// closures. other(component, weight) is told of components that are not the library's, such as
    /// a host's emission, and answers whether it knows them.
    template <class Make, class Other>
    Problems flatten(const ClosureColor* Ci, const ShaderGlobals& globals, CompositeBsdf& composite,
                     const Make& make, const Other& other) const
    {
        Problems found = 0;
        const auto leaf = [&](const ClosureComponent& c, const Imath::C3f& weight, bool asked) {
            Imath::C3f albedo(0.0f);
            ReadComponent read;
            if (c.id >= closure_ids)
            {
                if (!other(c, weight)) found |= unknown_closure;
            }
            else if (this->read(c, read, found))
                make(read.material, _strength, read.frame, globals, weight, asked, composite,
                     albedo, found);
            return albedo;
        };
        TreeWalk<decltype(leaf)> walk(leaf);
        walk.walk(Ci);
        return found | walk.problems();
    }

    /// The same where every component is the library's.
    template <class Make = MakeAny>
    Problems flatten(const ClosureColor* Ci, const ShaderGlobals& globals, CompositeBsdf& composite,
                     const Make& make = {}) const
    {
        return flatten(Ci, globals, composite, make,
                       [](const ClosureComponent&, const Imath::C3f&) { return false; });
    }

    /// The component, which is one of the library's and no layer. False where nothing can be made
    /// of it.
    bool read(const ClosureComponent& c, ReadComponent& out, Problems& problems) const
    {
        using namespace shaders;
        switch (c.id)
        {
            case oren_nayar_diffuse_id: {
                const auto& p = c.as<OrenNayarDiffuseParams>();
                return plain(OrenNayarSurface{ColorD(p.albedo), double(p.roughness),
                                              p.energy_compensation != 0},
                             p.N, out);
            }
            case burley_diffuse_id: {
                const auto& p = c.as<BurleyDiffuseParams>();
                return plain(BurleyDiffuseSurface{ColorD(p.albedo), double(p.roughness)}, p.N, out);
            }
            case translucent_id: {
                const auto& p = c.as<TranslucentParams>();
                return plain(TranslucentSurface{ColorD(p.albedo)}, p.N, out);
            }
            case transparent_id:
                out.frame.of_surface = true;
                out.material = PlainMaterial{TransparentSurface{}};
                return true;
            case subsurface_id: {
                const auto& p = c.as<SubsurfaceParams>();
                problems |= subsurface_stand_in;
                return plain(SubsurfaceSurface{ColorD(p.albedo)}, p.N, out);
            }
            case sheen_id: {
                const auto& p = c.as<SheenParams>();
                if (p.mode == 2)
                {
                    MicrofacetMaterial m;
                    m.surface = SheenSurface{ColorD(p.albedo), 1};
                    m.method = Method::none;
                    out.material = m;
                    out.frame.N = p.N;
                    return true;
                }
                return plain(
                    ClothSurface{ColorD(p.albedo), double(p.roughness),
                                 p.mode == 1 ? ClothMode::zeltner : ClothMode::conty_kulla},
                    p.N, out);
            }
            case conductor_id: {
                const auto& p = c.as<ConductorParams>();
                return microfacets(p, ConductorSurface{ColorD(p.ior), ColorD(p.extinction)}, out,
                                   problems);
            }
            case generalized_schlick_id: {
                const auto& p = c.as<GeneralizedSchlickParams>();
                if (p.transmission_tint != Imath::C3f(0.0f)) problems |= schlick_transmission;
                const bool no_tint = p.color82 == Imath::C3f(0.0f);
                SchlickSurface s;
                // A tint of what reflects is one of both its ends.
                s.F0 = ColorD(p.f0) * ColorD(p.reflection_tint);
                s.F82 = no_tint ? ColorD(1.0) : ColorD(p.color82);
                s.F90 = ColorD(p.f90) * ColorD(p.reflection_tint);
                s.exponent = double(p.exponent);
                return microfacets(p, s, out, problems);
            }
            case dielectric_id: return interface(c.as<DielectricParams>(), out, problems);
            default: return false;
        }
    }

private:
    using ColorD = shaders::ColorD;
    using Surface = decltype(shaders::MicrofacetMaterial::surface);

    template <class Plain>
    static bool plain(const Plain& surface, const Imath::V3f& N, ReadComponent& out)
    {
        out.material = shaders::PlainMaterial{surface};
        out.frame.N = N;
        return true;
    }

    template <class Params>
    bool microfacets(const Params& p, const Surface& surface, ReadComponent& out,
                     Problems& problems, const char* shadowing = nullptr) const
    {
        const shaders::MicrofacetMaterial* kind =
            find(surface, text(p.distribution), text(p.compensation), shadowing, problems);
        if (!kind) return false;
        shaders::MicrofacetMaterial m = *kind;
        m.surface = surface;
        // The form of transmission is the tables'.
        if (auto* i = std::get_if<shaders::InterfaceSurface>(&m.surface))
            i->shadowing = std::get<shaders::InterfaceSurface>(kind->surface).shadowing;
        m.gamma = p.gamma > 0 ? double(p.gamma) : 2;
        m.alpha_x = double(p.roughness_x);
        m.alpha_y = double(p.roughness_y);
        out.material = m;
        out.frame = {p.N, p.U};
        if (p.thinfilm_thickness > 0) problems |= thin_film;
        return true;
    }

    // OSL has no scatter mode: a tint of 0 takes one away.
    bool interface(const DielectricParams& p, ReadComponent& out, Problems& problems) const
    {
        const Imath::C3f black(0.0f);
        const bool reflects = p.reflection_tint != black, transmits = p.transmission_tint != black;
        if (!reflects && !transmits) return false;
        shaders::InterfaceSurface i;
        i.eta = double(p.ior);
        i.mode = !transmits ? ScatterMode::R : !reflects ? ScatterMode::T : ScatterMode::RT;
        i.thin_walled = p.thin_walled != 0;
        i.reflection_tint = ColorD(p.reflection_tint);
        i.transmission_tint = ColorD(p.transmission_tint);
        return microfacets(p, i, out, problems, text(p.transmission_shadowing));
    }

    const char* text(const StringParam& s) const
    {
        const char* characters = _text ? _text(s) : s.text;
        return characters && *characters ? characters : nullptr;
    }

    // The kind that the component asks for; else the one that differs least, which is said.
    const shaders::MicrofacetMaterial* find(const Surface& surface, const char* distribution,
                                            const char* compensation, const char* shadowing,
                                            Problems& problems) const
    {
        const shaders::MicrofacetMaterial* best = nullptr;
        int best_score = -1;
        bool same_distribution = false, same_compensation = false;
        const char* wanted = distribution ? distribution : "ggx";
        for (const shaders::MicrofacetMaterial& k : _kinds)
        {
            if (!is_alike(k.surface, surface)) continue;
            const bool d = name(k.distribution) == wanted,
                       c = !compensation || name(k.method) == compensation,
                       s = !shadowing || has_shadowing(k.surface, shadowing);
            const int score = 4 * d + 2 * c + s;
            if (score <= best_score) continue;
            best = &k;
            best_score = score;
            same_distribution = d;
            same_compensation = c && s;
        }
        if (!best) problems |= no_tables;
        if (best && !same_distribution) problems |= unknown_distribution;
        if (best && !same_compensation) problems |= unknown_compensation;
        return best;
    }

    static bool is_alike(const Surface& a, const Surface& b)
    {
        if (a.index() != b.index()) return false;
        const auto* one = std::get_if<shaders::InterfaceSurface>(&a);
        if (!one) return true;
        const auto& other = std::get<shaders::InterfaceSurface>(b);
        return one->mode == other.mode && one->thin_walled == other.thin_walled;
    }
    static bool has_shadowing(const Surface& surface, const char* wanted)
    {
        const auto* i = std::get_if<shaders::InterfaceSurface>(&surface);
        if (!i) return true;
        const bool beta = i->shadowing == TransmissionShadowing::beta;
        return std::strcmp(wanted, beta ? "beta" : "correlated") == 0;
    }

    std::vector<shaders::MicrofacetMaterial> _kinds;
    const char* (*_text)(const StringParam&) = nullptr;
    float _strength;
};

}  // namespace osl
REGAIN_NAMESPACE_END
