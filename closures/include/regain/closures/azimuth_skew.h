// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A density of azimuths for directions that an anisotropic surface sends out by its losses. Of the
/// directions of one cosine those along the narrower axis may lose several times as much as all
/// others, within a wedge as wide as their stretched length is short. So half of the azimuths are
/// even, the others go like the inverse square of that length:
///
///   2 pi p(phi) = 1/2 + 1/2 a b / (a^2 cos^2 phi + b^2 sin^2 phi)
///   a^2 = (ax sin theta)^2 + cos^2 theta,    b^2 = (ay sin theta)^2 + cos^2 theta
///
/// which is what (b cos psi, a sin psi) has for even psi. Weights that divide by it are at most
/// twice those of even azimuths.

#pragma once

#include <regain/closures/vector.h>

REGAIN_NAMESPACE_BEGIN

template <class RealType>
class AzimuthSkew
{
public:
    using Real = RealType;

    /// Widths in [0, 1].
    REGAIN_HOST_DEVICE AzimuthSkew(Real alpha_x, Real alpha_y) : _x(alpha_x), _y(alpha_y) {}

    /// 2 pi p above for a unit w with w.z > 0.
    REGAIN_HOST_DEVICE Real relative_density(const Vec3<Real>& w) const
    {
        const Real x2 = w.x * w.x, y2 = w.y * w.y, s2 = x2 + y2;
        const Lengths l(*this, w.z, s2);
        const Real tiny = detail::constant<Real>(1e-36);
        const Real along = l.a2 * x2 + l.b2 * y2;
        // Along the normal azimuths are even.
        const Real skew = detail::select(
            along > tiny, detail::sqrt(l.a2 * l.b2) * s2 / detail::max(along, tiny), Real(1));
        return Real(0.5f) + Real(0.5f) * skew;
    }

    /// A unit w of the cosine mu in (0, 1] for u in [0, 1].
    REGAIN_HOST_DEVICE Vec3<Real> sample(Real mu, Real u) const
    {
        const Real s2 = detail::max((Real(1) - mu) * (Real(1) + mu), Real(0));
        const Lengths l(*this, mu, s2);
        const MaskOf<Real> even = u < Real(0.5f);
        // Where both widths are the same the two halves are one.
        const Real part = detail::select(_x == _y, u, detail::select(even, u + u, u + u - Real(1)));
        const Real psi = detail::constant<Real>(6.28318530717958647692) * part;
        const Real x = detail::cos(psi) * detail::select(even, Real(1), detail::sqrt(l.b2)),
                   y = detail::sin(psi) * detail::select(even, Real(1), detail::sqrt(l.a2));
        const Real scale = detail::sqrt(s2 / (x * x + y * y));
        return {x * scale, y * scale, mu};
    }

private:
    struct Lengths
    {
        REGAIN_HOST_DEVICE Lengths(const AzimuthSkew& skew, const Real& mu, const Real& s2)
            : a2(skew._x * skew._x * s2 + mu * mu), b2(skew._y * skew._y * s2 + mu * mu)
        {}
        Real a2, b2;
    };

    Real _x, _y;
};

REGAIN_NAMESPACE_END
