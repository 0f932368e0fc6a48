// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The gain hook: a closure weight that depends on wo, and on wi only if it says so. A renderer may
/// pass its own object with
///
///     Color3<Real> at(const Vec3<Real>& wo) const             called once per shading point
///
/// and, optionally,
///
///     static constexpr bool depends_on_wi = true;             then also, per eval and sample,
///     Color3<Real> pair(const Vec3<Real>& wo, const Vec3<Real>& wi) const
///     static constexpr bool reciprocal = true;                keeps f(wo, wi) = f(wi, wo)
///     static constexpr bool energy_preserving = true;         makes the albedo 1 where F = 1
///
/// Both are asked about unit directions only, whatever the closure is asked about. What of a pair
/// depends on wo alone can be kept in a nested type
///
///     Prepared(const Gain& gain, const Vec3<Real>& wo)       made once per shading point
///     Color3<Real> pair(const Vec3<Real>& wi) const          asked in the place of pair(wo, wi)
///
/// The gain of a direction pair is at(wo) * pair(wo, wi). It is finite, not negative, and
/// dimensionless. No gain changes a direction or a pdf.

#pragma once

#include <regain/closures/closure.h>
#include <regain/closures/count.h>

#include <type_traits>

REGAIN_NAMESPACE_BEGIN

/// The hook that changes nothing, bit for bit.
template <class Real>
struct IdentityGain
{
    static constexpr bool reciprocal = true;

    REGAIN_HOST_DEVICE Color3<Real> at(const Vec3<Real>&) const { return Color3<Real>(Real(1)); }
};

namespace detail {

template <class Gain, class = void>
struct GainDependsOnWi : std::false_type
{};
template <class Gain>
struct GainDependsOnWi<Gain, std::void_t<decltype(Gain::depends_on_wi)>>
    : std::bool_constant<Gain::depends_on_wi>
{};

// A pair's gain with wo fixed.
template <class Gain, class Real, class = void>
class PairGain
{
public:
    REGAIN_HOST_DEVICE PairGain(const Gain& gain, const Vec3<Real>& wo) : _gain(gain), _wo(wo) {}
    REGAIN_HOST_DEVICE Color3<Real> pair(const Vec3<Real>& wi) const { return _gain.pair(_wo, wi); }

private:
    Gain _gain;
    Vec3<Real> _wo;
};
template <class Gain, class Real>
class PairGain<Gain, Real, std::void_t<typename Gain::Prepared>> : public Gain::Prepared
{
public:
    using Gain::Prepared::Prepared;
};
// Of a gain that has none nothing is kept.
struct NoPairGain
{
    template <class Gain, class Direction>
    REGAIN_HOST_DEVICE NoPairGain(const Gain&, const Direction&)
    {}
};

template <class Gain, class = void>
struct GainIsReciprocal : std::false_type
{};
template <class Gain>
struct GainIsReciprocal<Gain, std::void_t<decltype(Gain::reciprocal)>>
    : std::bool_constant<Gain::reciprocal>
{};

// A hook whose property depends on its state answers through a function instead of a constant.
template <class Gain, class = void>
struct GainPreservesEnergy
{
    REGAIN_HOST_DEVICE static bool of(const Gain&) { return false; }
};
template <class Gain>
struct GainPreservesEnergy<
    Gain, std::enable_if_t<std::is_same_v<decltype(Gain::energy_preserving), const bool>>>
{
    REGAIN_HOST_DEVICE static bool of(const Gain&) { return Gain::energy_preserving; }
};
template <class Gain>
struct GainPreservesEnergy<Gain,
                           std::void_t<decltype(std::declval<const Gain&>().energy_preserving())>>
{
    REGAIN_HOST_DEVICE static bool of(const Gain& gain) { return gain.energy_preserving(); }
};

}  // namespace detail

REGAIN_NAMESPACE_END
