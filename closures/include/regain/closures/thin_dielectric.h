// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A thin-walled dielectric: a sheet with two parallel rough interfaces, too thin to shift or bend
/// what passes. MaterialX's and OSL's thin-walled dielectric. Light goes back and forth between the
/// interfaces, so that of a facet with Fresnel reflectance F in all
///
///   R' = F + (1 - F)^2 F / (1 - F^2) = 2 F / (1 + F)
///   T' = (1 - F)^2 / (1 - F^2)       = (1 - F) / (1 + F)
///
/// is reflected and transmitted, R' + T' = 1. The reflected lobe is a rough mirror's
/// (microfacet_reflection.h), and the transmitted one is the same lobe mirrored to the other side:
///
///   f = R' D G2 / (4 cos_o cos_i)   and   f = T' D G2 / (4 cos_o cos_i)   of wi mirrored
///
/// The transmitted lobe has the width of the reflected one. Of a real sheet it differs: Kulla and
/// Conty 2017 fit alpha_T = alpha sqrt(3.4 (eta - 1) (eta - 1/2)^2 / eta^3), 0.71 alpha for eta
/// 1.5. With one width both lobes share each facet, which no other gives at once: E^R + E^T is E_ss
/// exactly, so the tables of a mirror serve, and f(wo, wi) = f(wi, wo). No eta squared enters, for
/// both sides have one index.
///
/// At the distribution's delta limit both lobes pass light in one direction. Where |eta - 1| alpha
/// is within dielectric.h's delta_width there is no sheet to speak of and light goes straight on.

#pragma once

#include <regain/closures/compensated.h>
#include <regain/closures/constant_fresnel.h>
#include <regain/closures/dielectric.h>
#include <regain/closures/dielectric_gain.h>
#include <regain/closures/microfacet_reflection.h>

REGAIN_NAMESPACE_BEGIN

