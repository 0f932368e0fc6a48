// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// `walk-bounded` of a rough interface between two dielectrics: the random walk of
/// dielectric_walk.h with a bound on the facets it meets, and an eval that is quieter for the time
/// it takes. What bounded_walk.h says holds here, but for the following.
///
/// The bound. Light that has not left after N facets goes straight on from the last one, whatever
/// else is in its way: where it is headed into the surface it leaves on the other side. No energy
/// is lost, and where the index is near 1 and light crosses the surface again and again at grazing
/// angles, hardly deflected, that is where it would get to. Of GGX, alpha 1, index 1.5, there is at
/// most 3e-3 of it beyond N = 8, seen from inside, and less than 1e-5 beyond N = 16, the default.
///
/// eval. What refracts is not the same seen from either side, K(v -> w) = (n_w / n_v)^2 K(w -> v)
/// with K = sigma(v) p(v -> w) and n the indices where v and w are. So the ratio of densities is
///
///   R = K_k sigma(v_1) / (K_1 sigma(w_k)) (n_2 / n_end)^2 product_2^{k-1} sigma(v_j) / sigma(w_j)
///
/// v_j being against the ray that arrives at facet j, w_j along the one that departs, and n_2 the
/// index behind the first facet. It enters the weights as it is, and at least an eighth of the
/// walks start from either end. Depths are drawn as soon as light crosses: microsurface_walk.h.
///
/// pdf. The first bounce exactly, and for the rest LaterDielectricDensity, scaled by what the
/// tables say is left; without them, for two alphas, and where transmission is a delta lobe, that
/// of dielectric_walk.h. The L1 distance to the density is at most 0.09 in the mean over wo, for
/// GGX and Beckmann of alpha up to 1 and index 1.1 to 3, from either side (docs/methods.md). The
/// pdf integrates to 1 as well as the tables know the sum of the beta form: 3e-3.

#pragma once

#include <regain/closures/beta_function.h>
#include <regain/closures/bounded_walk.h>
#include <regain/closures/dielectric_walk.h>
#include <regain/closures/dielectric_walk_density.h>
#include <regain/closures/microsurface_walk.h>

REGAIN_NAMESPACE_BEGIN

