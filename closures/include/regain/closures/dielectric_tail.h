// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// `tail` of a rough dielectric: added lobes with the energy of the second and later bounces of the
/// random walk (dielectric_walk.h), and with its own split between reflection and transmission.
/// With L_o(mu) = 1 - E^S_o(mu), what single scattering reflects and transmits too little on side o
/// of the interface, r_o(mu) the share of it that the walk reflects, o' the other side and <g> =
/// 2 int_0^1 g mu dmu:
///
///   R_o = L_o - T_o,    T_o = s_o L_o (1 - r_o)
///
///   f_R(wo, wi) = R_o(wo) R_o(wi) / (pi <R_o>)      reflected
///   f_T(wo, wi) = T_o(wo) T_o'(wi) / (pi <T_o'>)    transmitted
///
/// As energies; their albedos are R_o(wo) and T_o(wo), so R + T = 1 whatever r_o and s_o are.
///
/// Reciprocity, f_T(wo, wi) = eta_o^2 f_T(wi, wo) with eta_o the index ahead of wo over the one
/// behind, asks <T_o> = eta_o^2 <T_o'>. The walk has it; of looked-up numbers there is a defect,
/// and s takes it. Inside, where eta_o < 1 and little is transmitted, s is what is missing for it,
/// so that little is changed, but no more than leaves R_o above 0; outside it is then at most 1. So
/// energy and reciprocity are exact whatever is looked up.
///
/// L_o and r_o come from DielectricTables of the distribution in the beta form of shadowing, which
/// is what the first bounce of the walk is, with `later`. A lobe that transmits by the correlated
/// form gets no added lobes: they would continue another model.
///
/// About the normal the added lobes are the same from all sides. Of an anisotropic surface L_o
/// depends on azimuth, too: <g> is then over azimuths besides, sampled is the mean over these, and
/// r_o is that of the mean width. Tints multiply the lobes once. A lobe of mode R or T gets its own
/// part of both. Building a closure asks the tables 300 times, of an anisotropic one 1050; per
/// point and direction it is two look-ups.

#pragma once

#include <regain/closures/anisotropy.h>
#include <regain/closures/dielectric_with_added_lobes.h>
#include <regain/closures/missing_energy.h>

REGAIN_NAMESPACE_BEGIN

