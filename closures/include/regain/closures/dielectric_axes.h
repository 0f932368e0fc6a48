// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Coordinates on the axes of the tables of rough dielectrics: see dielectric_tables.h, whose
/// letters are meant by "above".

#pragma once

#include <regain/closures/table.h>

REGAIN_NAMESPACE_BEGIN

namespace detail {

/// Where the critical cosine lies on the axis of side 1.
constexpr double critical_coordinate = 15.0 / 31.0;

/// The least alpha on the axis x of distributions with a tail.
constexpr float tail_least_width = 0.05f;

/// z above, of eta > 0.
template <class Real>
REGAIN_HOST_DEVICE Real index_coordinate(Real eta)
{
    return sqrt(sqrt(
        min(abs(eta - Real(1)) / (eta + Real(1)) * constant<Real>(5.0 / 3.0), constant<Real>(1))));
}

/// The same of E^S of side 1 in the beta form.
template <class Real>
REGAIN_HOST_DEVICE Real near_index_coordinate(Real eta)
{
    const Real r =
        sqrt(min(abs(eta - Real(1)) / (eta + Real(1)) * constant<Real>(5.0 / 3.0), Real(1)));
    return log1p(Real(200) * r) * constant<Real>(1 / 5.303304908059076);
}

/// w above.
template <class Real>
REGAIN_HOST_DEVICE Real fresnel_weight(Real alpha, Real eta)
{
    const Real k = abs((eta - Real(1)) * (eta + Real(1)));
    return k / (k + alpha * alpha);
}

/// s above; mu in [0, 1], alpha in (0, 1].
template <class Real>
REGAIN_HOST_DEVICE Real dielectric_cosine(Real mu, Real alpha, bool tail)
{
    const Real s = stretched_cosine(mu, alpha);
    return tail ? Real(0.5f) * (s + Real(1) - sqrt(max(Real(1) - s, Real(0)))) : s;
}

/// x of side 1 above: mu in [0, 1], alpha in (0, 1], eta in (0, 1).
template <class Real>
REGAIN_HOST_DEVICE Real critical_cosine_coordinate(Real mu, Real alpha, Real eta, bool tail = false,
                                                   bool near_index = false)
{
    const Real one(1), tiny = constant<Real>(1e-6);
    const Real kappa = sqrt(max((one - eta) * (one + eta), constant<Real>(1e-12)));
    const Real below = min(mu / kappa, one), a = min(alpha / kappa, one);
    const Real left = constant<Real>(0.6) * stretched_cosine(below, a) +
                      constant<Real>(0.4) * (one - stretched_cosine(one - below, a));

    const Real room = max(one - kappa, tiny);
    const Real above = saturate((mu - kappa) / room);
    const Real a_above = near_index ? alpha / (room + alpha * kappa) : min(alpha / room, one);
    const Real right = dielectric_cosine(above, a_above, tail);

    const Real c = constant<Real>(critical_coordinate);
    return select(mu < kappa, c * left, c + (one - c) * right);
}

}  // namespace detail

REGAIN_NAMESPACE_END
