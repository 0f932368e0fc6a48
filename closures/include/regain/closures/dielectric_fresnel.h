// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Unpolarised Fresnel reflectance between two dielectrics, from either side:
///
///   r_s = (eta^2 - 1) / (g + c)^2,   r_p = (eta^2 - 1) ((eta^2 + 1) c^2 - 1) / (eta^2 c + g)^2
///   F     = (r_s^2 + r_p^2) / 2
///   1 - F = 2 c g (1 / (c + g)^2 + eta^2 / (eta^2 c + g)^2)
///   g^2   = (eta - 1)(eta + 1) + c^2;  where it is not positive, F = 1
///
/// with c the cosine on the near side: Walter et al. 2007, Eq. 22, with its differences multiplied
/// out, so that F, however small, and 1 - F, however small, keep their digits. eta = 1 gives 0.
///
/// The average, in r = (eta - 1) / (eta + 1), b = (eta^2 - 1) / (eta^2 + 1), u = -r_s:
///
///   F_ss = 2 int_0^1 F c dc = (eta - 1)(3 eta + 1) / (6 (eta + 1)^2)
///          + (eta^2 - 1) / 8 int_r^1 ((b - u) / (1 - b u))^2 (1 - u^2) / u^2 du     eta >= 1
///   1 - F_ss(eta) = eta^2 (1 - F_ss(1 / eta))
///
/// whose closed form (Walsh 1926; Egan and Hilgeman 1973) is used from eta = 2 on; nearer 1 it
/// cancels, and the smooth part of the integral is taken by Gauss-Legendre quadrature.
///
/// Interface as in constant_fresnel.h; the three channels are equal.

#pragma once

#include <regain/closures/fresnel_moments.h>
#include <regain/closures/refraction.h>

REGAIN_NAMESPACE_BEGIN

template <class RealType>
class DielectricFresnel
{
public:
    using Real = RealType;
    using Color = Color3<Real>;

    /// eta: index ahead over index on the side of the direction, in [1e-2, 1e2]; outside it is
    /// clamped, NaN becomes 1.5.
    REGAIN_HOST_DEVICE explicit DielectricFresnel(Real eta) : _eta(RelativeIndex<Real>::of(eta)) {}
    /// The index as it is.
    REGAIN_HOST_DEVICE explicit DielectricFresnel(const RelativeIndex<Real>& eta) : _eta(eta) {}

    REGAIN_HOST_DEVICE const RelativeIndex<Real>& relative_index() const { return _eta; }

    /// F and 1 - F at the cosine mu in [0, 1], each to nearly full precision.
    struct Split
    {
        Real reflectance, transmittance;
    };
    REGAIN_INLINE Split split(Real mu) const { return split(mu, mu * mu); }
    /// The same of the square of mu.
    REGAIN_INLINE Split split_of_square(Real mu2) const { return split(detail::sqrt(mu2), mu2); }
    REGAIN_INLINE Real reflectance(Real mu) const { return split(mu).reflectance; }
    REGAIN_INLINE Real transmittance(Real mu) const { return split(mu).transmittance; }

    /// 1 - F of a pair of directions that refract into each other: mu_o on the near side, mu_i on
    /// the far side, each up to a positive factor of both. Where only one of the cosines is known,
    /// the other loses its digits near the critical angle.
    REGAIN_INLINE Real transmittance(Real mu_o, Real mu_i) const
    {
        const Real tiny = detail::constant<Real>(1e-18);
        const Real c = detail::max(mu_o, tiny), t = detail::max(mu_i, tiny);
        const Real s = c + _eta.eta * t, p = _eta.eta * c + t, inv = Real(1) / (s * p);
        const Real inv_s = p * inv, inv_p = s * inv;
        const Real T = Real(2) * _eta.eta * (c * inv_s * (t * inv_s) + c * inv_p * (t * inv_p));
        return detail::min(T, Real(1));
    }

    REGAIN_HOST_DEVICE Color at(Real mu) const { return Color(reflectance(mu)); }
    REGAIN_HOST_DEVICE Color normal_incidence() const { return at(Real(1)); }
    /// F at the cosine of the falloff.
    REGAIN_HOST_DEVICE Color mean(const FresnelMoments<Real>& moments) const
    {
        return at(moments.cosine());
    }
    /// F_ss.
    REGAIN_HOST_DEVICE Color average() const { return Color(Real(1) - average_transmittance()); }

