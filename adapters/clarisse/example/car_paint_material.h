// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Car paint of closures of this library: a clear coat over pigment, in which flakes of metal lie
/// whose many directions make a highlight with a long tail (GTR). It is a material of several
/// closures as <regain/closures/host_queries.h> describes; the adapters know the rest.

#pragma once

#include <regain/closures/dielectric.h>
#include <regain/closures/dielectric_gain.h>
#include <regain/closures/ggx.h>
#include <regain/closures/gtr.h>
#include <regain/closures/method_gain.h>
#include <regain/closures/microfacet_reflection.h>
#include <regain/closures/oren_nayar_diffuse.h>
#include <regain/closures/schlick_fresnel.h>
#include <regain/luts/library.h>

#include <algorithm>

namespace car_paint_example {

using namespace regain;

struct Settings
{
    Imath::C3f pigment{0.35f, 0.02f, 0.02f};
    float pigment_roughness = 0.3f;
    float flakes = 0.4f, flake_roughness = 0.5f, flake_tail = 1.3f;
    Imath::C3f flake_color{0.9f, 0.4f, 0.35f};
    float coat = 1, coat_roughness = 0.05f, coat_ior = 1.5f;
    float opacity = 1;
};

class CarPaint
{
public:
    enum Part { coat, flakes, pigment, parts };

    /// Looks up the tables that the settings need.
    explicit CarPaint(const Settings& s) : _s(s)
    {
        const bool there[parts] = {s.coat > 0, s.flakes > 0, s.flakes < 1};
        for (int p = 0; p < parts; ++p)
            if (there[p]) _part[_count++] = static_cast<Part>(p);
        if (there[coat])
        {
            _mirror = luts::microfacet_tables("ggx");
            _interface = luts::dielectric_tables("ggx", TransmissionShadowing::correlated);
        }
        if (there[flakes]) _long_tailed = luts::microfacet_tables("gtr");
    }

    int lobes() const { return _count; }
    const char* lobe_name(int k) const
    {
        constexpr const char* names[parts] = {"coat", "flakes", "pigment"};
        return names[_part[k]];
    }
    float presence() const { return _s.opacity; }

    template <class Real, class Visit>
    decltype(auto) with_lobe(int k, Real strength, const Visit& visit) const
    {
        using Color = Color3<Real>;
        const Color white(Real(1));
        switch (_part[k])
        {
            case coat: {
                const Real alpha = Real(_s.coat_roughness * _s.coat_roughness);
                return visit(compensated(
                    Dielectric(GGX<Real>(alpha, alpha), Real(_s.coat_ior), ScatterMode::R, white,
                               white, TransmissionShadowing::correlated, _interface),
                    Method::turquin, _interface, _mirror, strength));
            }
            case flakes: {
                const Real alpha = Real(_s.flake_roughness * _s.flake_roughness);
                return visit(compensated(
                    MicrofacetReflection(
                        GTR<Real>(alpha, alpha, Real(_s.flake_tail)),
                        SchlickFresnel<Real>(Color(_s.flake_color), white, white, Real(5)),
                        _long_tailed),
                    Method::series, _long_tailed, strength));
            }
            default: break;
        }
        return visit(OrenNayarDiffuse<Real>(Color(_s.pigment), Real(_s.pigment_roughness), true));
    }

    template <class Real>
    Color3<Real> lobe_weights(const Color3<Real>* albedo, Color3<Real>* weight) const
    {
        using Color = Color3<Real>;
        Color whole(Real(0)), rest(Real(1));
        for (int k = 0; k < _count; ++k)
        {
            if (_part[k] == coat)
            {
                weight[k] = Color(Real(_s.coat));
                for (int c = 0; c < 3; ++c)
                    rest[c] -= std::clamp(Real(_s.coat) * albedo[k][c], Real(0), Real(1));
            }
            else
                weight[k] = rest * Real(_part[k] == flakes ? _s.flakes : 1 - _s.flakes);
            whole += weight[k] * albedo[k];
        }
        return whole;
    }

private:
    Settings _s;
    Part _part[parts] = {};
    int _count = 0;
    MicrofacetTables _mirror, _long_tailed;
    DielectricTables _interface;
};

}  // namespace car_paint_example
