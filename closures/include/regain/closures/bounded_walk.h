// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// `walk-bounded`: the random walk of walk.h for production. It costs no more than a number of
/// facets that the caller sets, its pdf is near its density, and its eval is quieter for the time
/// it takes.
///
/// The bound. A walk meets N facets at most. Light that has not left by then leaves by a closed
/// form: along a direction of density 3 cos^2 / (2 pi), which is how deep light comes out, and with
/// the colour F / (1 + N (1 - F)), F of its last facet: after N facets the best guess of how many
/// there would be is N more, and that is what the series of their reflectances sums to. So with
/// F = 1 all weights are 1 and no energy is lost, whatever N is. What the bound moves elsewhere, or
/// colours otherwise, is part of the light beyond N facets. Of GGX, alpha 1, wo along the normal,
/// where there is most of it: 5.7e-2 for N = 4, 2.2e-4 for N = 8, less than 1e-6 for N = 16, the
/// default; of Beckmann 2e-4 for N = 4. STD holds light longer: 1e-2 for N = 16 at gamma 1.6.
///
/// eval. The first bounce is exact, and needs no random numbers. For the others one walk of two is
/// taken, from wo or from wi, and joined at each of its facets with the direction at the other end.
/// A path can be found from either end, and the ratio R of the densities with which it is
/// is a product of what is at hand anyway, as sigma(v) p(v -> w) = D / 4 = sigma(w) p(w -> v):
///
///   R = D(h_k) sigma(wo) U / (D(h_1) sigma(wi) V),
///   U = product of sigma(-d_j), j = 1 .. k - 2,    V = product of sigma(d_j), j = 2 .. k - 1
///
/// h_j being the normals of k facets and d_j the rays between them. So the estimates of the two
/// kinds are weighed against each other: by the balance heuristic (Veach and Guibas 1995) for two
/// facets, and for more by the same after R has been brought nearer to 1 by up to a factor of 10:
/// where both find a path about as well, weights by density are noise. wo is chosen with the
/// probability mu_i / (mu_o + mu_i): what grazes makes the better start. Depths are integrated
/// over, not drawn: walk_phases.h. A walk goes on past a facet with the probability min(1, 2 s), s
/// being that of not leaving there, at a weight of s over this.
///
/// sample. The same as Walk's up to N facets: weight = product of F over the bounces. pdf: the
/// density of the first bounce, exactly, and for the rest LaterDensity of walk_density.h, or
/// without its tables, or for two alphas, what walk.h does. With tables the L1 distance to the
/// density of sample, which is the mean of |pdf / density - 1| over samples, is 0.04 at most for
/// GGX and Beckmann in the mean over wo, and 0.08 for single ones.
///
/// The pdf is not the density all the same, and what walk.h says about hosts holds here.

#pragma once

#include <regain/closures/count.h>
#include <regain/closures/directional_gain.h>
#include <regain/closures/microfacet_reflection.h>
#include <regain/closures/walk_density.h>
#include <regain/closures/walk_phases.h>

REGAIN_NAMESPACE_BEGIN

/// Facets that bounded walks meet at most: where nobody says how many, and whatever anybody says.
constexpr int default_bounces = 16, most_bounces = 32;

namespace detail {

/// What remains of light that has met n facets and goes on, where x is its last reflectance.
template <class Real>
REGAIN_HOST_DEVICE Color3<Real> closing_tint(const Color3<Real>& x, int n)
{
    const Real more(static_cast<ScalarOf<Real>>(n));
    return per_channel(x, [&](const Real& F) { return F / (Real(1) + more * (Real(1) - F)); });
}

/// Density 3 cos^2 / (2 pi), per steradian; z = |cos theta|.
template <class Real>
REGAIN_HOST_DEVICE Real closing_density(const Real& z)
{
    return z * z * constant<Real>(0.477464829275686007);
}
template <class Real>
REGAIN_HOST_DEVICE Vec3<Real> closing_direction(const Real& u, const Real& v)
{
    const Real z = min(pow(max(u, constant<Real>(1e-18)), constant<Real>(1.0 / 3)), Real(1));
    const Real sine = detail::sqrt((Real(1) - z) * (Real(1) + z));
    const Real phi = constant<Real>(6.28318530717958647692) * v;
    return {sine * detail::cos(phi), sine * detail::sin(phi), z};
}

/// The ratio R of bounded_walk.h as it enters weights, at the k-th facet.
template <class Real>
REGAIN_HOST_DEVICE Real tempered_ratio(const Real& R, int k)
{
    const Real ten(10);
    return k == 2 ? R : max(R / ten, min(R * ten, Real(1)));
}

/// |cos theta| of a ray, of which quotients are finite.
template <class Real>
REGAIN_HOST_DEVICE Real steepness(const Real& z)
{
    return max(abs(z), constant<Real>(horizon));
}

}  // namespace detail

