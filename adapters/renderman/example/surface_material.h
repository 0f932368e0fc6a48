// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A surface as productions have them, of closures of this library:
///
///     coat over sheen over (metal, or (glass, or specular over diffuse))
///
/// each layer letting through what it does not keep, compensation included. It is a material of
/// several closures as <regain/closures/host_queries.h> describes; the adapters know the rest. All
/// its closures have fixed types, so little is compiled and nothing is looked up while shading;
/// those that its settings leave nothing for are not there.

#pragma once

#include <regain/closures/dielectric.h>
#include <regain/closures/dielectric_gain.h>
#include <regain/closures/directional_gain.h>
#include <regain/closures/ggx.h>
#include <regain/closures/microfacet_reflection.h>
#include <regain/closures/oren_nayar_diffuse.h>
#include <regain/closures/schlick_fresnel.h>
#include <regain/closures/zeltner_sheen.h>
#include <regain/luts/library.h>

#include <algorithm>
#include <cmath>

namespace surface_example {

using namespace regain;

struct Settings
{
    Imath::C3f base_color{0.8f};
    float base_roughness = 0.2f;
    float metalness = 0, specular_roughness = 0.3f, specular_anisotropy = 0, specular_ior = 1.5f;
    Imath::C3f edge_color{1.0f};
    float transmission = 0;
    Imath::C3f transmission_color{1.0f};
    float coat = 0, coat_roughness = 0.1f, coat_ior = 1.5f;
    float sheen = 0, sheen_roughness = 0.3f;
    Imath::C3f sheen_color{1.0f};
    float presence = 1;
    float compensation = 1;
};

class SurfaceMaterial
{
public:
    enum Part { coat, sheen, metal, glass, specular, diffuse, parts };

    /// Looks up the tables that the settings need.
    explicit SurfaceMaterial(const Settings& s) : _s(s)
    {
        const bool dielectric = s.metalness < 1, opaque = dielectric && s.transmission < 1;
        const bool there[parts] = {s.coat > 0,      s.sheen > 0,
                                   s.metalness > 0, dielectric && s.transmission > 0,
                                   opaque,          opaque};
        for (int p = 0; p < parts; ++p)
            if (there[p]) _part[_count++] = static_cast<Part>(p);

        // Width and aspect as MaterialX's roughness_anisotropy has them.
        const float aspect = std::sqrt(1 - 0.98f * s.specular_anisotropy),
                    alpha = s.specular_roughness * s.specular_roughness;
        _alpha_x = std::min(alpha / aspect, 1.0f);
        _alpha_y = alpha * aspect;
        const bool anisotropic = _alpha_x != _alpha_y;

        _mirror = luts::microfacet_tables("ggx");
        if (there[metal]) luts::add_later_bounces(_mirror, "ggx");
        if (anisotropic) luts::add_anisotropy(_mirror, "ggx");
        if (there[coat] || there[glass] || there[specular])
        {
            _interface = luts::dielectric_tables("ggx", TransmissionShadowing::correlated);
            if (anisotropic)
                luts::add_anisotropy(_interface, "ggx", TransmissionShadowing::correlated);
        }
    }

    int lobes() const { return _count; }
    const char* lobe_name(int k) const
    {
        constexpr const char* names[parts] = {"coat",  "sheen",    "metal",
                                              "glass", "specular", "diffuse"};
        return names[_part[k]];
    }
    float presence() const { return _s.presence; }

    template <class Real, class Visit>
    decltype(auto) with_lobe(int k, Real strength, const Visit& visit) const
    {
        using Color = Color3<Real>;
        const Color white(Real(1));
        const Real gain = strength * Real(_s.compensation);
        const GGX<Real> facets{Real(_alpha_x), Real(_alpha_y)};
        const auto interface = [&](const GGX<Real>& d, float ior, ScatterMode mode,
                                   const Color& transmitted) {
            return compensated(Dielectric(d, Real(ior), mode, white, transmitted,
                                          TransmissionShadowing::correlated, _interface),
                               Method::turquin, _interface, _mirror, gain);
        };
        switch (_part[k])
        {
            case coat: {
                const Real alpha = Real(_s.coat_roughness * _s.coat_roughness);
                return visit(
                    interface(GGX<Real>(alpha, alpha), _s.coat_ior, ScatterMode::R, white));
            }
            case sheen:
                return visit(ZeltnerSheen<Real>(Color(_s.sheen_color), Real(_s.sheen_roughness)));
            case metal:
                return visit(directional(
                    MicrofacetReflection(facets,
                                         SchlickFresnel<Real>(Color(_s.base_color),
                                                              Color(_s.edge_color), white, Real(5)),
                                         _mirror),
                    _mirror, gain));
            case glass:
                return visit(interface(facets, _s.specular_ior, ScatterMode::RT,
                                       Color(_s.transmission_color)));
            case specular: return visit(interface(facets, _s.specular_ior, ScatterMode::R, white));
            default: break;
        }
        return visit(OrenNayarDiffuse<Real>(Color(_s.base_color), Real(_s.base_roughness), true));
    }

    template <class Real>
    Color3<Real> lobe_weights(const Color3<Real>* albedo, Color3<Real>* weight) const
    {
        using Color = Color3<Real>;
        Color by_part[parts], energy[parts];
        for (int p = 0; p < parts; ++p) energy[p] = Color(Real(0));
        for (int k = 0; k < _count; ++k) energy[_part[k]] = albedo[k];

        const auto below = [](const Color& above) {
            Color rest;
            for (int c = 0; c < 3; ++c) rest[c] = Real(1) - std::clamp(above[c], Real(0), Real(1));
            return rest;
        };
        const Color uncoated = below(energy[coat] * Real(_s.coat)),
                    base = uncoated * below(energy[sheen] * Real(_s.sheen)),
                    dielectric = base * Real(1 - _s.metalness),
                    opaque = dielectric * Real(1 - _s.transmission);
        by_part[coat] = Color(Real(_s.coat));
        by_part[sheen] = uncoated * Real(_s.sheen);
        by_part[metal] = base * Real(_s.metalness);
        by_part[glass] = dielectric * Real(_s.transmission);
        by_part[specular] = opaque;
        by_part[diffuse] = opaque * below(energy[specular]);

        Color whole(Real(0));
        for (int k = 0; k < _count; ++k)
        {
            weight[k] = by_part[_part[k]];
            whole += weight[k] * albedo[k];
        }
        return whole;
    }

private:
    Settings _s;
    Part _part[parts] = {};
    int _count = 0;
    float _alpha_x = 0, _alpha_y = 0;
    MicrofacetTables _mirror;
    DielectricTables _interface;
};

}  // namespace surface_example
