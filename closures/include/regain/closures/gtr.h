// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The GTR distribution of microfacet normals (generalised Trowbridge-Reitz) with Smith's masking
/// and shadowing, both exact for every gamma:
///
///   D(m) = (gamma-1) (alpha^2-1) / (pi (1 - alpha^(2 (1-gamma)))) (1 + (alpha^2-1) cos^2)^(-gamma)
///          Burley 2012, appendix B; gamma = 1: (alpha^2-1) / (pi ln alpha^2) / (1 + ...)
///
/// gamma = 2 is GGX; a smaller gamma has longer tails; at alpha = 1 every gamma is GGX. The slopes
/// have the density c (1 + rho)^(gamma-2) (alpha^2 + rho)^(-gamma), rho = slope^2. That is no
/// function of slope / alpha, and so the anisotropic form is a choice: the isotropic law at
/// alpha = sqrt(alpha_x alpha_y), its slopes stretched by alpha_x / alpha and alpha_y / alpha.
///
/// Area and visible normals come from the mixture of gtr_mixture.h: the area is its sum, within
/// 1e-5 (float) and 2e-9 (double). A visible normal is drawn from a term of the mixture in
/// proportion to that term's visible area, and kept with the probability D / D_mixture over its
/// bound, so that the error of the sum does not enter: the normals are exact. Nearly all are kept
/// at the first try. The interface is that of every distribution: see distribution.h.
///
/// Random numbers: three, and where rejection or the Student laws of gamma > 2 take more, those of
/// a RandomStream made from the three.
///
/// Directions: local frame, z = shading normal, unit.

#pragma once

#include <regain/closures/ggx.h>
#include <regain/closures/gtr_mixture.h>
#include <regain/closures/tail.h>

REGAIN_NAMESPACE_BEGIN

template <class RealType>
class GTR : public detail::MicrofacetWidths<GTR<RealType>, RealType>
{
    using Widths = detail::MicrofacetWidths<GTR<RealType>, RealType>;

public:
    using Real = RealType;
    using Mask = MaskOf<Real>;

    static constexpr int random_numbers = 3;
    static constexpr bool has_tail = true;
    static constexpr CosineAxis cosine_axis = CosineAxis::tail;
    static constexpr WidthAxis width_axis = WidthAxis::gtr;

    /// Widths along x and y in [0, 1]; outside they are clamped, NaN becomes 1. One axis narrower
    /// than delta_alpha is widened to it unless both are. gamma in [gtr_min_gamma, gtr_max_gamma];
    /// outside it is clamped, NaN becomes 2.
    REGAIN_HOST_DEVICE explicit GTR(Real alpha_x, Real alpha_y, Real gamma)
        : Widths(alpha_x, alpha_y),
          _gamma(detail::sanitised(gamma, gtr_min_gamma, gtr_max_gamma, 2)),
          _beta(_alpha_x * _alpha_y),
          _inv_beta(Real(1) / _beta),
          _log_beta(detail::log(_alpha_x) + detail::log(_alpha_y)),
          _mixture(_beta, _log_beta, _gamma)
    {
        // Their product is 1. Two quotients by one number g++ makes a vector of four, of which two
        // are whatever was there, and that may trap.
        _stretch_x = _alpha_x / detail::sqrt(_beta);
        _stretch_y = Real(1) / _stretch_x;
        // D at m = (0, 0, 1). With l = ln beta and phi(x) = x / (e^x - 1), which is 1 at 0, it is
        // phi((gamma-1) l) / (phi(l) pi beta): nothing is divided by 0 at gamma = 1 or alpha = 1.
        _peak = constant(0.318309886183790671538) * phi((_gamma - Real(1)) * _log_beta) /
                (phi(_log_beta) * _beta);
    }
    REGAIN_HOST_DEVICE explicit GTR(Real alpha, Real gamma) : GTR(alpha, alpha, gamma) {}

    /// Tail parameter, and its coordinate along the third axis of tables.
    REGAIN_HOST_DEVICE Real gamma() const { return _gamma; }
    REGAIN_HOST_DEVICE Real tail() const { return gtr_tail(_gamma); }

    /// D of the normal m along h, which need not be unit: length2 = h.h. Per steradian. At least
    /// 1e-25, so that quotients of it stay finite.
    REGAIN_HOST_DEVICE Real D(const Vec3<Real>& h, Real length2) const
    {
        const Real z2 = h.z * h.z, a2 = _beta * this->shrunk_tangential2(h);
        const Real r = length2 / (z2 + a2);
        return detail::max(isotropic_D(z2, a2) * r * r, constant(1e-25));
    }
    REGAIN_HOST_DEVICE Real D(const Vec3<Real>& m) const { return D(m, Real(1)); }

    /// sigma(w), the projected area of the visible microsurface; w.z may have either sign.
    REGAIN_HOST_DEVICE Real projected_area(const Vec3<Real>& w) const
    {
        const Vec3<Real> v = stretched(w);
        if (detail::all<Real>(v.z >= Real(0)))
            return _mixture.area_above(v.z, v.x * v.x + v.y * v.y);
        return detail::max(v.z, Real(0)) + area_below(v);
    }

    /// Lambda(w) for w.z > 0.
    REGAIN_HOST_DEVICE Real lambda(const Vec3<Real>& w) const
    {
        return area_below(stretched(w)) / w.z;
    }

    /// The visible normals of one wo.
    class Visible
    {
    public:
        REGAIN_HOST_DEVICE Visible(const GTR& gtr, const Vec3<Real>& wo)
            : _gtr(gtr),
              _v(gtr.stretched(wo)),
              _projected_area(detail::max(gtr.projected_area(wo), constant(1e-30)))
        {}

