// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Reflection and refraction at a facet between two dielectrics, and the one rule for which pairs
/// of directions a facet joins.
///
/// The relative index eta_o is the index ahead of wo over the index on the side of wo. With
/// c = wo.m > 0 and g = eta_o |cos theta_t| = sqrt((eta_o - 1)(eta_o + 1) + c^2), wo refracts into
///
///   wi = -(wo + m (eta_o - 1)(eta_o + 1) / (g + c)) / eta_o
///
/// which is Snell's law (Walter et al. 2007, Eq. 40) with its difference g - c written as a
/// quotient, so that nothing cancels where eta_o is near 1. Where g^2 <= 0 all is reflected.
///
/// The other way round, m is known from wo and wi up to its length (Walter et al. 2007, Eq. 16):
///
///   h = -+(wo + eta_o wi) = -+((wo + wi) + (eta_o - 1) wi),  minus where eta_o > 1
///
/// Directions are unit, in the local frame, and point away from the surface. A facet's normal m is
/// on wo's side of the surface, m.z wo.z > 0, and of the facet, wo.m > 0.

#pragma once

#include <regain/closures/vector.h>

REGAIN_NAMESPACE_BEGIN

/// A relative index of refraction eta_o and, to full precision, eta_o - 1: what an interface near
/// index 1 does is all in the difference.
template <class Real>
struct RelativeIndex
{
    Real eta;        ///< index ahead over index behind, > 0
    Real minus_one;  ///< eta - 1

    /// eta in [1e-2, 1e2]; outside it is clamped, NaN becomes 1.5.
    REGAIN_INLINE static RelativeIndex of(Real eta)
    {
        const Real e = detail::sanitised(eta, 1e-2, 1e2, 1.5);
        return {e, e - Real(1)};
    }

    /// Seen from the other side.
    REGAIN_INLINE RelativeIndex inverse() const
    {
        const Real inv = Real(1) / eta;
        return {inv, -minus_one * inv};
    }

    /// eta^2 - 1.
    REGAIN_INLINE Real square_minus_one() const { return minus_one * (eta + Real(1)); }

    /// g^2 = eta^2 - (1 - c^2) of the cosine c in [0, 1]: not positive where all is reflected. Near
    /// 1 by what eta differs from it, which is all there is at grazing angles; else by eta, which
    /// is all there is head on where eta is small.
    REGAIN_INLINE Real g2(Real c) const { return g2(c, c * c); }
    /// Where c^2 is known before c is.
    REGAIN_INLINE Real g2(Real c, Real c2) const
    {
        return detail::select(eta < Real(0.5f), eta * eta - (Real(1) - c) * (Real(1) + c),
                              square_minus_one() + c2);
    }
};

namespace detail {

template <class Real>
REGAIN_INLINE RelativeIndex<Real> select(MaskOf<Real> mask, const RelativeIndex<Real>& a,
                                         const RelativeIndex<Real>& b)
{
    return {select(mask, a.eta, b.eta), select(mask, a.minus_one, b.minus_one)};
}

}  // namespace detail

/// What a direction is refracted into.
template <class Real>
struct Refraction
{
    Vec3<Real> wi;       ///< unit; -wo where nothing is refracted
    Real cosine;         ///< |wi.m|; 0 where nothing is refracted
    MaskOf<Real> valid;  ///< false: all is reflected
};

/// The refraction of wo at a facet m, wo.m > 0.
template <class Real>
REGAIN_INLINE Refraction<Real> refract(const Vec3<Real>& wo, const Vec3<Real>& m,
                                       const RelativeIndex<Real>& eta_o)
{
    const Real c = detail::dot(wo, m), k = eta_o.square_minus_one();
    const Real g2 = eta_o.g2(c);

    Refraction<Real> r;
    r.valid = detail::both<Real>(c > Real(0), g2 > Real(0));
    const Real g = detail::sqrt(detail::select(r.valid, g2, Real(1)));
    const Real slide = k / (g + detail::max(c, Real(0)));
    const Vec3<Real> wi = (wo + m * slide) * (Real(-1) / eta_o.eta);
    r.wi = detail::normalised(detail::select(r.valid, wi, -wo));
    r.cosine = detail::select(r.valid, g / eta_o.eta, Real(0));
    return r;
}
/// eta_o > 0.
template <class Real>
REGAIN_INLINE Refraction<Real> refract(const Vec3<Real>& wo, const Vec3<Real>& m, Real eta_o)
{
    return refract(wo, m, RelativeIndex<Real>{eta_o, eta_o - Real(1)});
}

