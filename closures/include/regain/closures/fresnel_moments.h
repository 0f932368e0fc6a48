// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What the mean of a Fresnel term over many facets depends on: the means of the two curves that
/// make up Schlick's term with its tint at 82 degrees.

#pragma once

#include <regain/closures/vector.h>

REGAIN_NAMESPACE_BEGIN

template <class Real>
struct FresnelMoments
{
    Real falloff;  ///< mean of (1 - mu)^5
    Real dip;      ///< mean of mu (1 - mu)^6

    /// Of a single facet.
    REGAIN_HOST_DEVICE static FresnelMoments at(Real mu)
    {
        const Real x = Real(1) - mu, x2 = x * x, x4 = x2 * x2;
        return {x4 * x, mu * x4 * x2};
    }

    /// The cosine of a facet with the same falloff.
    REGAIN_HOST_DEVICE Real cosine() const
    {
        return Real(1) - detail::pow(detail::saturate(falloff), detail::constant<Real>(0.2));
    }
};

REGAIN_NAMESPACE_END
