// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The average of a Fresnel term over cosine-weighted directions,
///
///   F_ss = 2 int_0^1 F(mu) mu dmu        (Turquin 2019, below Eq. 7)
///
/// by the approximations in use and exactly. How far each is off is in docs/fresnel-averages.md,
/// which a test keeps true. Schlick's curve and its tint at 82 degrees have closed forms:
/// schlick_fresnel.h. The average() of a Fresnel term is what a closure uses; what is here serves
/// the terms themselves, comparison and hosts with curves of their own.
///
/// `fresnel` is anything with at(mu) as in constant_fresnel.h.

#pragma once

#include <regain/closures/vector.h>

REGAIN_NAMESPACE_BEGIN

/// Gauss-Jacobi quadrature for the weight 2 mu: exact where F is a polynomial of degree 5 (three
/// nodes) or 9 (five nodes).
template <int nodes, class Fresnel>
REGAIN_HOST_DEVICE auto gauss_jacobi_average(const Fresnel& fresnel)
{
    static_assert(nodes == 3 || nodes == 5, "three or five nodes");
    using Real = typename Fresnel::Real;
    constexpr double x3[] = {0.212340538239152943, 0.590533135559265289, 0.911412040487296052};
    constexpr double w3[] = {0.139653959802908245, 0.458482212719172493, 0.401863827477919261};
    constexpr double x5[] = {0.098535085798826426, 0.304535726646363905, 0.562025189752613856,
                             0.801986582126391827, 0.960190142948531258};
    constexpr double w5[] = {0.031495829043384552, 0.147817740145233341, 0.292773974169339617,
                             0.334349276188739131, 0.193563180453303359};
    Color3<Real> sum(Real(0));
    for (int i = 0; i < nodes; ++i)
        sum += fresnel.at(detail::constant<Real>(nodes == 3 ? x3[i % 3] : x5[i])) *
               detail::constant<Real>(nodes == 3 ? w3[i % 3] : w5[i]);
    return sum;
}

/// Gauss-Legendre quadrature of 2 mu F with four nodes.
template <class Fresnel>
REGAIN_HOST_DEVICE auto gauss_legendre_average(const Fresnel& fresnel)
{
    using Real = typename Fresnel::Real;
    constexpr double x[] = {0.0694318442029737124, 0.330009478207571868, 0.669990521792428132,
                            0.930568155797026288};
    constexpr double w[] = {0.173927422568726929, 0.326072577431273071, 0.326072577431273071,
                            0.173927422568726929};
    Color3<Real> sum(Real(0));
    for (int i = 0; i < 4; ++i)
        sum += fresnel.at(detail::constant<Real>(x[i])) * detail::constant<Real>(2 * x[i] * w[i]);
    return sum;
}

/// 2 int_0^1 f(mu) mu dmu of one channel, to 1e-8 and mostly to rounding: Gauss-Legendre with 64
/// nodes, gathered at 0, 1 and at `kink` in [0, 1), where f may have a square root's edge, as at
/// the critical angle. 64 evaluations: for checks and set-up.
template <class Real, class F>
REGAIN_HOST_DEVICE Real exact_average(const F& f, Real kink)
{
    constexpr double x[] = {
        0.005299532504175033, 0.027712488463383711, 0.067184398806084128, 0.122297795822498483,
        0.191061877798678125, 0.270991611171386306, 0.359198224610370543, 0.452493745081181279,
        0.547506254918818720, 0.640801775389629456, 0.729008388828613693, 0.808938122201321874,
        0.877702204177501516, 0.932815601193915871, 0.972287511536616288, 0.994700467495824966};
    constexpr double w[] = {
        0.013576229705877047, 0.031126761969323946, 0.047579255841246392, 0.062314485627766936,
        0.074797994408288366, 0.084578259697501269, 0.091301707522461794, 0.094725305227534248,
        0.094725305227534248, 0.091301707522461794, 0.084578259697501269, 0.074797994408288366,
        0.062314485627766936, 0.047579255841246392, 0.031126761969323946, 0.013576229705877047};
    // Without a kink the pieces still meet somewhere.
    const Real edge = detail::sanitised(kink, 0, 1, 0);
    const Real inner = detail::select(edge > Real(0), edge, Real(0.125f));
    Real sum(0);
    for (int piece = 0; piece < 4; ++piece)
    {
        const Real low = piece < 2 ? Real(0) : inner, high = piece < 2 ? inner : Real(1);
        const Real half = Real(0.5f) * (high - low);
        for (int i = 0; i < 16; ++i)
        {
            const Real y = half * detail::constant<Real>(x[i] * x[i] * x[i]);
            const Real mu = piece % 2 == 0 ? low + y : high - y;
            sum += f(mu) * mu * half * detail::constant<Real>(6 * x[i] * x[i] * w[i]);
        }
    }
    return sum;
}

