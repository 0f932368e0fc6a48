// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// `tail`: compensation by an added lobe with the shape, the energy and the colour of the second
/// and later bounces of the random walk:
///
///   f_ms(wo, wi) = A(mu_o) A(mu_i) / (pi <A>) P(mu_o, mu_i) 2 pi Phi(phi)
///   A(mu)        = (1 - E_ss(mu)) t(mu),    <g> = 2 int_0^1 g mu dmu
///   P(mu_o, mu_i) = 1 + c (mu_o - m) (mu_i - m),    m = <A mu> / <A>
///
/// The product of both directions' losses is Kulla and Conty's lobe. Against the walk it has nearly
/// the right mean over azimuth (what of that is no product is small, and P has most of it), but it
/// looks the same from all sides, where the walk's light goes on ahead: Phi, azimuth_spread.h.
///
/// Neither factor changes the albedo, which is A(mu_o): Phi integrates to 1 over azimuth, and m is
/// the mean that makes the second term of P vanish. All are the same with wo and wi exchanged. So
/// energy and reciprocity are exact whatever c and Phi are; these can be fitted freely.
///
/// The colour is that of directional_gain.h: t(mu) = F_1(mu) F_ms(mu), with the mean F_1 of the
/// Fresnel term over all that is scattered once. It is taken at six cosines, when the closure is
/// built, and interpolated; where F = 1 it is 1. c, k and m of Phi come from tables.
///
/// The lobe and the added lobe make one closure, as in kulla_conty.h. The polar angle is sampled by
/// missing_energy.h, the azimuth exactly.

#pragma once

#include <regain/closures/azimuth_spread.h>
#include <regain/closures/directional_gain.h>
#include <regain/closures/missing_energy.h>
#include <regain/closures/sum.h>

REGAIN_NAMESPACE_BEGIN

namespace detail {

/// A colour over the cosine: the polynomial in sqrt(mu) through six places.
template <class Real>
class ColorCurve
{
public:
    ColorCurve() : ColorCurve([](Real) { return Color3<Real>(Real(1)); }) {}

    /// color(mu) for mu in [0, 1].
    template <class F>
    explicit ColorCurve(const F& color)
    {
        for (int i = 0; i < nodes; ++i)
            _coefficient[i] = color(constant<Real>(place(i) * place(i)));
        // Newton's divided differences.
        for (int order = 1; order < nodes; ++order)
            for (int i = nodes - 1; i >= order; --i)
                _coefficient[i] = (_coefficient[i] - _coefficient[i - 1]) *
                                  constant<Real>(1 / (place(i) - place(i - order)));
    }

    /// In [0, 1] per channel.
    Color3<Real> at(Real mu) const
    {
        const Real x = sqrt(mu);
        Color3<Real> sum = _coefficient[nodes - 1];
        for (int i = nodes - 2; i >= 0; --i)
            sum = sum * (x - constant<Real>(place(i))) + _coefficient[i];
        return per_channel(sum, [](Real v) { return max(min(v, Real(1)), Real(0)); });
    }

private:
    static constexpr int nodes = 6;
    // Chebyshev's, in [0, 1].
    static constexpr double place(int i)
    {
        constexpr double x[nodes] = {0.017037086855465844, 0.14644660940672624,
                                     0.37059047744873963,  0.62940952255126037,
                                     0.85355339059327376,  0.98296291314453416};
        return x[i];
    }

    Color3<Real> _coefficient[nodes];
};

}  // namespace detail

/// The added lobe alone: black for a mirror and without its tables.
template <class RealType>
class FittedTailLobe : public Shorthands<FittedTailLobe<RealType>, RealType>
{
public:
    using Real = RealType;
    using Mask = MaskOf<Real>;
    using Color = Color3<Real>;
    static constexpr int random_numbers = 2;

    /// Of `tables` it needs E_ss, falloff, dip, q_ms, mu_ms, spread, forward and tilt. strength in
    /// [0, 1] scales the lobe; clamped, NaN becomes 0.
    template <class Distribution, class Fresnel>
    FittedTailLobe(const Distribution& distribution, const Fresnel& fresnel,
                   const MicrofacetTables& tables, Real strength)
        : _tables(tables),
          _axes(distribution),
          _black(distribution.is_delta()),
          _strength(detail::saturate(strength)),
          _mean_cosine(Real(0)),
          _inv_average(Real(0)),
          _tilt(Real(0))
    {
        const MicrofacetTables& t = tables;
        _bound = t.has_albedo() && t.has_moments() && t.has_later_bounces() && t.has_later_shape();
        if (!_bound) return;
        const auto loss_at = [this](Real mu) { return loss(mu); };
        _missing = MissingEnergy<Real>(_axes.alpha(), loss_at);

        const DirectionalGain<Fresnel> gain(distribution, fresnel, tables, Real(1));
        _tint = detail::ColorCurve<Real>(
            [&](Real mu) { return fresnel.mean(tables.moments(_axes, mu)) * gain.F_ms(mu); });
        const Color average =
            _missing.average_of(loss_at, [this](Real mu) { return _tint.at(mu); });
        const Color mean =
            _missing.average_of(loss_at, [this](Real mu) { return _tint.at(mu) * mu; });
        const Real tiny = detail::constant<Real>(1e-30);
        for (int c = 0; c < 3; ++c)
        {
            _inv_average[c] = Real(1) / detail::max(average[c], tiny);
            _mean_cosine[c] = detail::min(mean[c] * _inv_average[c], Real(1));
            // P stays above 0.05 for all pairs.
            const Real m = _mean_cosine[c], most = detail::constant<Real>(0.95),
                       far = detail::max(m, Real(1) - m), product = m * (Real(1) - m);
            _tilt[c] =
                detail::max(detail::min(t.later_tilt(_axes), most / detail::max(product, tiny)),
                            -most / (far * far));
        }
        const Real k = t.later_spread(_axes);
        _azimuth = AzimuthSpread<Real>(k * k, detail::saturate(t.later_forward(_axes)));
    }

