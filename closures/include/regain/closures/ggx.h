// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The GGX distribution of microfacet normals with Smith's masking and shadowing.
///
///   D(m)      = 1 / (pi ax ay ((mx/ax)^2 + (my/ay)^2 + mz^2)^2)
///               Walter et al. 2007, Eq. 33; anisotropic: Burley 2012, B.1; in this component form
///               nothing cancels at small alpha
///   sigma(w)  = cos theta (1 + Lambda(w)) = (cos theta + sqrt((ax wx)^2 + (ay wy)^2 + wz^2)) / 2,
///               the area of the visible microsurface projected along w: Heitz 2014, Eqs. 23, 72
///   D_wo(m)   = max(0, wo.m) D(m) / sigma(wo)                    Heitz 2014, Eq. 17
///   G1 = cos theta / sigma,  G2 = 1 / (1 + Lambda_o + Lambda_i)  height-correlated: Eq. 99
///
/// Visible normals are sampled by spherical caps (Dupuy and Benyoub 2023), for reflection lobes
/// with the cap bounded to what can leave upwards (Eto and Tokuyoshi 2023; Tokuyoshi and Eto 2024).
/// The interface is that of every distribution: see distribution.h.
///
/// Directions: local frame, z = shading normal, unit.

#pragma once

#include <regain/closures/microfacet_widths.h>

REGAIN_NAMESPACE_BEGIN

/// Which part of the visible normals a reflection lobe samples.
enum class NormalSampling {
    bounded,  ///< a smaller cap that still holds every normal which reflects upwards: fewer dead
              ///< samples, less noise
    full      ///< all visible normals
};

template <class RealType>
class GGX : public detail::MicrofacetWidths<GGX<RealType>, RealType>
{
    using Widths = detail::MicrofacetWidths<GGX<RealType>, RealType>;

public:
    using Real = RealType;
    using Mask = MaskOf<Real>;

    static constexpr int random_numbers = 2;
    static constexpr bool has_tail = false;

    /// Widths along x and y in [0, 1]; outside they are clamped, NaN becomes 1. One axis narrower
    /// than delta_alpha is widened to it unless both are.
    REGAIN_HOST_DEVICE explicit GGX(Real alpha_x, Real alpha_y,
                                    NormalSampling sampling = NormalSampling::bounded)
        : Widths(alpha_x, alpha_y), _sampling(sampling)
    {}
    REGAIN_HOST_DEVICE explicit GGX(Real alpha) : Widths(alpha), _sampling(NormalSampling::bounded)
    {}

    /// Of slopes: see anisotropy.h.
    REGAIN_HOST_DEVICE Real tail_length() const { return Real(1); }

    /// D of the normal m along h, which need not be unit: length2 = h.h. Per steradian.
    REGAIN_INLINE Real D(const Vec3<Real>& h, Real length2) const
    {
        const Real x = h.x * _inv_alpha_x, y = h.y * _inv_alpha_y;
        // The quotient first: squaring the lengths one by one would underflow at grazing angles.
        const Real r = length2 / (x * x + y * y + h.z * h.z);
        return _normalisation * r * r;
    }
    REGAIN_HOST_DEVICE Real D(const Vec3<Real>& m) const { return D(m, Real(1)); }

    /// Projected area of the visible microsurface, sigma(w) above; w.z may have either sign.
    REGAIN_INLINE Real projected_area(const Vec3<Real>& w) const
    {
        return projected_area(w, stretched_length(w));
    }

    /// Lambda(w) for w.z > 0.
    REGAIN_INLINE Real lambda(const Vec3<Real>& w) const
    {
        // (t / z - 1) / 2 loses all digits at small slopes; its conjugate does not.
        const Real x = _alpha_x * w.x, y = _alpha_y * w.y;
        return Real(0.5f) * (x * x + y * y) / (w.z * (w.z + stretched_length(w)));
    }

