// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A rough interface between two dielectrics with all its bounces, reflected and refracted, on
/// either side: the random walk of Heitz, Hanika, d'Eon and Dachsbacher 2016 on the Smith
/// microsurface, as a closure. It replaces the lobe; its first bounce is what Dielectric returns
/// with the `beta` form of shadowing. How a walk moves is told in microsurface_walk.h.
///
/// At each facet the walk is reflected with the probability F and refracted otherwise, so that no
/// energy is lost and R + T = 1. Where it is refracted it goes on along the other side of the same
/// surface, seen upside down: what was C1, the share of surface below a height, is 1 - C1. One can
/// cross any number of times.
///
///   sample   weight = tint of the side on which the walk leaves, unbiased
///   eval     an unbiased estimate of f |cos theta_i|, as energy: f(wo, wi) = eta_o^2 f(wi, wo).
///            The first bounce exactly, and of `eval_samples` walks the later bounces, each joined
///            with wi by reflection or refraction
///   pdf      near the density of sample, not equal to it. See walk.h for what that means to a host
///
/// The pdf is the density n(d) of first bounces, split by the probability e(d) that they leave,
///   reflected up      1 / (1 + Lambda_d / (1 + Lambda_o))     exact
///   refracted up      1 / (1 + Lambda_d (1 + Lambda_o))       near the beta form's, and cheap
///   down              0
/// The share n e is where it is. What is lost, n (1 - e), goes to either side by shares that were
/// fitted: reflected light, and refracted light that comes back, is carried from the sphere of
/// directions onto the hemisphere as in walk.h; refracted light that stays refracted keeps its
/// direction, mirrored where that points to the surface. A fiftieth is a cosine lobe on either
/// side. So the pdf integrates to 1, for any
/// distribution and index.
///
/// Both lobes only: what a walk would be that may only reflect, or only refract, is not defined,
/// and there is no parameter for it; scale a tint to 0 to see one side.
///
/// A flat surface (the distribution's delta limit) reflects and refracts in one direction each.
/// Where |eta - 1| alpha is at most Dielectric::delta_width the transmitted directions, still those
/// of the walk, are reported as delta: they have a density that no number type can tell.

#pragma once

#include <regain/closures/beta_function.h>
#include <regain/closures/dielectric.h>
#include <regain/closures/microsurface_walk.h>

REGAIN_NAMESPACE_BEGIN

