// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// GGX as the papers print it, for the closures that faults are planted in; apart from the
/// library's, so that the kit is not tested on what it was written beside.
///
///   D(m)    = 1 / (pi ax ay ((mx/ax)^2 + (my/ay)^2 + mz^2)^2)            Burley 2012, B.1
///   G1(w)   = 2 cos / (cos + t),  t^2 = (ax wx)^2 + (ay wy)^2 + wz^2     Heitz 2014, Eqs. 43, 72
///   G2/(4 cos_o cos_i) = 1 / (2 (cos_i t_o + cos_o t_i))                 Heitz 2014, Eq. 99
///
/// Visible normals by spherical caps: Dupuy and Benyoub 2023.

#pragma once

#include <regain/closures/vector.h>

#include <algorithm>
#include <cmath>

namespace regain::planted {

template <class Real>
constexpr Real pi = Real(3.14159265358979323846);

/// Widths clamped to what the number type can tell from a mirror.
template <class Real>
class GgxTextbook
{
public:
    using V = Vec3<Real>;
    static constexpr Real flat = sizeof(Real) == 4 ? Real(1e-5) : Real(1e-9);

    GgxTextbook(Real alpha_x, Real alpha_y)
    {
        const Real x = detail::sanitised(alpha_x, 0, 1, 1), y = detail::sanitised(alpha_y, 0, 1, 1);
        is_flat = x <= flat && y <= flat;
        ax = std::max(x, flat);
        ay = std::max(y, flat);
    }

    Real D(const V& m) const
    {
        const Real x = m.x / ax, y = m.y / ay, r = x * x + y * y + m.z * m.z;
        return 1 / (pi<Real> * ax * ay * r * r);
    }
    /// t above.
    Real stretched_length(const V& w) const
    {
        const Real x = ax * w.x, y = ay * w.y;
        return std::sqrt(x * x + y * y + w.z * w.z);
    }
    Real projected_area(const V& w) const { return (w.z + stretched_length(w)) / 2; }
    Real G1(const V& w) const { return 2 * w.z / (w.z + stretched_length(w)); }
    /// 1 / (1 + Lambda_o + Lambda_i).
    Real G2(const V& a, const V& b) const
    {
        return 2 * a.z * b.z / (b.z * stretched_length(a) + a.z * stretched_length(b));
    }
    /// G2 / (4 cos_o cos_i).
    Real visibility(const V& wo, const V& wi) const
    {
        return 1 / (2 * (wi.z * stretched_length(wo) + wo.z * stretched_length(wi)));
    }
    /// A visible normal of wo; `share` of its cap, 1 for the whole of it.
    V visible(const V& wo, Real u, Real v, Real share = 1) const
    {
        const V s = V(ax * wo.x, ay * wo.y, wo.z) * (1 / stretched_length(wo));
        const Real lowest = -share * s.z, z = (1 - v) * (1 - lowest) + lowest;
        const Real sine = std::sqrt(std::max(Real(0), (1 - z) * (1 + z))), phi = 2 * pi<Real> * u;
        const V h(s.x + sine * std::cos(phi), s.y + sine * std::sin(phi), s.z + z);
        return detail::normalised(V(ax * h.x, ay * h.y, std::max(h.z, Real(1e-15))));
    }

    Real ax, ay;
    bool is_flat;
};

template <class Real>
Vec3<Real> reflected(const Vec3<Real>& w, const Vec3<Real>& m)
{
    return m * (2 * detail::dot(w, m)) - w;
}

}  // namespace regain::planted
