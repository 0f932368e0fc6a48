// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The Beckmann distribution of microfacet normals, whose slopes are Gaussian, with Smith's masking
/// and shadowing.
///
///   D(m)     = exp(-((mx/ax)^2 + (my/ay)^2) / mz^2) / (pi ax ay mz^4)
///              Beckmann and Spizzichino 1963; Walter et al. 2007, Eq. 25
///   sigma(w) = (c + c erf(c / s) + s exp(-c^2 / s^2) / sqrt(pi)) / 2,  c = w.z,
///              s = |(ax wx, ay wy)|: Walter et al. 2007, Eq. 26 (smith G1 = c / sigma)
///
/// Visible normals (Heitz and d'Eon 2014): of the slopes in units of alpha, the one across wo is
/// Gaussian, the one along wo has a density proportional to (c / s + x)+ exp(-x^2) and is found by
/// inverting its distribution function to the last digits, so that the sampled density is the pdf.
/// Two random numbers, one each; stratification survives.
///
/// Directions: local frame, z = shading normal, unit. The interface is that of every distribution:
/// see distribution.h.

#pragma once

#include <regain/closures/erf_inverse.h>
#include <regain/closures/gaussian_tail.h>
#include <regain/closures/microfacet_widths.h>

REGAIN_NAMESPACE_BEGIN

namespace detail {

/// The slope x > -c whose density is proportional to (c + x)+ exp(-x^2), as a function of the part
/// u of the distribution that lies beyond x.
template <class Real>
REGAIN_HOST_DEVICE Real visible_gaussian_slope(const Real& cotangent, const Real& u);

}  // namespace detail

template <class RealType>
class Beckmann : public detail::MicrofacetWidths<Beckmann<RealType>, RealType>
{
    using Widths = detail::MicrofacetWidths<Beckmann<RealType>, RealType>;

public:
    using Real = RealType;

    static constexpr int random_numbers = 2;
    static constexpr bool has_tail = false;
    static constexpr CosineAxis cosine_axis = CosineAxis::plain;

    /// Widths along x and y in [0, 1]; outside they are clamped, NaN becomes 1. One axis narrower
    /// than delta_alpha is widened to it unless both are.
    REGAIN_HOST_DEVICE explicit Beckmann(Real alpha_x, Real alpha_y) : Widths(alpha_x, alpha_y) {}
    REGAIN_HOST_DEVICE explicit Beckmann(Real alpha) : Widths(alpha) {}

    /// Of slopes, which have none: see anisotropy.h.
    REGAIN_HOST_DEVICE Real tail_length() const { return Real(0); }

    /// D of the normal m along h, which need not be unit: length2 = h.h. Per steradian.
    REGAIN_HOST_DEVICE Real D(const Vec3<Real>& h, Real length2) const
    {
        // Half of the exponential with each power of the cosine: neither can overflow alone. D
        // never is 0, so that it may be divided by; what that adds is below any rounding.
        constexpr double least = sizeof(ScalarOf<Real>) == 4 ? 1e-16 : 1e-150;
        const Real inv_z2 = Real(1) / detail::max(h.z * h.z, detail::constant<Real>(1e-24));
        const Real gauss = detail::exp(Real(-0.5f) * this->shrunk_tangential2(h) * inv_z2);
        const Real r = detail::max(length2 * inv_z2 * gauss, detail::constant<Real>(least));
        return _normalisation * r * r;
    }
    REGAIN_HOST_DEVICE Real D(const Vec3<Real>& m) const { return D(m, Real(1)); }

    /// Projected area of the visible microsurface, sigma(w) above; w.z may have either sign.
    REGAIN_HOST_DEVICE Real projected_area(const Vec3<Real>& w) const
    {
        return detail::max(w.z, Real(0)) + excess_area(w);
    }

    /// Lambda(w) for w.z > 0.
    REGAIN_HOST_DEVICE Real lambda(const Vec3<Real>& w) const { return excess_area(w) / w.z; }

    /// The visible normals of one wo.
    class Visible
    {
    public:
        REGAIN_HOST_DEVICE Visible(const Beckmann& beckmann, const Vec3<Real>& wo)
            : _frame(beckmann._alpha_x, beckmann._alpha_y, wo),
              _projected_area(beckmann.projected_area(wo))
        {}

        /// sigma(wo).
        REGAIN_HOST_DEVICE Real projected_area() const { return _projected_area; }

        /// Factor that turns D(m) into the density of the reflected direction, per steradian.
        REGAIN_HOST_DEVICE Real reflected_density() const { return Real(0.25f) / _projected_area; }

        /// A visible normal for u in [0, 1)^3, of which x and y are read; unit, z > 0.
        REGAIN_HOST_DEVICE Vec3<Real> sample(const Vec3<Real>& u) const
        {
            const Real along =
                detail::visible_gaussian_slope(_frame.cotangent(), detail::saturate(u.x));
            return _frame.normal(along,
                                 detail::erf_inverse(Real(2) * detail::saturate(u.y) - Real(1)));
        }

    private:
        detail::SlopeFrame<Real> _frame;
        Real _projected_area;
    };

    /// All visible normals; wo.z may have either sign.
    REGAIN_HOST_DEVICE Visible visible(const Vec3<Real>& wo) const { return Visible(*this, wo); }
    /// The same: every visible normal may be sampled, also those that reflect downwards.
    REGAIN_HOST_DEVICE Visible reflecting(const Vec3<Real>& wo) const { return Visible(*this, wo); }

private:
    // sigma(w) - max(0, w.z) = s ierfc(|c| / s) / 2: what sigma(w) and sigma(-w) share.
    REGAIN_HOST_DEVICE Real excess_area(const Vec3<Real>& w) const
    {
        const Real s =
            detail::max(detail::sqrt(this->tangential2(w)), detail::constant<Real>(1e-18));
        return Real(0.5f) * s * detail::ierfc(detail::abs(w.z) / s);
    }

