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
typename Distribution::Real carried_density(const Distribution& distribution,
                                            const Vec3<typename Distribution::Real>& wo,
                                            const typename Distribution::Real& area,
                                            const Vec3<typename Distribution::Real>& wi)
{
    using Real = typename Distribution::Real;
    const Real slope = Real(2) * wi.z;
    const Vec3<Real> d(slope * wi.x, slope * wi.y, Real(1) - slope * wi.z);
    const FacetReflection<Real> lost(distribution, wo, d);
    const Real out = area * max(d.z, Real(0)), stay = distribution.projected_area(-d) * wo.z;
    return Real(4) * wi.z * lost.quarter_D * stay / (area * (out + stay));
}

/// With tables: the product of what both directions lose, with the azimuth of azimuth_spread.h,
///   A(mu_i) mu_i / (pi <A>) 2 pi Phi(phi),    A = 1 - E_ss,  <A> = 1 - E_avg
/// and a twentieth of a cosine lobe, so that it is small nowhere where the walk is not. It is the
/// lobe of fitted_tail.h at F = 1 but for what is made to be quick: there is no tilt, and the
/// normal distribution in Phi is one that takes neither exponential nor error function,
///   N(phi) = (1 - g^2)^7 / (2 pi (1 + 9 g^2 + 9 g^4 + g^6) (1 + g^2 - 2 g cos phi)^4)
/// with the same curvature at its top, 4 g / (1 - g)^2 = w; it, too, integrates to 1.
template <class RealType>
class LaterDensity
{
public:
    using Real = RealType;

    /// Of `tables` it needs E_ss and E_avg; without spread and forward Phi is uniform.
    template <class Distribution>
    LaterDensity(const Distribution& distribution, const MicrofacetTables& tables)
        : _tables(tables), _axes(distribution)
    {
        if (!bound()) return;
        // Where less is lost than this the lobe is nothing, and the rest is enough.
        const Real average =
            max(Real(1) - _tables.average_albedo(_axes), constant<Real>(1e-5));
        _scale = constant<Real>((1 - even) * 0.318309886183790671538) / average;
        if (!tables.spread || !tables.forward) return;
        const Real root = _axes.average(tables.spread);
        _spread = max(root * root, constant<Real>(1e-6));
        _forward = saturate(_axes.average(tables.forward));
    }

    bool bound() const { return _tables.E_ss && _tables.E_avg; }
    const MicrofacetTables& tables() const { return _tables; }

    /// 1 - E_ss(mu).
    Real lost(const Real& mu) const
    {
        return Real(1) - _tables.albedo(_axes, min(mu, Real(1)));
    }

    /// Per steradian; integrates to 1.
    Real at(const Vec3<Real>& wo, const Vec3<Real>& wi) const
    {
        const Real lobe = lost(wi.z) * _scale * relative_azimuth(wo, wi);
        return wi.z * (lobe + constant<Real>(even * 0.318309886183790671538));
    }

private:
    static constexpr double even = 0.05;

    // 2 pi Phi.
    Real relative_azimuth(const Vec3<Real>& wo, const Vec3<Real>& wi) const
    {
        const Real tiny = constant<Real>(1e-30), one(1);
        const Real s = detail::sqrt((wo.x * wo.x + wo.y * wo.y) * (wi.x * wi.x + wi.y * wi.y)),
                   sum = wo.z + wi.z;
        // w / 4 of azimuth_spread.h, no narrower than there; g / (1 - g)^2 is that.
        const Real r = min(s * s / max(Real(8) * _spread * sum * sum * (s + _spread), tiny),
                           Real(1250));
        const Real g = Real(2) * r / (Real(2) * r + one + detail::sqrt(Real(4) * r + one));
        const Real away = max(s + wo.x * wi.x + wo.y * wi.y, Real(0)) / max(s, tiny);
        // 1 + g^2 - 2 g cos phi, of 1 - cos phi.
        const Real g2 = g * g, left = (one - g) * (one - g) + Real(2) * g * away;
        const Real u = one - g2, q = u / left, q2 = q * q;
        const Real normal = q2 * q2 * u * u * u / (one + g2 * (Real(9) + g2 * (Real(9) + g2)));
        return one + _forward * (normal - one);
    }

    MicrofacetTables _tables;
    TableAxes<Real> _axes;
    Real _scale = Real(0), _spread = Real(1), _forward = Real(0);
};

}  // namespace detail
REGAIN_NAMESPACE_END
