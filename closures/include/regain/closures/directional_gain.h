// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// `directional`: a gain on the closure weight, as those of method_gain.h, whose colour depends on
/// wo:
///
///   gain(wo) = 1 + s F_ms(wo) (1 - E_ss(wo)) / E_ss(wo)         Turquin 2019, Eqs. 8 and 10
///   F_ms(wo) = x (1 - q) / (1 - q x),    x = F(mu_ms)
///
/// with the strength s in [0, 1] and two numbers that a table has of every wo, taken from random
/// walks on the surface (docs/methods.md):
///
///   q        of light that has met two facets, and of what then remains, the share that goes on to
///            another at each
///   mu_ms    the cosine at which the closure's own Fresnel term is what those facets reflect
///
/// Light that leaves after k facets carries k factors of F. The lobe has the first; the others make
/// the series
///   (1 - q) (x + q x^2 + q^2 x^3 + ...)
/// whose sum is F_ms. The methods of method_gain.h separate colour from direction: F_ms is one
/// colour for all wo. But light from a grazing direction meets later facets at other angles, and
/// fewer of them, than light along the normal.
///
/// Where F = 1 it is 1, so nothing is lost; where F = 0 it is 0. Against the walk, over alpha from
/// 0.1 and mu from 0.05, its albedo is within 5e-3 for Schlick's term, 1.2e-2 for metals by n and
/// k, where `turquin` is within 0.06 and 0.09.

#pragma once

#include <regain/closures/compensated.h>

REGAIN_NAMESPACE_BEGIN

/// The sum above, per channel, for x in [0, 1] and q in [0, 1).
template <class Real>
REGAIN_HOST_DEVICE Color3<Real> later_bounces_tint(const Color3<Real>& x, Real q)
{
    return detail::per_channel(x, [&](Real F) { return F * (Real(1) - q) / (Real(1) - q * F); });
}

/// The gain of a lobe of one alpha. With E_ss, q_ms or mu_ms missing among the tables it is 1.
template <class FresnelType>
class DirectionalGain
{
public:
    using Fresnel = FresnelType;
    using Real = typename Fresnel::Real;
    using Color = Color3<Real>;

    /// `fresnel` is a Fresnel term as in constant_fresnel.h, of which only at() is asked. A term
    /// that nobody knows as a curve is taken for its average: ConstantFresnel(F_ss). strength is
    /// clamped to [0, 1], NaN becomes 0.
    template <class Distribution>
    REGAIN_HOST_DEVICE DirectionalGain(const Distribution& distribution, const Fresnel& fresnel,
                                       const MicrofacetTables& tables, Real strength)
        : _tables(tables),
          _q_ms(tables.q_ms),
          _mu_ms(tables.mu_ms),
          _axes(distribution),
          _fresnel(fresnel),
          _strength(Real(0))
    {
        _bound = tables.has_albedo() && tables.has_later_bounces();
        if (!_bound) return;
        const Real s = detail::saturate(strength);
        // A mirror loses nothing to later bounces.
        _strength = detail::select(distribution.is_delta(), Real(0), s);
        // Of two widths the tables know to one per cent, which is no promise.
        _preserves = detail::all<Real>(s == Real(1)) &&
                     detail::all<Real>(distribution.alpha_x() == distribution.alpha_y());
    }

    /// Of a lobe's distribution and Fresnel term.
    template <class Lobe>
    REGAIN_INLINE DirectionalGain(const Lobe& lobe, const MicrofacetTables& tables, Real strength)
        : DirectionalGain(lobe.distribution(), lobe.fresnel(), tables, strength)
    {}

    REGAIN_HOST_DEVICE Color at(const Vec3<Real>& wo) const
    {
        if (!_bound) return Color(Real(1));
        REGAIN_COUNTED(gains);
        const Real mu = detail::saturate(wo.z);
        const Real E = _axes.albedo(_tables, {wo.x, wo.y, mu});
        const Real lost = (Real(1) - E) / detail::max(E, detail::constant<Real>(1e-12));
        return Color(Real(1)) + F_ms(mu) * (_strength * lost);
    }

    /// The colour of all bounces after the first, in [0, 1]; mu = cos theta_o in [0, 1]. Asked only
    /// where the tables are there.
    REGAIN_HOST_DEVICE Color F_ms(Real mu) const
    {
        // Short of 1, where a perfect mirror's series has no sum.
        const Real q =
            detail::min(_tables.later_share(_q_ms, _axes, mu), detail::constant<Real>(0.999));
        return later_bounces_tint(
            _fresnel.at(detail::saturate(_tables.later_cosine(_mu_ms, _axes, mu))), q);
    }

    /// At full strength; of an anisotropic lobe it is not promised.
    REGAIN_HOST_DEVICE bool energy_preserving() const { return _bound && _preserves; }

private:
    LossTables _tables;
    TableView _q_ms, _mu_ms;
    DirectionAxes<Real> _axes;
    Fresnel _fresnel;
    Real _strength;
    bool _bound = false, _preserves = false;
};

/// The lobe compensated by its directional gain at strength s in [0, 1]. The tables serve the gain
/// and, unless the lobe has its own, its albedo.
template <class Lobe>
REGAIN_HOST_DEVICE Compensated<Lobe, DirectionalGain<typename Lobe::Fresnel>> directional(
    Lobe lobe, const MicrofacetTables& tables,
    typename Lobe::Real strength = typename Lobe::Real(1))
{
    if (!lobe.tables().has_albedo()) lobe.set_tables(tables);
    return {BuildInPlace(), [&]() -> const Lobe& { return lobe; }, tables, strength};
}

/// The same of the lobe make(): see build_compensated.
template <class MakeLobe, class Lobe = std::decay_t<decltype(std::declval<const MakeLobe&>()())>>
REGAIN_INLINE Compensated<Lobe, DirectionalGain<typename Lobe::Fresnel>> build_directional(
    const MakeLobe& make, const MicrofacetTables& tables,
    typename Lobe::Real strength = typename Lobe::Real(1))
{
    return {BuildInPlace(), make, tables, strength};
}

REGAIN_NAMESPACE_END
