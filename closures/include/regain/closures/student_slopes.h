// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Slopes of the visible microsurface of the distribution STD (std.h), sampled exactly. In units of
/// sqrt(p) alpha, p = gamma - 1, the slopes (x, y) along and across the direction of view have the
/// density p / pi (1 + x^2 + y^2)^-gamma; those that are visible at a cotangent c have that times
/// (c + x)+. The slope along has the density C (1 + x^2)^-(p + 1/2), and the other is
/// sqrt(1 + x^2) times a variable of density proportional to (1 + t^2)^-gamma.
///
/// For c >= 0 the pair of x and -x weighs c + max(c, |x|). It is proposed by 2c + |x|, whose two
/// terms have closed forms, and is taken two times of three at the worst. For c = -a < 0, x beyond
/// a is proposed by x (1 + x^2)^-(p + 1/2), or, where that would seldom do, by the density
/// proportional to (x^2 - a^2) x (1 + x^2)^-(p + 1): a Beta variable of second parameter 2, the
/// product of two powers.

#pragma once

#include <regain/closures/random_stream.h>

REGAIN_NAMESPACE_BEGIN

namespace detail {

template <class RealType>
class StudentSlopes
{
public:
    using Real = RealType;
    using Mask = MaskOf<Real>;

    /// p = gamma - 1 > 1/2, beyond = p - 1/2, mean = E|x| of all slopes = C / beyond, cotangent =
    /// that of the direction of view after stretching, of either sign.
    REGAIN_HOST_DEVICE StudentSlopes(const Real& p, const Real& beyond, const Real& mean,
                                     const Real& cotangent)
        : _p(p), _beyond(beyond)
    {
        _cotangent = max(min(cotangent, constant<Real>(1e6)), constant<Real>(-1e6));
        const Real two = max(_cotangent, Real(0)) * Real(2);
        _plain = two / (two + mean);
    }

    /// Slopes along and across for u in [0, 1)^3. After 64 refused tries, of which there is less
    /// than one in 1e8, the last one is taken.
    REGAIN_HOST_DEVICE Vec2<Real> sample(const Vec3<Real>& u) const
    {
        const Mask below = _cotangent < Real(0);
        RandomStream<Real> stream(u);
        Vec3<Real> numbers = u;
        Vec2<Real> slopes{Real(0), Real(0)};
        Mask done(false);
        for (int tries = 0; tries < 64; ++tries)
        {
            const Real v = stream.next(), w = stream.next();
            Try t = all<Real>(below) ? from_below(numbers, v, w) : from_above(numbers, v);
            if (any<Real>(below) && !all<Real>(below))
            {
                const Try other = from_below(numbers, v, w);
                t.along = select(below, other.along, t.along);
                t.across = select(below, other.across, t.across);
                const Mask taken_below = both<Real>(below, other.taken),
                           taken_above = both<Real>(!below, t.taken);
                t.taken = taken_below | taken_above;
            }
            slopes.x = select(done, slopes.x, t.along);
            slopes.y = select(done, slopes.y, t.across);
            done = done | t.taken;
            if (all<Real>(done)) break;
            numbers = stream.next3();
        }
        return slopes;
    }

private:
    struct Try
    {
        Real along, across;
        Mask taken;
    };

    REGAIN_HOST_DEVICE Try from_above(const Vec3<Real>& u, const Real& v) const
    {
        // Either a plain slope, by its length and angle, or one of density |x| P(x) and another
        // across, as one axis of a polar pair (Bailey 1994).
        const Real c = _cotangent;
        const Mask plain = u.x < _plain;
        // The share of what is not taken may be 0.
        const Real number = select(plain, u.x, u.x - _plain) /
                            max(select(plain, _plain, Real(1) - _plain), constant<Real>(1e-30));
        const Real square = power_minus_one(number, select(plain, _p, _beyond));
        const Real length = sqrt(square), angle = angle_of(u.y);
        const Real side = detail::sin(angle);

        Try t;
        const Real x = select(plain, abs(length * detail::cos(angle)), length);
        t.across = side * select(plain, length, across_of(square, u.z));
        const Real weight = c + max(c, x), chance = v * (c + c + x);
        t.taken = chance < weight;
        // What is left of the random number chooses between x and -x: c + x to c - x.
        t.along = select((c + c) * chance < (c - x) * weight, -x, x);
        return t;
    }

    REGAIN_HOST_DEVICE Try from_below(const Vec3<Real>& u, const Real& v, const Real& w) const
    {
        const Real a = -_cotangent, a2 = a * a;
        // Measured: where the second kind of proposal is taken more often.
        const Mask steep = both<Real>(_p > Real(1.5f), a2 * (_p - Real(1)) > Real(0.64f));
        const Real k = select(steep, _p - Real(1), _beyond);
        const Real log_ratio = limited(-log(number_of(u.x)) / k -
                                       select(steep, log(number_of(v)) / (k + Real(1)), Real(0)));
        const Real extra = (Real(1) + a2) * detail::expm1(log_ratio);  // x^2 - a^2
        const Real square = a2 + extra, x = sqrt(square), height = extra / (a + x);

        Try t;
        t.along = x;
        t.across = detail::sin(angle_of(u.y)) * across_of(square, u.z);
        const Real chance =
            select(steep, Real(2) * a2 * detail::exp(Real(0.5f) * log_ratio), height * (x + a));
        t.taken = w * x * (x + a) < chance;
        return t;
    }

    // sqrt(1 + x^2) times the length of a pair of density proportional to (1 + r^2)^-(p + 3/2),
    // one axis of which is distributed as (1 + t^2)^-(p + 1).
    REGAIN_HOST_DEVICE Real across_of(const Real& square, const Real& u) const
    {
        return sqrt(Real(1) + square) * sqrt(power_minus_one(u, _p + Real(0.5f)));
    }

    // u^(-1/k) - 1.
    REGAIN_HOST_DEVICE static Real power_minus_one(const Real& u, const Real& k)
    {
        return detail::expm1(limited(-log(number_of(u)) / k));
    }
    // Slopes above 1e11 are all the same: their normals lie in the surface.
    REGAIN_HOST_DEVICE static Real limited(const Real& exponent) { return min(exponent, Real(55)); }
    REGAIN_HOST_DEVICE static Real number_of(const Real& u)
    {
        return max(u, constant<Real>(1e-12));
    }
    REGAIN_HOST_DEVICE static Real angle_of(const Real& u)
    {
        return constant<Real>(6.28318530717958647692) * u;
    }

    Real _p, _beyond, _cotangent;
    Real _plain;  // share of the plain slopes among the proposals
};

}  // namespace detail

REGAIN_NAMESPACE_END
