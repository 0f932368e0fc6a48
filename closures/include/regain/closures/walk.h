// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Reflection from a rough conductor with all its bounces: the random walk of Heitz, Hanika, d'Eon
/// and Dachsbacher 2016 on the Smith microsurface, as a closure. It replaces the lobe; its first
/// bounce is what MicrofacetReflection returns. How a walk moves is told in microsurface_walk.h.
///
/// A walk goes on until it has left the surface, so nothing is lost, no order is cut off, and
///
///   sample   weight = product of F over the bounces (times the closure's tint), unbiased, with no
///            other noise than the colour's
///   eval     an unbiased estimate of f |cos theta_i|: the first bounce exactly, and of
///   `eval_samples`
///            walks the later bounces, each joined with wi
///   pdf      near the density of sample, not equal to it: the density of the first bounce,
///   exactly,
///            and a lobe for the rest
///
/// A host that combines sample and eval by multiple importance sampling stays unbiased as long as
/// both sides weigh with pdf(): the weights add up to 1 whatever pdf is. The weight of a sample is
/// what counts; it is not eval / pdf. A host that divides by the pdf itself takes weight * pdf for
/// the value.
///
/// The lobe for the rest. Where the tables know E_ss, which they do for one alpha and, to the
/// digits needed here, no tail parameter, it is
///   (1 - E_ss) ((1 - t) cos / pi + t 3 cos^2 / (2 pi)),  t = alpha mu_o
/// For GGX the pdf is then within 0.02 to 0.11 of the density for alpha >= 0.25, relative rms, and
/// within 0.3 for smaller ones. It integrates to 1 as well as the table knows E_ss: 5e-4; 1e-3 for
/// Beckmann.
///
/// Otherwise the share 1 - E_ss is not known, but the density n(d) of first bounces along d that do
/// not leave is. Carried from the sphere onto the hemisphere, by halving the angle to -z, it
/// becomes
///   4 cos theta_i n(2 cos theta_i (wi_x, wi_y, -wi_z) + z)
/// which integrates to 1 - E_ss exactly, for any distribution; a fiftieth of all is a cosine lobe,
/// so that the pdf is positive. This one is within 0.02 to 0.6 of the density, and 2 where a narrow
/// n lands beside it (alpha 0.1 at grazing angles, STD of long tail).

#pragma once

#include <regain/closures/method_gain.h>
#include <regain/closures/microfacet_reflection.h>
#include <regain/closures/microsurface_walk.h>
#include <regain/closures/walk_density.h>

REGAIN_NAMESPACE_BEGIN

template <class DistributionType, class FresnelType>
class Walk : public Shorthands<Walk<DistributionType, FresnelType>, typename DistributionType::Real>
{
public:
    using Distribution = DistributionType;
    using Fresnel = FresnelType;
    using Real = typename Distribution::Real;
    using Mask = MaskOf<Real>;
    using Color = Color3<Real>;
    static constexpr int random_numbers = 3;
    static constexpr bool stochastic_eval = true;

    /// eval_samples: walks that an eval takes, at least 1. `tables` sharpen the pdf and make
    /// albedo() a look-up.
    REGAIN_HOST_DEVICE Walk(const Distribution& distribution, const Fresnel& fresnel,
                            int eval_samples = 1, const MicrofacetTables& tables = {})
        : _distribution(distribution),
          _fresnel(fresnel),
          _tables(tables),
          _eval_samples(eval_samples < 1 ? 1 : eval_samples)
    {}

    REGAIN_HOST_DEVICE const Distribution& distribution() const { return _distribution; }
    REGAIN_HOST_DEVICE const Fresnel& fresnel() const { return _fresnel; }
    REGAIN_HOST_DEVICE int eval_samples() const { return _eval_samples; }

    REGAIN_HOST_DEVICE const MicrofacetTables& tables() const { return _tables; }
    REGAIN_HOST_DEVICE void set_tables(const MicrofacetTables& tables) { _tables = tables; }

