// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Anisotropic rough glass in the tables of isotropic one. Of a direction w what single scattering
/// reflects and transmits in all is
///
///   E^S(w; ax, ay, eta) = E^S(|w.z|; a, eta) exp(D)
///   a^2 = R^2 w.z^2 + X^2 + Y^2,   R^2 = (ax^2 + ay^2) / 2,  X = ax w.x,  Y = ay w.y
///
/// a is the width towards w, R along the normal, where azimuths are all the same. The cosine stays
/// that of w, for so does the critical one. This much tells the masking of w, how far the edge of
/// total reflection is smeared and, near index 1, where light goes straight on, all. What facets
/// that lean across w change besides is D, a table over
///
///     x   of the cosine
///           eta >= 1   sqrt(mu / (mu + a (1 - mu)))
///           eta < 1    critical_cosine_coordinate(mu, a, eta) of the beta form (see
///                      dielectric_tables.h), which has the critical cosine kappa at c = 15/31; up
///                      to there 3/5 of the power 5/4 of it over c, beyond 3/5 and 2/5 of the
///                      power 3/2 of the rest. Of this v
///                        v (13/20 + 7/20 (1 + t) / (v + t)),   t = 1/15 + 1/5 of the fifth axis,
///                      as below mu ~ kappa^2 / (2 a), which is v = t for the widest, what is
///                      refracted at facets that lean towards w turns back to its side, and D
///                      changes most
///     y   of the azimuth, 0 along the wider axis, 1 along the narrower. With t = tan of it,
///         rho = the wider width over the narrower, and f(u) = u^2 / (1 + u^2), which is even about
///         either axis, as D is,
///             3/4 f(t / s) + 1/4 f(t / rho^(9/10))
///         Seen near the narrower axis a changes while t ~ rho. Seen from inside at angles beyond
///         the critical one, a grooved surface stops to let light out where the component of w
///         along the grooves is sqrt(1 - kappa^2) = eta, whatever the width: at
///         t^2 = eta^2 / (kappa^2 - mu^2), which is 3/8 or a little more of this axis, as
///             eta >= 1   s = 1
///             eta < 1    s^-4 = r^-4 + rho^-2,
///                        r = max(0.3, eta / sqrt(max(kappa^2 - mu^2, kappa^2 / 2)))
///         where r goes over into sqrt(rho), as beyond that the edge is where a changes anyway.
///     z   the power 3/4 of the wider width
///     4   ln rho / ln 20; D is 0 where rho is 1; beyond 20 its end serves
///     5   of u = (index_coordinate(eta) - 0.35) / 0.65, index 1.02 to 4 and inverses; beyond, the
///         ends serve
///           eta >= 1   u
///           eta < 1    (3 u - u^2) / 2, as near index 1 more depends on it
///
/// one for either side, by distribution and form of transmission shadowing.

#pragma once

#include <regain/closures/dielectric_axes.h>
#include <regain/closures/grid_view.h>

REGAIN_NAMESPACE_BEGIN

/// D above by side: 0 for eta >= 1, 1 for eta < 1.
struct DielectricAnisotropy
{
    GridView<5> change[2];
};

/// What the tables of glass are asked for a direction of an anisotropic lobe.
template <class Real>
struct AnisotropicGlassPlace
{
    Real alpha;  ///< a above
    Real x[5];   ///< coordinates of D

    /// Widths in (0, 1], w unit, of either side; eta > 0 the index ahead of w over the one behind.
    REGAIN_HOST_DEVICE AnisotropicGlassPlace(Real alpha_x, Real alpha_y, const Vec3<Real>& w,
                                             Real eta)
    {
        const Real one(1), tiny = detail::constant<Real>(1e-30);
        const MaskOf<Real> x_wider = alpha_x >= alpha_y;
        const Real wide = detail::max(alpha_x, alpha_y), narrow = detail::min(alpha_x, alpha_y);
        const Real mu = detail::min(detail::abs(w.z), one), x2 = w.x * w.x, y2 = w.y * w.y;
        const Real along2 = detail::select(x_wider, x2, y2),
                   across2 = detail::select(x_wider, y2, x2);

        alpha = towards(alpha_x, alpha_y, w);
        const Real rho = wide / narrow, log_rho = detail::log(rho);
        const MaskOf<Real> inside = eta < one;
        const auto f = [&](const Real& u2) {
            return across2 / detail::max(across2 + u2 * along2, tiny);
        };

        x[1] = Real(0.75f) * f(critical_tangent2(mu, rho, eta)) +
               Real(0.25f) * f(detail::exp(detail::constant<Real>(1.8) * log_rho));
        x[2] = detail::sqrt(wide * detail::sqrt(wide));
        x[3] = log_rho * detail::constant<Real>(1 / 2.995732273553991);
        const Real u = detail::max((detail::index_coordinate(eta) - detail::constant<Real>(0.35)) *
                                       detail::constant<Real>(1 / 0.65),
                                   Real(0));
        x[4] = detail::select(inside, Real(0.5f) * u * (Real(3) - u), u);
        x[0] = cosine(mu, eta, inside);
    }

    /// a above.
    REGAIN_HOST_DEVICE static Real towards(const Real& alpha_x, const Real& alpha_y,
                                           const Vec3<Real>& w)
    {
        const Real X = alpha_x * w.x, Y = alpha_y * w.y;
        const Real mean2 = Real(0.5f) * (alpha_x * alpha_x + alpha_y * alpha_y);
        const Real a = detail::sqrt(mean2 * w.z * w.z + X * X + Y * Y);
        return detail::min(detail::max(detail::min(alpha_x, alpha_y), a), Real(1));
    }

    /// s^2 above.
    REGAIN_HOST_DEVICE static Real critical_tangent2(const Real& mu, const Real& rho,
                                                     const Real& eta)
    {
        const Real one(1), kappa2 = (one - eta) * (one + eta);
        const Real r2 =
            detail::max(eta * eta /
                            detail::max(detail::max(kappa2 - mu * mu, Real(0.5f) * kappa2),
                                        detail::constant<Real>(1e-20)),
                        detail::constant<Real>(0.09));
        // r2 rho / sqrt(r2^2 + rho^2), of which neither square overflows.
        const Real part = rho / r2;
        return detail::select(eta < one, rho / detail::sqrt(one + part * part), one);
    }

private:
    // Needs x[4].
    REGAIN_HOST_DEVICE Real cosine(const Real& mu, const Real& eta,
                                   const MaskOf<Real>& inside) const
    {
        Real above = stretched_cosine(mu, alpha);
        if (!detail::any<Real>(inside)) return above;
        const Real c = detail::constant<Real>(detail::critical_coordinate),
                   before = detail::constant<Real>(0.6), beyond = detail::constant<Real>(0.4);
        const Real found = detail::critical_cosine_coordinate(
            mu, alpha, detail::select(inside, eta, before), false, true);
        const Real part = detail::min(found, c) / c,
                   rest = detail::max(found - c, Real(0)) / (Real(1) - c);
        const Real moved =
            before * part * detail::sqrt(detail::sqrt(part)) + beyond * rest * detail::sqrt(rest);
        const Real t = detail::constant<Real>(1 / 15.0) + detail::constant<Real>(0.2) * x[4];
        const Real spread = moved * (detail::constant<Real>(0.65) +
                                     detail::constant<Real>(0.35) * (Real(1) + t) / (moved + t));
        return detail::select(inside, spread, above);
    }
};

REGAIN_NAMESPACE_END