    /// 1 - F_ss.
    REGAIN_HOST_DEVICE Real average_transmittance() const
    {
        const MaskOf<Real> inside = _eta.minus_one < Real(0);
        const RelativeIndex<Real> larger = detail::select(inside, _eta.inverse(), _eta);
        const Real T = Real(1) - average_entering(larger);
        return detail::select(inside, _eta.eta * _eta.eta * T, T);
    }
    REGAIN_HOST_DEVICE Real average_reflectance() const
    {
        return detail::select(_eta.minus_one < Real(0), Real(1) - average_transmittance(),
                              average_entering(_eta));
    }

private:
    REGAIN_INLINE Split split(Real mu, Real mu2) const
    {
        // Keeps 0 / 0 out at grazing incidence on eta = 1.
        const Real tiny = detail::constant<Real>(1e-18);
        const Real c = detail::max(mu, tiny), k = _eta.square_minus_one();
        const Real eta2 = _eta.eta * _eta.eta, g2 = _eta.g2(c, detail::max(mu2, tiny * tiny));
        const MaskOf<Real> refracts = g2 > Real(0);
        const Real g = detail::sqrt(detail::select(refracts, g2, Real(1)));

        // One division for two; neither factor is small, but where both are.
        const Real s = g + c, p = eta2 * c + g, inv = Real(1) / (s * p);
        const Real inv_s = p * inv, inv_p = s * inv;
        const Real r_s = k * inv_s * inv_s;
        // (eta^2 + 1) c^2 - 1 of a small eta, head on, is eta^2.
        const Real over = eta2 * c * c - (Real(1) - c) * (Real(1) + c);
        const Real r_p = k * over * inv_p * inv_p;
        const Real F = Real(0.5f) * (r_s * r_s + r_p * r_p);
        // A product of quotients: c g underflows before it is divided by squares.
        const Real T = Real(2) * (c * inv_s * (g * inv_s) + eta2 * (c * inv_p) * (g * inv_p));
        return {detail::select(refracts, detail::min(F, Real(1)), Real(1)),
                detail::select(refracts, detail::min(T, Real(1)), Real(0))};
    }
    REGAIN_HOST_DEVICE static Real average_entering(const RelativeIndex<Real>& index)
    {
        const Real n = detail::max(index.eta, Real(1));
        const Real minus_one = detail::max(index.minus_one, Real(0));
        const MaskOf<Real> small = n < Real(2);
        return detail::select(small, average_near_one(n, minus_one),
                              average_closed(detail::max(n, Real(2))));
    }

    REGAIN_HOST_DEVICE static Real average_near_one(Real n, Real minus_one)
    {
        constexpr double node[] = {0.0198550717512318842, 0.101666761293186630,
                                   0.237233795041835507,  0.408282678752175098,
                                   0.591717321247824902,  0.762766204958164493,
                                   0.898333238706813370,  0.980144928248768116};
        constexpr double weight[] = {0.0506142681451881296, 0.111190517226687235,
                                     0.156853322938943644,  0.181341891689180991,
                                     0.181341891689180991,  0.156853322938943644,
                                     0.111190517226687235,  0.0506142681451881296};
        const Real one(1), two(2);
        const Real r = minus_one / (n + one), span = one - r;
        const Real b_over_r = two / (one + r * r), b = b_over_r * r, b2 = b * b;

        // (1 - u^2) / (1 - b u)^2 = 1 + 2 b u - u^2 (1 - 3 b^2 + 2 b^3 u) / (1 - b u)^2; the first
        // two terms in closed form, the smooth rest by quadrature.
        const Real log_r = detail::log(detail::max(r, detail::constant<Real>(1e-30)));
        Real sum = (one - Real(4) * b2) * span + b * (one - r * r) + two * b * (one - b2) * log_r +
                   b * b_over_r * span;
        for (int i = 0; i < 8; ++i)
        {
            const Real u = r + span * detail::constant<Real>(node[i]);
            const Real q = (b - u) / (one - b * u);
            sum -= detail::constant<Real>(weight[i]) * span * q * q *
                   (one - Real(3) * b2 + two * b2 * b * u);
        }
        const Real s = minus_one * (Real(3) * n + one) / ((n + one) * (n + one));
        return s * detail::constant<Real>(1.0 / 6) +
               minus_one * (n + one) * sum * detail::constant<Real>(1.0 / 8);
    }

    REGAIN_HOST_DEVICE static Real average_closed(Real n)
    {
        const Real one(1), two(2);
        const Real n2 = n * n, inv = one / n2, inv2 = inv * inv;  // powers of 1 / n do not overflow
        const Real plus = one + inv, minus = one - inv, plus4 = one + inv2;
        const Real minus4 = plus * minus;  // 1 - n^-4
        const Real step = (n - one) / (n + one);
        const Real s = (n - one) * (Real(3) * n + one) / ((n + one) * (n + one));
        return Real(0.5f) + s * detail::constant<Real>(1.0 / 6) +
               minus * minus / (plus * plus * plus) * detail::log(step) -
               two / n * (one + two / n - inv) / (plus * minus4) +
               Real(8) * inv * plus4 / (plus * minus4 * minus4) * detail::log(n);
    }

    RelativeIndex<Real> _eta;
};

REGAIN_NAMESPACE_END
