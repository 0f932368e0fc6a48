// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// `balanced`: a gain of both directions that leaves the lobe reciprocal and loses nothing:
///
///   gain(wo, wi) = 1 + s (g(wo) g(wi) - 1) (t(mu_o) + t(mu_i)) / 2
///
/// with the strength s in [0, 1]. g is the one function of a direction for which
///
///   g(wo) int rho_ss(wo, wi) g(wi) cos theta_i dwi = 1     for every wo
///
/// where rho_ss is the lobe with F = 1 (regain/luts/balance.h finds it; the scaling of a symmetric
/// kernel to rows that sum to 1, Sinkhorn and Knopp 1967). Of an isotropic lobe it depends on the
/// cosine alone, of others see anisotropic_balance.h. So the albedo is 1 where F = 1. Turquin
/// 2019, Eq. 10, has the whole gain at wo: its lobe preserves energy and is not reciprocal, or is
/// reciprocal and does not; two factors, one for each end, do both.
///
/// g is tabulated. It runs from below 1 at grazing angles, where single scattering sends more light
/// than all bounces do together, to its largest along the normal.
///
/// t is the colour of the later bounces, F_ms of directional_gain.h, 1 where F = 1. Of each
/// direction of a pair it says something else; their mean is symmetric, too. It is taken at two
/// cosines when the gain is built, with a straight line between them and on to both ends: F_ms
/// itself is no closer to the walk, from which the albedo is within 1.5e-2 for GGX and Beckmann
/// (docs/methods.md).
///
/// Directions and pdfs are the lobe's. A sample's weight is that of the lobe times the gain, whose
/// factor of wi evens out the masking on the way out: with F = 1 and alpha 1 the weight's variance
/// is 0.37 along the normal, of the lobe scaled to the same albedo 1.9. At grazing angles, where
/// either is small, it is larger: 0.14 and 0.05 at mu 0.05. No weight is above 2.2.
///
/// The albedo is no look-up: it is the lobe's times the mean gain over a grid of 1024 samples,
/// right within 1e-3 of what the lobe's tables are right to, of STD 1.5e-2.

#pragma once

#include <regain/closures/anisotropic_balance.h>
#include <regain/closures/directional_gain.h>

REGAIN_NAMESPACE_BEGIN

/// The gain of a lobe of one alpha. With a table missing that it needs, E_ss, q_ms, mu_ms or
/// balance, it is 1.
template <class FresnelType>
class BalancedGain
{
    using Channels = detail::ChannelsOf<typename FresnelType::Real>;

public:
    using Fresnel = FresnelType;
    using Real = typename Fresnel::Real;
    using Color = Color3<Real>;
    static constexpr bool depends_on_wi = true;
    static constexpr bool reciprocal = true;

    /// `fresnel` and strength as those of DirectionalGain.
    template <class Distribution>
    REGAIN_HOST_DEVICE BalancedGain(const Distribution& distribution, const Fresnel& fresnel,
                                    const MicrofacetTables& tables, Real strength)
        : _balance(distribution, tables)
    {
        _bound = _balance && tables.has_albedo() && tables.has_later_bounces();
        if (!_bound) return;
        const DirectionalGain<Fresnel> later(distribution, fresnel, tables, strength);
        _preserves = later.energy_preserving();
        const Real half = detail::select(distribution.is_delta(), Real(0),
                                         Real(0.5f) * detail::saturate(strength));
        const Color low = later.F_ms(Real(0.25f)), high = later.F_ms(Real(0.75f));
        const auto end = [&](Real x) {
            return detail::saturated_channels(low + (high - low) * x) * half;
        };
        _grazing = end(Real(-0.5f));
        _rise = end(Real(1.5f)) - _grazing;
    }

    /// Of a lobe's distribution and Fresnel term.
    template <class Lobe>
    REGAIN_INLINE BalancedGain(const Lobe& lobe, const MicrofacetTables& tables, Real strength)
        : BalancedGain(lobe.distribution(), lobe.fresnel(), tables, strength)
    {}

    REGAIN_HOST_DEVICE Color at(const Vec3<Real>&) const { return Color(Real(1)); }

    REGAIN_HOST_DEVICE Color pair(const Vec3<Real>& wo, const Vec3<Real>& wi) const
    {
        return Prepared(*this, wo).pair(wi);
    }

    /// What depends on wo alone.
    class Prepared
    {
    public:
        REGAIN_INLINE Prepared(const BalancedGain& gain, const Vec3<Real>& wo) : _gain(gain)
        {
            if (!gain._bound) return;
            const Vec3<Real> w = above(wo);
            _g = gain._balance.at(w);
            // That of wi begins where it grazes, too.
            _tint = gain._grazing + gain._grazing + gain._rise * w.z;
        }
        REGAIN_INLINE Color pair(const Vec3<Real>& wi) const
        {
            if (!_gain._bound) return Color(Real(1));
            REGAIN_COUNTED(gains);
            const Vec3<Real> w = above(wi);
            const Channels tint = _tint + _gain._rise * w.z;
            return detail::color(Channels(Real(1)) + tint * (_g * _gain._balance.at(w) - Real(1)));
        }

    private:
        REGAIN_INLINE static Vec3<Real> above(const Vec3<Real>& w)
        {
            return {w.x, w.y, detail::saturate(w.z)};
        }

        BalancedGain _gain;
        Real _g = Real(1);
        Channels _tint = Channels(Real(0));  // s (t(mu_o) + t(0)) / 2
    };

    /// At full strength; of an anisotropic lobe, which does so to a few thousandths with a table
    /// for it, it is not promised.
    REGAIN_HOST_DEVICE bool energy_preserving() const { return _bound && _preserves; }

private:
    DirectionalBalance<Real> _balance;
    // s t / 2 at mu = 0, and how much more it is at mu = 1.
    Channels _grazing = Channels(Real(0)), _rise = Channels(Real(0));
    bool _bound = false, _preserves = false;
};

/// The lobe compensated by its balanced gain at strength s in [0, 1]. The tables serve the gain
/// and, unless the lobe has its own, its albedo.
template <class Lobe>
REGAIN_HOST_DEVICE Compensated<Lobe, BalancedGain<typename Lobe::Fresnel>> balanced(
    Lobe lobe, const MicrofacetTables& tables,
    typename Lobe::Real strength = typename Lobe::Real(1))
{
    if (!lobe.tables().has_albedo()) lobe.set_tables(tables);
    return {BuildInPlace(), [&]() -> const Lobe& { return lobe; }, tables, strength};
}

/// The same of the lobe make(): see build_compensated.
template <class MakeLobe, class Lobe = std::decay_t<decltype(std::declval<const MakeLobe&>()())>>
REGAIN_INLINE Compensated<Lobe, BalancedGain<typename Lobe::Fresnel>> build_balanced(
    const MakeLobe& make, const MicrofacetTables& tables,
    typename Lobe::Real strength = typename Lobe::Real(1))
{
    return {BuildInPlace(), make, tables, strength};
}

REGAIN_NAMESPACE_END
