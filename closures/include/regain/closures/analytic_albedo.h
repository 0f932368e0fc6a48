// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Formulas in place of the tables of GGX and Beckmann mirrors, for whoever has no room for a table
/// or no way to load one. MicrofacetTables takes them by analytic_tables.h; `regain bake --export`
/// writes the same formulas as GLSL and OSL.
///
/// With m = mu / (mu + alpha), which puts the dip of E_ss in the same place for every alpha, and
/// s = sqrt(alpha):
///
///   1 - E_ss   m N(m, alpha) / D(m, alpha)              N and D of degree 4 in m, 2 and 3 in alpha
///   1 - E_avg  alpha^2 (n0 + n1 alpha) / (1 + d1 alpha + d2 alpha^2 + d3 alpha^3)
///   q_ms       (q0 + q1 alpha) sqrt(mu)                                      directional_gain.h
///   mu_ms      m0 + m1 s + (m2 + m3 s) mu                                     "
///   falloff    (1 - c)^5,        c = mu + alpha N(m, s) / D(m, s)            fresnel_moments.h
///   dip        c (1 - c)^6 N(m, alpha) / D(m, alpha)                          "
///   spread, forward, tilt        cubics in s                                 fitted_tail.h
///
/// All come out of bench/fit_albedo.py, quotients with the least largest error that their form has;
/// q_ms and mu_ms are as simple as what walks say of them is certain. Domain: mu and alpha in
/// [0, 1]. There, by bench/fit_error and bench/albedo_error,
///
///   exact E_ss / this one       0.9982 to 1.0019, and 1 where alpha or mu is 0: so much does a
///                               gain by this E_ss leave in a white furnace
///   E_ss, E_avg                 1.8e-3, 1.3e-4
///   falloff, dip                1.7e-3, 4.4e-4
///   albedo of `directional`     with Schlick's term 4.5e-3, of metals 1.1e-2, from alpha 0.1 and
///                               mu 0.05
///
/// Constants are floats: float and double evaluate the same formula. In float E_ss is good to 1e-5,
/// since Beckmann's D falls to 0.006 of its terms.

#pragma once

#include <regain/closures/fresnel_moments.h>

REGAIN_NAMESPACE_BEGIN

namespace detail {

/// c0 + c1 x + c2 x^2 ...; coefficients are floats or numbers.
template <class Real, class C>
REGAIN_HOST_DEVICE Real polynomial(const Real&, const C& c)
{
    return Real(c);
}
template <class Real, class C, class... More>
REGAIN_HOST_DEVICE Real polynomial(const Real& x, const C& c, const More&... more)
{
    return Real(c) + x * polynomial(x, more...);
}

/// c[0] + c[1] y + c[2] y^2 + x (c[3] + c[4] y) + x^2 c[5].
template <class Real>
REGAIN_HOST_DEVICE Real quadratic(const Real& x, const Real& y, const float (&c)[6])
{
    return polynomial(x, polynomial(y, c[0], c[1], c[2]), polynomial(y, c[3], c[4]), c[5]);
}
/// The same of 1 and the others.
template <class Real>
REGAIN_HOST_DEVICE Real quadratic(const Real& x, const Real& y, const float (&c)[5])
{
    return polynomial(x, polynomial(y, 1.0f, c[0], c[1]), polynomial(y, c[2], c[3]), c[4]);
}

}  // namespace detail

/// The constants of one distribution and what they stand for. Arguments mu = cos theta_o and alpha
/// are in [0, 1].
struct MicrofacetFits
{
    float loss[10], loss_below[12];  ///< N by rows of m, 1; D without its first term, which is 1
    float average_loss[2], average_loss_below[3];
    float cosine[10], cosine_below[5], dip_ratio[6], dip_ratio_below[5];
    float later[6];  ///< q0, q1, m0 ... m3
    float spread_in_root[4], forward_in_root[4], tilt_in_root[4];

