// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Kulla and Conty's compensation of a rough dielectric, both sides (Kulla and Conty 2017; Turquin
/// 2019, Section 2). With L_o(mu) = 1 - E^S_o(mu), what single scattering reflects and transmits
/// too little on side o of the interface, l_o = 2 int L_o mu dmu, and o' the other side:
///
///   f_R(wo, wi) = a_o L_o(wo) L_o(wi) / (pi l_o)             reflected
///   f_T(wo, wi) = b_o L_o(wo) L_o'(wi) / (pi l_o')           transmitted,    a_o + b_o = 1
///
/// As energies; their albedos are a_o L_o(wo) and b_o L_o(wo), so R + T = 1. Reciprocity,
/// f_T(wo, wi) = eta_o^2 f_T(wi, wo) with eta_o the index ahead of wo over the one behind, holds if
///
///   b_o l_o = eta_o^2 b_o' l_o'
///
/// which leaves one constant free. With the averages F_o of the Fresnel reflectance, for which
/// 1 - F_o = eta_o^2 (1 - F_o') exactly, b_o = x_o (1 - F_o) fulfils it for any x_o l_o = x_o'
/// l_o': the eta^2 that implementations have looked for is in the Fresnel averages already.
///
///   kulla_conty   x_o = l_o' / (l_o + l_o')         as published, where x_o + x_o' = 1
///   greatest      x_o = min(1, l_o' / l_o)          as much as goes through; at eta = 1 all
///
/// The published split sends half of what is missing at eta = 1 back from an interface that
/// reflects nothing. Neither knows the true split of later bounces.
///
/// L_o is looked up in DielectricTables of the distribution and form of shadowing. Tints multiply
/// the lobes once. A lobe of mode R or T gets its own part of both. Building a closure asks the
/// tables 102 times; per point and direction it is one look-up, and per point of a lobe of mode R
/// its albedo.

#pragma once

#include <regain/closures/anisotropy.h>
#include <regain/closures/dielectric_with_added_lobes.h>
#include <regain/closures/missing_energy.h>

REGAIN_NAMESPACE_BEGIN

/// How what is missing is split between reflection and transmission; see above.
enum class KullaContySplit { kulla_conty, greatest };

