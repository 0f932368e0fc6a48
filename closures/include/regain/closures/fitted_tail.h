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
/// An anisotropic surface loses more along some azimuths than along others, and Phi does not
/// integrate to 1 over what depends on azimuth. So its loss is divided into M(mu), the lesser of
/// those along its axes, which is common to all azimuths, and what is left, N(w); each makes a lobe
/// that is symmetric and has the albedo it should have by itself:
///
///   f_ms(wo, wi) = M_o M_i / (pi <M>) P 2 pi Phi  +  N_o N_i / (pi <N>)
///
/// (each times t). A product of N and Phi could not be both reciprocal and right in energy.
///
/// The lobe and the added lobe make one closure, as in kulla_conty.h. The polar angle is sampled by
/// missing_energy.h, the azimuth exactly.

#pragma once

#include <regain/closures/azimuth_spread.h>
#include <regain/closures/directional_gain.h>
#include <regain/closures/missing_energy.h>
#include <regain/closures/reflection_with_added_lobe.h>

REGAIN_NAMESPACE_BEGIN

namespace detail {

/// A colour over the cosine: the polynomial in sqrt(mu) through six places.
template <class Real>
class ColorCurve
{
public:
    REGAIN_HOST_DEVICE ColorCurve() : ColorCurve([](Real) { return Color3<Real>(Real(1)); }) {}

    /// color(mu) for mu in [0, 1].
    template <class F>
    REGAIN_HOST_DEVICE explicit ColorCurve(const F& color)
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
    REGAIN_HOST_DEVICE Color3<Real> at(Real mu) const
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
    REGAIN_HOST_DEVICE static constexpr double place(int i)
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
    REGAIN_HOST_DEVICE FittedTailLobe(const Distribution& distribution, const Fresnel& fresnel,
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
        const auto loss_at = [this](Real mu) { return common_loss(mu); };
        const auto rest_at = [this](Real mu) {
            const Real common = common_loss(mu);
            return _axes.azimuth_mean(mu, [&](const Vec3<Real>& w) { return rest(w, common); });
        };
        if (_axes.isotropic())
            _missing = MissingEnergy<Real>(_axes.alpha(), loss_at);
        else
            _missing = MissingEnergy<Real>(_axes.alpha(),
                                           [&](Real mu) { return common_loss(mu) + rest_at(mu); });

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
        if (!_axes.isotropic())
        {
            const Color rest =
                _missing.average_of(rest_at, [this](Real mu) { return _tint.at(mu); });
            // Where next to nothing is left, a part of it that no node has seen may be found later.
            for (int c = 0; c < 3; ++c)
                _inv_rest[c] =
                    Real(1) /
                    detail::max(rest[c],
                                detail::max(average[c] * detail::constant<Real>(1e-4), tiny));
        }
        const Real k = t.later_spread(_axes);
        _azimuth = AzimuthSpread<Real>(k * k, detail::saturate(t.later_forward(_axes)));
    }

    REGAIN_HOST_DEVICE bool bound() const { return _bound; }
    REGAIN_HOST_DEVICE const MissingEnergy<Real>& missing() const { return _missing; }
    REGAIN_HOST_DEVICE const AzimuthSpread<Real>& azimuth() const { return _azimuth; }
    REGAIN_HOST_DEVICE const Color& tilt() const { return _tilt; }
    REGAIN_HOST_DEVICE const Color& mean_cosine() const { return _mean_cosine; }

    /// 1 - E_ss of a unit w, w.z in [0, 1].
    REGAIN_HOST_DEVICE Real loss(const Vec3<Real>& w) const
    {
        if (!_bound) return Real(0);
        return detail::select(_black, Real(0), Real(1) - _axes.albedo(_tables, w));
    }
    /// M at mu in [0, 1]; where the lobe is isotropic, all of the loss.
    REGAIN_HOST_DEVICE Real common_loss(Real mu) const
    {
        if (_axes.isotropic()) return loss({Real(0), Real(0), mu});
        const Real sine = detail::sqrt(detail::max((Real(1) - mu) * (Real(1) + mu), Real(0)));
        return detail::min(loss({sine, Real(0), mu}), loss({Real(0), sine, mu}));
    }

    /// t at mu in [0, 1].
    REGAIN_HOST_DEVICE Color tint(Real mu) const { return _tint.at(mu); }