    /// Single-scattering albedo with F = 1, in [0, 1].
    template <class Real>
    REGAIN_HOST_DEVICE Real E_ss(const Real& mu, const Real& alpha) const
    {
        using detail::polynomial;
        const float(&n)[10] = loss;
        const float(&d)[12] = loss_below;
        const Real m = relative_cosine(mu, alpha), m2 = m * m;
        const Real above =
            polynomial(m, polynomial(alpha, n[0], n[1], n[2]), polynomial(alpha, n[3], n[4], n[5]),
                       polynomial(alpha, n[6], n[7], n[8]) + m2 * Real(n[9]));
        const Real below = polynomial(
            m, polynomial(alpha, 1.0f, d[0], d[1], d[2]), polynomial(alpha, d[3], d[4], d[5], d[6]),
            polynomial(alpha, d[7], d[8], d[9]), alpha * Real(d[10]), d[11]);
        return detail::min(Real(1.0f) - m * above / below, Real(1.0f));
    }

    /// 2 int_0^1 E_ss mu dmu.
    template <class Real>
    REGAIN_HOST_DEVICE Real E_avg(const Real& alpha) const
    {
        using detail::polynomial;
        const float(&n)[2] = average_loss;
        const float(&d)[3] = average_loss_below;
        return Real(1.0f) - alpha * alpha * polynomial(alpha, n[0], n[1]) /
                                polynomial(alpha, 1.0f, d[0], d[1], d[2]);
    }

    /// Of light past its second facet the share that goes on to another at each.
    template <class Real>
    REGAIN_HOST_DEVICE Real q_ms(const Real& mu, const Real& alpha) const
    {
        return detail::polynomial(alpha, later[0], later[1]) * detail::sqrt(mu);
    }
    /// The cosine at which later facets reflect.
    template <class Real>
    REGAIN_HOST_DEVICE Real mu_ms(const Real& mu, const Real& alpha) const
    {
        using detail::polynomial;
        const Real s = detail::sqrt(alpha);
        const Real line =
            polynomial(mu, polynomial(s, later[2], later[3]), polynomial(s, later[4], later[5]));
        return detail::max(detail::min(line, Real(1.0f)), Real(0.0f));
    }

    /// Means over what is scattered once.
    template <class Real>
    REGAIN_HOST_DEVICE FresnelMoments<Real> moments(const Real& mu, const Real& alpha) const
    {
        using detail::polynomial;
        const float(&n)[10] = cosine;
        const Real m = relative_cosine(mu, alpha), s = detail::sqrt(alpha);
        const Real above =
            polynomial(m, polynomial(s, n[0], n[1], n[2], n[3]), polynomial(s, n[4], n[5], n[6]),
                       polynomial(s, n[7], n[8]), n[9]);
        const Real line = mu + alpha * above / detail::quadratic(m, s, cosine_below);
        const Real c = detail::max(detail::min(line, Real(1.0f)), Real(0.0f));
        FresnelMoments<Real> result = FresnelMoments<Real>::at(c);
        result.dip = result.dip * detail::quadratic(m, alpha, dip_ratio) /
                     detail::quadratic(m, alpha, dip_ratio_below);
        return result;
    }

    /// sqrt(k), m and c of the later bounces' shape.
    template <class Real>
    REGAIN_HOST_DEVICE Real spread(const Real& alpha) const
    {
        return detail::max(in_root(alpha, spread_in_root), Real(0.02f));
    }
    template <class Real>
    REGAIN_HOST_DEVICE Real forward(const Real& alpha) const
    {
        return detail::max(detail::min(in_root(alpha, forward_in_root), Real(1.0f)), Real(0.0f));
    }
    template <class Real>
    REGAIN_HOST_DEVICE Real tilt(const Real& alpha) const
    {
        return in_root(alpha, tilt_in_root);
    }

private:
    /// m above; 0 where mu is.
    template <class Real>
    REGAIN_HOST_DEVICE static Real relative_cosine(const Real& mu, const Real& alpha)
    {
        return mu / detail::max(mu + alpha, Real(1e-30f));
    }
    template <class Real>
    REGAIN_HOST_DEVICE static Real in_root(const Real& alpha, const float (&c)[4])
    {
        return detail::polynomial(detail::sqrt(alpha), c[0], c[1], c[2], c[3]);
    }
};

