// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Where about the normal light leaves that has met two facets or more. phi in [-pi, pi] is the
/// azimuth of wi from straight ahead, opposite to that of wo:
///
///   Phi(phi) = (1 - m) / (2 pi) + m N(phi),    N(phi) = exp(-w phi^2) / int_-pi^pi exp(-w t^2) dt
///   1 / (2 w) = k (mu_o + mu_i)^2 / s (1 + k / s),    s = sin theta_o sin theta_i
///
/// Some of it goes anywhere, and some ahead, within a normal distribution that is cut off at pi.
/// How wide that is follows from one facet: its slope turns a reflection aside by (mu_o + mu_i) /
/// sin theta times the slope across. Measured on random walks, the variance keeps that form after
/// several bounces; two numbers, k and m, say the rest of it for each distribution and alpha
/// (docs/methods.md). Along the normal, where azimuth means nothing, Phi is uniform by itself.
///
/// Phi is the same with wo and wi exchanged, and integrates to 1 for every pair of cosines: a lobe
/// that is symmetric about the normal keeps its albedo and its reciprocity when it is multiplied
/// by 2 pi Phi.

#pragma once

#include <regain/closures/erf_inverse.h>
#include <regain/closures/vector.h>

REGAIN_NAMESPACE_BEGIN

template <class RealType>
class AzimuthSpread
{
public:
    using Real = RealType;

    /// Uniform.
    REGAIN_HOST_DEVICE AzimuthSpread() : AzimuthSpread(Real(1), Real(0)) {}

    /// k and m as above, k >= 0 in rad^2 and m in [0, 1].
    REGAIN_HOST_DEVICE AzimuthSpread(Real k, Real m) : _k(k), _m(m) {}

    /// A direction by its cosine and sine.
    struct Polar
    {
        Real cosine, sine;

        /// w is unit, above the horizon.
        REGAIN_HOST_DEVICE static Polar of(const Vec3<Real>& w)
        {
            return {w.z, detail::sqrt(w.x * w.x + w.y * w.y)};
        }
    };

    /// Phi of one pair of polar angles.
    class About
    {
    public:
        /// 2 pi Phi(phi); phi in [-pi, pi], radians.
        REGAIN_HOST_DEVICE Real relative_density(Real phi) const
        {
            return Real(1) - _m + _m * _peak * detail::exp(-_w * phi * phi);
        }

        /// phi with the density Phi for u in [0, 1].
        REGAIN_HOST_DEVICE Real sample(Real u) const
        {
            const Real tiny = detail::constant<Real>(1e-30), one(1);
            // A u of 1 is ahead where all is: there is no density anywhere else.
            const MaskOf<Real> ahead = u <= _m;
            const Real r = detail::select(ahead, u / detail::max(_m, tiny),
                                          (u - _m) / detail::max(one - _m, tiny));
            const Real even = Real(2) * detail::min(r, one) - one;
            const Real pi = detail::constant<Real>(3.14159265358979323846);
            const Real normal = detail::erf_inverse(even * _mass) * (pi / _z);
            return detail::select(ahead, detail::max(detail::min(normal, pi), -pi), pi * even);
        }

    private:
        friend class AzimuthSpread;

        REGAIN_HOST_DEVICE About(Real w, Real m)
            : _w(w),
              _m(m),
              // As good as 0, and divides.
              _z(detail::max(detail::constant<Real>(3.14159265358979323846) * detail::sqrt(w),
                             detail::constant<Real>(1e-3))),
              _mass(detail::erf(_z)),
              _peak(Real(2) * _z / (detail::constant<Real>(1.77245385090551602730) * _mass))
        {}

        Real _w, _m;
        Real _z, _mass;  // pi sqrt(w) and its error function
        Real _peak;      // 2 pi N(0)
    };

    REGAIN_HOST_DEVICE About about(const Polar& wo, const Polar& wi) const
    {
        const Real sum = wo.cosine + wi.cosine, s = wo.sine * wi.sine;
        // Along the surface the spread vanishes; half a degree is as narrow as it gets.
        const Real narrowest = Real(5000), tiny = detail::constant<Real>(1e-30);
        const Real w = s * s / detail::max(Real(2) * _k * sum * sum * (s + _k), tiny);
        return {detail::min(w, narrowest), _m};
    }

    /// |phi| of two directions; 0 where one is the normal.
    REGAIN_HOST_DEVICE static Real azimuth(const Vec3<Real>& wo, const Vec3<Real>& wi)
    {
        // sin^2 (phi / 2), by whichever of sine and cosine does not cancel.
        const Real ahead = -(wo.x * wi.x + wo.y * wi.y), aside = wo.x * wi.y - wo.y * wi.x;
        const Real length = detail::sqrt(ahead * ahead + aside * aside),
                   tiny = detail::constant<Real>(1e-30);
        const Real small = aside * aside / detail::max(length + ahead, tiny),
                   large = length - ahead;
        const Real twice =
            detail::select(ahead > Real(0), small, large) / detail::max(length, tiny);
        return Real(2) * detail::asin(detail::sqrt(detail::min(Real(0.5f) * twice, Real(1))));
    }

private:
    Real _k, _m;
};

REGAIN_NAMESPACE_END