/// The added lobes alone: black for a flat surface and without tables; of an isotropic one
/// symmetric about the normal.
template <class DielectricType>
class DielectricTailLobe
    : public Shorthands<DielectricTailLobe<DielectricType>, typename DielectricType::Real>
{
public:
    using Dielectric = DielectricType;
    using Real = typename Dielectric::Real;
    using Mask = MaskOf<Real>;
    using Color = Color3<Real>;
    static constexpr int random_numbers = 3;

    /// Of a dielectric with its tints and scatter mode. strength in [0, 1] scales the lobes;
    /// clamped, NaN becomes 0.
    REGAIN_HOST_DEVICE DielectricTailLobe(const Dielectric& lobe, const DielectricTables& tables,
                                          Real strength)
        : _tables(tables), _widths(lobe.distribution()), _black(lobe.distribution().is_delta())
    {
        const bool reflects = lobe.scatter_mode() != ScatterMode::T,
                   transmits = lobe.scatter_mode() != ScatterMode::R;
        _bound = tables && tables.later[0] && tables.later[1] &&
                 (!transmits || lobe.transmission_shadowing() == TransmissionShadowing::beta);

        const Vec3<Real> up(Real(0), Real(0), Real(1));
        const RelativeIndex<Real> index[] = {lobe.relative_index(up), lobe.relative_index(-up)};
        for (int o = 0; o < 2; ++o)
        {
            _eta[o] = index[o].eta;
            _scale[o] = Real(1);
        }
        if (_bound) balance(index, DirectionAxes<Real>(lobe.distribution()));

        const Real s = detail::saturate(strength);
        _reflection = reflects ? lobe.reflection_tint() * s : Color(Real(0));
        _transmission = transmits ? lobe.transmission_tint() * s : Color(Real(0));
    }

    REGAIN_HOST_DEVICE bool bound() const { return _bound; }

    /// What the added lobes reflect and transmit of a unit of light.
    struct Split
    {
        Real reflected, transmitted;
    };

    /// R_o and T_o of a unit wo above or below.
    REGAIN_HOST_DEVICE Split split(const Vec3<Real>& wo) const
    {
        const Mask below = wo.z < Real(0);
        const Split s = looked_up(detail::select(below, _eta[1], _eta[0]), wo);
        const Real lost = s.reflected + s.transmitted,
                   T = detail::min(detail::select(below, _scale[1], _scale[0]) * s.transmitted,
                                   lost);
        return {lost - T, T};
    }
    /// s_o of that side.
    REGAIN_HOST_DEVICE Real scale(int side) const { return _scale[side]; }

    REGAIN_HOST_DEVICE Traits traits() const
    {
        Traits t;
        t.reciprocal = true;
        t.exact_pdf = true;
        t.anisotropic = !detail::all<Real>(_widths.alpha_x() == _widths.alpha_y());
        t.transmissive = detail::any<Real>(total(_transmission) > Real(0));
        t.random_numbers = random_numbers;
        return t;
    }

    class Prepared
    {
    public:
        REGAIN_HOST_DEVICE Prepared(const DielectricTailLobe& lobe, const Vec3<Real>& wo)
            : _lobe(lobe),
              _valid(detail::is_off_horizon(wo)),
              _wo(detail::select(_valid, wo, Vec3<Real>(Real(0), Real(0), Real(1)))),
              _below(_wo.z < Real(0)),
              _split(lobe.split(_wo))
        {
            const Color none(Real(0));
            _reflection = detail::select(_valid, lobe._reflection, none);
            _transmission = detail::select(_valid, lobe._transmission, none);
            const Real R = total(_reflection) * _split.reflected,
                       T = total(_transmission) * _split.transmitted;
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
        REGAIN_HOST_DEVICE Real loss() const { return _split.reflected + _split.transmitted; }

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
            const Mask below = detail::differ<Real>(reflect, !_below);
            const Real x = detail::saturate(u.x);
            const Real mu = chosen(reflect, below, [&x](const Missing& m) { return m.sample(x); });
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
            return {_reflection * _split.reflected, _transmission * _split.transmitted};
        }

    private:
        struct Terms
        {
            Mask valid;
            Mask below;      // wi is
            Mask reflected;  // or else transmitted
            Vec3<Real> wi;
            Real mu;  // |cos theta_i|
        };
        REGAIN_HOST_DEVICE Terms terms(const Vec3<Real>& direction) const
        {
            Terms t;
            const Mask possible = detail::both<Real>(_valid, detail::is_off_horizon(direction));
            t.wi = detail::select(possible, direction, Vec3<Real>(Real(0), Real(0), Real(1)));
            const Real z = t.wi.z;
            t.below = z < Real(0);
            t.reflected = !detail::differ<Real>(t.below, _below);
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
            const Split i = _lobe.split(t.wi);
            const auto of_side = [&t](const Real(&side)[2]) {
                return detail::select(t.below, side[1], side[0]);
            };
            const Real R = _split.reflected * i.reflected * of_side(_lobe._inv_reflected),
                       T = _split.transmitted * i.transmitted * of_side(_lobe._inv_transmitted);
            return detail::select(t.reflected, _reflection * R, _transmission * T) * t.mu;
        }
        // Per steradian.
        REGAIN_HOST_DEVICE Real density(const Terms& t) const
        {
            const Real d =
                chosen(t.reflected, t.below, [&t](const Missing& m) { return m.density(t.mu); });
            return d * detail::select(t.reflected, _p, Real(1) - _p) *
                   detail::constant<Real>(0.159154943091895335769);
        }

        // f of what is sampled there, asked of as few as the lanes need.
        template <class F>
        REGAIN_HOST_DEVICE Real chosen(const Mask& reflected, const Mask& below, const F& f) const
        {
            Real result(0);
            const Mask above = !below, transmitted = !reflected;
            const auto add = [&](const Mask& lanes, const Missing& missing) {
                if (detail::any<Real>(lanes)) result = detail::select(lanes, f(missing), result);
            };
            add(detail::both<Real>(reflected, above), _lobe._reflected[0]);
            add(detail::both<Real>(reflected, below), _lobe._reflected[1]);
            add(detail::both<Real>(transmitted, above), _lobe._transmitted[0]);
            add(detail::both<Real>(transmitted, below), _lobe._transmitted[1]);
            return result;
        }

        DielectricTailLobe _lobe;
        Mask _valid;
        Vec3<Real> _wo;
        Mask _below;
        Split _split;  // at wo
        Real _p;       // probability of reflection
        Color _reflection, _transmission;
    };

    REGAIN_HOST_DEVICE Prepared prepare(const Vec3<Real>& wo) const { return Prepared(*this, wo); }

private:
    static constexpr int pieces = 3, cells = 24;
    using Missing = MissingEnergy<Real, pieces, cells>;

    REGAIN_HOST_DEVICE static Real total(const Color& c) { return c.x + c.y + c.z; }

    // 1 - E^S of a unit w, eta the index ahead over the one behind.
    REGAIN_HOST_DEVICE Real loss(Real eta, const Vec3<Real>& w) const
    {
        return detail::select(_black, Real(0), Real(1) - _tables.albedo(_widths, eta, w));
    }
    // Before s: L r and L (1 - r).
    REGAIN_HOST_DEVICE Split divided(Real lost, Real eta, Real mu) const
    {
        const Real R = lost * _tables.later_reflected_share(_widths.effective_alpha(), eta, mu);
        return {R, lost - R};
    }
    REGAIN_HOST_DEVICE Split looked_up(Real eta, const Vec3<Real>& w) const
    {
        if (!_bound) return {Real(0), Real(0)};
        return divided(loss(eta, w), eta, detail::min(detail::abs(w.z), Real(1)));
    }

    // Finds s, and what is sampled.
    REGAIN_HOST_DEVICE void balance(const RelativeIndex<Real> (&index)[2],
                                    const DirectionAxes<Real>& axes)
    {
        const Real tiny = detail::constant<Real>(1e-30), one(1);
        // Between nodes that see nothing missing there may be something.
        const Real least = detail::constant<Real>(1e-9);
        const Real inv_pi = detail::constant<Real>(0.318309886183790671538);
        // All four ask for the same cosines in the same order, so the tables are asked once.
        constexpr int places = pieces * (cells + 1);
        Split found[2][places];
        // r changes about the critical cosine as fast as that is small, however wide the loss is.
        const Real k = detail::sqrt(detail::abs(index[0].square_minus_one())) +
                       detail::constant<Real>(0.003),
                   alpha = _widths.effective_alpha(), width = alpha * k / (k + Real(4) * alpha);
        Real critical[2], most[2], average[2];
        for (int o = 0; o < 2; ++o)
        {
            // sqrt(1 - eta^2), 0 where there is no total reflection.
            critical[o] =
                detail::min(detail::sqrt(detail::max(-index[o].square_minus_one(), Real(0))),
                            detail::constant<Real>(0.9999));
            Real largest_share(0);
            int place = 0;
            const Missing transmitted(
                width,
                [&](Real mu) {
                    // All that is asked for is in proportion to the loss, so its mean will do.
                    const Real mean = axes.azimuth_mean(
                        mu, [&](const Vec3<Real>& w) { return loss(_eta[o], w); });
                    const Split s = divided(mean, _eta[o], mu);
                    const Real lost = detail::max(s.reflected + s.transmitted, tiny);
                    largest_share = detail::max(largest_share, s.transmitted / lost);
                    found[o][place++] = s;
                    return s.transmitted;
                },
                critical[o]);
            average[o] = transmitted.average();
            // The margin is for what lies between the nodes.
            most[o] = detail::max(one / (largest_share + detail::constant<Real>(0.05)), one);
        }

        // Of the side above, then of the inside.
        const Mask inside_below = _eta[0] >= one;
        const Real eta2 = _eta[0] * _eta[0];
        const Real below = eta2 * average[1], above = average[0];
        const Real excess = detail::max(detail::select(inside_below, above, below), tiny) /
                            detail::max(detail::select(inside_below, below, above), tiny);
        const Real inside = detail::min(excess, detail::select(inside_below, most[1], most[0]));
        const Real outside = inside / excess;
        _scale[0] = detail::select(inside_below, outside, inside);
        _scale[1] = detail::select(inside_below, inside, outside);

        for (int o = 0; o < 2; ++o)
        {
            int place = 0;
            const auto next = [&] {
                const Split& s = found[o][place++];
                const Real lost = s.reflected + s.transmitted;
                const Real T = detail::min(_scale[o] * s.transmitted, lost);
                return Split{lost - T, T};
            };
            _transmitted[o] = Missing(
                width, [&](Real) { return next().transmitted; }, critical[o]);
            place = 0;
            _reflected[o] = Missing(
                width, [&](Real) { return next().reflected; }, critical[o]);
            _inv_reflected[o] = inv_pi / detail::max(_reflected[o].average(), least);
        }
        _inv_transmitted[1] = inv_pi / detail::max(_scale[1] * average[1], least);
        _inv_transmitted[0] = _inv_transmitted[1] / eta2;
    }

    DielectricTables _tables;
    GlassWidths<Real> _widths;
    Mask _black;
    bool _bound;
    // By side of wo: above, below.
    Real _eta[2], _scale[2];
    Real _inv_reflected[2] = {Real(0), Real(0)}, _inv_transmitted[2] = {Real(0), Real(0)};
    Missing _reflected[2], _transmitted[2];
    Color _reflection, _transmission;
};

