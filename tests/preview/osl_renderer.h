// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A renderer in the manner of OSL's for tests: trees made by hand, flattened at one point.

#pragma once

#include "preview/osl_shader.h"

#include <cmath>

namespace regain::tools::preview::doubles {

inline shaders::MicrofacetMaterial white_metal(const shaders::Compensation& method)
{
    shaders::MicrofacetMaterial m;
    m.surface = shaders::SchlickSurface{};
    m.alpha_x = m.alpha_y = 0.6;
    m.method = method;
    return m;
}

inline shaders::MicrofacetMaterial clear_glass(ScatterMode mode)
{
    shaders::MicrofacetMaterial m;
    shaders::InterfaceSurface i;
    i.mode = mode;
    m.surface = i;
    m.alpha_x = m.alpha_y = 0.3;
    return m;
}

// A library with tables for white metal, glass and a coat, and room for a tree and its closures.
struct OslRenderer
{
    explicit OslRenderer(const shaders::Compensation& method = Method::turquin)
        : shader(kinds(method))
    {}

    static shaders::ClosureTree kinds(const shaders::Compensation& method)
    {
        shaders::ClosureTree all;
        const auto a = all.lobe(white_metal(method)), b = all.lobe(clear_glass(ScatterMode::RT)),
                   c = all.lobe(clear_glass(ScatterMode::R));
        all.set_root(all.add(a, all.add(b, c)));
        all.bind_tables(true);
        return all;
    }

    osl::Problems flatten(const osl::ClosureColor* Ci)
    {
        bsdf.clear();
        return shader.flatten(Ci, globals, bsdf);
    }
    Imath::V3f wo() const { return -globals.I; }

    const osl::ClosureColor* diffuse(const Imath::C3f& albedo = Imath::C3f(0.5f),
                                     const Imath::C3f& w = Imath::C3f(1.0f))
    {
        osl::OrenNayarDiffuseParams p;
        p.N = globals.N;
        p.albedo = albedo;
        p.energy_compensation = 1;
        return nodes.component(osl::oren_nayar_diffuse_id, p, w);
    }
    osl::GeneralizedSchlickParams metal_params() const
    {
        osl::GeneralizedSchlickParams p;
        p.N = globals.N;
        p.U = globals.dPdu;
        p.roughness_x = p.roughness_y = 0.6f;
        return p;
    }
    osl::DielectricParams glass_params() const
    {
        osl::DielectricParams p;
        p.N = globals.N;
        p.U = globals.dPdu;
        p.roughness_x = p.roughness_y = 0.3f;
        return p;
    }
    const osl::ClosureColor* coat()
    {
        auto p = glass_params();
        p.transmission_tint = Imath::C3f(0.0f);
        return nodes.component(osl::dielectric_id, p);
    }
    const osl::ClosureColor* layer(const osl::ClosureColor* top, const osl::ClosureColor* base,
                                   const Imath::C3f& w = Imath::C3f(1.0f))
    {
        return nodes.component(osl::layer_id, osl::LayerParams{top, base}, w);
    }

    // Sum of what leaves, by uniform cells of both hemispheres through eval.
    Imath::C3f energy() const
    {
        constexpr int rows = 200, columns = 100;
        Imath::C3f sum(0.0f);
        for (int i = 0; i < rows; ++i)
            for (int j = 0; j < columns; ++j)
            {
                const float z = 2 * (float(i) + 0.5f) / rows - 1, s = std::sqrt(1 - z * z),
                            phi = 2 * float(M_PI) * (float(j) + 0.5f) / columns;
                const auto e = bsdf.eval(wo(), {s * std::cos(phi), s * std::sin(phi), z});
                sum += e.weight * e.pdf;
            }
        return sum * (4 * float(M_PI) / (rows * columns));
    }

    alignas(16) unsigned char memory[64 * 1024];
    osl::NodePool nodes{memory, sizeof memory};
    osl::ShaderGlobals globals{Imath::V3f(-0.6f, 0, -0.8f), Imath::V3f(0, 0, 1),
                               Imath::V3f(0, 0, 1), Imath::V3f(1, 0, 0), false};
    TreeShader shader;
    osl::CompositeBsdf bsdf;
};

}  // namespace regain::tools::preview::doubles