    REGAIN_HOST_DEVICE Traits traits() const
    {
        Traits t;
        t.reciprocal = true;
        t.exact_pdf = true;
        t.anisotropic = !_axes.isotropic();
        t.random_numbers = random_numbers;
        return t;
    }

    class Prepared
    {
        using Polar = typename AzimuthSpread<Real>::Polar;

    public:
        REGAIN_HOST_DEVICE Prepared(const FittedTailLobe& lobe, const Vec3<Real>& wo)
            : _lobe(lobe),
              _valid(detail::is_above_horizon(wo)),
              _wo(detail::normalised(
                  detail::select(_valid, wo, Vec3<Real>(Real(0), Real(0), Real(1))))),
              _polar(Polar::of(_wo)),
              _loss(lobe.common_loss(_wo.z)),
              _energy(lobe.tint(_wo.z) * _loss),
              _weight(lobe._strength)
        {
            if (!lobe._axes.isotropic())
            {
                const Real rest = lobe.rest(_wo, _loss), common = _loss;
                _rest = lobe.tint(_wo.z) * rest;
                _loss += rest;
                _common = common / detail::max(_loss, detail::constant<Real>(1e-30));
            }
            _valid = detail::both<Real>(_valid, _loss > Real(0));
            _weight = detail::select(_valid, _weight, Color(Real(0)));
        }

        REGAIN_HOST_DEVICE const Vec3<Real>& wo() const { return _wo; }
        REGAIN_HOST_DEVICE void scale_by(const Color& weight) { _weight *= weight; }

        /// 1 - E_ss(wo).
        REGAIN_HOST_DEVICE Real loss() const { return _loss; }

        REGAIN_HOST_DEVICE Color eval(const Vec3<Real>& wi) const
        {
            const Terms t = terms(wi);
            return detail::select(t.valid, value(t), Color(Real(0)));
        }

        REGAIN_HOST_DEVICE Sample<Real> sample(const Vec2<Real>& u) const
        {
            return sample(detail::two_numbers<FittedTailLobe>(u));
        }
        REGAIN_HOST_DEVICE Sample<Real> sample(const Vec3<Real>& u) const
        {
            const Real mu = _lobe._missing.sample(detail::saturate(u.x));
            const Real sine = detail::sqrt((Real(1) - mu) * (Real(1) + mu));
            const Vec3<Real> wi = some_azimuth(mu, sine, detail::saturate(u.y));
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

        REGAIN_HOST_DEVICE Real pdf(const Vec3<Real>& wi) const
        {
            const Terms t = terms(wi);
            return detail::select(t.valid, density(t), Real(0));
        }

        REGAIN_HOST_DEVICE Albedo<Real> albedo() const
        {
            return {_weight * (_energy + _rest), Color(Real(0))};
        }

    private:
        struct Terms
        {
            Mask valid;
            Vec3<Real> wi;
            Real azimuth;  // 2 pi Phi
        };
        REGAIN_HOST_DEVICE Terms terms(const Vec3<Real>& direction) const
        {
            Terms t;
            t.valid = detail::both<Real>(_valid, detail::is_above_horizon(direction));
            t.wi = detail::select(t.valid, direction, Vec3<Real>(Real(0), Real(0), Real(1)));
            t.wi.z = detail::min(t.wi.z, Real(1));
            t.azimuth = _lobe._azimuth.about(_polar, Polar::of(t.wi))
                            .relative_density(AzimuthSpread<Real>::azimuth(_wo, t.wi));
            return t;
        }
        // wi of a polar angle, by Phi or, for the share of N, by azimuth_skew.h.
        REGAIN_HOST_DEVICE Vec3<Real> some_azimuth(const Real& mu, const Real& sine,
                                                   const Real& u) const
        {
            if (_lobe._axes.isotropic()) return some_way_ahead(mu, sine, u);
            const Real tiny = detail::constant<Real>(1e-30);
            const Mask common = u <= _common;
            const Real share = u / detail::max(_common, tiny),
                       rest = (u - _common) / detail::max(Real(1) - _common, tiny);
            return detail::select(common, some_way_ahead(mu, sine, detail::min(share, Real(1))),
                                  _lobe._axes.azimuths().sample(mu, detail::saturate(rest)));
        }
        REGAIN_HOST_DEVICE Vec3<Real> some_way_ahead(const Real& mu, const Real& sine,
                                                     const Real& u) const
        {
            const Real phi = _lobe._azimuth.about(_polar, {mu, sine}).sample(u);
            // Turned from straight ahead, which is any way for wo along the normal.
            const Mask upright = _polar.sine <= detail::constant<Real>(1e-12);
            const Real inv = Real(1) / detail::select(upright, Real(1), _polar.sine);
            const Real x = detail::select(upright, Real(1), -_wo.x * inv),
                       y = detail::select(upright, Real(0), -_wo.y * inv);
            const Real c = detail::cos(phi), s = detail::sin(phi);
            return {sine * (x * c - y * s), sine * (y * c + x * s), mu};
        }
        // f cos theta_i.
        REGAIN_HOST_DEVICE Color value(const Terms& t) const
        {
            const Color one(Real(1));
            const Real mu = t.wi.z, inv_pi = detail::constant<Real>(0.318309886183790671538);
            const Real loss = _lobe.common_loss(mu);
            const Color tint = _lobe.tint(mu);
            const Color energy = tint * (loss * mu * t.azimuth * inv_pi);
            const Color tilted = one + _lobe._tilt * (Color(_wo.z) - _lobe._mean_cosine) *
                                           (Color(mu) - _lobe._mean_cosine);
            const Color common = _weight * _energy * _lobe._inv_average * energy * tilted;
            if (_lobe._axes.isotropic()) return common;
            return common + _weight * _rest * _lobe._inv_rest * tint *
                                (_lobe.rest(t.wi, loss) * mu * inv_pi);
        }
        // Per steradian.
        REGAIN_HOST_DEVICE Real density(const Terms& t) const
        {
            Real azimuth = t.azimuth;
            if (!_lobe._axes.isotropic())
                azimuth = _common * azimuth +
                          (Real(1) - _common) * _lobe._axes.azimuths().relative_density(t.wi);
            return _lobe._missing.density(t.wi.z) * azimuth *
                   detail::constant<Real>(0.159154943091895335769);
        }

        FittedTailLobe _lobe;
        Mask _valid;
        Vec3<Real> _wo;
        Polar _polar;
        Real _loss;
        Color _energy, _weight;        // A(mu_o) or M_o t; strength and what scale_by was given
        Color _rest = Color(Real(0));  // N_o t
        Real _common = Real(1);        // share of M_o in the loss
    };

