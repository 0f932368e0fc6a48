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
#include <regain/closures/directional_loss.h>
#include <regain/closures/missing_energy.h>
#include <regain/closures/reflection_with_added_lobe.h>

REGAIN_NAMESPACE_BEGIN

namespace detail {

/// A colour over the cosine: the polynomial in sqrt(mu) through six places.
template <class Real>
class ColorCurve
{
public:
    /// 1 everywhere.
    REGAIN_HOST_DEVICE ColorCurve()
    {
        for (ChannelsOf<Real>& c : _coefficient) c = ChannelsOf<Real>(Real(0));
        _coefficient[0] = ChannelsOf<Real>(Real(1));
    }

    /// color(mu) for mu in [0, 1].
    template <class F>
    REGAIN_HOST_DEVICE explicit ColorCurve(const F& color)
    {
        for (int i = 0; i < nodes; ++i)
            _coefficient[i] = channels<Real>(color(constant<Real>(place(i) * place(i))));
        // Newton's divided differences.
        for (int order = 1; order < nodes; ++order)
            for (int i = nodes - 1; i >= order; --i)
                _coefficient[i] = (_coefficient[i] - _coefficient[i - 1]) *
                                  constant<Real>(1 / (place(i) - place(i - order)));
    }

    /// In [0, 1] per channel.
    REGAIN_HOST_DEVICE Color3<Real> at(Real mu) const { return detail::color(channels_at(mu)); }
    REGAIN_INLINE ChannelsOf<Real> channels_at(Real mu) const
    {
        const Real x = sqrt(mu);
        ChannelsOf<Real> sum = _coefficient[nodes - 1];
        for (int i = nodes - 2; i >= 0; --i)
            sum = sum * (x - constant<Real>(place(i))) + _coefficient[i];
        return each_channel([](const auto& v) { return clamped(v, 0, 1); }, sum);
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

    ChannelsOf<Real> _coefficient[nodes];
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
    using Channels = detail::ChannelsOf<Real>;
    static constexpr int random_numbers = 2;

    /// Of `tables` it needs E_ss, falloff, dip, q_ms, mu_ms, spread, forward and tilt. strength in
    /// [0, 1] scales the lobe; clamped, NaN becomes 0.
    template <class Distribution, class Fresnel>
    REGAIN_HOST_DEVICE FittedTailLobe(const Distribution& distribution, const Fresnel& fresnel,
                                      const MicrofacetTables& tables, Real strength)
        : _loss(distribution, tables), _strength(detail::saturate(strength))
    {
        const MicrofacetTables& t = tables;
        _bound = t.has_albedo() && t.has_moments() && t.has_later_bounces() && t.has_later_shape();
        if (!_bound) return;
        const bool isotropic = axes().isotropic();

        // M and N at the nodes of all integrals, and both together for what is sampled.
        using Missing = MissingEnergy<Real>;
        typename Missing::Nodes nodes;
        Real common[Missing::Nodes::count], rest[Missing::Nodes::count];
        int node = 0;
        _missing = Missing(
            axes().alpha(),
            [&](Real mu) {
                const Real M = common_loss(mu);
                const Real N =
                    isotropic ? Real(0) : axes().azimuth_mean(mu, [&](const Vec3<Real>& w) {
                        return this->rest(w, M);
                    });
                common[node] = M;
                rest[node++] = N;
                return M + N;
            },
            Real(0), &nodes);

        const DirectionalGain<Fresnel> gain(distribution, fresnel, tables, Real(1));
        _tint = detail::ColorCurve<Real>(
            [&](Real mu) { return fresnel.mean(tables.moments(axes(), mu)) * gain.F_ms(mu); });
        Channels average_channels(Real(0)), mean_channels(Real(0)), rest_channels(Real(0));
        for (int i = 0; i < Missing::Nodes::count; ++i)
        {
            const Channels tint = _tint.channels_at(nodes.mu[i]);
            const Channels part = tint * (common[i] * nodes.measure[i]);
            average_channels = average_channels + part;
            mean_channels = mean_channels + part * nodes.mu[i];
            rest_channels = rest_channels + tint * (rest[i] * nodes.measure[i]);
        }
        const Color average = detail::color(average_channels), mean = detail::color(mean_channels),
                    left = detail::color(rest_channels);

        const Real tiny = detail::constant<Real>(1e-30), tilt = t.later_tilt(axes());
        Color inv_average, inv_rest(Real(0)), mean_cosine, tilts;
        for (int c = 0; c < 3; ++c)
        {
            inv_average[c] = Real(1) / detail::max(average[c], tiny);
            const Real m = detail::min(mean[c] * inv_average[c], Real(1));
            mean_cosine[c] = m;
            // P stays above 0.05 for all pairs.
            const Real most = detail::constant<Real>(0.95), far = detail::max(m, Real(1) - m),
                       product = m * (Real(1) - m);
            tilts[c] = detail::max(detail::min(tilt, most / detail::max(product, tiny)),
                                   -most / (far * far));
            if (isotropic) continue;
            // Where next to nothing is left, a part of it that no node has seen may be found later.
            const Real least = average[c] * detail::constant<Real>(1e-4);
            inv_rest[c] = Real(1) / detail::max(left[c], detail::max(least, tiny));
        }
        _inv_average = detail::channels(inv_average);
        _inv_rest = detail::channels(inv_rest);
        _mean_cosine = detail::channels(mean_cosine);
        _tilt = detail::channels(tilts);
        const Real k = t.later_spread(axes());
        _azimuth = AzimuthSpread<Real>(k * k, detail::saturate(t.later_forward(axes())));
    }

    REGAIN_HOST_DEVICE bool bound() const { return _bound; }
    REGAIN_HOST_DEVICE const MissingEnergy<Real>& missing() const { return _missing; }
    REGAIN_HOST_DEVICE const AzimuthSpread<Real>& azimuth() const { return _azimuth; }
    REGAIN_HOST_DEVICE Color tilt() const { return detail::color(_tilt); }
    REGAIN_HOST_DEVICE Color mean_cosine() const { return detail::color(_mean_cosine); }

    /// 1 - E_ss of a unit w, w.z in [0, 1].
    REGAIN_HOST_DEVICE Real loss(const Vec3<Real>& w) const
    {
        return _bound ? _loss.at(w) : Real(0);
    }
    /// M at mu in [0, 1]; where the lobe is isotropic, all of the loss.
    REGAIN_HOST_DEVICE Real common_loss(Real mu) const
    {
        if (axes().isotropic()) return loss({Real(0), Real(0), mu});
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
        t.anisotropic = !axes().isotropic();
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
              _weight(lobe._strength)
        {
            const Channels tint = lobe._tint.channels_at(_wo.z);
            _energy = tint * _loss;
            _tilt = lobe._tilt * (Channels(_wo.z) - lobe._mean_cosine);
            if (!lobe.axes().isotropic())
            {
                const Real rest = lobe.rest(_wo, _loss), common = _loss;
                _rest = tint * rest;
                _loss += rest;
                _common = common / detail::max(_loss, detail::constant<Real>(1e-30));
            }
            _valid = detail::both<Real>(_valid, _loss > Real(0));
            _weight = detail::select(_valid, _weight, Channels(Real(0)));
        }

        REGAIN_HOST_DEVICE const Vec3<Real>& wo() const { return _wo; }
        REGAIN_HOST_DEVICE void scale_by(const Color& weight)
        {
            _weight = _weight * detail::channels(weight);
        }

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
            return {detail::color(_weight * (_energy + _rest)), Color(Real(0))};
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
            if (_lobe.axes().isotropic()) return some_way_ahead(mu, sine, u);
            const Real tiny = detail::constant<Real>(1e-30);
            const Mask common = u <= _common;
            const Real share = u / detail::max(_common, tiny),
                       rest = (u - _common) / detail::max(Real(1) - _common, tiny);
            return detail::select(common, some_way_ahead(mu, sine, detail::min(share, Real(1))),
                                  _lobe.axes().azimuths().sample(mu, detail::saturate(rest)));
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
            const Real mu = t.wi.z, cosine = mu * detail::constant<Real>(0.318309886183790671538);
            const Real loss = _lobe.common_loss(mu);
            const Channels weight = _weight * _lobe._tint.channels_at(mu);
            const Channels tilted = Channels(Real(1)) + _tilt * (Channels(mu) - _lobe._mean_cosine);
            const Channels common = _energy * _lobe._inv_average * tilted;
            if (_lobe.axes().isotropic())
                return detail::color(weight * common * (loss * cosine * t.azimuth));
            return detail::color(weight *
                                 (common * (loss * cosine * t.azimuth) +
                                  _rest * _lobe._inv_rest * (_lobe.rest(t.wi, loss) * cosine)));
        }
        // Per steradian.
        REGAIN_HOST_DEVICE Real density(const Terms& t) const
        {
            Real azimuth = t.azimuth;
            if (!_lobe.axes().isotropic())
                azimuth = _common * azimuth +
                          (Real(1) - _common) * _lobe.axes().azimuths().relative_density(t.wi);
            return _lobe._missing.density(t.wi.z) * azimuth *
                   detail::constant<Real>(0.159154943091895335769);
        }

        FittedTailLobe _lobe;
        Mask _valid;
        Vec3<Real> _wo;
        Polar _polar;
        Real _loss;
        Channels _weight;                    // strength and what scale_by was given
        Channels _energy;                    // A(mu_o) or M_o t
        Channels _rest = Channels(Real(0));  // N_o t
        Channels _tilt;                      // c (mu_o - m)
        Real _common = Real(1);              // share of M_o in the loss
    };

    REGAIN_HOST_DEVICE Prepared prepare(const Vec3<Real>& wo) const { return Prepared(*this, wo); }

private:
    // N of w, M being common to its cosine.
    REGAIN_HOST_DEVICE Real rest(const Vec3<Real>& w, Real common) const
    {
        return detail::max(loss(w) - common, Real(0));
    }

    REGAIN_HOST_DEVICE const DirectionAxes<Real>& axes() const { return _loss.axes(); }

    DirectionalLoss<Real> _loss;
    bool _bound;
    Real _strength;
    detail::ColorCurve<Real> _tint;
    MissingEnergy<Real> _missing;
    AzimuthSpread<Real> _azimuth;
    Channels _mean_cosine = Channels(Real(0)), _inv_average = Channels(Real(0)),
             _tilt = Channels(Real(0)), _inv_rest = Channels(Real(0));
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
