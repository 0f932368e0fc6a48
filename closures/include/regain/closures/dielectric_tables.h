// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Albedo tables of rough dielectrics: what single scattering reflects and transmits in all,
/// E^S = E^R + E^T (Turquin 2019, Eq. 17, 18), and the share of it that is reflected, with exact
/// Fresnel inside, over three axes and for either side of the interface.
///
/// eta_o is the index ahead over the index behind, seen from wo: where wo is on the side of the
/// normal it is the interface's eta, on the other side 1 / eta. Side 0 is eta_o >= 1, side 1 is
/// eta_o < 1, where beyond the critical cosine kappa = sqrt(1 - eta_o^2) everything is reflected.
///
/// Axes, each with nodes at both ends:
///     x   of the cosine. With s(t, a) = sqrt(t / (t + a (1 - t))), which gathers nodes within a of
///         t = 0,
///           side 0   s(mu, alpha), as for conductors
///           side 1   kappa lies at the fixed coordinate c = 15/31, a node of 32,
///             of 63 and of 94, and
///             mu < kappa    c (0.6 s(t, a) + 0.4 (1 - s(1 - t, a))),  t = mu / kappa,
///                           a = alpha / kappa
///             mu >= kappa   c + (1 - c) s(t, a),  t = (mu - kappa) / (1 - kappa),
///                           a = alpha / (1 - kappa);   a is limited to 1
///         E^S of distributions with a tail changes at any cosine, however small alpha is, and
///         like a power of theta near normal incidence. Of these alpha counts as 0.05 at least,
///         and on side 0 and where mu >= kappa (s + 1 - sqrt(1 - s)) / 2 is in the place of s
///     y   sqrt(alpha)
///     z   (|eta - 1| / (eta + 1) / (3/5))^(1/4): 0 at eta 1, 1 at eta 4 and 1/4; beyond, the end
///         serves. Near 1 its square is proportional to the cosine at which Fresnel reflection sets
///         in, and it is small cosines that matter most.
///         E^S of the beta form falls steeply at cosines below alpha, and from inside the axis x
///         moves with kappa. So on side 1 it has, with r = (|eta - 1| / (eta + 1) / (3/5))^(1/2),
///         ln(1 + 200 r) / ln(201), and on its axis x, where mu >= kappa, a has no bend at 1:
///         a = alpha / (1 - kappa + alpha kappa)
///
/// The reflected share is tabulated less w F(mu), w = k / (k + alpha^2), k = |eta_o^2 - 1|: where
/// alpha is small, Fresnel's term at mu is the share of the surface, and what is left is smooth;
/// where alpha is larger than the cosine that Fresnel's term turns at, it has no part in the share.
/// E^S in the beta form falls to nothing at grazing angles, and so
/// is tabulated as a logarithm.
///
/// Of an anisotropic interface the tables are asked about one width, of its direction w:
///
///   a^2 = R^2 + b ((ax w.x)^2 + (ay w.y)^2 - R^2 (w.x^2 + w.y^2)),   R^2 = (ax^2 + ay^2) / 2
///
/// Near index 1 light goes straight on, and all masking is that of the width towards w: b = 1. What
/// is reflected, or bent far, leaves at all azimuths: b = exp(-8 r), r = |eta_o - 1| / (eta_o + 1),
/// and into the denser side, in the beta form, where what is transmitted is masked most,
/// b = 1 - 1.2 r, 0 at least. The cosine stays that of w, for so does the critical one. Errors are
/// in docs/methods.md: this is a help, not a solution.

#pragma once

#include <regain/closures/dielectric_fresnel.h>
#include <regain/closures/table.h>

REGAIN_NAMESPACE_BEGIN

namespace detail {

/// Where the critical cosine lies on the axis of side 1.
constexpr double critical_coordinate = 15.0 / 31.0;

/// The least alpha on the axis x of distributions with a tail.
constexpr float tail_least_width = 0.05f;

/// z above, of eta > 0.
template <class Real>
Real index_coordinate(Real eta)
{
    return sqrt(sqrt(
        min(abs(eta - Real(1)) / (eta + Real(1)) * constant<Real>(5.0 / 3.0), constant<Real>(1))));
}

/// The same of E^S of side 1 in the beta form.
template <class Real>
Real near_index_coordinate(Real eta)
{
    const Real r =
        sqrt(min(abs(eta - Real(1)) / (eta + Real(1)) * constant<Real>(5.0 / 3.0), Real(1)));
    return log1p(Real(200) * r) * constant<Real>(1 / 5.303304908059076);
}

/// w above.
template <class Real>
Real fresnel_weight(Real alpha, Real eta)
{
    const Real k = abs((eta - Real(1)) * (eta + Real(1)));
    return k / (k + alpha * alpha);
}

/// s above; mu in [0, 1], alpha in (0, 1].
template <class Real>
Real dielectric_cosine(Real mu, Real alpha, bool tail)
{
    const Real s = stretched_cosine(mu, alpha);
    return tail ? Real(0.5f) * (s + Real(1) - sqrt(max(Real(1) - s, Real(0)))) : s;
}

/// x of side 1 above: mu in [0, 1], alpha in (0, 1], eta in (0, 1).
template <class Real>
Real critical_cosine_coordinate(Real mu, Real alpha, Real eta, bool tail = false,
                                bool near_index = false)
{
    const Real one(1), tiny = constant<Real>(1e-6);
    const Real kappa = sqrt(max((one - eta) * (one + eta), constant<Real>(1e-12)));
    const Real below = min(mu / kappa, one), a = min(alpha / kappa, one);
    const Real left = constant<Real>(0.6) * stretched_cosine(below, a) +
                      constant<Real>(0.4) * (one - stretched_cosine(one - below, a));

    const Real room = max(one - kappa, tiny);
    const Real above = saturate((mu - kappa) / room);
    const Real a_above = near_index ? alpha / (room + alpha * kappa) : min(alpha / room, one);
    const Real right = dielectric_cosine(above, a_above, tail);

    const Real c = constant<Real>(critical_coordinate);
    return select(mu < kappa, c * left, c + (one - c) * right);
}

}  // namespace detail

