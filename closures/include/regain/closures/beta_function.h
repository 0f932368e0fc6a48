// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The beta function B(1 + a, 1 + b) of numbers a, b >= 0: the joint masking and shadowing of a
/// rough interface for light that passes through it,
///
///   G2(wo, wi) = B(1 + Lambda_o, 1 + Lambda_i)                  Heitz et al. 2016, dielectrics
///
/// By Lanczos' approximation, Gamma(z) = (z + g - 1/2)^(z - 1/2) e^-(z + g - 1/2) L(z) with L of
/// positive coefficients (Lanczos 1964; the ones here are Boost.Math's lanczos6m24 and
/// lanczos13m53), in which the three powers of
///
///   B(1 + a, 1 + b) = Gamma(1 + a) Gamma(1 + b) / Gamma(2 + a + b)
///
/// meet before any is taken: nothing overflows, and where one argument is small nothing cancels
/// whatever the other is. Relative error about (3 + |ln B|) machine epsilons.

#pragma once

#include <regain/closures/number.h>

REGAIN_NAMESPACE_BEGIN

namespace detail {

/// L(z) for z >= 1, and its g.
template <class Real>
struct Lanczos
{
    static constexpr bool is_float = sizeof(ScalarOf<Real>) == 4;
    static constexpr double g =
        is_float ? 1.428456135094165802001953125 : 6.024680040776729583740234375;

    REGAIN_HOST_DEVICE static Real at(Real z)
    {
        // Both polynomials in 1 / z, which is at most 1.
        if constexpr (is_float)
        {
            constexpr double top[] = {2.50662858515256974113978724717473206342,
                                      27.5192015197455403062503721613097825345,
                                      112.2526547883668146736465390902227161763,
                                      211.0971093028510041839168287718170827259,
                                      182.5248962595894264831189414768236280862,
                                      58.52061591769095910314047740215847630266};
            constexpr double bottom[] = {1, 10, 35, 50, 24, 0};
            return quotient(top, bottom, Real(1) / z);
        }
        else
        {
            constexpr double top[] = {2.506628274631000270164908177133837338626431,
                                      210.8242777515793458725097339207133627117643,
                                      8071.672002365816210638002902272250613821856,
                                      186056.2653952234950402949897160456992822505,
                                      2876370.628935372441225409051620849613599112,
                                      31426415.58540019438061423162831820536287787,
                                      248874557.8620541565114603864132294232163077,
                                      1439720407.311721673663223072794912393972245,
                                      6039542586.352028005064291644307297921069938,
                                      17921034426.03720969991975575445893111267403,
                                      35711959237.35566804944018545154716670596718,
                                      42919803642.64909876895789904700198885093263,
                                      23531376880.41075968857200767445163675473076};
            constexpr double bottom[] = {1,         66,       1925,     32670,     357423,
                                         2637558,   13339535, 45995730, 105258076, 150917976,
                                         120543840, 39916800, 0};
            return quotient(top, bottom, Real(1) / z);
        }
    }

private:
    template <int n>
    REGAIN_HOST_DEVICE static Real quotient(const double (&top)[n], const double (&bottom)[n],
                                            Real x)
    {
        Real a = constant<Real>(top[n - 1]), b = constant<Real>(bottom[n - 1]);
        for (int i = n - 2; i >= 0; --i)
        {
            a = a * x + constant<Real>(top[i]);
            b = b * x + constant<Real>(bottom[i]);
        }
        return a / b;
    }
};

}  // namespace detail

/// B(1 + a, 1 + b), in (0, 1]; a and b in [0, 1e30]. 0 where it underflows.
template <class Real>
REGAIN_HOST_DEVICE Real beta_function(Real a, Real b)
{
    using L = detail::Lanczos<Real>;
    const Real one(1), half(0.5f), g = detail::constant<Real>(L::g + 0.5);
    const Real lo = detail::min(a, b), hi = detail::max(a, b);
    const Real sum = lo + (hi + (one + g)), inv = one / sum;

    const Real exponent =
        lo * detail::log((lo + g) * inv) + (hi + half) * detail::log1p(-(lo + one) * inv);
    // e^(1 - g), g with its 1/2.
    const Real scale =
        detail::constant<Real>(L::is_float ? 0.3951633184536883 : 0.003987144211625315);
    return scale * detail::sqrt(lo + g) * inv * L::at(lo + one) *
           (L::at(hi + one) / L::at(lo + hi + Real(2))) *
           detail::exp(detail::max(exponent, Real(-1000)));
}

/// (1 + a) B(1 + a, 1 + b) = B(1 + a, 1 + b) / B(1 + a, 1), in (0, 1]: G2 / G1(wo), which stays
/// finite at grazing angles, where a is large.
template <class Real>
REGAIN_HOST_DEVICE Real beta_quotient(Real a, Real b)
{
    return detail::min((Real(1) + a) * beta_function(a, b), Real(1));
}

REGAIN_NAMESPACE_END