/// A Dielectric and its tail.
template <class LobeType>
class DielectricTail : public DielectricWithAddedLobes<LobeType, DielectricTailLobe<LobeType>>
{
public:
    using Lobe = LobeType;
    using Real = typename Lobe::Real;

    /// strength in [0, 1] scales the added lobes; clamped, NaN becomes 0. Without tables there are
    /// none.
    REGAIN_HOST_DEVICE DielectricTail(const Lobe& lobe, const DielectricTables& tables,
                                      Real strength = Real(1))
        : DielectricWithAddedLobes<Lobe, DielectricTailLobe<Lobe>>(lobe, {lobe, tables, strength},
                                                                   strength)
    {}
};

/// The dielectric compensated by its tail at strength s in [0, 1]. The tables, of its distribution
/// and the beta form of shadowing, serve the added lobes and, unless it has its own, its albedo.
template <class Distribution>
REGAIN_HOST_DEVICE DielectricTail<Dielectric<Distribution>> fitted_tail(
    Dielectric<Distribution> lobe, const DielectricTables& tables,
    typename Distribution::Real strength = typename Distribution::Real(1))
{
    const bool of_this_form = lobe.scatter_mode() == ScatterMode::R ||
                              lobe.transmission_shadowing() == TransmissionShadowing::beta;
    if (!lobe.tables() && of_this_form) lobe.set_tables(tables);
    return {lobe, tables, strength};
}

REGAIN_NAMESPACE_END