template <class DistributionType>
class ThinDielectric
    : public Shorthands<ThinDielectric<DistributionType>, typename DistributionType::Real>
{
public:
    using Distribution = DistributionType;
    using Real = typename Distribution::Real;
    using Mask = MaskOf<Real>;
    using Color = Color3<Real>;
    using Mirror = MicrofacetReflection<Distribution, ConstantFresnel<Real>>;
    static constexpr int random_numbers = 3;
    static constexpr bool thin_walled = true;  ///< one medium is on both sides

    /// eta: index of the sheet over the index around it, in [1e-2, 1e2], clamped, NaN becomes 1.5.
    /// Tints in [0, 1] per channel, clamped, NaN becomes 0. `tables`, of this distribution, make
    /// albedo() faster.
    REGAIN_HOST_DEVICE ThinDielectric(const Distribution& distribution, Real eta,
                                      ScatterMode mode = ScatterMode::RT,
                                      const Color& reflection_tint = Color(Real(1)),
                                      const Color& transmission_tint = Color(Real(1)),
                                      const AlbedoTables& tables = {})
        : _interface(distribution, eta, mode, reflection_tint, transmission_tint),
          _mirror(distribution, ConstantFresnel<Real>(), tables)
    {}

    REGAIN_HOST_DEVICE const Distribution& distribution() const { return _mirror.distribution(); }
    /// The sheet as if both lobes were one: a rough mirror with F = 1.
    REGAIN_HOST_DEVICE const Mirror& mirror() const { return _mirror; }
    REGAIN_HOST_DEVICE Real eta() const { return _interface.eta(); }
    REGAIN_HOST_DEVICE ScatterMode scatter_mode() const { return _interface.scatter_mode(); }
    REGAIN_HOST_DEVICE Color reflection_tint() const { return _interface.reflection_tint(); }
    REGAIN_HOST_DEVICE Color transmission_tint() const { return _interface.transmission_tint(); }

    REGAIN_HOST_DEVICE const AlbedoTables& tables() const { return _mirror.tables(); }
    REGAIN_HOST_DEVICE void set_tables(const AlbedoTables& tables) { _mirror.set_tables(tables); }

    REGAIN_HOST_DEVICE Traits traits() const
    {
        Traits t = _interface.traits();
        t.random_numbers = random_numbers;
        return t;
    }

    /// Works on the side of wo: what is seen from below is mirrored to above.
    class Prepared
    {
    public:
        REGAIN_HOST_DEVICE Prepared(const ThinDielectric& sheet, const Vec3<Real>& wo)
            : _mode(sheet.scatter_mode()),
              _fresnel(sheet.eta()),
              _clear(sheet._interface.transmits_delta()),
              _side(detail::select(detail::quiet_less(wo.z, Real(0)), Real(-1), Real(1))),
              _mirror(sheet._mirror.prepare(turned(wo))),
              _tables(sheet.tables()),
              _reflection(sheet.reflection_tint()),
              _transmission(sheet.transmission_tint())
        {}

        REGAIN_HOST_DEVICE Vec3<Real> wo() const { return turned(_mirror.wo()); }

        REGAIN_HOST_DEVICE void scale_by(const Color& weight)
        {
            _reflection *= weight;
            _transmission *= weight;
        }

        REGAIN_HOST_DEVICE Color eval(const Vec3<Real>& wi) const
        {
            const Terms t = terms(wi);
            return t.tint * (_mirror.eval(t.wi).x * t.choice * t.passed);
        }

        /// u.x, u.y: the normal; u.z: reflection where it is below the facet's R'.
        REGAIN_HOST_DEVICE Sample<Real> sample(const Vec3<Real>& u) const
        {
            const Sample<Real> m = _mirror.sample(normal_numbers(u));
            const Real R = reflectance(m.wi);
            Mask reflect(_mode == ScatterMode::R);
            if (_mode == ScatterMode::RT) reflect = (detail::saturate(u.z) < R) | (R >= Real(1));

            const Vec3<Real> through =
                detail::select(_clear, -_mirror.wo(), Vec3<Real>(m.wi.x, m.wi.y, -m.wi.z));
            const Real share = detail::select(reflect, R, Real(1) - R);
            const bool both = _mode == ScatterMode::RT;

            Sample<Real> s;
            // Of light that passes straight on, all that is known of its probability is this
            // facet's.
            const Mask straight = detail::both<Real>(_clear, !reflect);
            const Real choice = both ? share : Real(1);
            s.pdf = choice * detail::select(straight, Real(1), m.pdf);
            s.valid = detail::both<Real>(m.valid, s.pdf > Real(0));
            s.delta = detail::both<Real>(s.valid, m.delta | straight);
            s.transmitted = detail::both<Real>(s.valid, !reflect);
            s.pdf = detail::select(s.valid, s.pdf, Real(0));
            s.wi = detail::select(s.valid, turned(detail::select(reflect, m.wi, through)),
                                  Vec3<Real>(Real(0), Real(0), Real(1)));
            s.weight = detail::select(s.valid,
                                      detail::select(reflect, _reflection, _transmission) *
                                          (both ? m.weight.x : m.weight.x * share),
                                      Color(Real(0)));
            return s;
        }

        REGAIN_HOST_DEVICE Real pdf(const Vec3<Real>& wi) const
        {
            const Terms t = terms(wi);
            return _mirror.pdf(t.wi) * t.choice;
        }

        REGAIN_HOST_DEVICE Albedo<Real> albedo() const
        {
            // The share that is reflected by the mirror's own facets, and all of it by its table.
            const bool tabulated = _tables.has_albedo();
            constexpr int rows = detail::grid_rows<Distribution>;
            const int n = tabulated ? rows / 2 : rows;
            Real all(0), reflected(0);
            for (int j = 0; j < n; ++j)
                for (int i = 0; i < n; ++i)
                {
                    const Sample<Real> m = _mirror.sample(detail::grid_numbers<Real>(i, j, n));
                    all += m.weight.x;
                    reflected += m.weight.x * reflectance(m.wi);
                }
            const Real scale = tabulated ? _mirror.albedo().reflect.x / detail::max(all, Real(1))
                                         : detail::constant<Real>(1.0 / (n * n));
            const Color none(Real(0));
            return {_mode != ScatterMode::T ? _reflection * (reflected * scale) : none,
                    _mode != ScatterMode::R ? _transmission * ((all - reflected) * scale) : none};
        }

    private:
        // What eval and pdf have in common. sample takes the facet's R' the same way.
        struct Terms
        {
            Vec3<Real> wi;        // of the mirror; no direction where there is no lobe
            Real choice, passed;  // of the facet: probability of the lobe, share of a lobe alone
            Color tint;
        };

        REGAIN_HOST_DEVICE Terms terms(const Vec3<Real>& direction) const
        {
            const Vec3<Real> w = turned(direction);
            const Mask known = detail::is_off_horizon(w);
            const Mask reflected = detail::quiet_less(Real(0), w.z);
            const Mask possible =
                (reflected & Mask(_mode != ScatterMode::T)) |
                detail::both<Real>(!reflected, Mask(_mode != ScatterMode::R) & !_clear);

            Terms t;
            t.wi = detail::select(detail::both<Real>(known, possible),
                                  Vec3<Real>(w.x, w.y, detail::abs(w.z)), Vec3<Real>(Real(0)));
            const Real R = reflectance(detail::select(known, t.wi, Vec3<Real>(Real(0))));
            const Real share = detail::select(reflected, R, Real(1) - R);
            t.choice = _mode == ScatterMode::RT ? share : Real(1);
            t.passed = _mode == ScatterMode::RT ? Real(1) : share;
            t.tint = detail::select(reflected, _reflection, _transmission);
            return t;
        }

        REGAIN_HOST_DEVICE static Real sheet_reflectance(
            const typename DielectricFresnel<Real>::Split& F)
        {
            return Real(2) * F.reflectance / (Real(1) + F.reflectance);
        }
        // R' of the facet that reflects wo into wi.
        REGAIN_HOST_DEVICE Real reflectance(const Vec3<Real>& wi) const
        {
            const Vec3<Real> h = detail::half_vector(_mirror.wo(), wi);
            return sheet_reflectance(
                _fresnel.split(detail::min(Real(0.5f) * detail::sqrt(detail::dot(h, h)), Real(1))));
        }

        REGAIN_HOST_DEVICE Vec3<Real> turned(const Vec3<Real>& w) const
        {
            return {w.x, w.y, w.z * _side};
        }

        // The third number of the normal has to be independent of the choice of the lobe.
        REGAIN_HOST_DEVICE Vec3<Real> normal_numbers(const Vec3<Real>& u) const
        {
            if constexpr (Distribution::random_numbers > 2)
                if (_mode == ScatterMode::RT) return {u.x, u.y, RandomStream<Real>(u).next()};
            return u;
        }

        ScatterMode _mode;
        DielectricFresnel<Real> _fresnel;
        Mask _clear;
        Real _side;  // 1 above, -1 below
        typename Mirror::Prepared _mirror;
        AlbedoTables _tables;
        Color _reflection, _transmission;  // what multiplies the lobes
    };

    REGAIN_HOST_DEVICE Prepared prepare(const Vec3<Real>& wo) const { return Prepared(*this, wo); }

private:
    Dielectric<Distribution> _interface;
    Mirror _mirror;
};

