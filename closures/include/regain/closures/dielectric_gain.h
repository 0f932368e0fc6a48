// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What a rough dielectric loses to later bounces, given back by a gain on its weight:
///
///   modes RT, T   1 + s (1 - E^S(wo)) / E^S(wo)                   Turquin 2019, Eq. 18
///   mode R        1 + s F_ss (1 - E_ss(wo)) / E_ss(wo)            Eqs. 10 and 14
///
/// with the strength s in [0, 1], E^S = E^R + E^T the albedo of both lobes on the side of wo, and
/// E_ss that of the distribution with F = 1. Later bounces are taken to divide into reflected and
/// transmitted light as the first does, so a lobe of mode T has the gain of the pair.
///
/// A dielectric absorbs nothing, so where all its light is accounted for there is no F_ms to
/// choose: `normalise` and `turquin` are one formula. The other methods are formulas for metals.

#pragma once

#include <regain/closures/compensated.h>
#include <regain/closures/dielectric.h>

REGAIN_NAMESPACE_BEGIN

template <class RealType>
class DielectricGain
{
public:
    using Real = RealType;
    using Color = Color3<Real>;

    /// Methods that mean something for a dielectric; with another the gain is 1.
    REGAIN_HOST_DEVICE static constexpr bool supports(Method method)
    {
        return method == Method::none || method == Method::normalise || method == Method::turquin;
    }

    /// `tables` are of the lobe's distribution and form of transmission shadowing; mode R takes its
    /// E_ss from `mirror`. Without the table that the mode needs the gain is 1. strength is clamped
    /// to [0, 1], NaN becomes 0.
    template <class Distribution>
    REGAIN_HOST_DEVICE DielectricGain(const Dielectric<Distribution>& lobe, Method method,
                                      const DielectricTables& tables, const LossTables& mirror,
                                      Real strength)
        : _tables(tables), _mirror(mirror), _axes(lobe.distribution())
    {
        const Vec3<Real> up(Real(0), Real(0), Real(1));
        _index[0] = lobe.relative_index(up);
        _index[1] = lobe.relative_index(-up);
        _reflects_only = lobe.scatter_mode() == ScatterMode::R;
        _bound = supports(method) && method != Method::none &&
                 (_reflects_only ? mirror.has_albedo() : bool(tables));
        if (!_bound) return;

        const auto& distribution = lobe.distribution();
        const Real s = detail::saturate(strength);
        for (int side = 0; side < 2; ++side)
        {
            const Real colour = _reflects_only
                                    ? DielectricFresnel<Real>(_index[side]).average_reflectance()
                                    : Real(1);
            // A flat surface loses nothing to later bounces.
            _strength[side] = colour * detail::select(distribution.is_delta(), Real(0), s);
        }
        _preserves = lobe.scatter_mode() == ScatterMode::RT && detail::all<Real>(s == Real(1)) &&
                     detail::all<Real>(distribution.alpha_x() == distribution.alpha_y());
    }

    REGAIN_HOST_DEVICE Color at(const Vec3<Real>& wo) const
    {
        if (!_bound) return Color(Real(1));
        REGAIN_COUNTED(gains);
        const MaskOf<Real> below = wo.z < Real(0);
        const Real mu = detail::saturate(detail::abs(wo.z));
        const Real eta = detail::select(below, _index[1].eta, _index[0].eta);
        const Real E = _reflects_only ? _axes.albedo(_mirror, {wo.x, wo.y, mu})
                                      : _tables.albedo(_axes, eta, wo);
        const Real s = detail::select(below, _strength[1], _strength[0]);
        // At grazing angles the beta form of shadowing lets next to nothing pass the first time.
        const Real some = detail::max(E, detail::constant<Real>(1e-12));
        return Color(Real(1) + s * ((Real(1) - E) / some));
    }

    /// At full strength all light of an isotropic interface that is not tinted leaves it.
    REGAIN_HOST_DEVICE bool energy_preserving() const { return _bound && _preserves; }

private:
    DielectricLossTables _tables;
    LossTables _mirror;
    DirectionAxes<Real> _axes;
    RelativeIndex<Real> _index[2];  // from above, from below
    Real _strength[2] = {Real(0), Real(0)};
    bool _reflects_only = false, _bound = false, _preserves = false;
};

/// The dielectric compensated at strength s in [0, 1]. `tables` serve its gain and, unless the lobe
/// has its own, its albedo; mode R takes its gain from `mirror`.
template <class Distribution>
REGAIN_HOST_DEVICE
    Compensated<Dielectric<Distribution>, DielectricGain<typename Distribution::Real>>
    compensated(Dielectric<Distribution> lobe, Method method, const DielectricTables& tables,
                const LossTables& mirror,
                typename Distribution::Real strength = typename Distribution::Real(1))
{
    if (!lobe.tables()) lobe.set_tables(tables);
    return {BuildInPlace(), [&]() -> const Dielectric<Distribution>& { return lobe; },
            method,         tables,
            mirror,         strength};
}
/// The same for modes RT and T.
template <class Distribution>
REGAIN_HOST_DEVICE
    Compensated<Dielectric<Distribution>, DielectricGain<typename Distribution::Real>>
    compensated(const Dielectric<Distribution>& lobe, Method method, const DielectricTables& tables,
                typename Distribution::Real strength = typename Distribution::Real(1))
{
    return compensated(lobe, method, tables, LossTables{}, strength);
}

/// The same of the dielectric make(), with the tables that it has: see compensated.h.
template <class MakeLobe, class Lobe = std::decay_t<decltype(std::declval<const MakeLobe&>()())>>
REGAIN_INLINE Compensated<Lobe, DielectricGain<typename Lobe::Real>> build_compensated(
    const MakeLobe& make, Method method, const DielectricTables& tables, const LossTables& mirror,
    typename Lobe::Real strength = typename Lobe::Real(1))
{
    return {BuildInPlace(), make, method, tables, mirror, strength};
}

REGAIN_NAMESPACE_END