    bool bound() const { return _bound; }
    const MissingEnergy<Real>& missing() const { return _missing; }
    const AzimuthSpread<Real>& azimuth() const { return _azimuth; }
    const Color& tilt() const { return _tilt; }
    const Color& mean_cosine() const { return _mean_cosine; }

    /// 1 - E_ss at mu in [0, 1].
    Real loss(Real mu) const
    {
        if (!_bound) return Real(0);
        return detail::select(_black, Real(0), Real(1) - _tables.albedo(_axes, mu));
    }

    /// t at mu in [0, 1].
    Color tint(Real mu) const { return _tint.at(mu); }

    Traits traits() const
    {
        Traits t;
        t.reciprocal = true;
        t.exact_pdf = true;
        t.random_numbers = random_numbers;
        return t;
    }

    class Prepared
    {
        using Polar = typename AzimuthSpread<Real>::Polar;

    public:
        Prepared(const FittedTailLobe& lobe, const Vec3<Real>& wo)
            : _lobe(lobe),
              _valid(detail::is_above_horizon(wo)),
              _wo(detail::normalised(
                  detail::select(_valid, wo, Vec3<Real>(Real(0), Real(0), Real(1))))),
              _polar(Polar::of(_wo)),
              _loss(lobe.loss(_wo.z)),
              _energy(lobe.tint(_wo.z) * _loss),
              _weight(lobe._strength)
        {
            _valid = detail::both<Real>(_valid, _loss > Real(0));
            _weight = detail::select(_valid, _weight, Color(Real(0)));
        }

        const Vec3<Real>& wo() const { return _wo; }
        void scale_by(const Color& weight) { _weight *= weight; }

        /// 1 - E_ss(wo).
        Real loss() const { return _loss; }

        Color eval(const Vec3<Real>& wi) const
        {
            const Terms t = terms(wi);
            return detail::select(t.valid, value(t), Color(Real(0)));
        }

        Sample<Real> sample(const Vec2<Real>& u) const
        {
            return sample(detail::two_numbers<FittedTailLobe>(u));
        }
        Sample<Real> sample(const Vec3<Real>& u) const
        {
            const Real mu = _lobe._missing.sample(detail::saturate(u.x));
            const Real sine = detail::sqrt((Real(1) - mu) * (Real(1) + mu));
            const Real phi = _lobe._azimuth.about(_polar, {mu, sine}).sample(detail::saturate(u.y));
            // Turned from straight ahead, which is any way for wo along the normal.
            const Mask upright = _polar.sine <= detail::constant<Real>(1e-12);
            const Real inv = Real(1) / detail::select(upright, Real(1), _polar.sine);
            const Real x = detail::select(upright, Real(1), -_wo.x * inv),
                       y = detail::select(upright, Real(0), -_wo.y * inv);
            const Real c = detail::cos(phi), s = detail::sin(phi);
            const Vec3<Real> wi(sine * (x * c - y * s), sine * (y * c + x * s), mu);
            const Terms t = terms(wi);

            const Real pdf = density(t);
            const Mask valid = detail::both<Real>(t.valid, pdf > Real(0));

            Sample<Real> result;
            result.valid = valid;
            result.wi = detail::select(valid, wi, Vec3<Real>(Real(0), Real(0), Real(1)));
            result.weight = detail::select(
                valid, value(t) * (Real(1) / detail::select(valid, pdf, Real(1))), Color(Real(0)));
            result.pdf = detail::select(valid, pdf, Real(0));
            return result;
        }

        Real pdf(const Vec3<Real>& wi) const
        {
            const Terms t = terms(wi);
            return detail::select(t.valid, density(t), Real(0));
        }

        Albedo<Real> albedo() const { return {_weight * _energy, Color(Real(0))}; }

