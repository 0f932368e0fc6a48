// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The Student t-distribution of microfacet normals (STD; Ribardiere et al. 2017) with Smith's
/// masking and shadowing. gamma is the tail parameter: 2 is GGX, large is Beckmann, below 2 the
/// tails are longer than GGX's.
///
///   D(m) = (1 + t^2 / (gamma - 1))^-gamma / (pi ax ay mz^4),
///          t^2 = ((mx/ax)^2 + (my/ay)^2) / mz^2                  Ribardiere et al. 2017
///
/// sigma is exact, not the paper's fit of Lambda. With p = gamma - 1, s = |(ax wx, ay wy)| and the
/// angle psi between w = (sqrt(p) s, w.z) and the normal after stretching, y = sin(psi)^2,
/// z = sin(psi / 2)^2, the slopes along w have the density C (1 + q^2)^(1/2 - gamma) in units of
/// sqrt(p) alpha, and for w.z >= 0
///
///   sigma(w) = w.z + |w| g,   g = C int_0^psi sin(chi)^(2p - 2) sin(psi - chi) dchi
///            = C y^p / (2p (2p - 1)) 2F1(2p - 1, 2; p + 1; z)
///            = C y^p (1 / (2p (2p - 1)) + z / p - cos(psi) z F / (p + 1)),
///   F = 2F1(2p + 1, 1; p + 2; z),   C = Gamma(p + 1/2) / (sqrt(pi) Gamma(p))
///
/// (g'' + g = C sin^(2p - 2); quadratic transformation, DLMF 15.8(iii); a contiguous relation). F
/// is Gauss's continued fraction (DLMF 15.7), whose coefficients depend on gamma alone.
///
/// Visible normals are exact, by rejection: the first try reads the three random numbers, later
/// ones a stream that these determine (random_stream.h), so that samples stay stratified as far as
/// the first try is taken.
///
/// Directions: local frame, z = shading normal, unit. The interface is that of every distribution:
/// see distribution.h.

#pragma once

#include <regain/closures/microfacet_widths.h>
#include <regain/closures/student_slopes.h>
#include <regain/closures/tail.h>

REGAIN_NAMESPACE_BEGIN

template <class RealType>
class STD : public detail::MicrofacetWidths<STD<RealType>, RealType>
{
    using Widths = detail::MicrofacetWidths<STD<RealType>, RealType>;

public:
    using Real = RealType;
    using Mask = MaskOf<Real>;

    static constexpr int random_numbers = 3;
    static constexpr bool has_tail = true;
    static constexpr CosineAxis cosine_axis = CosineAxis::tail;
    static constexpr WidthAxis width_axis = WidthAxis::std;

    /// Widths along x and y in [0, 1]; outside they are clamped, NaN becomes 1. One axis narrower
    /// than delta_alpha is widened to it unless both are. gamma in [std_min_gamma, std_max_gamma];
    /// outside it is clamped, NaN becomes 2.
    REGAIN_HOST_DEVICE explicit STD(Real alpha_x, Real alpha_y, Real gamma)
        : Widths(alpha_x, alpha_y),
          _gamma(detail::sanitised(gamma, std_min_gamma, std_max_gamma, 2)),
          _p(_gamma - Real(1)),
          _inv_p(Real(1) / _p)
    {
        const Real p = _p, C = normalisation(p);
        // E|x| = 2 C / (2p - 1), where 2p - 1 may be small.
        _mean_slope = C / (_gamma - Real(1.5f));
        _limit = Real(0.25f) * _mean_slope * _inv_p;
        _linear = C * _inv_p;
        _rest = C / (p + Real(1));
        for (int n = 1; n <= terms + 2; ++n)
        {
            const Real k = Real(static_cast<float>(n / 2));
            const Real numerator =
                n % 2 ? (Real(2) * p + Real(1) + k) * (p + Real(1) + k) : k * (k - p);
            const Real denominator = p + Real(static_cast<float>(n));
            _fraction[n - 1] = numerator / (denominator * (denominator + Real(1)));
        }
    }
    REGAIN_HOST_DEVICE explicit STD(Real alpha, Real gamma) : STD(alpha, alpha, gamma) {}

    /// Tail parameter, and its coordinate along the third axis of tables.
    REGAIN_HOST_DEVICE Real gamma() const { return _gamma; }
    REGAIN_HOST_DEVICE Real tail() const { return std_tail(_gamma); }
    /// Of slopes: 1 is GGX's, 0 Beckmann's. See anisotropy.h.
    REGAIN_HOST_DEVICE Real tail_length() const { return _inv_p; }

