// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Fresnel reflectance of a conductor with complex index of refraction n + ik against a dielectric
/// of index 1, unpolarised:  F = (R_s + R_p) / 2  (Born and Wolf, Principles of Optics, 14.2).
///
/// It is computed as 1 - F, from the absorptances of both polarisations,
///     A_s = 2 t2 / (t1 + t2),  t1 = |e - s2| + mu^2,          t2 = 2 a mu
///     q   = 2 t4 / (t3 + t4),  t3 = mu^2 |e - s2| + s2^2,     t4 = t2 s2,   R_p = R_s (1 - q)
///     F   = 1 - (2 A_s + q - A_s q) / 2
/// with e = (n + ik)^2, s2 = 1 - mu^2, a = Re sqrt(e - s2). The usual form subtracts nearly equal
/// numbers and has, in float, errors of 13 per cent in 1 - F of metals with high k.
///
/// With n = 0 all is reflected; with k = 0 it is a dielectric, with n = 1 besides nothing at all.
///
/// Interface as in constant_fresnel.h; n and k are no colours and need no colour management.

#pragma once

#include <regain/closures/channels.h>
#include <regain/closures/fresnel_average.h>
#include <regain/closures/fresnel_moments.h>

REGAIN_NAMESPACE_BEGIN

template <class RealType>
class ConductorFresnel
{
public:
    using Real = RealType;
    using Color = Color3<Real>;

    /// n and k per channel, in [0, 1e4], clamped; NaN becomes n = 1 or k = 0.
    REGAIN_HOST_DEVICE ConductorFresnel(const Color& n, const Color& k)
        : _n(detail::channels(
              detail::per_channel(n, [](Real v) { return detail::sanitised(v, 0, 1e4, 1); }))),
          _k(detail::channels(
              detail::per_channel(k, [](Real v) { return detail::sanitised(v, 0, 1e4, 0); })))
    {}

    REGAIN_INLINE Color at(Real mu) const { return detail::color(channels_at(mu)); }
    REGAIN_INLINE detail::ChannelsOf<Real> channels_at(Real mu) const
    {
        return detail::each_channel(
            [mu](const auto& n, const auto& k) {
                return channel(n, k, std::decay_t<decltype(n)>(mu));
            },
            _n, _k);
    }

    REGAIN_HOST_DEVICE Color normal_incidence() const { return at(Real(1)); }

    /// F at the cosine of the falloff.
    REGAIN_HOST_DEVICE Color mean(const FresnelMoments<Real>& moments) const
    {
        return at(moments.cosine());
    }

    /// By five nodes: see docs/fresnel-averages.md.
    REGAIN_HOST_DEVICE Color average() const { return gauss_jacobi_average<5>(*this); }

    /// F_ss to 1e-8, at 64 evaluations.
    REGAIN_HOST_DEVICE Color exact_average() const
    {
        const Color a = n(), b = k();
        return {exact_channel(a.x, b.x), exact_channel(a.y, b.y), exact_channel(a.z, b.z)};
    }

    REGAIN_HOST_DEVICE Color n() const { return detail::color(_n); }
    REGAIN_HOST_DEVICE Color k() const { return detail::color(_k); }

private:
    // Below n = 1 a metal that hardly absorbs has a critical angle.
    REGAIN_HOST_DEVICE static Real exact_channel(Real n, Real k)
    {
        const Real critical = detail::sqrt(detail::max((Real(1) - n) * (Real(1) + n), Real(0)));
        return regain::exact_average([&](Real mu) { return channel(n, k, mu); },
                                     detail::min(critical, detail::constant<Real>(0.9999)));
    }

    // Of one channel, or of several at once.
    template <class T>
    REGAIN_INLINE static T channel(const T& n, const T& k, const T& mu)
    {
        // Keeps 0 / 0 out where n = 0, and where n = 1, k = 0 meets grazing incidence.
        const T tiny = detail::constant<T>(1e-30);

        const T mu2 = mu * mu, s2 = detail::max((T(1) - mu) * (T(1) + mu), T(0));
        // Re (e - s2), of metals that are nearly air by what their index differs from 1.
        const T nk = n * k, t0 = detail::select(n > T(0.5f), (n - T(1)) * (n + T(1)) - k * k + mu2,
                                                (n - k) * (n + k) - s2);
        const T modulus = detail::sqrt(t0 * t0 + T(4) * nk * nk);
        const T root = detail::sqrt(T(0.5f) * (modulus + detail::abs(t0)));
        const T a = detail::select(t0 >= T(0), root, nk / detail::max(root, tiny));

        const T t1 = modulus + mu2, t2 = T(2) * a * mu;
        const T t3 = mu2 * modulus + s2 * s2, t4 = t2 * s2;
        const T A_s = T(2) * t2 / detail::max(t1 + t2, tiny);
        const T q = T(2) * t4 / detail::max(t3 + t4, tiny);
        // Where nothing is reflected rounding may leave less than nothing.
        return detail::max(T(1) - T(0.5f) * (A_s + A_s + q - A_s * q), T(0));
    }

    detail::ChannelsOf<Real> _n, _k;
};

REGAIN_NAMESPACE_END