/// The reflection of wo at a facet m.
template <class Real>
REGAIN_INLINE Vec3<Real> reflect(const Vec3<Real>& wo, const Vec3<Real>& m)
{
    return m * (Real(2) * detail::dot(wo, m)) - wo;
}

namespace detail {

/// wo + wi. Of two grazing directions the tangential parts all but cancel, and what is left of them
/// in float is rounding. Their difference d does not cancel; and since both vectors are unit,
/// (wo + wi).d = wi.z^2 - wo.z^2 is known to the last digit.
template <class Real>
REGAIN_INLINE Vec3<Real> half_vector(const Vec3<Real>& wo, const Vec3<Real>& wi)
{
    const Vec3<Real> sum = wo + wi;
    const Real dx = wo.x - wi.x, dy = wo.y - wi.y, d2 = dx * dx + dy * dy;
    const MaskOf<Real> opposed = d2 > Real(1);
    const Real scale = Real(1) / select(opposed, d2, Real(1));
    const Real along = (wi.z - wo.z) * sum.z * scale;
    const Real across = Real(2) * (wo.x * wi.y - wo.y * wi.x) * scale;
    return {select(opposed, dx * along - dy * across, sum.x),
            select(opposed, dy * along + dx * across, sum.y), sum.z};
}

/// A facet's normal that refracts wo into wi, times a positive length; see above. Where eta_o is
/// near 1 the sum wo + wi is short, and the rounding of the lengths of wo and wi, which lies along
/// their difference, would be most of it; of unit vectors the sum has no such part.
template <class Real>
REGAIN_INLINE Vec3<Real> refraction_half_vector(const Vec3<Real>& wo, const Vec3<Real>& wi,
                                                const RelativeIndex<Real>& eta_o)
{
    const Vec3<Real> sum = wo + wi, d = wo - wi;
    const Real d2 = dot(d, d);
    const MaskOf<Real> opposed = d2 > Real(1);
    const Real excess = select(opposed, dot(sum, d) / select(opposed, d2, Real(1)), Real(0));
    const Vec3<Real> h = (sum - d * excess) + wi * eta_o.minus_one;
    return select(eta_o.minus_one > Real(0), -h, h);
}

template <class Real>
REGAIN_INLINE MaskOf<Real> same_sign(Real a, Real b)
{
    const MaskOf<Real> up = both<Real>(a > Real(0), b > Real(0)),
                       down = both<Real>(a < Real(0), b < Real(0));
    return up | down;
}

/// A unit direction on either side of the surface. All of NaN, infinity, zero and the horizon give
/// false.
template <class Real>
REGAIN_INLINE MaskOf<Real> is_off_horizon(const Vec3<Real>& w)
{
    return both<Real>(quiet_less(constant<Real>(horizon), abs(w.z)), is_direction(w));
}

/// Directions of cosines a and b are on the same side of the surface, off the horizon: vector.h.
template <class Real>
REGAIN_INLINE MaskOf<Real> same_side(Real a, Real b)
{
    const Real bound = constant<Real>(horizon);
    return both<Real>(same_sign(a, b), both<Real>(bound < abs(a), bound < abs(b)));
}

}  // namespace detail

/// Whether a facet m on wo's side may reflect wo into wi: all three on the same side of the
/// surface, both directions on the side of the facet that m points to. m need not be unit; that wi
/// is where m reflects wo to is for the caller to know.
template <class Real>
REGAIN_INLINE MaskOf<Real> is_reflection(const Vec3<Real>& wo, const Vec3<Real>& wi,
                                         const Vec3<Real>& m)
{
    const MaskOf<Real> surface =
        detail::both<Real>(detail::same_side(wo.z, wi.z), detail::same_sign(wo.z, m.z));
    return detail::both<Real>(
        surface, detail::both<Real>(detail::dot(wo, m) > Real(0), detail::dot(wi, m) > Real(0)));
}

/// Whether a facet m on wo's side may refract wo into wi: on opposite sides of the surface and of
/// the facet. m as above.
template <class Real>
REGAIN_INLINE MaskOf<Real> is_transmission(const Vec3<Real>& wo, const Vec3<Real>& wi,
                                           const Vec3<Real>& m)
{
    const MaskOf<Real> surface =
        detail::both<Real>(detail::same_side(wo.z, -wi.z), detail::same_sign(wo.z, m.z));
    return detail::both<Real>(
        surface, detail::both<Real>(detail::dot(wo, m) > Real(0), detail::dot(wi, m) < Real(0)));
}

REGAIN_NAMESPACE_END