    /// The visible normals of one wo, or those of them that matter to a reflection lobe.
    class Visible
    {
    public:
        REGAIN_HOST_DEVICE Visible(const GGX& ggx, const Vec3<Real>& wo, NormalSampling sampling)
            : _alpha_x(ggx._alpha_x), _alpha_y(ggx._alpha_y)
        {
            const Vec3<Real> v(_alpha_x * wo.x, _alpha_y * wo.y, wo.z);
            const Real t = ggx.stretched_length(wo);
            _v = v * (Real(1) / t);

            Real k(1);
            if (sampling == NormalSampling::bounded)
            {
                const Real a = detail::min(_alpha_x, _alpha_y), a2 = a * a;
                const Real s = Real(1) + detail::sqrt(wo.x * wo.x + wo.y * wo.y), s2 = s * s;
                k = (Real(1) - a2) * s2 / (s2 + a2 * wo.z * wo.z);
            }
            _cap = k * _v.z;
            // Far below the horizon the cap is small, and 1 + z all that there is of it.
            const Real below = (_v.x * _v.x + _v.y * _v.y) / (Real(1) + detail::abs(_v.z));
            _height = detail::select(_v.z < Real(0), below, Real(1) + _cap);
            // From straight below nothing is seen.
            _projected_area = detail::max(ggx.projected_area(wo, t), detail::constant<Real>(1e-30));
            _reflected_density = sampling == NormalSampling::bounded
                                     ? Real(0.5f) / (k * wo.z + t)
                                     : Real(0.25f) / _projected_area;
        }

        /// sigma(wo).
        REGAIN_INLINE Real projected_area() const { return _projected_area; }

        /// Factor that turns D(m) into the density of the reflected direction, per steradian.
        REGAIN_HOST_DEVICE Real reflected_density() const { return _reflected_density; }

        /// A visible normal for u in [0, 1)^3, of which x and y are read; unit, z >= 0.
        REGAIN_INLINE Vec3<Real> sample(const Vec3<Real>& u) const
        {
            const Real phi = detail::constant<Real>(6.28318530717958647692) * detail::saturate(u.x);
            // v + c, where c = (sin_theta cos phi, sin_theta sin phi, rise - cap) is on the cap,
            // and 1 - c.z = drop.
            const Real y = detail::saturate(u.y), drop = y * _height, rise = _height - drop;
            const Real sin_theta = detail::sqrt(drop * (Real(2) - drop));
            const Vec3<Real> h(_v.x + sin_theta * detail::cos(phi),
                               _v.y + sin_theta * detail::sin(phi), (_v.z - _cap) + rise);
            // Rounding can put h.z a little below 0, and h near 0 where v and the cap cancel.
            const Vec3<Real> m(_alpha_x * h.x, _alpha_y * h.y,
                               detail::max(h.z, detail::constant<Real>(1e-15)));
            return m * (Real(1) / detail::sqrt(detail::dot(m, m)));
        }

    private:
        Real _alpha_x, _alpha_y;
        Vec3<Real> _v;  // wo in the space where the microsurface is a hemisphere
        Real _cap;      // the cap of reflection directions reaches down to z = -_cap,
        Real _height;   // and is 1 + _cap high
        Real _projected_area, _reflected_density;
    };

    /// All visible normals; wo.z may have either sign.
    REGAIN_HOST_DEVICE Visible visible(const Vec3<Real>& wo) const
    {
        return Visible(*this, wo, NormalSampling::full);
    }
    /// Those a reflection lobe samples, wo.z > 0.
    REGAIN_HOST_DEVICE Visible reflecting(const Vec3<Real>& wo) const
    {
        return Visible(*this, wo, _sampling);
    }

private:
    // t is the stretched length of w. Below the horizon the sum cancels; its conjugate does not.
    REGAIN_INLINE Real projected_area(const Vec3<Real>& w, Real t) const
    {
        const MaskOf<Real> below = w.z < Real(0);
        if (!detail::any<Real>(below)) return Real(0.5f) * (w.z + t);
        const Real x = _alpha_x * w.x, y = _alpha_y * w.y;
        const Real tangential2 = detail::select(below, x * x + y * y, Real(0));
        return Real(0.5f) * detail::select(below, tangential2 / (t + detail::abs(w.z)), w.z + t);
    }
    REGAIN_INLINE Real stretched_length(const Vec3<Real>& w) const
    {
        const Real x = _alpha_x * w.x, y = _alpha_y * w.y;
        return detail::sqrt(x * x + y * y + w.z * w.z);
    }

    using Widths::_alpha_x, Widths::_alpha_y, Widths::_inv_alpha_x, Widths::_inv_alpha_y,
        Widths::_normalisation;
    NormalSampling _sampling;
};

REGAIN_NAMESPACE_END
