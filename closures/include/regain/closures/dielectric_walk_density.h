// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A density near that by which light leaves a dielectric interface that has met two or more of its
/// facets, for the pdf of bounded_dielectric_walk.h. On either side of the surface it is
///
///   r_b P(z) / (2 pi) 2 pi Phi(phi),    P(z) = z / (I (1 + t^2)^{3/2})
///   t = (z - c) / w_l where z < c, (z - c) / w_r beyond;    z = |cos theta_i|
///
/// r_b being the share of that side, and I the integral of the rest, in closed form: one hump, at
/// c, with a width below and a width above it. With c beyond 0 or 1 it climbs or falls throughout.
/// About the normal, with the N of walk_density.h,
///
///   2 pi Phi = 1 + m (2 pi N - 1),    m <= 0.96 / (1 - 2 pi N(pi))
///
/// m above 1 takes light from behind: it is nowhere less than 0.04. All that integrates to 1;
/// 0.03 of it is a cosine lobe on either side, so that the density is small nowhere where light is.
///
/// r, c, w_l, w_r, k and m are functions of polynomials of alpha, index, mu_o and `forward` of the
/// distribution, dielectric_walk_shape.h. They were fitted to walks of GGX and Beckmann, alpha 0.1
/// to 1, index 1.03 to 3 and from either side, for the least L1 distance where it is largest.

#pragma once

#include <regain/closures/dielectric_walk_shape.h>
#include <regain/closures/walk_density.h>

REGAIN_NAMESPACE_BEGIN
namespace detail {

/// `forward` of a distribution; without that table about that of GGX.
template <class Real, class Distribution>
REGAIN_HOST_DEVICE Real later_forward(const MicrofacetTables& shape,
                                      const Distribution& distribution)
{
    if (shape.has_later_shape())
        return saturate(shape.later_forward(TableAxes<Real>(distribution)));
    const Real narrow = Real(1) - sqrt(distribution.effective_alpha());
    return narrow * narrow;
}

template <class Real>
class LaterDielectricDensity
{
public:
    using Mask = MaskOf<Real>;

    LaterDielectricDensity() = default;

    /// alpha in (0, 1], forward in [0, 1], eta > 0 the index ahead of wo over the one behind,
    /// mu = |cos theta_o| in [0, 1].
    REGAIN_HOST_DEVICE LaterDielectricDensity(const Real& alpha, const Real& forward,
                                              const Real& eta, const Real& mu)
    {
        const Real one(1);
        Real of[values];
        find(of, alpha, forward, eta, min(mu, one));
        for (int b = 0; b < 2; ++b)
        {
            const Real* n = of + 5 * b;
            Side& s = _side[b];
            s.c = between(n[0], -0.5, 1.5);
            s.inv_below = exp(-between(n[1], -3.5, 1.5));
            s.inv_above = exp(-between(n[2], -3.5, 1.5));
            s.k = exp(between(n[3], -6, 2));
            s.m = Real(2) / (one + exp(-between(n[4], -3, 4)));
        }
        const Real share = one / (one + exp(-between(of[10], -10, 10)));
        _side[0].weight = share / _side[0].integral();
        _side[1].weight = (one - share) / _side[1].integral();
    }

    /// Per steradian; integrates to 1 over both sides. wi is beyond the surface or not.
    REGAIN_HOST_DEVICE Real at(const Vec3<Real>& wo, const Vec3<Real>& wi, const Mask& beyond) const
    {
        const Real z = min(abs(wi.z), Real(1)), one(1);
        const auto of = [&](Real Side::*member) {
            return select(beyond, _side[1].*member, _side[0].*member);
        };
        const Real from = z - of(&Side::c),
                   t = from * select(from < Real(0), of(&Side::inv_below), of(&Side::inv_above));
        const Real hump = one + t * t;
        const ForwardNormal<Real> normal(of(&Side::k), wo, wi);
        // Where N is 1 all around m does not matter.
        const Real m = min(of(&Side::m), constant<Real>(1 - least_azimuth) /
                                             max(one - normal.least, constant<Real>(1e-6)));
        const Real lobe =
            of(&Side::weight) / (hump * detail::sqrt(hump)) * (one + m * (normal.value - one));
        return constant<Real>(0.159154943091895335769) * z *
               (constant<Real>(1 - even) * lobe + constant<Real>(even));
    }

private:
    static constexpr double even = 0.03, least_azimuth = 0.04;
    static constexpr int terms = later_dielectric_terms, values = later_dielectric_values;

    // The polynomials.
    REGAIN_HOST_DEVICE static void find(Real (&of)[values], const Real& alpha, const Real& m,
                                        const Real& eta, const Real& mu)
    {
        // Beyond what was fitted the ends serve.
        const Real a = detail::sqrt(max(alpha, constant<Real>(0.1)));
        const Real q = abs(eta - Real(1)) / (eta + Real(1));
        const Real l = detail::log(between(q, 0.015, 0.55));
        const Real al = a * l, ll = l * l, lu = l * mu;
        const Real x[terms] = {Real(1), a,       l,      mu,     m,       a * a,  al,    a * mu,
                               a * m,   ll,      lu,     l * m,  mu * mu, mu * m, m * m, ll * l,
                               ll * mu, lu * mu, al * l, ll * m, al * mu, lu * m};
        const Mask inside = eta < Real(1);
        const bool all_inside = all<Real>(inside);
        sum(of, later_dielectric_shape(all_inside), x);
        if (all_inside || !any<Real>(inside)) return;
        Real of_inside[values];
        sum(of_inside, later_dielectric_shape(true), x);
        for (int j = 0; j < values; ++j) of[j] = select(inside, of_inside[j], of[j]);
    }
    REGAIN_HOST_DEVICE static void sum(Real (&of)[values], const float (&factors)[terms][values],
                                       const Real (&x)[terms])
    {
        for (int j = 0; j < values; ++j) of[j] = Real(factors[0][j]);
        for (int i = 1; i < terms; ++i)
            for (int j = 0; j < values; ++j) of[j] += Real(factors[i][j]) * x[i];
    }
    REGAIN_HOST_DEVICE static Real between(const Real& x, double low, double high)
    {
        return min(max(x, constant<Real>(low)), constant<Real>(high));
    }

    // What is reflected, and what is transmitted.
    struct Side
    {
        Real c = Real(0), inv_below = Real(1), inv_above = Real(1), k = Real(1), m = Real(0);
        Real weight = Real(0);

        // I above.
        REGAIN_HOST_DEVICE Real integral() const
        {
            const Real middle = min(max(c, Real(0)), Real(1));
            return part(Real(0), middle, inv_below) + part(middle, Real(1), inv_above);
        }
        // int_low^high z (1 + t^2)^{-3/2} dz.
        REGAIN_HOST_DEVICE Real part(const Real& low, const Real& high, const Real& inv_w) const
        {
            const Real w = Real(1) / inv_w;
            const auto antiderivative = [&](const Real& z) {
                const Real t = (z - c) * inv_w;
                return (c * t - w) / detail::sqrt(Real(1) + t * t);
            };
            return w * (antiderivative(high) - antiderivative(low));
        }
    };
    Side _side[2];
};

}  // namespace detail
REGAIN_NAMESPACE_END