/// Of GGX.
inline constexpr MicrofacetFits ggx_fits = {
    /*loss*/ {0.1625739f, -0.01293966f, 0.4220084f, 1.681513f, 0.06660581f, 11.93703f, -2.871557f,
              0.1456569f, -13.3036f, 1.02747f},
    /*loss_below*/
    {-3.302447f, 4.062903f, -1.665126f, 5.464622f, 4.264878f, -9.318538f, 5.009203f, -10.69172f,
     18.49522f, -0.08798255f, -22.24284f, 8.771738f},
    /*average_loss*/ {4.769988f, 15.06043f},
    /*average_loss_below*/ {11.54182f, 6.86855f, 14.14853f},
    /*cosine*/
    {7.56112f, 11.8216f, -22.80193f, 10.04163f, -12.14135f, -1.149803f, 0.656589f, 5.30149f,
     -10.76161f, -0.6273091f},
    /*cosine_below*/ {14.74887f, -1.34368f, -1.255622f, -9.478632f, 1.46723f},
    /*dip*/ {0.8745688f, 136.1685f, -106.1841f, -1.001909f, -1.299769f, 3.254772f},
    /*dip_below*/ {214.6005f, -172.9818f, -0.8543922f, -85.39671f, 3.005835f},
    /*later*/ {0.016f, 0.4497f, -0.0903f, 0.4983f, 0.2213f, -0.1797f},
    /*spread*/ {0.1287f, -0.3196f, 1.6033f, -0.9132f},
    /*forward*/ {0.6918f, 0.0422f, -2.2968f, 1.5655f},
    /*tilt*/ {1.0156f, 0.4788f, -4.2877f, 4.5499f}};

/// Of Beckmann.
inline constexpr MicrofacetFits beckmann_fits = {
    /*loss*/ {0.2150628f, -0.1776961f, 0.159827f, -0.6314601f, 0.3999477f, -0.4072639f, 0.5199166f,
              -0.2250105f, 0.2634076f, -0.1035193f},
    /*loss_below*/
    {-0.9570423f, 0.4087209f, -0.04276328f, -2.942392f, 2.247512f, -0.9342949f, 0.06600696f,
     2.569917f, -1.709448f, 0.7519454f, 0.1265459f, -0.577649f},
    /*average_loss*/ {0.483177f, -0.3774252f},
    /*average_loss_below*/ {-0.6733574f, 0.2312069f, -0.2433944f},
    /*cosine*/
    {0.8839723f, -0.1325971f, -0.9196656f, 0.5017039f, -1.948994f, 0.6128945f, 0.2647697f,
     1.158263f, -0.4203976f, -0.08957218f},
    /*cosine_below*/ {-0.293911f, 0.1115743f, -1.622387f, 0.05122532f, 0.8052827f},
    /*dip*/ {1.015761f, 0.8891319f, -1.12967f, -0.8478392f, 0.1377986f, -0.1357966f},
    /*dip_below*/ {2.266899f, -2.151052f, -0.8298966f, -1.268343f, -0.1378386f},
    /*later*/ {0.0849f, 0.0146f, -0.0454f, 0.1175f, -0.1425f, 0.5056f},
    /*spread*/ {-0.3941f, 2.479f, -4.327f, 3.0443f},
    /*forward*/ {0.8056f, 1.0738f, -1.7672f, 0.8621f},
    /*tilt*/ {1.3584f, -5.9982f, 12.4511f, -9.0775f}};

REGAIN_NAMESPACE_END
