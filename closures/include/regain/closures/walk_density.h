// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Densities near those by which walks leave a conductor after their first bounce, for the pdfs
/// that go with walks. wo and wi are unit, above the horizon.

#pragma once

#include <regain/closures/microsurface_walk.h>
#include <regain/closures/table.h>

REGAIN_NAMESPACE_BEGIN
namespace detail {

/// Without tables. The density n(d) of first bounces along d that do not leave is known; carried
/// from the sphere onto the hemisphere, by halving the angle to -z, it is
///   4 cos theta_i n(2 cos theta_i (wi_x, wi_y, -wi_z) + z)
/// which integrates to 1 - E_ss exactly, for any distribution. area = sigma(wo).
template <class Distribution>
REGAIN_HOST_DEVICE typename Distribution::Real carried_density(
    const Distribution& distribution, const Vec3<typename Distribution::Real>& wo,
    const typename Distribution::Real& area, const Vec3<typename Distribution::Real>& wi)
{
    using Real = typename Distribution::Real;
    const Real slope = Real(2) * wi.z;
    const Vec3<Real> d(slope * wi.x, slope * wi.y, Real(1) - slope * wi.z);
    const FacetReflection<Real> lost(distribution, wo, d);
    const Real out = area * max(d.z, Real(0)), stay = distribution.projected_area(-d) * wo.z;
    return Real(4) * wi.z * lost.quarter_D * stay / (area * (out + stay));
}

/// Where about the normal walks leave: 2 pi N of azimuth_spread.h, by a normal distribution that
/// takes neither an exponential nor an error function,
///   N(phi) = (1 - g^2)^7 / (2 pi (1 + 9 g^2 + 9 g^4 + g^6) (1 + g^2 - 2 g cos phi)^4)
/// with the same curvature at its top, 4 g / (1 - g)^2 = w; it, too, integrates to 1.
template <class Real>
struct ForwardNormal
{
    Real value, least;  ///< 2 pi N, and that at phi = pi

    /// k >= 1e-6 in rad^2; wo and wi on whatever side.
    REGAIN_HOST_DEVICE ForwardNormal(const Real& k, const Vec3<Real>& wo, const Vec3<Real>& wi)
    {
        const Real tiny = constant<Real>(1e-30), one(1);
        const Real s = detail::sqrt((wo.x * wo.x + wo.y * wo.y) * (wi.x * wi.x + wi.y * wi.y)),
                   sum = abs(wo.z) + abs(wi.z);
        // w / 4, no narrower than there.
        const Real r = min(s * s / max(Real(8) * k * sum * sum * (s + k), tiny), Real(1250));
        const Real g = Real(2) * r / (Real(2) * r + one + detail::sqrt(Real(4) * r + one));
        // 1 + g^2 - 2 g cos phi, of 1 - cos phi.
        const Real away = max(s + wo.x * wi.x + wo.y * wi.y, Real(0)) / max(s, tiny);
        const Real g2 = g * g, left = (one - g) * (one - g) + Real(2) * g * away;
        const Real u = one - g2, q = u / left, q2 = q * q;
        const Real norm = one + g2 * (Real(9) + g2 * (Real(9) + g2));
        value = q2 * q2 * u * u * u / norm;
        const Real p = (one - g) / (one + g), p2 = p * p;
        least = p2 * p2 * u * u * u / norm;
    }
};

/// A part m of light spread by that, the rest any way.
template <class Real>
class ForwardAzimuth
{
public:
    /// Any way.
    ForwardAzimuth() = default;
    /// As `tables` have it of a distribution; any way where they do not.
    REGAIN_HOST_DEVICE ForwardAzimuth(const MicrofacetTables& tables, const TableAxes<Real>& axes)
    {
        if (!tables.has_later_shape()) return;
        const Real root = tables.later_spread(axes);
        _k = max(root * root, constant<Real>(1e-6));
        _m = saturate(tables.later_forward(axes));
    }

    /// 2 pi Phi; wo and wi on whatever side.
    REGAIN_HOST_DEVICE Real relative_density(const Vec3<Real>& wo, const Vec3<Real>& wi) const
    {
        return Real(1) + _m * (ForwardNormal<Real>(_k, wo, wi).value - Real(1));
    }

private:
    Real _k = Real(1), _m = Real(0);
};

/// With tables: the product of what both directions lose,
///   A(mu_i) mu_i / (pi <A>) 2 pi Phi(phi),    A = 1 - E_ss,  <A> = 1 - E_avg
/// and a twentieth of a cosine lobe, so that it is small nowhere where the walk is not. It is the
/// lobe of fitted_tail.h at F = 1, made quick: without its tilt.
template <class RealType>
class LaterDensity
{
public:
    using Real = RealType;

    /// Of `tables` it needs E_ss and E_avg; without spread and forward Phi is uniform.
    template <class Distribution>
    REGAIN_HOST_DEVICE LaterDensity(const Distribution& distribution,
                                    const MicrofacetTables& tables)
        : _tables(tables), _axes(distribution)
    {
        if (!bound()) return;
        // Where less is lost than this the lobe is nothing, and the rest is enough.
        const Real average = max(Real(1) - _tables.average_albedo(_axes), constant<Real>(1e-5));
        _scale = constant<Real>((1 - even) * 0.318309886183790671538) / average;
        _azimuth = ForwardAzimuth<Real>(tables, _axes);
    }

    REGAIN_HOST_DEVICE bool bound() const
    {
        return _tables.has_albedo() && _tables.has_average_albedo();
    }
    REGAIN_HOST_DEVICE const MicrofacetTables& tables() const { return _tables; }

    /// 1 - E_ss(mu).
    REGAIN_HOST_DEVICE Real lost(const Real& mu) const
    {
        return Real(1) - _tables.albedo(_axes, min(mu, Real(1)));
    }

    /// Per steradian; integrates to 1.
    REGAIN_HOST_DEVICE Real at(const Vec3<Real>& wo, const Vec3<Real>& wi) const
    {
        const Real lobe = lost(wi.z) * _scale * _azimuth.relative_density(wo, wi);
        return wi.z * (lobe + constant<Real>(even * 0.318309886183790671538));
    }

private:
    static constexpr double even = 0.05;

    MicrofacetTables _tables;
    TableAxes<Real> _axes;
    Real _scale = Real(0);
    ForwardAzimuth<Real> _azimuth;
};

}  // namespace detail
REGAIN_NAMESPACE_END
