// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// One material of every closure that can be chosen at run time: every lobe, distribution and
/// method of compensation that go together, and the closures without microfacets.

#pragma once

#include <regain/shaders/wide_material.h>

#include <string>
#include <vector>

namespace regain::tests {

struct NamedMaterial
{
    std::string name;
    shaders::ClosureTree::Material material;
};

/// Their tables are bound. `alpha_y`: 0 for that of x.
inline std::vector<NamedMaterial> wide_materials(double alpha, double alpha_y = 0)
{
    using namespace shaders;
    std::vector<NamedMaterial> all;
    InterfaceSurface glass, window, reflecting, transmitting;
    glass.shadowing = TransmissionShadowing::beta;
    glass.reflection_tint = ColorD(0.9, 0.8, 0.7);
    window.thin_walled = true;
    reflecting.mode = ScatterMode::R;
    transmitting.mode = ScatterMode::T;
    const struct
    {
        const char* name;
        decltype(MicrofacetMaterial::surface) surface;
    } surfaces[] = {
        {"schlick", SchlickSurface{{0.9, 0.6, 0.2}, {0.9, 0.95, 1.0}, ColorD(1.0), 5}},
        {"conductor", ConductorSurface{}},
        {"glass", glass},
        {"correlated glass", InterfaceSurface{}},
        {"glass R", reflecting},
        {"glass T", transmitting},
        {"window", window},
    };
    for (const auto& s : surfaces)
        for (const DistributionKind distribution : all_distributions)
            for (const std::string_view method : compensation_names())
            {
                MicrofacetMaterial m;
                m.surface = s.surface;
                m.distribution = distribution;
                m.gamma = distribution == DistributionKind::std ? 2.5 : 1.5;
                m.alpha_x = alpha;
                m.alpha_y = alpha_y > 0 ? alpha_y : alpha;
                m.method = *compensation_named(method);
                try
                {
                    m.bind_tables(true);
                }
                catch (const std::exception&)
                {
                    continue;  // there is no such combination, or a table that is not shipped
                }
                all.push_back({std::string(s.name) + ", " + std::string(name(distribution)) + ", " +
                                   std::string(method),
                               m});
            }
    MicrofacetMaterial sheen;
    sheen.surface = SheenSurface{{0.8, 0.5, 0.3}, 0.9};
    sheen.method = Method::none;
    all.push_back({"sheen", sheen});
    const PlainMaterial plain[] = {{OrenNayarSurface{{0.8, 0.5, 0.3}, 0.6, true}},
                                   {BurleyDiffuseSurface{{0.8, 0.5, 0.3}, alpha}},
                                   {SubsurfaceSurface{}},
                                   {TranslucentSurface{}},
                                   {TransparentSurface{}},
                                   {ClothSurface{{0.8, 0.5, 0.3}, alpha}},
                                   {ClothSurface{ColorD(0.9), alpha, ClothMode::zeltner}}};
    for (const PlainMaterial& p : plain)
        all.push_back({"plain " + std::to_string(p.surface.index()), p});
    return all;
}

}  // namespace regain::tests