template <class DistributionType>
class DielectricWalk
    : public Shorthands<DielectricWalk<DistributionType>, typename DistributionType::Real>
{
public:
    using Distribution = DistributionType;
    using Real = typename Distribution::Real;
    using Mask = MaskOf<Real>;
    using Color = Color3<Real>;
    static constexpr int random_numbers = 3;
    static constexpr bool stochastic_eval = true;

    /// eta: index on the -z side over index on the +z side, in [1e-2, 1e2], clamped, NaN becomes
    /// 1.5. Tints in [0, 1] per channel, clamped, NaN becomes 0: of all that leaves on a side,
    /// whatever it met before. eval_samples: walks that an eval takes, at least 1.
    REGAIN_HOST_DEVICE DielectricWalk(const Distribution& distribution, Real eta,
                                      const Color& reflection_tint = Color(Real(1)),
                                      const Color& transmission_tint = Color(Real(1)),
                                      int eval_samples = 1)
        : _lobe(distribution, eta, ScatterMode::RT, reflection_tint, transmission_tint,
                TransmissionShadowing::beta),
          _eval_samples(eval_samples < 1 ? 1 : eval_samples)
    {}

    REGAIN_HOST_DEVICE const Distribution& distribution() const { return _lobe.distribution(); }
    REGAIN_HOST_DEVICE Real eta() const { return _lobe.eta(); }
    REGAIN_HOST_DEVICE Color reflection_tint() const { return _lobe.reflection_tint(); }
    REGAIN_HOST_DEVICE Color transmission_tint() const { return _lobe.transmission_tint(); }
    REGAIN_HOST_DEVICE int eval_samples() const { return _eval_samples; }

    REGAIN_HOST_DEVICE Traits traits() const
    {
        Traits t = _lobe.traits();
        t.energy_preserving = true;
        t.exact_pdf = false;
        t.stochastic_eval = true;
        return t;
    }

    /// Works on the side of wo: what is seen from below is mirrored to above.
    class Prepared
    {
        using Depth = detail::WalkDepth<Real>;
        using Visible = decltype(std::declval<const Distribution&>().visible(Vec3<Real>()));

    public:
        REGAIN_HOST_DEVICE Prepared(const DielectricWalk& closure, const Vec3<Real>& wo)
            : _distribution(closure.distribution()),
              _samples(closure._eval_samples),
              _valid(detail::is_off_horizon(wo)),
              _flat(_distribution.is_delta()),
              _narrow(closure._lobe.transmits_delta()),
              _side(detail::select(detail::both<Real>(_valid, detail::quiet_less(wo.z, Real(0))),
                                   Real(-1), Real(1))),
              _wo(detail::normalised(
                  detail::select(_valid, turned(wo), Vec3<Real>(Real(0), Real(0), Real(1))))),
              _visible(_distribution.visible(_wo)),
              _ahead(closure._lobe.relative_index(Vec3<Real>(Real(0), Real(0), _side))),
              _behind(closure._lobe.relative_index(Vec3<Real>(Real(0), Real(0), -_side))),
              _T_to_T(transmitted_share(0.99)),
              _R_to_T(transmitted_share(0.88)),
              _reflection(closure.reflection_tint() * detail::select(_valid, Real(1), Real(0))),
              _transmission(closure.transmission_tint() * detail::select(_valid, Real(1), Real(0)))
        {}

        REGAIN_HOST_DEVICE Vec3<Real> wo() const { return turned(_wo); }

        /// Multiplies the closure weight: all that eval, sample and albedo return, and no direction
        /// or pdf.
        REGAIN_HOST_DEVICE void scale_by(const Color& weight)
        {
            _reflection *= weight;
            _transmission *= weight;
        }

        /// An unbiased estimate; u in [0, 1)^3.
        REGAIN_HOST_DEVICE Color eval(const Vec3<Real>& direction, const Vec3<Real>& u) const
        {
            const Vec3<Real> wi = safe(direction);
            const Mask beyond = wi.z < Real(0);
            const Vec3<Real> up = outward(wi);
            const Real area_i = _distribution.projected_area(-up);

            Real sum(0);
            const auto join = [&](const Vec3<Real>& v, const Real& area, const Mask& below,
                                  const Real& throughput, const Depth& depth, const Real& first) {
                const Mask reflects = !detail::differ<Real>(below, beyond);
                const RelativeIndex<Real> index = detail::select(below, _behind, _ahead);
                Real value(0);
                if (detail::any<Real>(reflects))
                    value = reflected(v, up, index) * depth.escape_probability(up.z, area_i);
                if (!detail::all<Real>(reflects))
                    value = detail::select(reflects, value,
                                           refracted(v, detail::mirrored(up), index) *
                                               depth.escape_beyond(up.z, area_i, first));
                sum += throughput * value / area;
            };
            for (int i = 0; i < _samples; ++i) trace<false>(detail::shifted_numbers(u, i), join);
            sum *= Real(1) / Real(static_cast<ScalarOf<Real>>(_samples));
            sum += first_bounce(up, area_i, beyond);
            return detail::select(answers(direction), tint(beyond) * sum, Color(Real(0)));
        }

        /// u in [0, 1)^3. The weight is not eval / pdf: see walk.h.
        REGAIN_HOST_DEVICE Sample<Real> sample(const Vec3<Real>& u) const
        {
            return sample_of(path(u));
        }

        /// A walk under way, for who goes on with many at a time: see wide_walks.h.
        struct Flight
        {
            Vec3<Real> v;              // against the ray, in the frame of the side on which it is
            Real area;                 // sigma(v)
            Mask below = Mask(false);  // that is the other side
            Real side, bounces;        // of wo, 1 above and -1 below; facets met
            Real first;                // the number that the depth of the first hit is drawn by
            Depth depth;
            RandomStream<Real> stream;

            template <class Numbers, class Masks>
            REGAIN_HOST_DEVICE void each(const Numbers& numbers, const Masks& masks)
            {
                for (Real* x : {&v.x, &v.y, &v.z, &area, &side, &bounces, &first}) numbers(*x);
                masks(below);
                depth.each(numbers, masks);
            }
        };
        /// After the first facet: where it has not left the surface.
        REGAIN_HOST_DEVICE Mask take_off(const Vec3<Real>& u, Flight& f) const
        {
            Real weight(1);
            return start<true>(u, f, weight);
        }
        /// One facet more for those in `active`, of which those that leave are taken out.
        REGAIN_HOST_DEVICE static void bounce(const DielectricWalk& closure, Flight& f,
                                              Mask& active)
        {
            const auto index = [&](const Real& side) {
                return closure._lobe.relative_index(Vec3<Real>(Real(0), Real(0), side));
            };
            Surface{closure.distribution(), index(f.side), index(-f.side),
                    closure._lobe.transmits_delta()}
                .bounce(f, active);
        }
        /// Where it has got to; `active` are those that are given up.
        REGAIN_HOST_DEVICE WalkPath<Real> land(const Flight& f, const Mask& active) const
        {
            // What has been given up leaves along its way: see walk_limit.
            const Mask inward = detail::both<Real>(active, f.v.z > Real(0));
            const Vec3<Real> v = detail::select(inward, detail::mirrored(f.v), f.v);
            const Mask below = detail::differ<Real>(f.below, inward);

            WalkPath<Real> p;
            const Vec3<Real> d = detail::normalised(-v);  // what the bounces have rounded off
            p.wi = turned(detail::select(below, detail::mirrored(d), d));
            p.weight = tint(below);
            p.bounces = f.bounces;
            p.escaped = Mask(true);
            p.transmitted = below;
            return p;
        }
        REGAIN_HOST_DEVICE Sample<Real> sample_of(const WalkPath<Real>& p) const
        {
            Sample<Real> s;
            s.valid = detail::both<Real>(_valid, p.escaped);
            s.transmitted = detail::both<Real>(s.valid, p.transmitted);
            s.delta =
                detail::both<Real>(s.valid, _flat | detail::both<Real>(_narrow, s.transmitted));
            s.wi = detail::select(s.valid, p.wi, Vec3<Real>(Real(0), Real(0), Real(1)));
            s.weight = detail::select(s.valid, p.weight, Color(Real(0)));
            const auto F = DielectricFresnel<Real>(_ahead).split(_wo.z);
            const Real choice = detail::select(s.transmitted, F.transmittance, F.reflectance);
            // One that cannot be, by the mean surface, may have been by a facet.
            const Real delta_pdf = detail::max(choice, detail::constant<Real>(1e-12));
            s.pdf = detail::select(
                s.valid, detail::select(s.delta, delta_pdf, density(turned(s.wi))), Real(0));
            return s;
        }

        REGAIN_HOST_DEVICE Real pdf(const Vec3<Real>& wi) const
        {
            return detail::select(answers(wi), density(safe(wi)), Real(0));
        }

        /// The mean weight of 1024 walks.
        REGAIN_HOST_DEVICE Albedo<Real> albedo() const { return detail::mean_weight<Real>(*this); }

        /// One walk, with what sample does not tell.
        REGAIN_HOST_DEVICE WalkPath<Real> path(const Vec3<Real>& u) const
        {
            return trace<true>(u, [](const auto&...) {});
        }

    private:
        // What facets do, to whichever walk.
        struct Surface
        {
            const Distribution& distribution;
            RelativeIndex<Real> ahead, behind;  // seen from the side of wo, and from the other
            Mask narrow;                        // light passes undeflected

            REGAIN_HOST_DEVICE static Real third(RandomStream<Real>& stream)
            {
                return Distribution::random_numbers > 2 ? stream.next() : Real(0);
            }
            REGAIN_HOST_DEVICE Real area_of(const Vec3<Real>& v) const
            {
                return detail::max(distribution.projected_area(v), detail::constant<Real>(1e-30));
            }

            REGAIN_HOST_DEVICE void bounce(Flight& f, Mask& active) const
            {
                const auto visible = distribution.visible(f.v);
                const Real x = f.stream.next(), y = f.stream.next();
                const Vec3<Real> m = visible.sample({x, y, third(f.stream)});
                scatter(f, m, f.stream.next(), active);
                f.bounces = detail::select(active, f.bounces + Real(1), f.bounces);
                f.area = area_of(f.v);
                active = detail::both<Real>(active, !passed(f));
                active = detail::both<Real>(
                    active, !f.depth.move(-f.v.z, f.area, f.stream.next(), f.first, active));
            }

            // Where transmission is a delta lobe the surface deflects nothing, and that it is
            // crossed again and again at grazing angles, about 1 / mu times, changes nothing.
            REGAIN_HOST_DEVICE Mask passed(const Flight& f) const
            {
                return detail::both<Real>(detail::both<Real>(narrow, f.below), f.v.z < Real(0));
            }

            // At the facet m, in the lanes `active`: v, against the ray that arrives, becomes what
            // is against the one that departs, in the frame of the side on which it does.
            REGAIN_HOST_DEVICE void scatter(Flight& f, const Vec3<Real>& m, const Real& choice,
                                            const Mask& active) const
            {
                const RelativeIndex<Real> index = detail::select(f.below, behind, ahead);
                const Real cosine = detail::dot(f.v, m);
                const Real F =
                    DielectricFresnel<Real>(index).reflectance(detail::clamped(cosine, 0, 1));
                const Vec3<Real> reflected = f.v - m * (Real(2) * cosine);
                const Mask crosses = detail::both<Real>(active, choice >= F);
                if (!detail::any<Real>(crosses))
                {
                    f.v = detail::select(active, reflected, f.v);
                    return;
                }
                const Refraction<Real> refraction = refract(f.v, m, index);
                const Mask passes = detail::both<Real>(crosses, refraction.valid);
                f.v = detail::select(passes, -detail::mirrored(refraction.wi),
                                     detail::select(active, reflected, f.v));
                f.depth.cross(f.first, passes);
                f.below = detail::differ<Real>(f.below, passes);
            }
        };

        REGAIN_HOST_DEVICE Real transmitted_share(double entering) const
        {
            return detail::select(_ahead.minus_one < Real(0), _ahead.eta * _ahead.eta * _wo.z,
                                  detail::constant<Real>(entering));
        }

        REGAIN_HOST_DEVICE Vec3<Real> turned(const Vec3<Real>& w) const
        {
            return {w.x, w.y, w.z * _side};
        }
        REGAIN_HOST_DEVICE static Vec3<Real> outward(const Vec3<Real>& w)
        {
            return {w.x, w.y, detail::abs(w.z)};
        }
        REGAIN_HOST_DEVICE Color tint(const Mask& beyond) const
        {
            return detail::select(beyond, _transmission, _reflection);
        }
        REGAIN_HOST_DEVICE Depth start() const { return Depth(_wo.z, _visible.projected_area()); }

        REGAIN_HOST_DEVICE Mask answers(const Vec3<Real>& wi) const
        {
            const Mask beyond = detail::quiet_less(wi.z * _side, Real(0));
            return detail::both<Real>(
                detail::both<Real>(_valid & !_flat, detail::is_off_horizon(wi)),
                !detail::both<Real>(_narrow, beyond));
        }
        // On the side of wo.
        REGAIN_HOST_DEVICE Vec3<Real> safe(const Vec3<Real>& wi) const
        {
            return detail::select(detail::is_off_horizon(wi), turned(wi),
                                  Vec3<Real>(Real(0), Real(0), Real(1)));
        }

        // sigma(v) times the density of wi after one facet, in the frame of v's side.
        REGAIN_HOST_DEVICE Real reflected(const Vec3<Real>& v, const Vec3<Real>& wi,
                                          const RelativeIndex<Real>& index) const
        {
            const detail::FacetReflection<Real> facet(_distribution, v, wi);
            return facet.quarter_D * DielectricFresnel<Real>(index).reflectance(facet.cosine);
        }
        REGAIN_HOST_DEVICE Real refracted(const Vec3<Real>& v, const Vec3<Real>& wi,
                                          const RelativeIndex<Real>& index) const
        {
            const detail::FacetRefraction<Real> facet(_distribution, v, wi, index);
            return facet.D_jacobian *
                   DielectricFresnel<Real>(index).transmittance(facet.cosine, facet.cosine_beyond);
        }

        // What leaves after one bounce; up is wi in the frame of its own side.
        REGAIN_HOST_DEVICE Real first_bounce(const Vec3<Real>& up, const Real& area_i,
                                             const Mask& beyond) const
        {
            const Real area = _visible.projected_area();
            Real value(0);
            if (!detail::all<Real>(beyond))
                value = reflected(_wo, up, _ahead) * start().escape_probability(up.z, area_i);
            if (detail::any<Real>(beyond))
                value = detail::select(
                    beyond,
                    refracted(_wo, detail::mirrored(up), _ahead) *
                        beta_quotient(_distribution.lambda(_wo), _distribution.lambda(up)),
                    value);
            return value / area;
        }

        // From wo to where the walk leaves; or, if it may not leave at the first bounce, with that
        // taken off its weight. join(v, sigma(v), side, weight, depth, first) is called at each
        // facet but the first, before it scatters; v points against the ray that arrives.
        template <bool leaves_at_once, class Join>
        REGAIN_HOST_DEVICE WalkPath<Real> trace(const Vec3<Real>& u, const Join& join) const
        {
            Flight f;
            Real weight(1);
            Mask active = start<leaves_at_once>(u, f, weight);
            const Surface surface{_distribution, _ahead, _behind, _narrow};
            for (int n = 1; n < walk_limit && detail::any<Real>(active); ++n)
            {
                join(f.v, f.area, f.below, detail::select(active, weight, Real(0)), f.depth,
                     f.first);
                surface.bounce(f, active);
            }
            WalkPath<Real> p = land(f, active);
            p.weight *= weight;
            return p;
        }

        // The first facet; where the walk has not left.
        template <bool leaves_at_once>
        REGAIN_HOST_DEVICE Mask start(const Vec3<Real>& u, Flight& f,
                                      [[maybe_unused]] Real& weight) const
        {
            const Surface surface{_distribution, _ahead, _behind, _narrow};
            f.stream = RandomStream<Real>(Vec3<Real>(u.z, u.x, u.y));
            f.first = f.stream.next();
            f.side = _side;
            f.bounces = Real(1);
            f.depth = start();
            f.v = _wo;
            const Vec3<Real> z(Real(0), Real(0), Real(1)),
                m = detail::select(_flat, z, _visible.sample({u.x, u.y, Surface::third(f.stream)}));
            surface.scatter(f, m, detail::saturate(u.z), Mask(true));
            f.area = surface.area_of(f.v);
            Mask active = detail::both<Real>(_valid, !_flat);
            active = detail::both<Real>(active, !surface.passed(f));
            const Real step = f.stream.next();
            if constexpr (!leaves_at_once)
            {
                weight = f.depth.stay(-f.v.z, f.area, step, f.first, active);
                return active;
            }
            return detail::both<Real>(active, !f.depth.move(-f.v.z, f.area, step, f.first, active));
        }

        // Near the density of sample, per steradian; wi on the side of wo.
        REGAIN_HOST_DEVICE Real density(const Vec3<Real>& wi) const
        {
            const Mask beyond = wi.z < Real(0);
            const Vec3<Real> up = outward(wi);
            const Real area_i = _distribution.projected_area(-up);
            const Real slope = Real(2) * up.z;
            const Vec3<Real> d(slope * up.x, slope * up.y, Real(1) - slope * up.z);
            const Real d_out = detail::max(d.z, Real(0)), area_d = _distribution.projected_area(-d);

            const Real lost_R = reflected(_wo, d, _ahead) * (Real(1) - leaves(d_out, area_d));
            const Real carried = Real(4) * up.z;
            Real value(0);
            if (!detail::all<Real>(beyond))
            {
                const Real lost_T = refracted(_wo, detail::mirrored(d), _ahead) *
                                    (Real(1) - leaves_beyond(d_out, area_d));
                value = reflected(_wo, up, _ahead) * leaves(up.z, area_i) +
                        carried * (lost_R * (Real(1) - _R_to_T) + lost_T * (Real(1) - _T_to_T));
            }
            if (detail::any<Real>(beyond))
            {
                const Real out = leaves_beyond(up.z, area_i);
                const Real through = refracted(_wo, detail::mirrored(up), _ahead) *
                                         (out + (Real(1) - out) * _T_to_T) +
                                     refracted(_wo, up, _ahead) * _T_to_T +
                                     carried * lost_R * _R_to_T;
                value = detail::select(beyond, through, value);
            }
            // Some of it everywhere: no facet that wo sees need lead to where a walk can. Where
            // light passes undeflected, what is left may be next to nothing.
            const Real even =
                detail::select(_narrow, detail::constant<Real>(1e-6), detail::constant<Real>(0.02));
            return (Real(1) - even) * value / _visible.projected_area() +
                   up.z * even * detail::constant<Real>(0.159154943091895336);
        }
        REGAIN_HOST_DEVICE Real leaves(const Real& z, const Real& area_i) const
        {
            const Real out = z * _visible.projected_area();
            return out / (out + area_i * _wo.z);
        }
        REGAIN_HOST_DEVICE Real leaves_beyond(const Real& z, const Real& area_i) const
        {
            const Real out = z * _wo.z;
            return out / (out + area_i * _visible.projected_area());
        }

        Distribution _distribution;
        int _samples;
        Mask _valid, _flat, _narrow;
        Real _side;      // 1 above, -1 below
        Vec3<Real> _wo;  // above
        Visible _visible;
        RelativeIndex<Real> _ahead, _behind;  // seen from wo, and from the other side
        // What becomes of light that does not leave at once, by measurement: nearly all of it ends
        // in the denser medium. Seen from there, eta_o^2 is the share of a diffuse flux that can
        // leave, and little can that travels flat.
        Real _T_to_T, _R_to_T;
        Color _reflection, _transmission;  // what multiplies the lobes
    };

    REGAIN_HOST_DEVICE Prepared prepare(const Vec3<Real>& wo) const { return Prepared(*this, wo); }

private:
    Dielectric<Distribution> _lobe;
    int _eval_samples;
};

REGAIN_NAMESPACE_END
