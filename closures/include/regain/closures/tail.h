// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The tail parameter gamma of the distributions that have one, as a coordinate in [0, 1] along the
/// third axis of their tables:
///
///   GTR   f = 3.84 g / (g + 3) + 0.7 S((g - 1.25) / 0.5),  S(t) = t / sqrt(1 + t^2)
///   STD   f = ln(u / (u + 4)),  u = g - 1.5
///
/// each scaled to [0, 1] over its range. The slope of f is close to the root of what E_ss bends by,
/// |d^2 E_ss / dg^2| / E_ss at its largest over alpha in [1e-3, 1] and mu, which spreads the error
/// of interpolation evenly. GTR's bump is where its weight moves from slopes of 1 to slopes of
/// alpha, between gamma 1 and 1.5. Each map grows with gamma, and has its inverse next to it.
///
/// gamma: without unit; outside its range it is clamped. Coordinates outside [0, 1] are, too.

#pragma once

#include <regain/closures/number.h>

REGAIN_NAMESPACE_BEGIN

/// Range of gamma of GTR (Burley 2012, B.1). At 2 it is GGX, smaller means longer tails.
constexpr double gtr_min_gamma = 1e-3, gtr_max_gamma = 10;
/// Range of gamma of STD (Ribardiere et al. 2017). At 2 it is GGX, smaller means longer tails. At
/// 1.5 the mean slope diverges and nothing comes back; 100 is a Beckmann lobe within 4e-3 of its
/// albedo, so the limit is no loss.
constexpr double std_min_gamma = 1.51, std_max_gamma = 100;

namespace detail {

template <class Real>
REGAIN_HOST_DEVICE Real gtr_tail_position(const Real& gamma)
{
    const Real t = (gamma - constant<Real>(1.25)) * Real(2);
    return constant<Real>(3.84) * gamma / (gamma + Real(3)) +
           constant<Real>(0.7) * t / sqrt(Real(1) + t * t);
}
template <class Real>
REGAIN_HOST_DEVICE Real std_tail_position(const Real& gamma)
{
    const Real u = gamma - constant<Real>(1.5);
    return log(u / (u + Real(4)));
}

/// A position that lies at `lowest` to `highest`, scaled to [0, 1].
template <class Real>
REGAIN_HOST_DEVICE Real tail_coordinate(const Real& position, double lowest, double highest)
{
    return saturate((position - constant<Real>(lowest)) * constant<Real>(1 / (highest - lowest)));
}

// Of the limits of gamma.
constexpr double gtr_lowest_position = -0.6485823190685543,
                 gtr_highest_position = 3.652706087942937;
constexpr double std_lowest_position = -5.9939614273065684,
                 std_highest_position = -0.039806250400419706;

}  // namespace detail

/// Coordinates of alpha in [0, 1] along the second axis of their tables, logarithms but for the
/// end:
///
///   GTR   ln(1 + 1000 alpha) / (2 ln 1001) + alpha^2 / 2, since with a large gamma E_ss changes
///         most close to alpha 1
///   STD   0.8 ln(1 + 1000 alpha) / ln 1001 + 0.2 alpha
template <class Real>
REGAIN_HOST_DEVICE Real gtr_width(const Real& alpha)
{
    const double scale = 0.5 / 6.9087547793152205;
    return detail::saturate(detail::constant<Real>(scale) *
                                detail::log(Real(1) + Real(1000) * alpha) +
                            Real(0.5f) * alpha * alpha);
}
template <class Real>
REGAIN_HOST_DEVICE Real std_width(const Real& alpha)
{
    const double scale = 0.8 / 6.9087547793152205;
    return detail::saturate(detail::constant<Real>(scale) *
                                detail::log(Real(1) + Real(1000) * alpha) +
                            detail::constant<Real>(0.2) * alpha);
}

/// Coordinate of a GTR's gamma, 0 at gtr_min_gamma and 1 at gtr_max_gamma; NaN counts as 2.
template <class Real>
REGAIN_HOST_DEVICE Real gtr_tail(const Real& gamma)
{
    const Real g = detail::sanitised(gamma, gtr_min_gamma, gtr_max_gamma, 2);
    return detail::tail_coordinate(detail::gtr_tail_position(g), detail::gtr_lowest_position,
                                   detail::gtr_highest_position);
}
/// The inverse of gtr_tail, by bisection.
template <class Real>
REGAIN_HOST_DEVICE Real gtr_gamma(const Real& coordinate)
{
    using namespace detail;
    const Real wanted = saturate(coordinate);
    Real low = constant<Real>(gtr_min_gamma), high = constant<Real>(gtr_max_gamma);
    for (int i = 0; i < 60; ++i)
    {
        const Real middle = Real(0.5f) * (low + high);
        const MaskOf<Real> below = gtr_tail(middle) < wanted;
        low = select(below, middle, low);
        high = select(below, high, middle);
    }
    return Real(0.5f) * (low + high);
}

/// Coordinate of an STD's gamma, 0 at std_min_gamma and 1 at std_max_gamma; NaN counts as 2.
template <class Real>
REGAIN_HOST_DEVICE Real std_tail(const Real& gamma)
{
    const Real g = detail::sanitised(gamma, std_min_gamma, std_max_gamma, 2);
    return detail::tail_coordinate(detail::std_tail_position(g), detail::std_lowest_position,
                                   detail::std_highest_position);
}
/// The inverse of std_tail.
template <class Real>
REGAIN_HOST_DEVICE Real std_gamma(const Real& coordinate)
{
    using namespace detail;
    const Real position =
        constant<Real>(std_lowest_position) +
        constant<Real>(std_highest_position - std_lowest_position) * saturate(coordinate);
    const Real e = detail::exp(position);
    return sanitised(constant<Real>(1.5) + Real(4) * e / (Real(1) - e), std_min_gamma,
                     std_max_gamma, 2);
}

REGAIN_NAMESPACE_END
