// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Materials: parameters in a form that scenes and documents have, which build closures at any
/// precision. The adapters know a material only through
///
///     template <class Real> auto closure(Real strength) const    its compensated closure
///     const char* lobe_name() const                             for light path expressions
///
/// so a renderer's own material, with a gain hook of its own, fits in the same place.

#pragma once

#include <regain/closures/compensated.h>
#include <regain/closures/conductor.h>
#include <regain/closures/generalized_schlick.h>
#include <regain/luts/builtin.h>

REGAIN_NAMESPACE_BEGIN
namespace shaders {

/// A GGX metal in the artist's terms: MaterialX's generalized_schlick_bsdf, scatter mode R.
struct SchlickMetal
{
    Imath::C3f F0{1.0f}, F82{1.0f};          ///< in [0, 1], linear colour of the working space
    float alpha_x = 0.05f, alpha_y = 0.05f;  ///< microfacet widths in [0, 1]
    Method method = Method::turquin;

    /// strength of the compensation in [0, 1].
    template <class Real>
    Compensated<GeneralizedSchlick<Real>, MethodGain<Real>> closure(Real strength) const
    {
        const GeneralizedSchlick<Real> lobe{
            GGX<Real>(Real(alpha_x), Real(alpha_y)),
            SchlickFresnel<Real>(Color3<Real>(F0), Color3<Real>(F82))};
        return compensated(lobe, method, luts::ggx_tables(), strength);
    }
    const char* lobe_name() const { return "metal"; }
};

/// A GGX metal by its index of refraction: MaterialX's conductor_bsdf.
struct ConductorMetal
{
    Imath::C3f n{1.0f}, k{0.0f};             ///< complex index n + ik per channel; no colours
    float alpha_x = 0.05f, alpha_y = 0.05f;  ///< microfacet widths in [0, 1]
    Method method = Method::turquin;

    /// strength of the compensation in [0, 1].
    template <class Real>
    Compensated<Conductor<Real>, MethodGain<Real>> closure(Real strength) const
    {
        const Conductor<Real> lobe{GGX<Real>(Real(alpha_x), Real(alpha_y)),
                                   ConductorFresnel<Real>(Color3<Real>(n), Color3<Real>(k))};
        return compensated(lobe, method, luts::ggx_tables(), strength);
    }
    const char* lobe_name() const { return "metal"; }
};

}  // namespace shaders
REGAIN_NAMESPACE_END