    using Widths::_alpha_x, Widths::_alpha_y, Widths::_normalisation;
};

namespace detail {

/// Halley's method takes one to three steps, a few more near u = 1 for c between 2 and 5.
constexpr int slope_steps = 12;

/// Whether the next step would be below rounding: its length goes with the cube of the last.
template <class Real>
REGAIN_HOST_DEVICE bool slope_found(const Real& last_step, const Real& height)
{
    const Real small = constant<Real>(sizeof(ScalarOf<Real>) == 4 ? 6e-3 : 3e-6);
    return all<Real>(abs(last_step) <= small * min(height, Real(1)));
}

/// The same where c >= 0. Nothing cancels in Q(x) = int_x^inf (c + x) exp(-x^2); Q / (1 + c) is
/// what is computed, so that c may be large.
template <class Real>
REGAIN_HOST_DEVICE Real visible_gaussian_slope_above(const Real& cotangent, const Real& u)
{
    using Mask = MaskOf<Real>;
    const Real c = min(cotangent, Real(1e8f)), scale = Real(1) / (Real(1) + c);
    const Real half = Real(0.5f) * scale,
               weight = constant<Real>(0.886226925452758013649) * c * scale;
    const Real gauss_at_c = detail::exp(-min(c * c, Real(60)));
    const Real total = half * gauss_at_c + weight * (Real(2) - detail::erfc(min(c, Real(9))));
    const Real target = u * total;

    // With 1 - b^2 for exp(-erf_inverse(b)^2), as Jakob 2014 starts, this is quadratic in b.
    const Real rest = weight + half - target;
    const Real root = sqrt(max(weight * weight + Real(4) * half * rest, Real(0)));
    const Real start = erf_inverse((rest + rest) / max(weight + root, constant<Real>(1e-6)));
    // The integrand (c + v) exp(-v^2) of what lies between -c and x is below c + v, and above
    // (c + v) exp(-c^2) as long as v < 0.
    const Real square = Real(2) * (Real(1) - u) * total * (Real(1) + c);
    const Real least = sqrt(square) - c, most = sqrt(square / gauss_at_c) - c;
    Real x = select(most < Real(0), select(start > least, min(start, most), most), start);

    // Halley's method on the logarithm of the smaller part, which is concave; 2 (a - b) / (a + b)
    // stands for log(a / b), from which it differs in the third order.
    const Mask lower = u > Real(0.5f);
    const Real ulp = constant<Real>(sizeof(ScalarOf<Real>) == 4 ? 0x1p-24 : 0x1p-53) * total;
    const Real goal = select(lower, total - target, target);
    const Real sign = select(lower, scale, -scale);
    for (int step = 0; step < slope_steps; ++step)
    {
        const Real gauss = detail::exp(-x * x), beyond = half * gauss + weight * detail::erfc(x);
        const Real part = select(lower, max(total - beyond, ulp), beyond);
        const Real height = max(x + c, constant<Real>(1e-9));
        const Real excess = Real(2) * (part - goal) / (part + goal);
        const Real newton = excess * part / (sign * height * gauss);
        const Real bend = newton / height - Real(2) * x * newton - excess;
        x = max(x - newton / max(Real(1) - Real(0.5f) * bend, Real(0.5f)), least);
        if (slope_found(newton, height)) break;
    }
    return x;
}

/// The same where c = -a < 0: all relative to exp(-a^2), which underflows. With
/// r = erfcx_deficit, Q(x) / Q(a) = exp(a^2 - x^2) (x - a + a r(x)) / (x r(a)).
template <class Real>
REGAIN_HOST_DEVICE Real visible_gaussian_slope_below(const Real& cotangent, const Real& u)
{
    const Real a = min(-cotangent, Real(1e8f)), deficit = erfcx_deficit(a);
    const Real goal = log(u);

    // y = x^2 - a^2 is exponential for a = 0, and for large a the sum of two such.
    const Real early = sqrt(Real(-2) * goal) * a * sqrt(deficit + deficit);
    const Real y = early - goal;
    Real d = y / (a + sqrt(a * a + y));

    for (int step = 0; step < slope_steps; ++step)
    {
        const Real x = a + d, height = d + a * erfcx_deficit(x);
        const Real value = log(height / (x * deficit)) - d * (a + x);
        const Real slope = Real(-2) * x * d / height;
        const Real newton = (value - goal) / slope;
        const Real curvature = Real(1) / d - x - x - slope;
        d = max(d - newton / max(Real(1) - Real(0.5f) * newton * curvature, Real(0.5f)),
                Real(0.1f) * d);
        if (slope_found(newton, d)) break;
    }
    return a + d;
}

template <class Real>
REGAIN_HOST_DEVICE Real visible_gaussian_slope(const Real& cotangent, const Real& number)
{
    constexpr double ulp = sizeof(ScalarOf<Real>) == 4 ? 0x1p-25 : 0x1p-54;
    const Real u = min(max(number, constant<Real>(ulp)), constant<Real>(1 - 2 * ulp));
    const MaskOf<Real> below = cotangent < Real(0);
    if (all<Real>(below)) return visible_gaussian_slope_below(cotangent, u);
    const Real above = visible_gaussian_slope_above(max(cotangent, Real(0)), u);
    if (!any<Real>(below)) return above;
    return select(below, visible_gaussian_slope_below(min(cotangent, Real(-1e-6f)), u), above);
}

}  // namespace detail

REGAIN_NAMESPACE_END
