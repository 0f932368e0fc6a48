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

#include <regain/closures/channels.h>
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
        const Channels edge = detail::saturated_channels(F90);
        _exponent = detail::sanitised(exponent, 0, 100, 5);
        // (1 - mu)^0 is 1 at mu = 1, too, which a power by logarithms does not know.
        _F0 = detail::select(_exponent > Real(0), detail::saturated_channels(F0), edge);
        _edge = edge - _F0;
        _is_quintic = detail::all<Real>(_exponent == Real(5));

        const Channels tint = detail::saturated_channels(F82);
        const Real falloff = power(detail::constant<Real>(6.0 / 7.0));
        _dip = (_F0 + _edge * falloff) * (Channels(Real(1)) - tint) *
               detail::constant<Real>(1.0 / dip_at_82);
    }

    REGAIN_INLINE Color at(Real mu) const { return detail::color(channels_at(mu)); }
    REGAIN_INLINE detail::ChannelsOf<Real> channels_at(Real mu) const
    {
        const Real x = Real(1) - mu, x2 = x * x, x5 = x2 * x2 * x;
        const Real falloff = _is_quintic ? x5 : other_power(x), dip = x5 * (x * mu);
        // A dark F0 with a dark F82 would go negative between the two.
        return detail::each_channel([](const auto& v) { return detail::clamped(v, 0, 1); },
                                    _F0 + _edge * falloff - _dip * dip);
    }

    REGAIN_HOST_DEVICE Color normal_incidence() const { return detail::color(_F0); }

    /// Exact for the exponent 5, unless F is clamped.
    REGAIN_HOST_DEVICE Color mean(const FresnelMoments<Real>& moments) const
    {
        const Real falloff = _is_quintic ? moments.falloff : power(Real(1) - moments.cosine());
        return detail::per_channel(detail::color(_F0 + _edge * falloff - _dip * moments.dip),
                                   [](Real v) { return detail::saturate(v); });
    }

    REGAIN_HOST_DEVICE Color average() const
    {
        const Real n = _exponent;
        const Color closed_form =
            detail::color(_F0 + _edge * (Real(2) / ((n + Real(1)) * (n + Real(2)))) -
                          _dip * detail::constant<Real>(1.0 / 126.0));
        // Where F is clamped the closed form, which knows nothing of it, is too low.
        const Channels lowest = detail::each_channel(
            [](const auto& e) {
                return detail::min(e, detail::constant<std::decay_t<decltype(e)>>(0));
            },
            _edge);
        const Color room = detail::color(_F0 + lowest - _dip * detail::constant<Real>(dip_at_82));
        const MaskOf<Real> exact = detail::min(room.x, detail::min(room.y, room.z)) >= Real(0);
        if (detail::all<Real>(exact)) return closed_form;
        const Color sum = average_by_quadrature();
        return {detail::select(room.x >= Real(0), closed_form.x, sum.x),
                detail::select(room.y >= Real(0), closed_form.y, sum.y),
                detail::select(room.z >= Real(0), closed_form.z, sum.z)};
    }

private:
    using Channels = detail::ChannelsOf<Real>;

    // mu (1 - mu)^6 at mu = 1/7, where it is largest.
    static constexpr double dip_at_82 = 46656.0 / 823543.0;

    REGAIN_HOST_DEVICE Real power(Real x) const
    {
        const Real x2 = x * x;
        return _is_quintic ? x2 * x2 * x : other_power(x);
    }
    REGAIN_HOST_DEVICE Real other_power(Real x) const
    {
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

    Channels _F0, _edge, _dip;
    Real _exponent;
    bool _is_quintic;
};

REGAIN_NAMESPACE_END
