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
/// Of an anisotropic interface they are asked about one width, of its direction w, and what that
/// leaves of E^S is one more table, over five axes: see dielectric_anisotropy.h. The reflected
/// share goes by that width alone; E^S, where there is no such table, by
///
///   a^2 = R^2 + b ((ax w.x)^2 + (ay w.y)^2 - R^2 (w.x^2 + w.y^2)),   R^2 = (ax^2 + ay^2) / 2
///
/// Near index 1 light goes straight on, and all masking is that of the width towards w: b = 1. What
/// is reflected, or bent far, leaves at all azimuths: b = exp(-8 r), r = |eta_o - 1| / (eta_o + 1),
/// and into the denser side, in the beta form, where what is transmitted is masked most,
/// b = 1 - 1.2 r, 0 at least. Errors are in docs/methods.md.

#pragma once

#include <regain/closures/dielectric_anisotropy.h>
#include <regain/closures/dielectric_fresnel.h>

REGAIN_NAMESPACE_BEGIN

/// The widths of a distribution, for whoever keeps nothing else of it.
template <class RealType>
class GlassWidths
{
public:
    using Real = RealType;
    template <class Distribution>
    REGAIN_HOST_DEVICE explicit GlassWidths(const Distribution& distribution)
        : _x(distribution.alpha_x()),
          _y(distribution.alpha_y()),
          _mean(distribution.effective_alpha())
    {}
    REGAIN_HOST_DEVICE Real alpha_x() const { return _x; }
    REGAIN_HOST_DEVICE Real alpha_y() const { return _y; }
    REGAIN_HOST_DEVICE Real effective_alpha() const { return _mean; }

private:
    Real _x, _y, _mean;
};

/// What single scattering keeps of the light: the part of DielectricTables that a gain needs.
struct DielectricLossTables
{
    TableView E[2];            ///< E^S over (x, y, z), by side
    bool logarithmic = false;  ///< E holds natural logarithms
    bool near_index = false;   ///< E[1] runs along z of the beta form
    bool tail = false;         ///< x is that of distributions with a tail
    /// What anisotropic lobes take besides; nothing else reads it. It is kept by whoever made it.
    const DielectricAnisotropy* anisotropy = nullptr;

    /// a above of a unit w and of `widths`, a distribution or its axes; eta_o > 0.
    template <class Widths, class Real>
    REGAIN_HOST_DEVICE Real width(const Widths& widths, Real eta_o, const Vec3<Real>& w) const
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
    REGAIN_HOST_DEVICE Real albedo(Real alpha, Real eta_o, Real mu) const
    {
        const Real found = look_up(E, near_index, alpha, eta_o, mu);
        return detail::min(logarithmic ? detail::exp(found) : found, Real(1));
    }

    /// E^S of a unit w of either side and of `widths`, a distribution or its axes; eta_o > 0 the
    /// index ahead of w over the one behind.
    template <class Widths, class Real>
    REGAIN_HOST_DEVICE Real albedo(const Widths& widths, Real eta_o, const Vec3<Real>& w) const
    {
        const Real x = widths.alpha_x(), y = widths.alpha_y();
        const Real mu = detail::saturate(detail::abs(w.z));
        const MaskOf<Real> same = x == y;
        if (detail::all<Real>(same)) return albedo(widths.effective_alpha(), eta_o, mu);
        if (!anisotropy) return albedo(width(widths, eta_o, w), eta_o, mu);

        const AnisotropicGlassPlace<Real> place(x, y, w, eta_o);
        const Real alpha = detail::select(same, widths.effective_alpha(), place.alpha);
        const MaskOf<Real> dense_ahead = eta_o >= Real(1);
        Real outside(0), inside(0);
        if (detail::any<Real>(dense_ahead)) outside = anisotropy->change[0].at(place.x);
        if (!detail::all<Real>(dense_ahead)) inside = anisotropy->change[1].at(place.x);
        const Real change = detail::exp(
            detail::select(same, Real(0), detail::select(dense_ahead, outside, inside)));
        return detail::min(albedo(alpha, eta_o, mu) * change, Real(1));
    }

protected:
    template <class Real>
    REGAIN_HOST_DEVICE Real look_up(const TableView (&table)[2], bool near, Real alpha, Real eta,
                                    Real mu) const
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

/// What a lobe needs of them to know its own albedo. Without them the default is empty, and nothing
/// may be looked up.
struct DielectricAlbedoTables : DielectricLossTables
{
    TableView R[2];  ///< E^R / E^S - w F(mu) over (x, y, z), by side

    REGAIN_INLINE explicit operator bool() const { return E[0] && E[1] && R[0] && R[1]; }

    /// E^R / E^S, in [0, 1]; arguments as of the first.
    template <class Real>
    REGAIN_HOST_DEVICE Real reflected_share(Real alpha, Real eta_o, Real mu) const
    {
        const Real F = DielectricFresnel<Real>(eta_o).reflectance(mu);
        const Real w = detail::fresnel_weight(alpha, eta_o);
        return detail::saturate(w * F + look_up(R, false, alpha, eta_o, mu));
    }

    /// The same of a unit w of either side and of `widths`.
    template <class Widths, class Real>
    REGAIN_HOST_DEVICE Real reflected_share(const Widths& widths, Real eta_o,
                                            const Vec3<Real>& w) const
    {
        const Real x = widths.alpha_x(), y = widths.alpha_y();
        const Real mu = detail::min(detail::abs(w.z), Real(1));
        const MaskOf<Real> same = x == y;
        if (detail::all<Real>(same)) return reflected_share(widths.effective_alpha(), eta_o, mu);
        const Real towards = AnisotropicGlassPlace<Real>::towards(x, y, w);
        return reflected_share(detail::select(same, widths.effective_alpha(), towards), eta_o, mu);
    }
};

/// The tables of one distribution and one form of transmission shadowing.
struct DielectricTables : DielectricAlbedoTables
{
    /// Reflected share of later bounces over (x, y, z), by side: see dielectric_tail.h.
    TableView later[2];

    /// The reflected share of all that leaves after two facets or more, in [0, 1]; arguments as
    /// above. Needs `later`.
    template <class Real>
    REGAIN_HOST_DEVICE Real later_reflected_share(Real alpha, Real eta_o, Real mu) const
    {
        return detail::saturate(look_up(later, false, alpha, eta_o, mu));
    }
};

REGAIN_NAMESPACE_END