template <class DistributionType, class FresnelType>
class BoundedWalk
    : public Shorthands<BoundedWalk<DistributionType, FresnelType>, typename DistributionType::Real>
{
public:
    using Distribution = DistributionType;
    using Fresnel = FresnelType;
    using Real = typename Distribution::Real;
    using Mask = MaskOf<Real>;
    using Color = Color3<Real>;
    static constexpr int random_numbers = 3;
    static constexpr bool stochastic_eval = true;

    /// eval_samples: walks that an eval takes, at least 1. `tables` sharpen the pdf, which takes
    /// E_ss, E_avg, spread and forward, and make albedo() a look-up. bounces: N, in [2, 32],
    /// clamped.
    REGAIN_HOST_DEVICE BoundedWalk(const Distribution& distribution, const Fresnel& fresnel,
                                   int eval_samples = 1, const MicrofacetTables& tables = {},
                                   int bounces = default_bounces)
        : _distribution(distribution),
          _fresnel(fresnel),
          _later(distribution, tables),
          _eval_samples(eval_samples < 1 ? 1 : eval_samples),
          _bounces(bounces < 2              ? 2
                   : bounces > most_bounces ? most_bounces
                                            : bounces)
    {}

    REGAIN_HOST_DEVICE const Distribution& distribution() const { return _distribution; }
    REGAIN_HOST_DEVICE const Fresnel& fresnel() const { return _fresnel; }
    REGAIN_HOST_DEVICE const MicrofacetTables& tables() const { return _later.tables(); }
    REGAIN_HOST_DEVICE int eval_samples() const { return _eval_samples; }
    REGAIN_HOST_DEVICE int bounces() const { return _bounces; }

    /// Reciprocal but for light beyond N facets.
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
        REGAIN_HOST_DEVICE Prepared(const BoundedWalk& closure, const Vec3<Real>& wo)
            : _closure(closure),
              _delta(closure._distribution.is_delta()),
              _valid(detail::is_above_horizon(wo)),
              _wo(detail::normalised(
                  detail::select(_valid, wo, Vec3<Real>(Real(0), Real(0), Real(1))))),
              _visible(closure._distribution.visible(_wo)),
              _weight(detail::select(_valid, Real(1), Real(0))),
              _knows_rest(closure._later.bound() && closure.isotropic()),
              _rest(_knows_rest
                        ? detail::max(closure._later.lost(_wo.z), detail::constant<Real>(1e-4))
                        : Real(0))
        {}

        REGAIN_HOST_DEVICE const Vec3<Real>& wo() const { return _wo; }

        /// Multiplies the closure weight: all that eval, sample and albedo return, and no direction
        /// or pdf.
        REGAIN_HOST_DEVICE void scale_by(const Color& weight) { _weight *= weight; }

        /// An estimate that is unbiased but for what the bound does; u in [0, 1)^3.
        REGAIN_HOST_DEVICE Color eval(const Vec3<Real>& direction, const Vec3<Real>& u) const
        {
            const Vec3<Real> wi = detail::select(detail::is_above_horizon(direction), direction,
                                                 Vec3<Real>(Real(0), Real(0), Real(1)));
            Color sum(Real(0));
            Real place(0);
            for (int i = 0; i < _closure._eval_samples; ++i)
            {
                const Vec3<Real> numbers = detail::shifted_numbers(u, i);
                // Not the stream of u itself, which the distribution may have drawn from.
                RandomStream<Real> stream(Vec3<Real>(numbers.z, numbers.x, numbers.y));
                const Real own = stream.next();
                // Of several walks, every other one from either end.
                place = i == 0 ? own : place + Real(0.5f);
                place = detail::select(place >= Real(1), place - Real(1), place);
                sum += later(wi, place, numbers, stream);
            }
            sum *= Real(1) / Real(static_cast<ScalarOf<Real>>(_closure._eval_samples));
            sum += single(wi);
            const Mask answers =
                detail::both<Real>(_valid & !_delta, detail::is_above_horizon(direction));
            return detail::select(answers, sum * _weight, Color(Real(0)));
        }

        /// u in [0, 1)^3. The weight is not eval / pdf: see walk.h.
        REGAIN_HOST_DEVICE Sample<Real> sample(const Vec3<Real>& u) const
        {
            const WalkPath<Real> p = path(u);
            Sample<Real> s;
            s.valid = _valid;
            s.delta = detail::both<Real>(_valid, _delta);
            s.wi = detail::select(_valid, p.wi, Vec3<Real>(Real(0), Real(0), Real(1)));
            s.weight = detail::select(_valid, p.weight, Color(Real(0)));
            s.pdf = detail::select(_valid, detail::select(_delta, Real(1), density(s.wi)), Real(0));
            return s;
        }

        REGAIN_HOST_DEVICE Real pdf(const Vec3<Real>& wi) const
        {
            const Mask above = detail::is_above_horizon(wi);
            const Vec3<Real> safe =
                detail::select(above, wi, Vec3<Real>(Real(0), Real(0), Real(1)));
            return detail::select(detail::both<Real>(_valid & !_delta, above), density(safe),
                                  Real(0));
        }

        /// With E_ss, falloff, dip, q_ms and mu_ms what `directional` says, within 0.007 of the
        /// walk's for GGX and Beckmann. Without, the mean weight of 1024 walks.
        REGAIN_HOST_DEVICE Albedo<Real> albedo() const
        {
            const MicrofacetTables& t = _closure.tables();
            if (!(t.has_albedo() && t.has_moments() && t.has_later_bounces()))
                return detail::mean_weight<Real>(*this);
            auto prepared = MicrofacetReflection<Distribution, Fresnel>(_closure._distribution,
                                                                        _closure._fresnel, t)
                                .prepare(_wo);
            const DirectionalGain<Fresnel> gain(_closure._distribution, _closure._fresnel, t,
                                                Real(1));
            prepared.scale_by(_weight * gain.at(_wo));
            return prepared.albedo();
        }

        /// One walk, with what sample does not tell.
        REGAIN_HOST_DEVICE WalkPath<Real> path(const Vec3<Real>& u) const
        {
            constexpr bool three = Distribution::random_numbers > 2;
            const Distribution& distribution = _closure._distribution;

            Color F;
            const Facet first = first_facet(_wo, _visible, u, F);
            Ray ray(distribution, first.departing);
            Phases phases(_wo.z, _visible.projected_area());

            WalkPath<Real> p;
            p.weight = _weight * F;
            p.bounces = Real(1);
            p.escaped = Mask(true);
            Mask active = detail::both<Real>(_valid, !_delta);
            Vec3<Real> d = ray.d;

            // The number that the distribution leaves over decides about the first step.
            Real step = detail::saturate(u.z);
            if constexpr (!three)
            {
                active = detail::both<Real>(active, !ray.rises(phases, step, active));
                if (!detail::any<Real>(active)) return finished(p, d);
            }
            RandomStream<Real> stream(Vec3<Real>(u.z, u.x, u.y));
            if constexpr (three)
            {
                step = stream.next();
                active = detail::both<Real>(active, !ray.rises(phases, step, active));
            }
            for (int n = 2; detail::any<Real>(active); ++n)
            {
                if (n > _closure._bounces)
                {
                    const Real x = stream.next(), y = stream.next();
                    p.weight = detail::select(
                        active, p.weight * detail::closing_tint(F, _closure._bounces), p.weight);
                    d = detail::select(active, detail::closing_direction(x, y), d);
                    break;
                }
                ray.sinks(phases, active);
                ray = Ray(distribution, next_facet(ray, stream, F));
                d = detail::select(active, ray.d, d);
                p.weight = detail::select(active, p.weight * F, p.weight);
                p.bounces = detail::select(active, p.bounces + Real(1), p.bounces);
                active = detail::both<Real>(active, !ray.rises(phases, stream.next(), active));
            }
            return finished(p, d);
        }

    private:
        using Phases = detail::WalkPhases<Real, most_bounces>;
        using Visible = decltype(std::declval<const Distribution&>().visible(Vec3<Real>()));

        // A ray between two facets.
        struct Ray
        {
            REGAIN_HOST_DEVICE Ray(const Distribution& distribution, const Vec3<Real>& direction)
                : d(direction),
                  visible(distribution.visible(-direction)),
                  area(detail::visible_area(visible)),
                  z(detail::steepness(direction.z)),
                  up(direction.z > detail::constant<Real>(detail::horizon))
            {}

            /// True where it leaves; u as in WalkPhases.
            REGAIN_HOST_DEVICE Mask rises(Phases& phases, const Real& u, const Mask& lanes) const
            {
                REGAIN_COUNTED(bounces);
                return phases.rise(z, area, u, detail::both<Real>(lanes, up));
            }
            REGAIN_HOST_DEVICE void sinks(Phases& phases, const Mask& lanes) const
            {
                phases.sink(z, area, detail::both<Real>(lanes, !up));
            }
            /// Probability that it meets a facet.
            REGAIN_HOST_DEVICE Real stays(const Phases& phases) const
            {
                return detail::select(up, phases.stay_probability(z, area), Real(1));
            }

            Vec3<Real> d;
            Visible visible;  // from its next facet
            Real area;        // sigma(-d)
            Real z;           // |cos theta|
            Mask up;
        };
        struct Facet
        {
            Vec3<Real> normal, departing;
        };

        // Where the first facet reflects w, and its F.
        REGAIN_HOST_DEVICE Facet first_facet(const Vec3<Real>& w, const Visible& visible,
                                             const Vec3<Real>& u, Color& F) const
        {
            const Vec3<Real> up(Real(0), Real(0), Real(1));
            const Vec3<Real> m = detail::select(_delta, up, visible.sample(u));
            const Real cosine = detail::dot(w, m);
            F = _closure._fresnel.at(clamped(cosine));
            return {m, m * (Real(2) * cosine) - w};
        }
        // Where the facet that a ray meets reflects it, and its F.
        REGAIN_HOST_DEVICE Vec3<Real> next_facet(const Ray& ray, RandomStream<Real>& stream,
                                                 Color& F) const
        {
            constexpr bool three = Distribution::random_numbers > 2;
            const Real x = stream.next(), y = stream.next();
            const Vec3<Real> m = ray.visible.sample({x, y, three ? stream.next() : Real(0)});
            const Real cosine = -detail::dot(ray.d, m);
            F = _closure._fresnel.at(clamped(cosine));
            return ray.d + m * (Real(2) * cosine);
        }

        // What leaves at the first facet.
        REGAIN_HOST_DEVICE Color single(const Vec3<Real>& wi) const
        {
            const detail::FacetReflection<Real> facet(_closure._distribution, _wo, wi);
            return _closure._fresnel.at(facet.cosine) * first_density(facet, wi);
        }
        // Of what is headed along wi the share out / (out + stay) leaves.
        REGAIN_HOST_DEVICE Real first_density(const detail::FacetReflection<Real>& facet,
                                              const Vec3<Real>& wi) const
        {
            const Real out = _visible.projected_area() * wi.z,
                       stay = _closure._distribution.projected_area(-wi) * _wo.z;
            return facet.quarter_D * wi.z / (out + stay);
        }

        // An estimate of what leaves at later facets, by a walk from wo or, where `place` is beyond
        // its share, from wi.
        REGAIN_HOST_DEVICE Color later(const Vec3<Real>& wi, const Real& place, const Vec3<Real>& u,
                                       RandomStream<Real>& stream) const
        {
            constexpr bool three = Distribution::random_numbers > 2;
            const Distribution& distribution = _closure._distribution;

            const Real share = wi.z / (wi.z + _wo.z);
            const Mask forward = place < share;
            const Vec3<Real> start = detail::select(forward, _wo, wi),
                             end = detail::select(forward, wi, _wo);
            const Real p_start = detail::select(forward, share, Real(1) - share),
                       p_end = Real(1) - p_start;
            Visible seen = _visible;
            if (!detail::all<Real>(forward)) seen = distribution.visible(start);
            const Real end_stay = distribution.projected_area(-end), end_area = end_stay + end.z;

            Color F;
            const Facet first = first_facet(start, seen, u, F);
            Ray ray(distribution, first.departing);
            Phases phases(start.z, seen.projected_area());
            Mask active = detail::both<Real>(_valid, !_delta);
            Real stays = ray.stays(phases);
            Color weight = F;
            ray.sinks(phases, active);
            // R without what belongs to the end.
            Real ratio = Real(4) * seen.projected_area() /
                         (distribution.D(first.normal, Real(1)) * end_area);

            Color sum(Real(0));
            const auto join = [&](int n, const Color& throughput) {
                const detail::FacetReflection<Real> facet(distribution, -ray.d, end);
                const Real R = detail::tempered_ratio(ratio * facet.quarter_D, n);
                // Where the walk has ended it may be anything; no colour times it may be NaN.
                const Real value = detail::min(facet.quarter_D / ray.area *
                                                   phases.escape_probability(end.z, end_stay) /
                                                   (p_start + p_end * R),
                                               detail::constant<Real>(1e20));
                sum +=
                    detail::select(active, throughput * _closure._fresnel.at(facet.cosine) * value,
                                   Color(Real(0)));
            };
            // It may not leave at once: that is known exactly.
            join(2, weight * stays);
            Real step = three ? stream.next() : detail::saturate(u.z);
            for (int n = 2;; ++n)
            {
                active = detail::both<Real>(active, step < detail::min(Real(2) * stays, Real(1)));
                if (!detail::any<Real>(active)) break;
                const Real scale = detail::max(stays, Real(0.5f));
                weight *= scale;
                if (n > 2)
                {
                    // What is left of the number decides where it stays.
                    ray.rises(phases, step * scale, active);
                    ray.sinks(phases, active);
                    join(n, weight);
                }
                const Real before = ray.area;
                ray = Ray(distribution, next_facet(ray, stream, F));
                stays = ray.stays(phases);
                weight *= F;
                if (n == _closure._bounces)
                {
                    // What does not leave here; from wo only, as samples have it.
                    const Mask closes = detail::both<Real>(active, forward);
                    const Color rest = weight * detail::closing_tint(F, n) *
                                       (stays * detail::closing_density(end.z) / p_start);
                    sum += detail::select(closes, rest, Color(Real(0)));
                    break;
                }
                ratio = detail::min(
                    ratio * before / detail::max(ray.area + ray.d.z, detail::constant<Real>(1e-30)),
                    detail::constant<Real>(1e20));
                step = stream.next();
            }
            // f is the same from either end.
            return sum * detail::select(forward, Real(1), wi.z / _wo.z);
        }

        REGAIN_HOST_DEVICE static Real clamped(const Real& cosine)
        {
            return detail::min(detail::max(cosine, Real(0)), Real(1));
        }
        REGAIN_HOST_DEVICE static WalkPath<Real> finished(WalkPath<Real> p, const Vec3<Real>& d)
        {
            p.wi = detail::normalised(d);  // what the bounces have rounded off
            return p;
        }

        // Near the density of sample, per steradian; wi.z > 0.
        REGAIN_HOST_DEVICE Real density(const Vec3<Real>& wi) const
        {
            const Distribution& distribution = _closure._distribution;
            const Real once =
                first_density(detail::FacetReflection<Real>(distribution, _wo, wi), wi);
            if (_knows_rest) return once + _rest * _closure._later.at(_wo, wi);
            const Real carried =
                detail::carried_density(distribution, _wo, _visible.projected_area(), wi);
            return Real(0.98f) * (once + carried) +
                   wi.z * detail::constant<Real>(0.02 * 0.318309886183790671538);
        }

        BoundedWalk _closure;
        Mask _delta, _valid;
        Vec3<Real> _wo;
        Visible _visible;
        Color _weight;
        bool _knows_rest;
        Real _rest;
    };

    REGAIN_HOST_DEVICE Prepared prepare(const Vec3<Real>& wo) const { return Prepared(*this, wo); }

private:
    REGAIN_HOST_DEVICE bool isotropic() const
    {
        return detail::all<Real>(_distribution.alpha_x() == _distribution.alpha_y());
    }

    Distribution _distribution;
    Fresnel _fresnel;
    detail::LaterDensity<Real> _later;
    int _eval_samples, _bounces;
};

REGAIN_NAMESPACE_END
