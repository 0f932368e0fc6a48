// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Fresnel reflectance that does not depend on the angle. With value 1 it is the perfect mirror of
/// the white furnace test.
///
/// A Fresnel term answers, per channel and in [0, 1]:
///     at(mu)               reflectance at the cosine mu in [0, 1] between a direction and the
///                          normal of the facet
///     normal_incidence()   at(1), the paper's F0
///     mean(moments)        mean over facets of which only these moments are known
///     average()            F_ss = 2 int_0^1 at(mu) mu dmu (Turquin 2019, below Eq. 7)

#pragma once

#include <regain/closures/channels.h>
#include <regain/closures/fresnel_moments.h>

REGAIN_NAMESPACE_BEGIN

template <class RealType>
class ConstantFresnel
{
public:
    using Real = RealType;

    /// Reflectance in [0, 1] per channel; outside it is clamped, NaN becomes 0.
    REGAIN_HOST_DEVICE explicit ConstantFresnel(const Color3<Real>& value = Color3<Real>(Real(1)))
        : _value(detail::saturated_channels(value))
    {}

    REGAIN_HOST_DEVICE Color3<Real> at(Real) const { return detail::color(_value); }
    REGAIN_HOST_DEVICE detail::ChannelsOf<Real> channels_at(Real) const { return _value; }
    REGAIN_HOST_DEVICE Color3<Real> normal_incidence() const { return at(Real(1)); }
    REGAIN_HOST_DEVICE Color3<Real> mean(const FresnelMoments<Real>&) const { return at(Real(1)); }
    REGAIN_HOST_DEVICE Color3<Real> average() const { return at(Real(1)); }

private:
    detail::ChannelsOf<Real> _value;
};

REGAIN_NAMESPACE_END
