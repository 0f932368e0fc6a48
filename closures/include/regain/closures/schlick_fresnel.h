// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Schlick's Fresnel approximation with a free edge and exponent, and a tint at 82 degrees:
///
///   F(mu)    = S(mu) - B mu (1 - mu)^6,    S(mu) = F0 + (F90 - F0) (1 - mu)^n
///   B        = S(1/7) (1 - F82) / ((1/7) (6/7)^6)
///   F_ss     = F0 + (F90 - F0) 2 / ((n + 1)(n + 2)) - B / 126
///
/// Schlick 1994; the tint is the F82 model of Kutz et al. 2021 as OpenPBR Surface 1.1 states it
/// (section "Metal"), and MaterialX's generalized_schlick_bsdf: F82 multiplies the reflectance at
/// cos 82 deg, about 1/7. Interface as in constant_fresnel.h.

#pragma once

#include <regain/closures/fresnel_moments.h>

REGAIN_NAMESPACE_BEGIN

template <class RealType>
class SchlickFresnel
{
public:
    using Real = RealType;
    using Color = Color3<Real>;

    /// F0: colour at normal incidence; F82: tint at 82 degrees, 1 leaves Schlick's curve alone;
    /// F90: colour at grazing; all in [0, 1] per channel, clamped, NaN becomes 0. exponent in [0,
    /// 100], clamped, NaN becomes 5; with 0 the curve is F90 everywhere.
    REGAIN_HOST_DEVICE explicit SchlickFresnel(const Color& F0, const Color& F82 = Color(Real(1)),
                                               const Color& F90 = Color(Real(1)),
                                               Real exponent = Real(5))
    {
        const auto clamped = [](Real v) { return detail::saturate(v); };
        const Color edge = detail::per_channel(F90, clamped);
        _exponent = detail::sanitised(exponent, 0, 100, 5);
        // (1 - mu)^0 is 1 at mu = 1, too, which a power by logarithms does not know.
        _F0 = detail::select(_exponent > Real(0), detail::per_channel(F0, clamped), edge);
        _edge = edge - _F0;
        _is_quintic = detail::all<Real>(_exponent == Real(5));

        const Color tint = detail::per_channel(F82, clamped);
        const Real falloff = power(detail::constant<Real>(6.0 / 7.0));
        _dip = (_F0 + _edge * falloff) * (Color(Real(1)) - tint) *
               detail::constant<Real>(1.0 / dip_at_82);
    }

    REGAIN_INLINE Color at(Real mu) const
    {
        const Real x = Real(1) - mu, x2 = x * x;
        const Real falloff = power(x), dip = mu * x2 * x2 * x2;
        // A dark F0 with a dark F82 would go negative between the two.
        return detail::per_channel(_F0 + _edge * falloff - _dip * dip,
                                   [](Real v) { return detail::clamped(v, 0, 1); });
    }

    REGAIN_HOST_DEVICE Color normal_incidence() const { return _F0; }

    /// Exact for the exponent 5, unless F is clamped.
    REGAIN_HOST_DEVICE Color mean(const FresnelMoments<Real>& moments) const
    {
        const Real falloff = _is_quintic ? moments.falloff : power(Real(1) - moments.cosine());
        return detail::per_channel(_F0 + _edge * falloff - _dip * moments.dip,
                                   [](Real v) { return detail::saturate(v); });
    }

    REGAIN_HOST_DEVICE Color average() const
    {
        const Real n = _exponent;
        const Color closed_form = _F0 + _edge * (Real(2) / ((n + Real(1)) * (n + Real(2)))) -
                                  _dip * detail::constant<Real>(1.0 / 126.0);
        // Where F is clamped the closed form, which knows nothing of it, is too low.
        const Color lowest =
            detail::per_channel(_edge, [](Real e) { return detail::min(e, Real(0)); });
        const Color room = _F0 + lowest - _dip * detail::constant<Real>(dip_at_82);
        const MaskOf<Real> exact = detail::min(room.x, detail::min(room.y, room.z)) >= Real(0);
        if (detail::all<Real>(exact)) return closed_form;
        const Color sum = average_by_quadrature();
        return {detail::select(room.x >= Real(0), closed_form.x, sum.x),
                detail::select(room.y >= Real(0), closed_form.y, sum.y),
                detail::select(room.z >= Real(0), closed_form.z, sum.z)};
    }

private:
    // mu (1 - mu)^6 at mu = 1/7, where it is largest.
    static constexpr double dip_at_82 = 46656.0 / 823543.0;

    REGAIN_INLINE Real power(Real x) const
    {
        if (_is_quintic)
        {
            const Real x2 = x * x;
            return x2 * x2 * x;
        }
        return detail::pow(detail::max(x, Real(0)), _exponent);
    }

    REGAIN_HOST_DEVICE Color average_by_quadrature() const
    {
        constexpr int n = 32;
        Color sum(Real(0));
        for (int i = 0; i < n; ++i)
        {
            const double mu = (i + 0.5) / n;
            sum += at(detail::constant<Real>(mu)) * detail::constant<Real>(2 * mu / n);
        }
        return sum;
    }

    Color _F0, _edge, _dip;
    Real _exponent;
    bool _is_quintic;
};

REGAIN_NAMESPACE_END