/// The added lobes alone: black for a flat surface and without tables. Of an isotropic surface they
/// are symmetric about the normal; the averages of another are over azimuths, too.
template <class DielectricType>
class DielectricMissingEnergyLobe
    : public Shorthands<DielectricMissingEnergyLobe<DielectricType>, typename DielectricType::Real>
{
public:
    using Dielectric = DielectricType;
    using Real = typename Dielectric::Real;
    using Mask = MaskOf<Real>;
    using Color = Color3<Real>;
    static constexpr int random_numbers = 3;

    /// Of a dielectric with its tints and scatter mode. strength in [0, 1] scales the lobes;
    /// clamped, NaN becomes 0.
    REGAIN_HOST_DEVICE DielectricMissingEnergyLobe(const Dielectric& lobe,
                                                   const DielectricTables& tables, Real strength,
                                                   KullaContySplit split)
        : _tables(tables),
          _axes(lobe.distribution()),
          _black(lobe.distribution().is_delta()),
          _bound(tables)
    {
        const Vec3<Real> up(Real(0), Real(0), Real(1));
        const RelativeIndex<Real> index[] = {lobe.relative_index(up), lobe.relative_index(-up)};
        for (int o = 0; o < 2; ++o)
        {
            _eta[o] = index[o].eta;
            // sqrt(1 - eta^2), 0 where there is no total reflection.
            const Real critical = detail::sqrt(detail::max(-index[o].square_minus_one(), Real(0)));
            if (_bound)
                _missing[o] = Missing(
                    _axes.alpha(),
                    [this, o](Real mu) {
                        return _axes.azimuth_mean(
                            mu, [&](const Vec3<Real>& w) { return loss(_eta[o], w); });
                    },
                    detail::min(critical, detail::constant<Real>(0.9999)));
        }

        const Real tiny = detail::constant<Real>(1e-30);
        const Real l[] = {_missing[0].average(), _missing[1].average()};
        for (int o = 0; o < 2; ++o)
        {
            _inv_average[o] =
                detail::constant<Real>(0.318309886183790671538) / detail::max(l[o], tiny);
            const Real other = l[1 - o];
            const Real x = split == KullaContySplit::kulla_conty
                               ? other / detail::max(l[o] + other, tiny)
                               : detail::min(other / detail::max(l[o], tiny), Real(1));
            _passed[o] = x * DielectricFresnel<Real>(index[o]).average_transmittance();
        }

        const Real s = detail::saturate(strength);
        const bool reflects = lobe.scatter_mode() != ScatterMode::T,
                   transmits = lobe.scatter_mode() != ScatterMode::R;
        _reflection = reflects ? lobe.reflection_tint() * s : Color(Real(0));
        _transmission = transmits ? lobe.transmission_tint() * s : Color(Real(0));
    }

    REGAIN_HOST_DEVICE bool bound() const { return _bound; }

    /// Share b_o of what is missing that is transmitted, of a wo above (0) or below (1).
    REGAIN_HOST_DEVICE Real transmitted_share(int side) const { return _passed[side]; }
    /// l_o = 1 - E_avg of that side.
    REGAIN_HOST_DEVICE Real average_loss(int side) const { return _missing[side].average(); }

    REGAIN_HOST_DEVICE Traits traits() const
    {
        Traits t;
        t.reciprocal = true;
        t.exact_pdf = true;
        t.anisotropic = !_axes.isotropic();
        t.transmissive = detail::any<Real>(total(_transmission) > Real(0));
        t.random_numbers = random_numbers;
        return t;
    }

    class Prepared
    {
    public:
        REGAIN_HOST_DEVICE Prepared(const DielectricMissingEnergyLobe& lobe, const Vec3<Real>& wo)
            : _lobe(lobe),
              _valid(detail::is_off_horizon(wo)),
              _wo(detail::select(_valid, wo, Vec3<Real>(Real(0), Real(0), Real(1)))),
              _below(_wo.z < Real(0)),
              _loss(lobe.loss(detail::select(_below, lobe._eta[1], lobe._eta[0]), _wo))
        {
            _valid = detail::both<Real>(_valid, _loss > Real(0));
            const Real passed = detail::select(_below, lobe._passed[1], lobe._passed[0]);
            const Color none(Real(0));
            _reflection = detail::select(_valid, lobe._reflection * (Real(1) - passed), none);
            _transmission = detail::select(_valid, lobe._transmission * passed, none);
            const Real R = total(_reflection), T = total(_transmission);
            _p = R / detail::max(R + T, detail::constant<Real>(1e-30));
            _valid = detail::both<Real>(_valid, R + T > Real(0));
        }

        REGAIN_HOST_DEVICE const Vec3<Real>& wo() const { return _wo; }
        REGAIN_HOST_DEVICE void scale_by(const Color& weight)
        {
            _reflection *= weight;
            _transmission *= weight;
        }

        /// 1 - E^S(wo).
        REGAIN_HOST_DEVICE Real loss() const { return _loss; }

        REGAIN_HOST_DEVICE Color eval(const Vec3<Real>& wi) const
        {
            const Terms t = terms(wi);
            return detail::select(t.valid, value(t), Color(Real(0)));
        }

        /// u.x, u.y: the direction; u.z: reflection or transmission.
        REGAIN_HOST_DEVICE Sample<Real> sample(const Vec3<Real>& u) const
        {
            const Mask reflect = (detail::saturate(u.z) < _p) | (_p >= Real(1));
            // Above where reflection meets a wo above, or transmission one below.
            const Mask below = differ(reflect, !_below);
            const Real x = detail::saturate(u.x);
            Real mu(0);
            if (!detail::all<Real>(below)) mu = _lobe._missing[0].sample(x);
            if (detail::any<Real>(below))
                mu = detail::select(below, _lobe._missing[1].sample(x), mu);
            const Real sine = detail::sqrt((Real(1) - mu) * (Real(1) + mu));
            const Real phi = detail::constant<Real>(6.28318530717958647692) * detail::saturate(u.y);
            const Vec3<Real> wi(sine * detail::cos(phi), sine * detail::sin(phi),
                                detail::select(below, -mu, mu));

            const Terms t = terms(wi);
            const Real pdf = density(t);
            Sample<Real> s;
            s.valid = t.valid;
            s.transmitted = s.valid & !reflect;
            s.wi = detail::select(s.valid, wi, Vec3<Real>(Real(0), Real(0), Real(1)));
            s.weight = detail::select(
                s.valid, value(t) * (Real(1) / detail::max(pdf, detail::constant<Real>(1e-30))),
                Color(Real(0)));
            s.pdf = detail::select(s.valid, pdf, Real(0));
            return s;
        }

        REGAIN_HOST_DEVICE Real pdf(const Vec3<Real>& wi) const
        {
            const Terms t = terms(wi);
            return detail::select(t.valid, density(t), Real(0));
        }

        REGAIN_HOST_DEVICE Albedo<Real> albedo() const
        {
            return {_reflection * _loss, _transmission * _loss};
        }

    private:
        struct Terms
        {
            Mask valid;
            Vec3<Real> wi;
            Mask below;      // wi is
            Mask reflected;  // or else transmitted
            Real mu;         // |cos theta_i|
        };
        REGAIN_HOST_DEVICE Terms terms(const Vec3<Real>& direction) const
        {
            Terms t;
            const Mask possible = detail::both<Real>(_valid, detail::is_off_horizon(direction));
            t.wi = detail::select(possible, direction, Vec3<Real>(Real(0), Real(0), Real(1)));
            const Real z = t.wi.z;
            t.below = z < Real(0);
            t.reflected = !differ(t.below, _below);
            t.mu = detail::min(detail::abs(z), Real(1));
            const Mask reflects = _p > Real(0), transmits = _p < Real(1);
            const Mask transmitted = !t.reflected;
            const Mask seen = (t.reflected & reflects) | (transmitted & transmits);
            t.valid = detail::both<Real>(possible, seen);
            return t;
        }
        // f cos theta_i.
        REGAIN_HOST_DEVICE Color value(const Terms& t) const
        {
            const Real eta = detail::select(t.below, _lobe._eta[1], _lobe._eta[0]);
            const Real scale =
                detail::select(t.below, _lobe._inv_average[1], _lobe._inv_average[0]);
            return detail::select(t.reflected, _reflection, _transmission) *
                   (_loss * scale * _lobe.loss(eta, t.wi) * t.mu);
        }
        // Per steradian.
        REGAIN_HOST_DEVICE Real density(const Terms& t) const
        {
            Real d(0);
            if (!detail::all<Real>(t.below)) d = _lobe._missing[0].density(t.mu);
            if (detail::any<Real>(t.below))
                d = detail::select(t.below, _lobe._missing[1].density(t.mu), d);
            return d * detail::select(t.reflected, _p, Real(1) - _p) *
                   detail::constant<Real>(0.159154943091895335769);
        }

        REGAIN_HOST_DEVICE static Mask differ(const Mask& a, const Mask& b)
        {  // xsimd's != takes two true masks for two NaNs.
            const Mask not_a = !a, not_b = !b;
            return (a & not_b) | (not_a & b);
        }
        DielectricMissingEnergyLobe _lobe;
        Mask _valid;
        Vec3<Real> _wo;
        Mask _below;
        Real _loss;
        Real _p;  // probability of reflection
        Color _reflection, _transmission;
    };

    REGAIN_HOST_DEVICE Prepared prepare(const Vec3<Real>& wo) const { return Prepared(*this, wo); }

private:
    using Missing = MissingEnergy<Real, 3, 16>;

    REGAIN_HOST_DEVICE static Real total(const Color& c) { return c.x + c.y + c.z; }

    // 1 - E^S of w, seen from where eta is the index ahead over the one behind.
    REGAIN_HOST_DEVICE Real loss(Real eta, const Vec3<Real>& w) const
    {
        if (!_bound) return Real(0);
        return detail::select(_black, Real(0), Real(1) - _tables.albedo(_axes, eta, w));
    }

    DielectricTables _tables;
    DirectionAxes<Real> _axes;
    Mask _black;
    bool _bound;
    Real _eta[2], _inv_average[2], _passed[2];  // by side of wo: above, below
    Missing _missing[2];
    Color _reflection, _transmission;
};

