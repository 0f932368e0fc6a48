// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Integrals of the Gaussian beyond a point, without the cancellation of the text-book formulas:
///
///   erfcx_deficit(x) = 1 - sqrt(pi) x exp(x^2) erfc(x)
///   ierfc(x)         = int_x^inf erfc = exp(-x^2) / sqrt(pi) - x erfc(x)
///                    = exp(-x^2) erfcx_deficit(x) / sqrt(pi)
///
/// for x >= 0, all digits but two or so of the number type. Far out both come from the continued
/// fraction of erfc (DLMF 7.9), in which nothing is subtracted.

#pragma once

#include <regain/closures/number.h>

REGAIN_NAMESPACE_BEGIN

namespace detail {

template <class Real>
constexpr double gaussian_tail_begin = sizeof(ScalarOf<Real>) == 4 ? 2 : 3;

/// erfcx_deficit(x) for x >= gaussian_tail_begin.
template <class Real>
REGAIN_HOST_DEVICE Real erfcx_deficit_far(const Real& x)
{
    // sqrt(pi) x erfcx(x) = 1 / (1 + w / v),  v = 1 + 2w / (1 + 3w / (1 + ...)). The tail that is
    // cut off is replaced by that of a fraction with equal terms. v = p / q.
    constexpr int terms = sizeof(ScalarOf<Real>) == 4 ? 12 : 24;
    const Real w = Real(0.5f) / (x * x);
    Real p = Real(0.5f) * (Real(1) + sqrt(Real(1) + constant<Real>(4 * (terms + 1)) * w)), q(1);
    for (int n = terms; n >= 2; --n)
    {
        const Real next = p + constant<Real>(n) * w * q;
        q = p;
        p = next;
    }
    return w * q / (p + w * q);
}

template <class Real>
REGAIN_HOST_DEVICE Real erfcx_deficit(const Real& x)
{
    const MaskOf<Real> far = x >= constant<Real>(gaussian_tail_begin<Real>);
    if (all<Real>(far)) return erfcx_deficit_far(x);
    const Real begin = constant<Real>(gaussian_tail_begin<Real>), at = min(x, begin);
    const Real near = Real(1) - constant<Real>(1.77245385090551602730) * at *
                                    (detail::exp(at * at) * detail::erfc(at));
    return any<Real>(far) ? select(far, erfcx_deficit_far(max(x, begin)), near) : near;
}

template <class Real>
REGAIN_HOST_DEVICE Real ierfc(const Real& x)
{
    const Real gauss = constant<Real>(0.564189583547756286948) * detail::exp(-x * x);
    const MaskOf<Real> far = x >= constant<Real>(gaussian_tail_begin<Real>);
    if (all<Real>(far)) return gauss * erfcx_deficit_far(x);
    const Real near = gauss - x * detail::erfc(x);
    if (!any<Real>(far)) return near;
    const Real begin = constant<Real>(gaussian_tail_begin<Real>);
    return select(far, gauss * erfcx_deficit_far(max(x, begin)), near);
}

}  // namespace detail

REGAIN_NAMESPACE_END