    REGAIN_HOST_DEVICE Prepared prepare(const Vec3<Real>& wo) const { return Prepared(*this, wo); }

private:
    // N of w, M being common to its cosine.
    REGAIN_HOST_DEVICE Real rest(const Vec3<Real>& w, Real common) const
    {
        return detail::max(loss(w) - common, Real(0));
    }

    MicrofacetTables _tables;
    DirectionAxes<Real> _axes;
    Mask _black;
    bool _bound;
    Real _strength;
    detail::ColorCurve<Real> _tint;
    MissingEnergy<Real> _missing;
    AzimuthSpread<Real> _azimuth;
    Color _mean_cosine, _inv_average, _tilt;
    Color _inv_rest = Color(Real(0));
};

/// A MicrofacetReflection and its tail.
template <class LobeType>
class FittedTail : public ReflectionWithAddedLobe<LobeType, FittedTailLobe<typename LobeType::Real>>
{
public:
    using Lobe = LobeType;
    using Real = typename Lobe::Real;

    /// strength in [0, 1] scales the added lobe; clamped, NaN becomes 0. Without its tables there
    /// is no added lobe.
    REGAIN_HOST_DEVICE FittedTail(const Lobe& lobe, const MicrofacetTables& tables,
                                  Real strength = Real(1))
        : ReflectionWithAddedLobe<Lobe, FittedTailLobe<Real>>(
              lobe, {lobe.distribution(), lobe.fresnel(), tables, strength}, strength)
    {}
};

/// The lobe compensated by its tail at strength s in [0, 1]. The tables serve the tail and, unless
/// the lobe has its own, its albedo.
template <class Lobe>
REGAIN_HOST_DEVICE FittedTail<Lobe> fitted_tail(
    Lobe lobe, const MicrofacetTables& tables,
    typename Lobe::Real strength = typename Lobe::Real(1))
{
    if (!lobe.tables().has_albedo()) lobe.set_tables(tables);
    return {lobe, tables, strength};
}

REGAIN_NAMESPACE_END
