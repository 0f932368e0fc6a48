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

/// Where about the normal walks leave: 2 pi Phi of azimuth_spread.h, by a normal distribution that
/// takes neither an exponential nor an error function,
///   N(phi) = (1 - g^2)^7 / (2 pi (1 + 9 g^2 + 9 g^4 + g^6) (1 + g^2 - 2 g cos phi)^4)
/// with the same curvature at its top, 4 g / (1 - g)^2 = w; it, too, integrates to 1.
template <class Real>
class ForwardAzimuth
{
public:
    /// Any way.
    ForwardAzimuth() = default;
    /// k > 0 in rad^2 and m in [0, 1].
    ForwardAzimuth(Real k, Real m) : _k(max(k, constant<Real>(1e-6))), _m(m) {}
    /// As `tables` have it of a distribution; any way where they do not.
    ForwardAzimuth(const MicrofacetTables& tables, const TableAxes<Real>& axes)
    {
        if (!tables.has_later_shape()) return;
        const Real root = tables.later_spread(axes);
        *this = {root * root, saturate(tables.later_forward(axes))};
    }

    Real spread() const { return _k; }
    Real forward() const { return _m; }

    /// 2 pi Phi; wo and wi on whatever side.
    Real relative_density(const Vec3<Real>& wo, const Vec3<Real>& wi) const
    {
        const Real tiny = constant<Real>(1e-30), one(1);
        const Real s = detail::sqrt((wo.x * wo.x + wo.y * wo.y) * (wi.x * wi.x + wi.y * wi.y)),
                   sum = abs(wo.z) + abs(wi.z);
        // w / 4, no narrower than there.
        const Real r = min(s * s / max(Real(8) * _k * sum * sum * (s + _k), tiny), Real(1250));
        const Real g = Real(2) * r / (Real(2) * r + one + detail::sqrt(Real(4) * r + one));
        // 1 + g^2 - 2 g cos phi, of 1 - cos phi.
        const Real away = max(s + wo.x * wi.x + wo.y * wi.y, Real(0)) / max(s, tiny);
        const Real g2 = g * g, left = (one - g) * (one - g) + Real(2) * g * away;
        const Real u = one - g2, q = u / left, q2 = q * q;
        const Real normal = q2 * q2 * u * u * u / (one + g2 * (Real(9) + g2 * (Real(9) + g2)));
        return one + _m * (normal - one);
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
    LaterDensity(const Distribution& distribution, const MicrofacetTables& tables)
        : _tables(tables), _axes(distribution)
    {
        if (!bound()) return;
        // Where less is lost than this the lobe is nothing, and the rest is enough.
        const Real average = max(Real(1) - _tables.average_albedo(_axes), constant<Real>(1e-5));
        _scale = constant<Real>((1 - even) * 0.318309886183790671538) / average;
        _azimuth = ForwardAzimuth<Real>(tables, _axes);
    }

    bool bound() const { return _tables.has_albedo() && _tables.has_average_albedo(); }
    const MicrofacetTables& tables() const { return _tables; }

    /// 1 - E_ss(mu).
    Real lost(const Real& mu) const { return Real(1) - _tables.albedo(_axes, min(mu, Real(1))); }

    /// Per steradian; integrates to 1.
    Real at(const Vec3<Real>& wo, const Vec3<Real>& wi) const
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

/// The same of light that has met two or more facets of a dielectric interface, by closed forms
/// that were fitted to walks of GGX and Beckmann at index 1.5. eta is the index ahead of wo over
/// the one behind, mu_o = |cos theta_o|, z = |cos theta_i|, and each lobe is normalised:
///
///   eta >= 1   transmitted   0.985          z^(1 + 0.8 alpha)
///              reflected     0.015          z / (z + 1/2)
///   eta < 1    transmitted   b              z / (z + 3/10)
///              reflected     1 - b          (1 - mu_o) z / (z + mu_o + 1/5)^2 + mu_o z
///              b = eta^2 mu_o (0.3 + (1 - m)(0.3 + 0.15 alpha) + 2 (eta - 2/3)), the bracket in
///                  [0.25, 1.2]
///
/// times 2 pi Phi. With k and m those of conductors, its own are k (1 - alpha m / 2) and
/// 1 - (1 - m) / 2 outside, k (1 - 0.8 alpha^2 m) and 1 - 0.4 (1 - m) inside. A twentieth is a
/// cosine lobe on either side.
template <class Real>
class LaterDielectricDensity
{
public:
    LaterDielectricDensity(const ForwardAzimuth<Real>& azimuth, const Real& alpha, const Real& eta,
                           const Real& mu)
        : _inside(eta < Real(1)), _mu(min(mu, Real(1))), _power(Real(1) + Real(0.8f) * alpha)
    {
        const Real one(1), m = azimuth.forward(), any_way = one - m;
        const Real narrower = select(_inside, constant<Real>(0.8) * alpha * alpha, alpha / Real(2));
        _azimuth = {azimuth.spread() * (one - narrower * m),
                    one - any_way * select(_inside, constant<Real>(0.4), Real(0.5f))};
        const Real steepness = constant<Real>(0.3) + any_way * constant<Real>(0.3) +
                               any_way * alpha * constant<Real>(0.15) +
                               Real(2) * (eta - constant<Real>(2.0 / 3));
        const Real slope = max(min(steepness, constant<Real>(1.2)), constant<Real>(0.25));
        _passes = select(_inside, min(eta * eta * _mu * slope, constant<Real>(0.95)),
                         constant<Real>(0.985));
        _shift = _mu + constant<Real>(0.2);
        _inv_norm =
            Real(1) / (detail::log((Real(1) + _shift) / _shift) - Real(1) / (Real(1) + _shift));
    }

    /// Per steradian; integrates to 1 over both sides. wi is beyond the surface or not.
    Real at(const Vec3<Real>& wo, const Vec3<Real>& wi, const MaskOf<Real>& beyond) const
    {
        const Real z = min(abs(wi.z), Real(1)), one(1);
        // 2 int_0^1 z / (z + q) dz = 2 (1 - q ln((1 + q) / q)).
        const Real near = z / (z + constant<Real>(0.3)) * constant<Real>(1 / 0.5600987895),
                   far = z / (z + constant<Real>(0.5)) * constant<Real>(1 / 0.4506938557);
        const Real steep = z + _shift;
        const Real back = (one - _mu) * z * _inv_norm / (steep * steep) + _mu * Real(2) * z;
        Real through = near;
        if (!all<Real>(_inside))
            through = select(_inside, near,
                             (one + _power) * detail::pow(max(z, constant<Real>(1e-12)), _power));
        const Real polar =
            select(beyond, _passes * through, (one - _passes) * select(_inside, back, far));
        return constant<Real>(0.159154943091895335769) *
               (constant<Real>(0.95) * polar * _azimuth.relative_density(wo, wi) +
                constant<Real>(0.05) * z);
    }

private:
    ForwardAzimuth<Real> _azimuth;
    MaskOf<Real> _inside;
    Real _mu, _power;
    Real _passes;            // b
    Real _shift, _inv_norm;  // mu_o + 1/5, and the integral of z / (z + that)^2
};

}  // namespace detail
REGAIN_NAMESPACE_END
