// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The tail parameter gamma of the distributions that have one, as a coordinate in [0, 1] along the
/// third axis of their tables. 1 - E_ss has to be close to linear in it, so that a table of 32
/// nodes interpolates well. Each map is smooth, grows with gamma, and has its inverse next to it.
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

// Where gtr_tail and std_tail spend half of their nodes: the half-way gamma is about this much
// above the smallest.
constexpr double gtr_tail_scale = 2.5, std_tail_scale = 0.5;

/// t = (1 + s) x / (x + s) of the position x in [0, 1] of gamma in its range: monotone, dense where
/// x < s.
template <class Real>
Real tail_coordinate(const Real& gamma, double lo, double hi, double scale)
{
    const double s = scale / (hi - lo);
    const Real x =
        constant<Real>(1 / (hi - lo)) * (sanitised(gamma, lo, hi, 2) - constant<Real>(lo));
    return min(constant<Real>(1 + s) * x / (x + constant<Real>(s)), Real(1));
}
template <class Real>
Real tail_gamma(const Real& coordinate, double lo, double hi, double scale)
{
    const double s = scale / (hi - lo);
    const Real t = saturate(coordinate);
    const Real x = constant<Real>(s) * t / (constant<Real>(1 + s) - t);
    return min(constant<Real>(lo) + constant<Real>(hi - lo) * x, constant<Real>(hi));
}

}  // namespace detail

/// Coordinate of a GTR's gamma, 0 at gtr_min_gamma and 1 at gtr_max_gamma; NaN counts as 2.
template <class Real>
Real gtr_tail(const Real& gamma)
{
    return detail::tail_coordinate(gamma, gtr_min_gamma, gtr_max_gamma, detail::gtr_tail_scale);
}
/// The inverse of gtr_tail.
template <class Real>
Real gtr_gamma(const Real& coordinate)
{
    return detail::tail_gamma(coordinate, gtr_min_gamma, gtr_max_gamma, detail::gtr_tail_scale);
}

/// Coordinate of an STD's gamma, 0 at std_min_gamma and 1 at std_max_gamma; NaN counts as 2.
template <class Real>
Real std_tail(const Real& gamma)
{
    return detail::tail_coordinate(gamma, std_min_gamma, std_max_gamma, detail::std_tail_scale);
}
/// The inverse of std_tail.
template <class Real>
Real std_gamma(const Real& coordinate)
{
    return detail::tail_gamma(coordinate, std_min_gamma, std_max_gamma, detail::std_tail_scale);
}

REGAIN_NAMESPACE_END
