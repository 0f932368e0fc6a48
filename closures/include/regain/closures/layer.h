// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The combinators of MaterialX's pbrlib, over closures of any kind; each makes a closure again.
///
///   multiply(c, w)       w f                          w per channel
///   mix(fg, bg, m)       m f_fg + (1 - m) f_bg
///   sum(c_1, c_2)        f_1 + f_2                    `add`: sum.h
///   layer(top, base)     f_top + (1 - E_top(wo)) f_base
///
/// E_top(wo) is all that the top reflects and lets through of light along wo, per channel, by its
/// albedo(), so with its own compensation: what is left goes to the base (MaterialX specification,
/// `layer`: "albedo scaling"). Below a top and a base that lose nothing, nothing is lost. It is a
/// gain of the base, and as such takes no part in directions or pdfs; but it looks at wo alone, so
/// a layer is not reciprocal.
///
/// A base under a top is not reached by the light that the top bends: nothing is refracted into or
/// out of it, and nothing absorbed on the way. A tint of the top's transmission is the base's to
/// bear.

#pragma once

#include <regain/closures/compensated.h>
#include <regain/closures/sum.h>

REGAIN_NAMESPACE_BEGIN

/// The gain hook of a weight that is the same for all directions.
template <class RealType>
class ConstantGain
{
public:
    using Real = RealType;
    using Color = Color3<Real>;
    static constexpr bool reciprocal = true;

    /// In [0, 1e6] per channel, clamped; NaN becomes 0.
    REGAIN_HOST_DEVICE explicit ConstantGain(const Color& weight)
        : _weight(
              detail::per_channel(weight, [](Real v) { return detail::sanitised(v, 0, 1e6, 0); }))
    {}

    REGAIN_HOST_DEVICE Color at(const Vec3<Real>&) const { return _weight; }

private:
    Color _weight;
};

/// The gain hook of what lies under `Top`.
template <class Top>
class UnderLayer
{
public:
    using Real = typename Top::Real;
    using Color = Color3<Real>;

    REGAIN_HOST_DEVICE explicit UnderLayer(const Top& top) : _top(top) {}

    /// 1 - E_top(wo), not negative.
    REGAIN_HOST_DEVICE Color at(const Vec3<Real>& wo) const
    {
        const Albedo<Real> a = _top.prepare(wo).albedo();
        return detail::per_channel(a.reflect + a.transmit,
                                   [](Real v) { return Real(1) - detail::saturate(v); });
    }

private:
    Top _top;
};

/// A closure with a weight.
template <class Closure>
REGAIN_HOST_DEVICE Compensated<Closure, ConstantGain<typename Closure::Real>> multiply(
    const Closure& closure, const Color3<typename Closure::Real>& weight)
{
    return {closure, ConstantGain<typename Closure::Real>(weight)};
}
template <class Closure>
REGAIN_HOST_DEVICE auto multiply(const Closure& closure, typename Closure::Real weight)
{
    return multiply(closure, Color3<typename Closure::Real>(weight));
}

/// `amount` of the foreground in [0, 1], clamped; NaN becomes 0.
template <class Foreground, class Background>
REGAIN_HOST_DEVICE auto mix(const Foreground& foreground, const Background& background,
                            typename Foreground::Real amount)
{
    using Real = typename Foreground::Real;
    const Real m = detail::saturate(amount);
    return sum(multiply(foreground, m), multiply(background, Real(1) - m));
}

template <class Top, class Base>
REGAIN_HOST_DEVICE Sum<Top, Compensated<Base, UnderLayer<Top>>> layer(const Top& top,
                                                                      const Base& base)
{
    return {top, {base, UnderLayer<Top>(top)}};
}

REGAIN_NAMESPACE_END