/// The average of a conductor from its reflectance at normal incidence and at the cosine 1/7 alone:
/// Schlick's curve with the tint at 82 degrees through both has a closed form. Cycles' way.
template <class Fresnel>
REGAIN_HOST_DEVICE auto f82_average(const Fresnel& fresnel)
{
    using Real = typename Fresnel::Real;
    const auto F0 = fresnel.at(Real(1)), F82 = fresnel.at(detail::constant<Real>(1.0 / 7));
    const Color3<Real> edge = Color3<Real>(Real(1)) - F0;
    const Color3<Real> dip = F0 + edge * detail::constant<Real>(7776.0 / 16807) - F82;
    return F0 + edge * detail::constant<Real>(1.0 / 21) -
           dip * detail::constant<Real>(823543.0 / 46656 / 126);
}

/// Artist-friendly conductor of reflectivity r and edge tint g in [0, 1]: a cubic fit. Kulla and
/// Conty 2017.
template <class Real>
REGAIN_HOST_DEVICE Real kulla_conty_conductor_average(Real r, Real g)
{
    const auto c = [](double x) { return detail::constant<Real>(x); };
    return c(0.087237) + g * (c(0.0230685) + g * (c(-0.0864902) + g * c(0.0774594))) +
           r * (c(0.782654) + r * (c(-0.136432) + r * c(0.278708)) +
                g * (c(0.19744) + g * c(0.0360605) - r * c(0.2586)));
}

/// Dielectric of relative index eta, a rational fit above 1 and a cubic below, where it is to be
/// used down to 1/3. Kulla and Conty 2017.
template <class Real>
REGAIN_HOST_DEVICE Real kulla_conty_dielectric_average(Real eta)
{
    const auto c = [](double x) { return detail::constant<Real>(x); };
    const Real above = (eta - Real(1)) / (c(4.08567) + c(1.00071) * eta);
    const Real below = c(0.997118) + eta * (c(0.1014) + eta * (c(-0.965241) - eta * c(0.130607)));
    return detail::select(eta >= Real(1), above, below);
}

/// Dielectric of relative index eta in [1/3, 3]: d'Eon's fit, as OpenPBR Surface 1.1 states it;
/// below 1 by 1 - F_ss(eta) = eta^2 (1 - F_ss(1 / eta)).
template <class Real>
REGAIN_HOST_DEVICE Real deon_dielectric_average(Real eta)
{
    const auto c = [](double x) { return detail::constant<Real>(x); };
    const MaskOf<Real> below = eta < Real(1);
    const Real n = detail::select(below, Real(1) / detail::max(eta, c(1e-3)), eta);
    const Real quotient = (c(10893) * n - c(1438.2)) / (Real(1) + n * (c(10212) - c(774.4) * n));
    const Real average = detail::log(detail::max(quotient, c(1e-3)));
    return detail::select(below, Real(1) - eta * eta * (Real(1) - average), average);
}

REGAIN_NAMESPACE_END
