// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A lobe with a gain on its weight: a closure again. The lobe does not know it is compensated; its
/// directions and pdfs stay bit for bit what they were.

#pragma once

#include <regain/closures/method_gain.h>

#include <type_traits>
#include <utility>

REGAIN_NAMESPACE_BEGIN

/// Asks Compensated to build what it is made of where it stays.
struct BuildInPlace
{};

template <class LobeType, class GainType>
class Compensated : public Shorthands<Compensated<LobeType, GainType>, typename LobeType::Real>
{
public:
    using Lobe = LobeType;
    using Gain = GainType;
    using Real = typename Lobe::Real;
    using Color = Color3<Real>;
    static constexpr bool depends_on_wi = detail::GainDependsOnWi<Gain>::value;
    static constexpr int random_numbers = Lobe::random_numbers;

    REGAIN_INLINE Compensated(const Lobe& lobe, const Gain& gain) : _lobe(lobe), _gain(gain) {}

    /// The lobe make(), with Gain(lobe, arguments...).
    template <class MakeLobe, class... Arguments>
    REGAIN_INLINE Compensated(BuildInPlace, const MakeLobe& make, const Arguments&... arguments)
        : _lobe(make()), _gain(_lobe, arguments...)
    {}

    REGAIN_HOST_DEVICE const Lobe& lobe() const { return _lobe; }
    REGAIN_HOST_DEVICE const Gain& gain() const { return _gain; }

    REGAIN_HOST_DEVICE Traits traits() const
    {
        Traits t = _lobe.traits();
        t.reciprocal = t.reciprocal && detail::GainIsReciprocal<Gain>::value;
        t.energy_preserving = t.energy_preserving || detail::GainPreservesEnergy<Gain>::of(_gain);
        return t;
    }

    class Prepared
    {
    public:
        REGAIN_INLINE Prepared(const Compensated& closure, const Vec3<Real>& wo)
            : _lobe(closure._lobe.prepare(wo)), _gain(closure._gain, _lobe.wo())
        {
            _lobe.scale_by(closure._gain.at(_lobe.wo()));
        }

        REGAIN_HOST_DEVICE decltype(auto) wo() const { return _lobe.wo(); }
        REGAIN_HOST_DEVICE void scale_by(const Color& weight) { _lobe.scale_by(weight); }

        REGAIN_INLINE Color eval(const Vec3<Real>& wi) const
        {
            if constexpr (depends_on_wi)
            {
                const Vec3<Real> safe = detail::select(detail::is_direction(wi), wi, wo());
                return _lobe.eval(wi) * _gain.pair(safe);
            }
            else
                return _lobe.eval(wi);
        }

        REGAIN_HOST_DEVICE Sample<Real> sample(const Vec2<Real>& u) const
        {
            return sample(detail::two_numbers<Compensated>(u));
        }
        REGAIN_INLINE Sample<Real> sample(const Vec3<Real>& u) const
        {
            Sample<Real> s = _lobe.sample(u);
            if constexpr (depends_on_wi) s.weight *= _gain.pair(s.wi);
            return s;
        }

        REGAIN_INLINE Real pdf(const Vec3<Real>& wi) const { return _lobe.pdf(wi); }

        REGAIN_HOST_DEVICE Albedo<Real> albedo() const
        {
            if constexpr (!depends_on_wi)
                return _lobe.albedo();
            else  // no table knows a gain that depends on wi
                return mean_gain();
        }

        /// Without the gain of the pair.
        REGAIN_HOST_DEVICE Albedo<Real> expected_albedo() const
        {
            return regain::expected_albedo(_lobe);
        }