    REGAIN_HOST_DEVICE Traits traits() const
    {
        Traits t;
        t.reciprocal = true;
        t.energy_preserving = true;
        t.stochastic_eval = true;
        t.delta = detail::any<Real>(_distribution.is_delta());
        t.anisotropic = !isotropic();
        t.random_numbers = random_numbers;
        return t;
    }

    class Prepared
    {
    public:
        REGAIN_HOST_DEVICE Prepared(const Walk& closure, const Vec3<Real>& wo)
            : _closure(closure),
              _delta(closure._distribution.is_delta()),
              _valid(detail::is_above_horizon(wo)),
              _wo(detail::normalised(
                  detail::select(_valid, wo, Vec3<Real>(Real(0), Real(0), Real(1))))),
              _visible(closure._distribution.visible(_wo)),
              _weight(detail::select(_valid, Real(1), Real(0))),
              _knows_share(!Distribution::has_tail && closure._tables.has_albedo() &&
                           closure.isotropic())
        {
            if (!_knows_share) return;
            const TableAxes<Real> axes(closure._distribution);
            _rest = detail::max(Real(1) - closure._tables.albedo(axes, _wo.z),
                                detail::constant<Real>(1e-4));
            _narrowing = closure._distribution.alpha_x() * _wo.z;
        }

        REGAIN_HOST_DEVICE const Vec3<Real>& wo() const { return _wo; }

        /// Multiplies the closure weight: all that eval, sample and albedo return, and no direction
        /// or pdf.
        REGAIN_HOST_DEVICE void scale_by(const Color& weight) { _weight *= weight; }

        /// An unbiased estimate; u in [0, 1)^3.
        REGAIN_HOST_DEVICE Color eval(const Vec3<Real>& direction, const Vec3<Real>& u) const
        {
            const Distribution& distribution = _closure._distribution;
            const Vec3<Real> wi = safe(direction);
            const Real area_i = distribution.projected_area(-wi);
            Color sum(Real(0));
            const auto join = [&](const Vec3<Real>& v, const Real& area, const Color& throughput,
                                  const Depth& depth) {
                const detail::FacetReflection<Real> facet(distribution, v, wi);
                sum += throughput * _closure._fresnel.at(facet.cosine) *
                       (facet.quarter_D / area * depth.escape_probability(wi.z, area_i));
            };
            for (int i = 0; i < _closure._eval_samples; ++i)
                trace<false>(detail::shifted_numbers(u, i), join);
            sum *= Real(1) / Real(static_cast<ScalarOf<Real>>(_closure._eval_samples));
            join(_wo, _visible.projected_area(), Color(Real(1)), start());
            return detail::select(answers(direction), sum * _weight, Color(Real(0)));
        }

        /// u in [0, 1)^3. The weight is not eval / pdf: see above.
        REGAIN_HOST_DEVICE Sample<Real> sample(const Vec3<Real>& u) const
        {
            return sample_of(path(u));
        }

        /// A walk under way, for who goes on with many at a time: see wide_walks.h.
        struct Flight
        {
            Vec3<Real> d;  // where it is headed
            Real area;     // sigma(-d)
            Color weight;
            Real bounces;
            Real first = Real(0);  // the number that the depth of the first hit is drawn by
            detail::WalkDepth<Real> depth;
            RandomStream<Real> stream;

