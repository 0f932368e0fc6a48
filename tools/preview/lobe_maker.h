// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// How a closure of a tree becomes lobes of each host. The adapters of all the closures that a
/// material may be are the bulk of what the preview takes to compile: they are in one file per
/// distribution, and one for what has no microfacets.

#pragma once

#include <regain/clarisse/closure_lobe.h>
#include <regain/osl/closure_bsdf.h>
#include <regain/renderman/wide_batch.h>
#include <regain/shaders/wide_material.h>

namespace regain::tools::preview {

/// A closure of a tree, at a point of the one-point host.
struct PointLobe
{
    int k;
    const char* name;
    const clarisse::shading_point<float>& point;
    clarisse::scratchpad& pad;
    clarisse::PendingLobes<float>& pending;
    clarisse::color<float>* albedo;
};

/// A closure at a point of the OSL-shaped host, and what becomes of it.
struct OslLobe
{
    float strength;
    const osl::ComponentFrame& frame;
    const osl::ShaderGlobals& globals;
    const Imath::C3f& weight;
    bool asked;
    osl::CompositeBsdf& composite;
    Imath::C3f& albedo;
    osl::Problems& problems;
};

/// A point of a surface, as it is seen.
struct SeenPoint
{
    Imath::V3f V, N, Ng, T;  ///< unit, in world space, V towards the viewer
};

/// Each is asked about materials of its own kind only.
struct LobeMaker
{
    using Material = shaders::ClosureTree::Material;

    /// What the closure reflects and lets through, at a strength of its compensation.
    Imath::C3f (*albedo)(const Material&, float strength, const SeenPoint&);

    /// `single`: one float at a time.
    renderman::LobeBatch* (*batch)(const renderman::ShadingContext*, const Material&,
                                   const char* name);
    renderman::LobeBatch* (*single)(const renderman::ShadingContext*, const Material&,
                                    const char* name);
    bool (*add)(const Material&, const PointLobe&);
    void (*add_bsdf)(const Material&, const OslLobe&);
};

extern const LobeMaker ggx_lobes, beckmann_lobes, gtr_lobes, std_lobes, plain_lobes;

const LobeMaker& maker_of(const LobeMaker::Material&);

/// with(material, strength, visit) calls visit with the material's closure.
template <class With>
struct MakesLobes
{
    static renderman::LobeBatch* batch(const renderman::ShadingContext* ctx,
                                       const LobeMaker::Material& material, const char* name)
    {
        // However few points there are: with whom a point is in a batch must not change its bits.
        const shaders::WideMaker* wide = ctx->lightPath ? nullptr : shaders::wide_maker(material);
        if (!wide) return single(ctx, material, name);
        constexpr float whole = 1;
        return With::call(material, whole, [&](const auto& closure) -> renderman::LobeBatch* {
            return renderman::WideBatch<std::decay_t<decltype(closure)>>::create(
                ctx, closure, name, [&](const WideSurface& surface, const WideMemory& memory) {
                    return wide->prepare(material, whole, ctx->numPts, surface, memory);
                });
        });
    }
    static renderman::LobeBatch* single(const renderman::ShadingContext* ctx,
                                        const LobeMaker::Material& material, const char* name)
    {
        return With::call(material, 1.0f, [&](const auto& closure) {
            return renderman::make_batch(ctx, closure, name);
        });
    }
    static bool add(const LobeMaker::Material& material, const PointLobe& l)
    {
        return With::call(material, l.point.multiple_scattering_strength, [&](const auto& closure) {
            return clarisse::add_lobes(closure, l.k, l.name, l.point, l.pad, l.pending, l.albedo);
        });
    }
    static void add_bsdf(const LobeMaker::Material& material, const OslLobe& l)
    {
        With::call(material, l.strength, [&](const auto& closure) {
            osl::add_closure(closure, l.frame, l.globals, l.weight, l.asked, l.composite, l.albedo,
                             l.problems);
        });
    }
    static Imath::C3f albedo(const LobeMaker::Material& material, float strength,
                             const SeenPoint& p)
    {
        return With::call(material, strength, [&](const auto& closure) {
            const auto frame = is_interface(closure)
                                   ? ShadingFrame<float>::of(p.N, p.Ng, p.T)
                                   : ShadingFrame<float>::facing(p.V, p.N, p.Ng, p.T);
            const auto a = closure.prepare(frame.known(p.V)).albedo();
            return Imath::C3f(a.reflect + a.transmit);
        });
    }
    static constexpr LobeMaker maker{&albedo, &batch, &single, &add, &add_bsdf};
};

/// Of one distribution.
template <template <class> class Distribution>
struct WithDistribution
{
    template <class Visit>
    static decltype(auto) call(const LobeMaker::Material& material, float strength,
                               const Visit& visit)
    {
        return std::get<shaders::MicrofacetMaterial>(material).with_closure_of<Distribution>(
            strength, visit);
    }
};

}  // namespace regain::tools::preview
