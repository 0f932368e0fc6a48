// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The tail parameter gamma of the distributions that have one, as a coordinate in [0, 1] along the
/// third axis of their tables. E_ss has to be close to linear in it, so that a table of 32 nodes
/// interpolates well. Each map is smooth, grows with gamma, and has its inverse next to it.
///
/// gamma: without unit; outside its range it is clamped. Coordinates outside [0, 1] are, too.

#pragma once

#include <regain/closures/number.h>

REGAIN_NAMESPACE_BEGIN

/// Range of gamma of GTR (Burley 2012). At 2 it is GGX, smaller means longer tails.
constexpr double gtr_min_gamma = 1e-3, gtr_max_gamma = 10;
/// Range of gamma of STD (Ribardiere et al. 2017). At 2 it is GGX, smaller means longer tails. At
/// 1.5 the mean slope diverges and nothing comes back; 100 is a Beckmann lobe within 4e-3 of its
/// albedo, so the limit is no loss.
constexpr double std_min_gamma = 1.51, std_max_gamma = 100;

namespace detail {

// gtr_tail is x / (x + s) of the distance x above the smallest gamma, std_tail the square root of
// that of the distance above 3 / 2, where the mean slope diverges. Of powers and scales for
// STD these leave the least between 32 linear nodes: 2e-3 of E_ss, 4e-3 relative.
constexpr double gtr_tail_scale = 2.5, std_tail_scale = 0.2, std_pole = 1.5;

/// sqrt for limits known while compiling: Newton's method from above.
constexpr double constant_sqrt(double x)
{
    double r = 1 + x;
    for (int i = 0; i < 40; ++i) r = 0.5 * (r + x / r);
    return r;
}
constexpr double std_tail_of(double gamma)
{
    return constant_sqrt((gamma - std_pole) / (gamma - std_pole + std_tail_scale));
}
constexpr double std_tail_begin = std_tail_of(std_min_gamma),
                 std_tail_length = std_tail_of(std_max_gamma) - std_tail_begin,
                 gtr_tail_length = (gtr_max_gamma - gtr_min_gamma) /
                                   (gtr_max_gamma - gtr_min_gamma + gtr_tail_scale);

}  // namespace detail

/// Coordinate of a GTR's gamma, 0 at gtr_min_gamma and 1 at gtr_max_gamma; NaN counts as 2.
template <class Real>
Real gtr_tail(const Real& gamma)
{
    const Real x = detail::sanitised(gamma, gtr_min_gamma, gtr_max_gamma, 2) -
                   detail::constant<Real>(gtr_min_gamma);
    return detail::saturate(detail::constant<Real>(1 / detail::gtr_tail_length) * x /
                            (x + detail::constant<Real>(detail::gtr_tail_scale)));
}
/// The inverse of gtr_tail.
template <class Real>
Real gtr_gamma(const Real& coordinate)
{
    const Real t = detail::saturate(coordinate) * detail::constant<Real>(detail::gtr_tail_length);
    return detail::min(detail::constant<Real>(gtr_min_gamma) +
                           detail::constant<Real>(detail::gtr_tail_scale) * t / (Real(1) - t),
                       detail::constant<Real>(gtr_max_gamma));
}

/// Coordinate of an STD's gamma, 0 at std_min_gamma and 1 at std_max_gamma; NaN counts as 2.
template <class Real>
Real std_tail(const Real& gamma)
{
    const Real x = detail::sanitised(gamma, std_min_gamma, std_max_gamma, 2) -
                   detail::constant<Real>(detail::std_pole);
    const Real t = detail::sqrt(x / (x + detail::constant<Real>(detail::std_tail_scale)));
    return detail::saturate((t - detail::constant<Real>(detail::std_tail_begin)) *
                            detail::constant<Real>(1 / detail::std_tail_length));
}
/// The inverse of std_tail.
template <class Real>
Real std_gamma(const Real& coordinate)
{
    const Real t = detail::constant<Real>(detail::std_tail_begin) +
                   detail::constant<Real>(detail::std_tail_length) * detail::saturate(coordinate);
    const Real x =
        detail::constant<Real>(detail::std_tail_scale) * t * t / ((Real(1) - t) * (Real(1) + t));
    return detail::sanitised(detail::constant<Real>(detail::std_pole) + x, std_min_gamma,
                             std_max_gamma, 2);
}

REGAIN_NAMESPACE_END