    /// D of the normal m along h, which need not be unit: length2 = h.h. Per steradian.
    REGAIN_HOST_DEVICE Real D(const Vec3<Real>& h, Real length2) const
    {
        // GGX's form of it, widened by sqrt(p), and what is left for gamma other than 2. Through
        // the logarithm, which neither overflows nor loses the digits of small slopes.
        const Real z2 = detail::max(h.z * h.z, detail::constant<Real>(1e-24));
        const Real t2 = _inv_p * this->shrunk_tangential2(h);
        const Real r = length2 / (z2 + t2);
        // D never is 0, so that it may be divided by; what that adds is below any rounding.
        constexpr double least = sizeof(ScalarOf<Real>) == 4 ? 1e-18 : 1e-200;
        const Real rest = detail::exp((Real(1) - _p) * detail::log1p(t2 / z2));
        return _normalisation * r * r * detail::max(rest, detail::constant<Real>(least));
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
        REGAIN_HOST_DEVICE Visible(const STD& distribution, const Vec3<Real>& wo)
            : _frame(distribution._alpha_x * detail::sqrt(distribution._p),
                     distribution._alpha_y * detail::sqrt(distribution._p), wo),
              _slopes(distribution._p, distribution._gamma - Real(1.5f), distribution._mean_slope,
                      _frame.cotangent()),
              _projected_area(distribution.projected_area(wo))
        {}

        /// sigma(wo).
        REGAIN_HOST_DEVICE Real projected_area() const { return _projected_area; }

        /// Factor that turns D(m) into the density of the reflected direction, per steradian.
        REGAIN_HOST_DEVICE Real reflected_density() const { return Real(0.25f) / _projected_area; }

        /// A visible normal for u in [0, 1)^3; unit, z > 0.
        REGAIN_HOST_DEVICE Vec3<Real> sample(const Vec3<Real>& u) const
        {
            const Vec2<Real> slopes = _slopes.sample(
                {detail::saturate(u.x), detail::saturate(u.y), detail::saturate(u.z)});
            return _frame.normal(slopes.x, slopes.y);
        }

    private:
        detail::SlopeFrame<Real> _frame;
        detail::StudentSlopes<Real> _slopes;
        Real _projected_area;
    };

    /// All visible normals; wo.z may have either sign.
    REGAIN_HOST_DEVICE Visible visible(const Vec3<Real>& wo) const { return Visible(*this, wo); }
    /// The same: every visible normal may be sampled, also those that reflect downwards.
    REGAIN_HOST_DEVICE Visible reflecting(const Vec3<Real>& wo) const { return Visible(*this, wo); }

private:
    // Enough for 1e-6 and 1e-12 of sigma at the largest gamma, and far better below.
    static constexpr int terms = sizeof(ScalarOf<Real>) == 4 ? 17 : 33;

    // |w| g of the above: sigma(w) - max(0, w.z), which sigma(w) and sigma(-w) share.
    REGAIN_HOST_DEVICE Real excess_area(const Vec3<Real>& w) const
    {
        const Real s2 = detail::max(_p * this->tangential2(w), detail::constant<Real>(1e-30));
        const Real cot2 = w.z * w.z / s2, y = Real(1) / (Real(1) + cot2);
        const Real length = detail::sqrt(w.z * w.z + s2), x = detail::abs(w.z) / length;
        const Real z = Real(0.5f) * y / (Real(1) + x);
        return length * detail::exp(-_p * detail::log1p(cot2)) *
               (_limit + z * (_linear - _rest * x * fraction(z)));
    }

    // F(z) = 1 / (1 - f1 z / (1 - f2 z / ...)), from its end: there the fraction is taken to go on
    // with its last two coefficients for ever, which saves a third of the terms. v = p / q.
    REGAIN_HOST_DEVICE Real fraction(const Real& z) const
    {
        const Real b = Real(1) + (_fraction[terms + 1] - _fraction[terms]) * z;
        const Real root =
            detail::sqrt(detail::max(b * b - Real(4) * _fraction[terms + 1] * z, Real(0)));
        Real p = Real(0.5f) * (b + root), q(1);
        for (int n = terms; n-- > 0;)
        {
            const Real next = p - _fraction[n] * z * q;
            q = p;
            p = next;
        }
        return q / p;
    }

    // Gamma(p + 1/2) / (sqrt(pi) Gamma(p)): the recurrence up to where the series of
    // Gamma(q + 3/4) / Gamma(q + 1/4) in 1 / q^2 has converged.
    REGAIN_HOST_DEVICE static Real normalisation(const Real& p)
    {
        constexpr int steps = sizeof(ScalarOf<Real>) == 4 ? 4 : 16;
        Real below(1), above(1);
        for (int n = 0; n < steps; ++n)
        {
            const Real at = p + Real(static_cast<float>(n));
            below *= at;
            above *= at + Real(0.5f);
        }
        const Real q = p + number(steps - 0.25), t = Real(1) / (q * q);
        const Real series =
            Real(1) + t * (number(1.0 / 64) -
                           t * (number(19.0 / 8192) -
                                t * (number(631.0 / 524288) - t * number(174317.0 / 134217728))));
        return number(0.564189583547756286948) * detail::sqrt(q) * series * below / above;
    }
    REGAIN_HOST_DEVICE static Real number(double x) { return detail::constant<Real>(x); }

    using Widths::_alpha_x, Widths::_alpha_y, Widths::_normalisation;
    Real _gamma, _p, _inv_p;
    Real _mean_slope;  // of |x|, in units of sqrt(p) alpha
    Real _limit, _linear, _rest;
    Real _fraction[terms + 2];
};

REGAIN_NAMESPACE_END