            template <class Numbers, class Masks>
            REGAIN_HOST_DEVICE void each(const Numbers& numbers, const Masks& masks)
            {
                for (Real* x :
                     {&d.x, &d.y, &d.z, &area, &weight.x, &weight.y, &weight.z, &bounces, &first})
                    numbers(*x);
                depth.each(numbers, masks);
            }
        };
        /// After the first facet: where it has not left the surface.
        REGAIN_HOST_DEVICE Mask take_off(const Vec3<Real>& u, Flight& f) const
        {
            return start<true>(u, f);
        }
        /// One facet more for those in `active`, of which those that leave are taken out.
        REGAIN_HOST_DEVICE static void bounce(const Walk& closure, Flight& f, Mask& active)
        {
            constexpr bool three = Distribution::random_numbers > 2;
            const Visible visible = closure._distribution.visible(-f.d);
            const Real x = f.stream.next(), y = f.stream.next();
            const Vec3<Real> m = visible.sample({x, y, three ? f.stream.next() : Real(0)});
            const Real step = f.stream.next(), cosine = -detail::dot(f.d, m);
            f.d = detail::select(active, m * (Real(2) * cosine) + f.d, f.d);
            f.weight = detail::select(
                active, f.weight * closure._fresnel.at(detail::clamped(cosine, 0, 1)), f.weight);
            f.bounces = detail::select(active, f.bounces + Real(1), f.bounces);
            f.area = area_against(closure._distribution, f.d);
            active =
                detail::both<Real>(active, !f.depth.move(f.d.z, f.area, step, f.first, active));
        }
        /// Where it has got to; `active` are those that are given up.
        REGAIN_HOST_DEVICE WalkPath<Real> land(const Flight& f, const Mask& active) const
        {
            return finished(f, active);
        }
        REGAIN_HOST_DEVICE Sample<Real> sample_of(const WalkPath<Real>& p) const
        {
            Sample<Real> s;
            s.valid = detail::both<Real>(_valid, p.escaped);
            s.delta = detail::both<Real>(s.valid, _delta);
            s.wi = detail::select(s.valid, p.wi, Vec3<Real>(Real(0), Real(0), Real(1)));
            s.weight = detail::select(s.valid, p.weight, Color(Real(0)));
            s.pdf =
                detail::select(s.valid, detail::select(_delta, Real(1), density(s.wi)), Real(0));
            return s;
        }

        REGAIN_HOST_DEVICE Real pdf(const Vec3<Real>& wi) const
        {
            return detail::select(answers(wi), density(safe(wi)), Real(0));
        }

        /// With E_ss, E_avg and the moments' tables, what the compensation method `series` says:
        /// exact for F = 1, within 0.05 otherwise. Without tables, the mean weight of 1024 walks.
        REGAIN_HOST_DEVICE Albedo<Real> albedo() const
        {
            const MicrofacetTables& t = _closure._tables;
            if (!(t.has_albedo() && t.has_average_albedo() && t.has_moments()))
                return detail::mean_weight<Real>(*this);
            const MicrofacetReflection<Distribution, Fresnel> lobe(_closure._distribution,
                                                                   _closure._fresnel, t);
            auto prepared = lobe.prepare(_wo);
            prepared.scale_by(_weight * MethodGain<Real>(lobe, Method::series, t, Real(1)).at(_wo));
            return prepared.albedo();
        }

        /// One walk, with what sample does not tell.
        REGAIN_HOST_DEVICE WalkPath<Real> path(const Vec3<Real>& u) const
        {
            return trace<true>(u, [](const auto&...) {});
        }

    private:
        using Depth = detail::WalkDepth<Real>;
        using Visible = decltype(std::declval<const Distribution&>().visible(Vec3<Real>()));

        REGAIN_HOST_DEVICE Mask answers(const Vec3<Real>& wi) const
        {
            return detail::both<Real>(_valid & !_delta, detail::is_above_horizon(wi));
        }
        REGAIN_HOST_DEVICE static Vec3<Real> safe(const Vec3<Real>& wi)
        {
            return detail::select(detail::is_above_horizon(wi), wi,
                                  Vec3<Real>(Real(0), Real(0), Real(1)));
        }
        REGAIN_HOST_DEVICE Depth start() const { return Depth(_wo.z, _visible.projected_area()); }

        // From wo to where the walk leaves; or, if it may not leave at the first bounce, with that
        // taken off its weight, which halves the variance of eval. join(v, sigma(v), weight, depth)
        // is called at each facet but the first, before it scatters; v points against the ray that
        // arrives.
        template <bool leaves_at_once, class Join>
        REGAIN_HOST_DEVICE WalkPath<Real> trace(const Vec3<Real>& u, const Join& join) const
        {
            Flight f;
            Mask active = start<leaves_at_once>(u, f);
            for (int n = 1; n < walk_limit && detail::any<Real>(active); ++n)
            {
                join(-f.d, f.area, detail::select(active, f.weight, Color(Real(0))), f.depth);
                bounce(_closure, f, active);
            }
            return finished(f, active);
        }