    private:
        struct Terms
        {
            Mask valid;
            Real mu;       // cos theta_i
            Real azimuth;  // 2 pi Phi
        };
        Terms terms(const Vec3<Real>& direction) const
        {
            Terms t;
            t.valid = detail::both<Real>(_valid, detail::is_above_horizon(direction));
            const Vec3<Real> wi =
                detail::select(t.valid, direction, Vec3<Real>(Real(0), Real(0), Real(1)));
            t.mu = detail::min(wi.z, Real(1));
            t.azimuth = _lobe._azimuth.about(_polar, Polar::of({wi.x, wi.y, t.mu}))
                            .relative_density(AzimuthSpread<Real>::azimuth(_wo, wi));
            return t;
        }
        // f cos theta_i.
        Color value(const Terms& t) const
        {
            const Color one(Real(1));
            const Color energy =
                _lobe.tint(t.mu) * (_lobe.loss(t.mu) * t.mu * t.azimuth *
                                    detail::constant<Real>(0.318309886183790671538));
            const Color tilted = one + _lobe._tilt * (Color(_wo.z) - _lobe._mean_cosine) *
                                           (Color(t.mu) - _lobe._mean_cosine);
            return _weight * _energy * _lobe._inv_average * energy * tilted;
        }
        // Per steradian.
        Real density(const Terms& t) const
        {
            return _lobe._missing.density(t.mu) * t.azimuth *
                   detail::constant<Real>(0.159154943091895335769);
        }

        FittedTailLobe _lobe;
        Mask _valid;
        Vec3<Real> _wo;
        Polar _polar;
        Real _loss;
        Color _energy, _weight;  // A(mu_o); strength and what scale_by was given
    };

    Prepared prepare(const Vec3<Real>& wo) const { return Prepared(*this, wo); }

private:
    MicrofacetTables _tables;
    TableAxes<Real> _axes;
    Mask _black;
    bool _bound;
    Real _strength;
    detail::ColorCurve<Real> _tint;
    MissingEnergy<Real> _missing;
    AzimuthSpread<Real> _azimuth;
    Color _mean_cosine, _inv_average, _tilt;
};

/// A MicrofacetReflection and its tail.
template <class LobeType>
class FittedTail : public Shorthands<FittedTail<LobeType>, typename LobeType::Real>
{
public:
    using Lobe = LobeType;
    using Real = typename Lobe::Real;
    using Color = Color3<Real>;
    using Mixture = Sum<Lobe, FittedTailLobe<Real>>;
    static constexpr int random_numbers = Mixture::random_numbers;

    /// strength in [0, 1] scales the added lobe; clamped, NaN becomes 0. Without its tables there
    /// is no added lobe.
    FittedTail(const Lobe& lobe, const MicrofacetTables& tables, Real strength = Real(1))
        : _mixture(lobe,
                   FittedTailLobe<Real>(lobe.distribution(), lobe.fresnel(), tables, strength)),
          _F_ss(lobe.fresnel().average())
    {
        const auto& distribution = lobe.distribution();
        // The tables know one alpha; what they say of two is an estimate.
        _preserves = _mixture.second().bound() &&
                     detail::all<Real>(detail::saturate(strength) == Real(1)) &&
                     detail::all<Real>(distribution.alpha_x() == distribution.alpha_y());
    }

    const Lobe& lobe() const { return _mixture.first(); }
    const FittedTailLobe<Real>& added_lobe() const { return _mixture.second(); }

    Traits traits() const
    {
        Traits t = _mixture.traits();
        t.energy_preserving = _preserves;
        return t;
    }

    class Prepared : public Mixture::Prepared
    {
    public:
        Prepared(const FittedTail& closure, const Vec3<Real>& wo)
            : Prepared(closure, closure.lobe().prepare(wo), closure.added_lobe().prepare(wo))
        {}

    private:
        // The lobe's own albedo would cost more look-ups, or an integral where there are none.
        Prepared(const FittedTail& closure, const typename Lobe::Prepared& lobe,
                 const typename FittedTailLobe<Real>::Prepared& added)
            : Mixture::Prepared(lobe, added, total(closure._F_ss) * (Real(1) - added.loss()),
                                total(added.albedo().reflect))
        {}
        static Real total(const Color& c) { return c.x + c.y + c.z; }
    };

    Prepared prepare(const Vec3<Real>& wo) const { return Prepared(*this, wo); }

private:
    Mixture _mixture;
    Color _F_ss;
    bool _preserves;
};

/// The lobe compensated by its tail at strength s in [0, 1]. The tables serve the tail and, unless
/// the lobe has its own, its albedo.
template <class Lobe>
FittedTail<Lobe> fitted_tail(Lobe lobe, const MicrofacetTables& tables,
                             typename Lobe::Real strength = typename Lobe::Real(1))
{
    if (!lobe.tables().has_albedo()) lobe.set_tables(tables);
    return {lobe, tables, strength};
}

REGAIN_NAMESPACE_END