        /// sigma(wo), at least 1e-30.
        REGAIN_HOST_DEVICE Real projected_area() const { return _projected_area; }

        /// Factor that turns D(m) into the density of the reflected direction, per steradian.
        REGAIN_HOST_DEVICE Real reflected_density() const { return Real(0.25f) / _projected_area; }

        /// A visible normal for u in [0, 1)^3, of which all are read; unit, z > 0.
        REGAIN_HOST_DEVICE Vec3<Real> sample(const Vec3<Real>& u) const
        {
            Vec3<Real> numbers(detail::saturate(u.x), detail::saturate(u.y), detail::saturate(u.z));
            RandomStream<Real> stream(numbers);
            // The mixture's D exceeds GTR's by no more than this.
            const Real bound = constant(1 + detail::GtrMixture<Real>::tolerance);
            const Real sure = constant(1 - detail::GtrMixture<Real>::tolerance) / bound;

            Vec3<Real> n(Real(0), Real(0), Real(1));
            Mask done(false);
            // A try fails once in 2500 times; after eight the last normal is taken.
            for (int attempt = 0; attempt < 8; ++attempt)
            {
                const Real threshold = stream.next(), order = stream.next();
                n = detail::select(done, n, normal_of_mixture(numbers, order, threshold));
                // D is at least (1 - tolerance) D_mixture: most need no look at either.
                done = done | (threshold < sure);
                if (detail::all<Real>(done)) break;
                const Real z2 = n.z * n.z, a2 = n.x * n.x + n.y * n.y;
                done = done |
                       (threshold * bound * _gtr._mixture.D(z2, a2) <= _gtr.isotropic_D(z2, a2));
                if (detail::all<Real>(done)) break;
                numbers = stream.next3();
            }
            const Vec3<Real> m(n.x * _gtr._stretch_x, n.y * _gtr._stretch_y, n.z);
            return detail::normalised(m);
        }

    private:
        // Unit, of the isotropic surface.
        REGAIN_HOST_DEVICE Vec3<Real> normal_of_mixture(const Vec3<Real>& u, const Real& order,
                                                        const Real& seed) const
        {
            const detail::GtrMixture<Real>& mixture = _gtr._mixture;
            const Real s2 = _v.x * _v.x + _v.y * _v.y;
            const auto term = mixture.term(_v.z, s2, _projected_area, u.z, order);
            const Real alpha = detail::sqrt(term.t);
            const Vec3<Real> of_ggx = GGX<Real>(alpha).visible(_v).sample(u);
            if (mixture.orders() == 0) return of_ggx;

            // A stream of its own: other lanes, which may need more tries, must not move it.
            RandomStream<Real> stream(Vec3<Real>(u.x, order, seed));
            const Real s = detail::sqrt(s2), q = detail::sqrt(_v.z * _v.z + term.t * s2);
            const Mask upright = s < constant(1e-18);
            const Real inv_s = Real(1) / detail::select(upright, Real(1), s);
            const Real x = detail::select(upright, Real(1), _v.x * inv_s),
                       y = detail::select(upright, Real(0), _v.y * inv_s);
            const Vec3<Real> h = detail::student_visible(term.order, alpha * s / q, _v.z / q,
                                                         Vec2<Real>(u.x, u.y), stream);
            const Vec3<Real> m(alpha * (h.x * x - h.y * y), alpha * (h.x * y + h.y * x),
                               detail::max(h.z, constant(1e-9)));
            return detail::select(_gtr._gamma > Real(2), detail::normalised(m), of_ggx);
        }

        GTR _gtr;
        Vec3<Real> _v;  // wo where the surface is isotropic; not unit
        Real _projected_area;
    };

    /// All visible normals; wo.z may have either sign.
    REGAIN_HOST_DEVICE Visible visible(const Vec3<Real>& wo) const { return Visible(*this, wo); }
    /// The same: none are left out.
    REGAIN_HOST_DEVICE Visible reflecting(const Vec3<Real>& wo) const { return Visible(*this, wo); }

private:
    REGAIN_HOST_DEVICE static Real constant(double x) { return detail::constant<Real>(x); }

    // x / (e^x - 1).
    REGAIN_HOST_DEVICE static Real phi(const Real& x)
    {
        const Mask zero = x == Real(0);
        return detail::select(zero, Real(1), x / detail::expm1(detail::select(zero, Real(1), x)));
    }

    // w where the surface is isotropic: its products with stretched normals are the same.
    REGAIN_HOST_DEVICE Vec3<Real> stretched(const Vec3<Real>& w) const
    {
        return {w.x * _stretch_x, w.y * _stretch_y, w.z};
    }
    REGAIN_HOST_DEVICE Real area_below(const Vec3<Real>& v) const
    {
        return _mixture.area_below(detail::abs(v.z), v.x * v.x + v.y * v.y);
    }
    // D of the isotropic surface, along a normal whose square is z2 + a2, z2 being that of its z.
    REGAIN_HOST_DEVICE Real isotropic_D(const Real& z2, const Real& a2) const
    {
        // beta (1 + rho) / (beta + rho), in [beta, 1].
        return _peak * detail::pow((z2 + a2) / (z2 + a2 * _inv_beta), _gamma);
    }

    using Widths::_alpha_x, Widths::_alpha_y;
    Real _gamma, _beta, _inv_beta, _log_beta, _stretch_x, _stretch_y;
    Real _peak;  // D at (0, 0, 1)
    detail::GtrMixture<Real> _mixture;
};

REGAIN_NAMESPACE_END