/// What a rough sheet loses to later bounces, given back by the gain of a rough mirror with F = 1,
/// 1 + s (1 - E_ss) / E_ss: Turquin 2019, Eq. 18, for E^R + E^T = E_ss. The methods are those that
/// DielectricGain supports; with another the gain is 1.
template <class RealType>
class ThinDielectricGain
{
public:
    using Real = RealType;

    REGAIN_HOST_DEVICE static constexpr bool supports(Method method)
    {
        return DielectricGain<Real>::supports(method);
    }

    template <class Distribution>
    REGAIN_HOST_DEVICE ThinDielectricGain(const ThinDielectric<Distribution>& sheet, Method method,
                                          const MicrofacetTables& tables, Real strength)
        : _gain(sheet.mirror(),
                supports(method) && method != Method::none ? Method::normalise : Method::none,
                tables, strength),
          _whole(sheet.scatter_mode() == ScatterMode::RT)
    {}

    REGAIN_HOST_DEVICE Color3<Real> at(const Vec3<Real>& wo) const
    {
        return _gain.at({wo.x, wo.y, detail::abs(wo.z)});
    }
    REGAIN_HOST_DEVICE bool energy_preserving() const
    {
        return _whole && _gain.energy_preserving();
    }

private:
    MethodGain<Real> _gain;
    bool _whole;
};

/// The sheet compensated at strength s in [0, 1]. The tables serve its gain and, unless the sheet
/// has its own, its albedo.
template <class Distribution>
REGAIN_HOST_DEVICE
    Compensated<ThinDielectric<Distribution>, ThinDielectricGain<typename Distribution::Real>>
    compensated(ThinDielectric<Distribution> sheet, Method method, const MicrofacetTables& tables,
                typename Distribution::Real strength = typename Distribution::Real(1))
{
    if (!sheet.tables().has_albedo()) sheet.set_tables(tables);
    return {sheet,
            ThinDielectricGain<typename Distribution::Real>(sheet, method, tables, strength)};
}

REGAIN_NAMESPACE_END