    private:
        // The lobe's albedo times the mean gain over its samples, each by its weight: of what the
        // samples know of the lobe itself nothing is left in the ratio.
        REGAIN_HOST_DEVICE Albedo<Real> mean_gain() const
        {
            const Color none(Real(0));
            Albedo<Real> with{none, none}, without{none, none};
            constexpr int n = 32;
            for (int j = 0; j < n; ++j)
                for (int i = 0; i < n; ++i)
                {
                    const Sample<Real> s = _lobe.sample(detail::grid_numbers<Real>(i, j, n));
                    const Color w = s.weight, scaled = w * _gain.pair(s.wi);
                    without.reflect += detail::select(s.transmitted, none, w);
                    without.transmit += detail::select(s.transmitted, w, none);
                    with.reflect += detail::select(s.transmitted, none, scaled);
                    with.transmit += detail::select(s.transmitted, scaled, none);
                }
            const Albedo<Real> bare = _lobe.albedo();
            return {bare.reflect * ratio(with.reflect, without.reflect),
                    bare.transmit * ratio(with.transmit, without.transmit)};
        }
        REGAIN_HOST_DEVICE static Color ratio(const Color& a, const Color& b)
        {
            const Real tiny = detail::constant<Real>(1e-30);
            return {a.x / detail::max(b.x, tiny), a.y / detail::max(b.y, tiny),
                    a.z / detail::max(b.z, tiny)};
        }

        typename Lobe::Prepared _lobe;
        std::conditional_t<depends_on_wi, detail::PairGain<Gain, Real>, detail::NoPairGain> _gain;
    };

    REGAIN_INLINE Prepared prepare(const Vec3<Real>& wo) const { return Prepared(*this, wo); }

    // No gain enters a pdf, so none is looked up for it.
    REGAIN_HOST_DEVICE Real pdf(const Vec3<Real>& wo, const Vec3<Real>& wi) const
    {
        return _lobe.pdf(wo, wi);
    }

private:
    Lobe _lobe;
    Gain _gain;
};

/// The lobe compensated by a method of method_gain.h at strength s in [0, 1]. The tables serve its
/// gain and, unless the lobe has its own, its albedo.
template <class Lobe>
REGAIN_INLINE Compensated<Lobe, MethodGain<typename Lobe::Real>> compensated(
    Lobe lobe, Method method, const MicrofacetTables& tables,
    typename Lobe::Real strength = typename Lobe::Real(1))
{
    if (!lobe.tables().has_albedo()) lobe.set_tables(tables);
    return {BuildInPlace(), [&]() -> const Lobe& { return lobe; }, method, tables, strength};
}

/// compensated(make(), method, tables, strength), for closures that are built at every shading
/// point: the lobe is made where it stays, with the tables that make() gives it. A copy costs more
/// than the rest, since a processor waits where it reads back at once what was written in pieces.
template <class MakeLobe, class Lobe = std::decay_t<decltype(std::declval<const MakeLobe&>()())>>
REGAIN_INLINE Compensated<Lobe, MethodGain<typename Lobe::Real>> build_compensated(
    const MakeLobe& make, Method method, const MicrofacetTables& tables,
    typename Lobe::Real strength = typename Lobe::Real(1))
{
    return {BuildInPlace(), make, method, tables, strength};
}

/// The lobe with a gain hook of the caller's.
template <class Lobe, class Gain>
REGAIN_HOST_DEVICE Compensated<Lobe, Gain> compensated(const Lobe& lobe, const Gain& gain)
{
    return {lobe, gain};
}

/// A gain taken at the other end. On a path that carries importance the eye is on the side of wi,
/// and f(wo, wi) of a gain that is not reciprocal has to be what the eye's path would see: f(wi,
/// wo).
template <class Gain, class Real>
class ReversedGain
{
public:
    static constexpr bool depends_on_wi = true;

    REGAIN_HOST_DEVICE explicit ReversedGain(const Gain& gain) : _gain(gain) {}

    REGAIN_HOST_DEVICE Color3<Real> at(const Vec3<Real>&) const { return Color3<Real>(Real(1)); }
    REGAIN_HOST_DEVICE Color3<Real> pair([[maybe_unused]] const Vec3<Real>& wo,
                                         const Vec3<Real>& wi) const
    {
        if constexpr (detail::GainDependsOnWi<Gain>::value)
            return _gain.at(wi) * _gain.pair(wi, wo);
        else
            return _gain.at(wi);
    }

private:
    Gain _gain;
};

/// f*(wo, wi) = f(wi, wo) of a compensated reciprocal lobe, with directions and pdfs still its own.
template <class Lobe, class Gain>
REGAIN_HOST_DEVICE Compensated<Lobe, ReversedGain<Gain, typename Lobe::Real>> reversed(
    const Compensated<Lobe, Gain>& closure)
{
    return {closure.lobe(), ReversedGain<Gain, typename Lobe::Real>(closure.gain())};
}

REGAIN_NAMESPACE_END
