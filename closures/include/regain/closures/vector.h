// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Directions and colours: Imath's, for any number type. Directions are in the local shading frame,
/// z = shading normal, and point away from the surface. Colours are linear and scene-referred.

#pragma once

#include <regain/closures/number.h>

#include <Imath/ImathColor.h>
#include <Imath/ImathVec.h>

REGAIN_NAMESPACE_BEGIN

template <class Real>
using Vec2 = Imath::Vec2<Real>;
template <class Real>
using Vec3 = Imath::Vec3<Real>;
template <class Real>
using Color3 = Imath::Color3<Real>;

namespace detail {

template <class Real>
REGAIN_INLINE Vec3<Real> select(MaskOf<Real> mask, const Vec3<Real>& a, const Vec3<Real>& b)
{
    return {select(mask, a.x, b.x), select(mask, a.y, b.y), select(mask, a.z, b.z)};
}
template <class Real>
REGAIN_INLINE Color3<Real> select(MaskOf<Real> mask, const Color3<Real>& a, const Color3<Real>& b)
{
    return {select(mask, a.x, b.x), select(mask, a.y, b.y), select(mask, a.z, b.z)};
}

/// f of each channel.
template <class Real, class F>
REGAIN_INLINE Color3<Real> per_channel(const Color3<Real>& c, const F& f)
{
    return {f(c.x), f(c.y), f(c.z)};
}

template <class Real>
REGAIN_INLINE Real dot(const Vec3<Real>& a, const Vec3<Real>& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class Real>
REGAIN_INLINE Vec3<Real> normalised(const Vec3<Real>& w)
{
    return w * (Real(1) / detail::sqrt(dot(w, w)));
}

/// |w| = 1 within half a per cent, so that garbage (NaN, infinity, zero) is not taken for a
/// direction.
template <class Real>
REGAIN_INLINE MaskOf<Real> is_direction(const Vec3<Real>& w)
{
    const Real length2 = dot(w, w);
    return both<Real>(quiet_less(constant<Real>(0.99), length2),
                      quiet_less(length2, constant<Real>(1.01)));
}

/// Below this cosine a direction counts as below the horizon. It keeps products of cosines above
/// the smallest float, and so quotients of them finite.
constexpr double horizon = 1e-12;

/// True for a direction on the side of the normal. All of NaN, infinity, zero, the horizon itself
/// and the other side give false.
template <class Real>
REGAIN_INLINE MaskOf<Real> is_above_horizon(const Vec3<Real>& w)
{
    return both<Real>(quiet_less(constant<Real>(horizon), w.z), is_direction(w));
}

}  // namespace detail

REGAIN_NAMESPACE_END