/// The tables of one distribution and one form of transmission shadowing. Without them the default
/// is empty, and nothing may be looked up.
struct DielectricTables
{
    TableView E[2];            ///< E^S over (x, y, z), by side
    TableView R[2];            ///< E^R / E^S - w F(mu) over (x, y, z), by side
    bool logarithmic = false;  ///< E holds natural logarithms
    bool near_index = false;   ///< E[1] runs along z of the beta form
    bool tail = false;         ///< x is that of distributions with a tail
    /// Reflected share of later bounces over (x, y, z), by side: see dielectric_tail.h.
    TableView later[2];

    explicit operator bool() const { return E[0] && E[1] && R[0] && R[1]; }

    /// a above of a unit w and of `widths`, a distribution or its axes; eta_o > 0.
    template <class Widths, class Real>
    Real width(const Widths& widths, Real eta_o, const Vec3<Real>& w) const
    {
        const Real x = widths.alpha_x(), y = widths.alpha_y(), mean = widths.effective_alpha();
        const MaskOf<Real> same = x == y;
        if (detail::all<Real>(same)) return mean;
        const Real X = x * w.x, Y = y * w.y, s2 = w.x * w.x + w.y * w.y;
        const Real r = detail::abs(eta_o - Real(1)) / (eta_o + Real(1));
        Real b = detail::exp(Real(-8) * r);
        if (near_index)
            b = detail::select(eta_o >= Real(1),
                               detail::max(Real(1) - detail::constant<Real>(1.2) * r, Real(0)), b);
        const Real a = detail::sqrt(
            detail::max(mean * mean + b * (X * X + Y * Y - mean * mean * s2), Real(0)));
        return detail::select(same, mean, detail::min(detail::max(a, detail::min(x, y)), Real(1)));
    }

    /// E^S at the cosine mu = |wo.z| in [0, 1], at most 1. alpha in (0, 1], eta_o > 0.
    template <class Real>
    Real albedo(Real alpha, Real eta_o, Real mu) const
    {
        const Real found = look_up(E, near_index, alpha, eta_o, mu);
        return detail::min(logarithmic ? detail::exp(found) : found, Real(1));
    }

    /// E^R / E^S, in [0, 1]; arguments as above.
    template <class Real>
    Real reflected_share(Real alpha, Real eta_o, Real mu) const
    {
        const Real F = DielectricFresnel<Real>(eta_o).reflectance(mu);
        const Real w = detail::fresnel_weight(alpha, eta_o);
        return detail::saturate(w * F + look_up(R, false, alpha, eta_o, mu));
    }

    /// The reflected share of all that leaves after two facets or more, in [0, 1]; arguments as
    /// above. Needs `later`.
    template <class Real>
    Real later_reflected_share(Real alpha, Real eta_o, Real mu) const
    {
        return detail::saturate(look_up(later, false, alpha, eta_o, mu));
    }

private:
    template <class Real>
    Real look_up(const TableView (&table)[2], bool near, Real alpha, Real eta, Real mu) const
    {
        const Real width = tail ? detail::max(alpha, Real(detail::tail_least_width)) : alpha;
        const Real y = detail::sqrt(alpha);
        const MaskOf<Real> dense_ahead = eta >= Real(1);
        Real outside(1), inside(1);
        if (detail::any<Real>(dense_ahead))
            outside = table[0].at(detail::dielectric_cosine(mu, width, tail), y,
                                  detail::index_coordinate(eta));
        if (!detail::all<Real>(dense_ahead))
        {
            const Real below_1 = detail::select(dense_ahead, Real(0.5f), eta);
            inside = table[1].at(
                detail::critical_cosine_coordinate(mu, width, below_1, tail, near), y,
                near ? detail::near_index_coordinate(below_1) : detail::index_coordinate(below_1));
        }
        return detail::select(dense_ahead, outside, inside);
    }
};

REGAIN_NAMESPACE_END
