// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Materials for the tests of what adapters are apt to get wrong.

#pragma once

#include "interfaces.h"

#include <regain/closures/dielectric.h>
#include <regain/closures/oren_nayar_diffuse.h>
#include <regain/closures/transparent.h>
#include <regain/shaders/material.h>

namespace regain::tests {

/// Half Lambert, half a compensated metal: closures 0 and 1.
struct HalfAndHalf
{
    Imath::C3f weight[2] = {Imath::C3f(0.5f), Imath::C3f(0.5f)};
    const char* names[2] = {"diffuse", "metal"};
    shaders::SchlickMetal metal{Imath::C3f(1.0f), Imath::C3f(1.0f), 0.9f, 0.9f};
    Imath::C3f color{1.0f};

    int lobes() const { return 2; }
    template <class Real>
    OrenNayarDiffuse<Real> diffuse() const
    {
        return OrenNayarDiffuse<Real>(Color3<Real>(color), Real(0));
    }
    template <class Real, class Visit>
    decltype(auto) with_lobe(int k, Real strength, const Visit& visit) const
    {
        return k == 0 ? visit(diffuse<Real>()) : visit(metal.closure(strength));
    }
    template <class Real>
    Color3<Real> lobe_weights(const Color3<Real>* albedo, Color3<Real>* w) const
    {
        for (int k = 0; k < 2; ++k) w[k] = Color3<Real>(weight[k]);
        return w[0] * albedo[0] + w[1] * albedo[1];
    }
    const char* lobe_name(int k) const { return names[k]; }
};

/// n times Lambert, each an n-th.
struct Many
{
    int count;
    int lobes() const { return count; }
    template <class Real, class Visit>
    decltype(auto) with_lobe(int, Real, const Visit& visit) const
    {
        return visit(OrenNayarDiffuse<Real>(Color3<Real>(Real(1)), Real(0)));
    }
    template <class Real>
    Color3<Real> lobe_weights(const Color3<Real>*, Color3<Real>* weight) const
    {
        for (int k = 0; k < count; ++k) weight[k] = Color3<Real>(Real(1) / Real(count));
        return Color3<Real>(Real(1));
    }
    const char* lobe_name(int) const { return "diffuse"; }
};

/// Glass, alone or with a gain that tells every direction from every other.
template <bool with_gain>
struct TrapGlass
{
    float alpha = 0.5f;
    template <class Real>
    auto closure(Real) const
    {
        const GGX<Real> ggx{Real(alpha), Real(alpha)};
        const Dielectric<GGX<Real>> glass(ggx, Real(1.5));
        if constexpr (with_gain)
            return compensated(glass, SlopedGain<Real>{});
        else
            return glass;
    }
    const char* lobe_name() const { return "glass"; }
};

/// Lambert with a gain that tells every direction from every other.
struct SlopedLambert
{
    template <class Real>
    auto closure(Real) const
    {
        return compensated(OrenNayarDiffuse<Real>(Color3<Real>(Real(1)), Real(0)),
                           SlopedGain<Real>{});
    }
    const char* lobe_name() const { return "diffuse"; }
};

}  // namespace regain::tests
