// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The inverse of the error function: erf(erf_inverse(y)) = y, for Gaussian random numbers from
/// uniform ones without losing their stratification.
///
/// Giles 2012, "Approximating the erfinv function", single precision (a central and a tail
/// polynomial in -log(1 - y^2)); in double followed by Halley steps. |y| is taken as at most 1 less
/// half an ulp, so that the answer is finite: |x| <= 3.9 in float, 5.9 in double.

#pragma once

#include <regain/closures/number.h>

REGAIN_NAMESPACE_BEGIN

namespace detail {

template <class Real>
REGAIN_HOST_DEVICE Real erf_inverse(const Real& y)
{
    constexpr bool single = sizeof(ScalarOf<Real>) == 4;
    constexpr double ulp = single ? 0x1p-24 : 0x1p-53;
    const Real most = constant<Real>(1 - ulp);
    const Real b = max(min(y, most), -most);

    const Real w = -log((Real(1) - b) * (Real(1) + b));
    const Real c = w - constant<Real>(2.5);
    constexpr double central[] = {2.81022636e-08,  3.43273939e-07, -3.5233877e-06,
                                  -4.39150654e-06, 0.00021858087,  -0.00125372503,
                                  -0.00417768164,  0.246640727,    1.50140941};
    Real p = constant<Real>(central[0]);
    for (int i = 1; i < 9; ++i) p = p * c + constant<Real>(central[i]);

    const MaskOf<Real> outer = w >= Real(5);
    if (any<Real>(outer))
    {
        constexpr double tail[] = {-0.000200214257, 0.000100950558, 0.00134934322,
                                   -0.00367342844,  0.00573950773,  -0.0076224613,
                                   0.00943887047,   1.00167406,     2.83297682};
        // The polynomial ends where float does.
        const Real t = sqrt(min(max(w, Real(5)), Real(17))) - Real(3);
        Real far = constant<Real>(tail[0]);
        for (int i = 1; i < 9; ++i) far = far * t + constant<Real>(tail[i]);
        p = select(outer, far * sqrt(max(w, Real(17)) / Real(17)), p);
    }
    Real x = p * b;

    if constexpr (!single)
        for (int step = 0; step < 3; ++step)
        {
            // By erfc, which keeps its digits where erf is nearly 1.
            const Real a = abs(x);
            const Real excess = ((Real(1) - abs(b)) - detail::erfc(a)) *
                                (constant<Real>(0.886226925452758013649) * detail::exp(a * a));
            const Real shift = excess / (Real(1) + a * excess);
            x = select(b < Real(0), -(a - shift), a - shift);
        }
    return x;
}

}  // namespace detail

REGAIN_NAMESPACE_END