/// A Dielectric and its added lobes.
template <class LobeType>
class DielectricKullaConty
    : public DielectricWithAddedLobes<LobeType, DielectricMissingEnergyLobe<LobeType>>
{
public:
    using Lobe = LobeType;
    using Real = typename Lobe::Real;

    /// strength in [0, 1] scales the added lobes; clamped, NaN becomes 0. Without tables there are
    /// none.
    REGAIN_HOST_DEVICE DielectricKullaConty(const Lobe& lobe, const DielectricTables& tables,
                                            Real strength = Real(1),
                                            KullaContySplit split = KullaContySplit::kulla_conty)
        : DielectricWithAddedLobes<Lobe, DielectricMissingEnergyLobe<Lobe>>(
              lobe, {lobe, tables, strength, split}, strength)
    {}
};

/// The dielectric compensated by added lobes, at strength s in [0, 1]. The tables, of its
/// distribution and form of shadowing, serve the added lobes and, unless it has its own, its
/// albedo.
template <class Distribution>
REGAIN_HOST_DEVICE DielectricKullaConty<Dielectric<Distribution>> kulla_conty(
    Dielectric<Distribution> lobe, const DielectricTables& tables,
    typename Distribution::Real strength = typename Distribution::Real(1),
    KullaContySplit split = KullaContySplit::kulla_conty)
{
    if (!lobe.tables()) lobe.set_tables(tables);
    return {lobe, tables, strength, split};
}

REGAIN_NAMESPACE_END