template <class DistributionType>
class BoundedDielectricWalk
    : public Shorthands<BoundedDielectricWalk<DistributionType>, typename DistributionType::Real>
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
    /// whatever it met before. eval_samples: walks that an eval takes, at least 1. `tables`, of
    /// this distribution and the beta form, and `forward` of `shape` sharpen the pdf.
    /// bounces: N, in [2, 32], clamped.
    REGAIN_HOST_DEVICE BoundedDielectricWalk(const Distribution& distribution, Real eta,
                                             const Color& reflection_tint = Color(Real(1)),
                                             const Color& transmission_tint = Color(Real(1)),
                                             int eval_samples = 1,
                                             const DielectricTables& tables = {},
                                             const MicrofacetTables& shape = {},
                                             int bounces = default_bounces)
        : _lobe(distribution, eta, ScatterMode::RT, reflection_tint, transmission_tint,
                TransmissionShadowing::beta, tables),
          _forward(detail::later_forward<Real>(shape, distribution)),
          _eval_samples(eval_samples < 1 ? 1 : eval_samples),
          _bounces(bounces < 2              ? 2
                   : bounces > most_bounces ? most_bounces
                                            : bounces)
    {}

    REGAIN_HOST_DEVICE const Distribution& distribution() const { return _lobe.distribution(); }
    REGAIN_HOST_DEVICE Real eta() const { return _lobe.eta(); }
    REGAIN_HOST_DEVICE Color reflection_tint() const { return _lobe.reflection_tint(); }
    REGAIN_HOST_DEVICE Color transmission_tint() const { return _lobe.transmission_tint(); }
    REGAIN_HOST_DEVICE int eval_samples() const { return _eval_samples; }
    REGAIN_HOST_DEVICE int bounces() const { return _bounces; }

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
    public:
        REGAIN_HOST_DEVICE Prepared(const BoundedDielectricWalk& closure, const Vec3<Real>& wo)
            : _distribution(closure.distribution()),
              _samples(closure._eval_samples),
              _bounces(closure._bounces),
              _valid(detail::is_off_horizon(wo)),
              _flat(_distribution.is_delta()),
              _narrow(closure._lobe.transmits_delta()),
              _eta(closure.eta()),
              _side(detail::select(detail::both<Real>(_valid, detail::quiet_less(wo.z, Real(0))),
                                   Real(-1), Real(1))),
              _wo(detail::normalised(
                  detail::select(_valid, turned(wo), Vec3<Real>(Real(0), Real(0), Real(1))))),
              _visible(_distribution.visible(_wo)),
              _ahead(closure._lobe.relative_index(Vec3<Real>(Real(0), Real(0), _side))),
              _behind(closure._lobe.relative_index(Vec3<Real>(Real(0), Real(0), -_side))),
              _knows_rest(closure._lobe.tables() && closure.isotropic()),
              _rest(lost(closure)),
              _reflection(closure.reflection_tint() * detail::select(_valid, Real(1), Real(0))),
              _transmission(closure.transmission_tint() * detail::select(_valid, Real(1), Real(0)))
        {
            if (_knows_rest)
                _later = {_distribution.effective_alpha(), closure._forward, _ahead.eta, _wo.z};
        }

        REGAIN_HOST_DEVICE Vec3<Real> wo() const { return turned(_wo); }

        /// Multiplies the closure weight: all that eval, sample and albedo return, and no direction
        /// or pdf.
        REGAIN_HOST_DEVICE void scale_by(const Color& weight)
        {
            _reflection *= weight;
            _transmission *= weight;
        }

        /// An estimate that is unbiased but for what the bound does; u in [0, 1)^3.
        REGAIN_HOST_DEVICE Color eval(const Vec3<Real>& direction, const Vec3<Real>& u) const
        {
            const Vec3<Real> wi = safe(direction);
            const Mask beyond = wi.z < Real(0);
            const Vec3<Real> up = outward(wi);

            Real sum(0), place(0);
            for (int i = 0; i < _samples; ++i)
            {
                const Vec3<Real> numbers = detail::shifted_numbers(u, i);
                // Not the stream of u itself, which the distribution may have drawn from.
                RandomStream<Real> stream(Vec3<Real>(numbers.z, numbers.x, numbers.y));
                const Real own = stream.next();
                // Of several walks, every other one from either end.
                place = i == 0 ? own : place + Real(0.5f);
                place = detail::select(place >= Real(1), place - Real(1), place);
                sum += later(up, beyond, place, numbers, stream);
            }
            sum *= Real(1) / Real(static_cast<ScalarOf<Real>>(_samples));
            sum += single(up, beyond);
            return detail::select(answers(direction), tint(beyond) * sum, Color(Real(0)));
        }

        /// u in [0, 1)^3. The weight is not eval / pdf: see walk.h.
        REGAIN_HOST_DEVICE Sample<Real> sample(const Vec3<Real>& u) const
        {
            const WalkPath<Real> p = path(u);
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
            RandomStream<Real> stream(Vec3<Real>(u.z, u.x, u.y));
            const Real first = stream.next();
            Flight flight(_wo, _visible);
            Depth depth(_wo.z, _visible.projected_area());
            Real bounces(1);
            Mask active = detail::both<Real>(_valid, !_flat);
            scatter(flight, depth, {u.x, u.y, third(stream)}, detail::saturate(u.z), first,
                    Mask(true), _ahead, _behind);
            for (int n = 1;; ++n)
            {
                active = detail::both<Real>(active, !passed(flight));
                active = detail::both<Real>(
                    active, !depth.move(-flight.v.z, flight.area, stream.next(), first, active));
                if (n == _bounces || !detail::any<Real>(active)) break;
                const Real x = stream.next(), y = stream.next(), z = third(stream);
                scatter(flight, depth, {x, y, z}, stream.next(), first, active, _ahead, _behind);
                bounces = detail::select(active, bounces + Real(1), bounces);
            }
            // What goes on leaves along its way.
            const Mask inward = detail::both<Real>(active, flight.v.z > Real(0));
            const Mask below = detail::differ<Real>(flight.below, inward);
            const Vec3<Real> d = detail::normalised(  // what the bounces have rounded off
                -detail::select(inward, detail::mirrored(flight.v), flight.v));

            WalkPath<Real> p;
            p.wi = turned(detail::select(below, detail::mirrored(d), d));
            p.weight = tint(below);
            p.bounces = bounces;
            p.escaped = Mask(true);
            p.transmitted = below;
            return p;
        }

    private:
        using Depth = detail::WalkDepth<Real>;
        using Visible = decltype(std::declval<const Distribution&>().visible(Vec3<Real>()));

        // 1 - E^S, not quite 0, so that the pdf is positive.
        REGAIN_HOST_DEVICE Real lost(const BoundedDielectricWalk& closure) const
        {
            if (!_knows_rest) return Real(0);
            return detail::max(
                Real(1) - closure._lobe.tables().albedo(_distribution.effective_alpha(), _ahead.eta,
                                                        detail::min(_wo.z, Real(1))),
                detail::constant<Real>(1e-4));
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

        // Light between two facets.
        struct Flight
        {
            REGAIN_HOST_DEVICE Flight(const Vec3<Real>& against, const Visible& normals)
                : v(against), visible(normals), area(detail::visible_area(visible)), below(false)
            {}

            Vec3<Real> v;     // against it, in the frame of the side it is on
            Visible visible;  // from its next facet
            Real area;        // sigma(v)
            Mask below;       // on the other side than where it started
        };
        REGAIN_HOST_DEVICE static Real third(RandomStream<Real>& stream)
        {
            return Distribution::random_numbers > 2 ? stream.next() : Real(0);
        }

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

        // sigma(v) times the density with which a facet on the side `from` sends what comes from v
        // along w, up to either side, where `to` tells the side; both in the frames of their sides.
        // The indices are those of that facet.
        REGAIN_HOST_DEVICE Real kernel(const Vec3<Real>& v, const Mask& from, const Vec3<Real>& w,
                                       const Mask& to, const RelativeIndex<Real>& index) const
        {
            const Mask crosses = detail::differ<Real>(from, to);
            Real value(0);
            if (!detail::all<Real>(crosses)) value = reflected(v, w, index);
            if (detail::any<Real>(crosses))
                value = detail::select(crosses, refracted(v, detail::mirrored(w), index), value);
            return value;
        }

        // What leaves after one bounce; up is wi in the frame of its own side.
        REGAIN_HOST_DEVICE Real single(const Vec3<Real>& up, const Mask& beyond) const
        {
            const Real area = _visible.projected_area();
            Real leaves(0);
            if (!detail::all<Real>(beyond))
                leaves =
                    Depth(_wo.z, area).escape_probability(up.z, _distribution.projected_area(-up));
            if (detail::any<Real>(beyond))
                leaves = detail::select(
                    beyond, beta_quotient(_distribution.lambda(_wo), _distribution.lambda(up)),
                    leaves);
            return kernel(_wo, Mask(false), up, beyond, _ahead) * leaves / area;
        }

        // An estimate of what leaves at later facets, by a walk from wo or, where `place` is beyond
        // its share, from wi. Sides are told from that end.
        REGAIN_HOST_DEVICE Real later(const Vec3<Real>& up, const Mask& beyond, const Real& place,
                                      const Vec3<Real>& u, RandomStream<Real>& stream) const
        {
            // What passes undeflected is not joined with anything. An eighth at least starts from
            // wo, since only that knows of light beyond the bound.
            const Real share = detail::select(_narrow, Real(1),
                                              Real(0.125f) + Real(0.75f) * up.z / (up.z + _wo.z));
            const Mask forward = place < share;
            const Mask turned_over = detail::both<Real>(!forward, beyond);
            const RelativeIndex<Real> ahead = detail::select(turned_over, _behind, _ahead),
                                      behind = detail::select(turned_over, _ahead, _behind);
            const Vec3<Real> start = detail::select(forward, _wo, up),
                             end = detail::select(forward, up, _wo);
            const Real p_start = detail::select(forward, share, Real(1) - share),
                       p_end = Real(1) - p_start;
            Visible seen = _visible;
            if (!detail::all<Real>(forward)) seen = _distribution.visible(start);
            const Real end_stay = _distribution.projected_area(-end), end_area = end_stay + end.z;

            const Real first = stream.next();
            Flight flight(start, seen);
            Depth depth(start.z, flight.area);
            Mask active = detail::both<Real>(_valid, !_flat);
            Real ratio = flight.area / end_area;
            scatter(flight, depth, {u.x, u.y, third(stream)}, detail::saturate(u.z), first, active,
                    ahead, behind);
            active = detail::both<Real>(active, !passed(flight));
            // R without what belongs to the end.
            const Real K = kernel(start, Mask(false), -flight.v, flight.below, ahead);
            const Real index2 = ahead.eta * ahead.eta;
            ratio *= detail::select(flight.below, index2, Real(1)) /
                     (detail::select(beyond, index2, Real(1)) *
                      detail::max(K, detail::constant<Real>(1e-30)));
            ratio = detail::min(ratio, detail::constant<Real>(1e20));

            // It may not leave at once: that is known exactly.
            Real stays = depth.stay(-flight.v.z, flight.area, stream.next(), first, active);
            Real weight(1), sum(0);
            for (int n = 2;; ++n)
            {
                // Join.
                const RelativeIndex<Real> index = detail::select(flight.below, behind, ahead);
                const Mask crosses = detail::differ<Real>(flight.below, beyond);
                const Real to_end = kernel(flight.v, flight.below, end, beyond, index);
                Real leaves = depth.escape_probability(end.z, end_stay);
                if (detail::any<Real>(crosses))
                    leaves = detail::select(crosses, depth.escape_beyond(end.z, end_stay, first),
                                            leaves);
                const Real R = detail::min(ratio * to_end, detail::constant<Real>(1e20));
                Real value = to_end * leaves / (p_start + p_end * R);
                if (n == _bounces)
                {
                    // What does not leave goes straight on; from wo only, as samples have it.
                    const Real through =
                        kernel(flight.v, flight.below, detail::mirrored(end), !beyond, index);
                    value += detail::select(
                        forward, (to_end * (Real(1) - leaves) + through) / p_start, Real(0));
                }
                sum += detail::select(active, weight * stays * (value / flight.area), Real(0));
                if (n == _bounces) break;

                // Go on.
                active = detail::both<Real>(active,
                                            stream.next() < detail::min(Real(2) * stays, Real(1)));
                if (!detail::any<Real>(active)) break;
                weight *= detail::max(stays, Real(0.5f));
                const Real before = flight.area;
                const Real x = stream.next(), y = stream.next(), z = third(stream);
                scatter(flight, depth, {x, y, z}, stream.next(), first, active, ahead, behind);
                active = detail::both<Real>(active, !passed(flight));
                ratio = detail::min(
                    ratio * before /
                        detail::max(flight.area - flight.v.z, detail::constant<Real>(1e-30)),
                    detail::constant<Real>(1e20));
                stays = depth.stay(-flight.v.z, flight.area, stream.next(), first, active);
            }
            // f(wo, wi) = eta_o^2 f(wi, wo) for what is transmitted.
            const Real other_way =
                detail::select(beyond, _ahead.eta * _ahead.eta, Real(1)) * up.z / _wo.z;
            return sum * detail::select(forward, Real(1), other_way);
        }

        // Where transmission is a delta lobe the surface deflects nothing, and that it is crossed
        // again and again at grazing angles, about 1 / mu times, changes nothing.
        REGAIN_HOST_DEVICE Mask passed(const Flight& f) const
        {
            return detail::both<Real>(detail::both<Real>(_narrow, f.below), f.v.z < Real(0));
        }

        // At the next facet, in the lanes `active`; indices ahead of light where it started, and on
        // the other side.
        REGAIN_HOST_DEVICE void scatter(Flight& f, Depth& depth, const Vec3<Real>& u,
                                        const Real& choice, const Real& first, const Mask& active,
                                        const RelativeIndex<Real>& ahead,
                                        const RelativeIndex<Real>& behind) const
        {
            const Vec3<Real> z(Real(0), Real(0), Real(1));
            const Vec3<Real> m = detail::select(_flat, z, f.visible.sample(u));
            const RelativeIndex<Real> index = detail::select(f.below, behind, ahead);
            const Real cosine = detail::dot(f.v, m);
            const Real F = DielectricFresnel<Real>(index).reflectance(
                detail::min(detail::max(cosine, Real(0)), Real(1)));
            const Vec3<Real> reflected = f.v - m * (Real(2) * cosine);
            const Mask crosses = detail::both<Real>(active, choice >= F);
            Vec3<Real> v = reflected;
            if (detail::any<Real>(crosses))
            {
                const Refraction<Real> refraction = refract(f.v, m, index);
                const Mask passes = detail::both<Real>(crosses, refraction.valid);
                v = detail::select(passes, -detail::mirrored(refraction.wi), reflected);
                depth.cross(first, passes);
                f.below = detail::differ<Real>(f.below, passes);
            }
            f.v = detail::select(active, v, f.v);
            f.visible = _distribution.visible(f.v);
            f.area = detail::visible_area(f.visible);
        }
        // Near the density of sample, per steradian; wi on the side of wo.
        REGAIN_HOST_DEVICE Real density(const Vec3<Real>& wi) const
        {
            Real value(0);
            // Where light passes undeflected there is nothing to know.
            const Mask unknown = _knows_rest ? _narrow : Mask(true);
            if (!detail::all<Real>(unknown))
            {
                const Mask beyond = wi.z < Real(0);
                const Vec3<Real> up = outward(wi);
                value = single(up, beyond) + _rest * _later.at(_wo, up, beyond);
            }
            if (detail::any<Real>(unknown))
            {
                const DielectricWalk<Distribution> plain(_distribution, _eta);
                value = detail::select(unknown, plain.prepare(wo()).pdf(turned(wi)), value);
            }
            return value;
        }

        Distribution _distribution;
        int _samples, _bounces;
        Mask _valid, _flat, _narrow;
        Real _eta;       // of the interface
        Real _side;      // 1 above, -1 below
        Vec3<Real> _wo;  // above
        Visible _visible;
        RelativeIndex<Real> _ahead, _behind;  // seen from wo, and from the other side
        bool _knows_rest;
        Real _rest;
        detail::LaterDielectricDensity<Real> _later;
        Color _reflection, _transmission;  // what multiplies the lobes
    };

    REGAIN_HOST_DEVICE Prepared prepare(const Vec3<Real>& wo) const { return Prepared(*this, wo); }

private:
    REGAIN_HOST_DEVICE bool isotropic() const
    {
        return detail::all<Real>(distribution().alpha_x() == distribution().alpha_y());
    }

    Dielectric<Distribution> _lobe;
    Real _forward;
    int _eval_samples, _bounces;
};

REGAIN_NAMESPACE_END