        // The first facet; where the walk has not left.
        template <bool leaves_at_once>
        REGAIN_HOST_DEVICE Mask start(const Vec3<Real>& u, Flight& f) const
        {
            constexpr bool three = Distribution::random_numbers > 2;
            const Vec3<Real> z(Real(0), Real(0), Real(1));
            const Vec3<Real> m = detail::select(_delta, z, _visible.sample(u));
            const Real cosine = detail::dot(_wo, m);
            f.d = m * (Real(2) * cosine) - _wo;
            f.area = area_against(_closure._distribution, f.d);
            f.weight = _weight * _closure._fresnel.at(detail::clamped(cosine, 0, 1));
            f.bounces = Real(1);
            f.depth = start();
            Mask active = detail::both<Real>(_valid, !_delta);

            // The number that the distribution leaves over decides about the first step, so that a
            // path of one bounce draws none.
            const Real spare = detail::saturate(u.z);
            if constexpr (leaves_at_once && !three)
            {
                active = detail::both<Real>(active, !f.depth.leaves_at_once(f.d.z, f.area, spare));
                if (!detail::any<Real>(active)) return active;
            }
            // Not the stream of u itself, which the distribution may have drawn from.
            f.stream = RandomStream<Real>(Vec3<Real>(u.z, u.x, u.y));
            f.first = f.stream.next();
            const Real step = three ? f.stream.next() : spare;
            if constexpr (!leaves_at_once)
            {
                f.weight *= f.depth.stay(f.d.z, f.area, step, f.first, active);
                return active;
            }
            return detail::both<Real>(active, !f.depth.move(f.d.z, f.area, step, f.first, active));
        }

        REGAIN_HOST_DEVICE static Real area_against(const Distribution& distribution,
                                                    const Vec3<Real>& d)
        {
            return detail::max(distribution.projected_area(-d), detail::constant<Real>(1e-30));
        }
        REGAIN_HOST_DEVICE static WalkPath<Real> finished(const Flight& f, const Mask& active)
        {
            WalkPath<Real> p;
            p.wi = detail::normalised(f.d);  // what the bounces have rounded off
            p.weight = f.weight;
            p.bounces = f.bounces;
            p.escaped = !active;
            p.transmitted = Mask(false);
            return p;
        }

        // Near the density of sample, per steradian; wi.z > 0.
        REGAIN_HOST_DEVICE Real density(const Vec3<Real>& wi) const
        {
            const Distribution& distribution = _closure._distribution;
            const Real area = _visible.projected_area();
            // Of what is headed along d the share out / (out + stay) leaves.
            const Real out = area * wi.z, stay = distribution.projected_area(-wi) * _wo.z;
            const detail::FacetReflection<Real> facet(distribution, _wo, wi);
            const Real single = facet.quarter_D * wi.z / (out + stay);
            if (_knows_share)
            {
                const Real lobe = Real(1) + _narrowing * (Real(1.5f) * wi.z - Real(1));
                return single +
                       _rest * wi.z * detail::constant<Real>(0.318309886183790671538) * lobe;
            }
            const Real carried = detail::carried_density(distribution, _wo, area, wi);
            // Some of it everywhere: no facet that wo sees need lead to where a walk can.
            return Real(0.98f) * (single + carried) +
                   wi.z * detail::constant<Real>(0.02 * 0.318309886183790671538);
        }

        Walk _closure;
        Mask _delta, _valid;
        Vec3<Real> _wo;
        Visible _visible;
        Color _weight;
        bool _knows_share;
        Real _rest = Real(0), _narrowing = Real(0);
    };

    REGAIN_HOST_DEVICE Prepared prepare(const Vec3<Real>& wo) const { return Prepared(*this, wo); }

private:
    REGAIN_HOST_DEVICE bool isotropic() const
    {
        return detail::all<Real>(_distribution.alpha_x() == _distribution.alpha_y());
    }

    Distribution _distribution;
    Fresnel _fresnel;
    MicrofacetTables _tables;
    int _eval_samples;
};

REGAIN_NAMESPACE_END
