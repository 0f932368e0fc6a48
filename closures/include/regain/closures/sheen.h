// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Burley's sheen, an added grazing glow for what a surface loses to "multiple-scattering effects
/// between and through microsurface features" (Burley 2015, as Turquin 2019, Section 2, quotes it;
/// first in Burley 2012 and the published code of that model):
///
///   f(wo, wi) = color (1 - cos theta_d)^5,   cos theta_d = wo.h = wi.h,   h = (wo + wi) / |wo +
///   wi|
///
/// There is no division by pi. theta_d is the angle between either direction and their half-vector,
/// which is what makes it reciprocal; Turquin 2019, Section 2, writes the same profile with
/// cos theta_o. It knows nothing of roughness, and nothing is taken from the base for what it adds:
/// its albedo is 0.0885 at grazing incidence, 0.0003 at normal incidence, 0.0116 on average.
///
/// Sampled forwards by (1 - wo.wi)^8, folded to the upper side, and evenly over the hemisphere, the
/// more so the more wo faces the normal: no weight is more than 9 times the albedo, and 3 times
/// below a cosine of 0.6, where there is some to speak of.

#pragma once

#include <regain/closures/sum.h>

REGAIN_NAMESPACE_BEGIN

template <class RealType>
class Sheen : public Shorthands<Sheen<RealType>, RealType>
{
public:
    using Real = RealType;
    using Mask = MaskOf<Real>;
    using Color = Color3<Real>;
    static constexpr int random_numbers = 3;

    /// weight: Burley's `sheen`, in [0, 1], clamped, NaN becomes 0. color: in [0, 100] per channel
    /// (a tint of unit luminance may pass 1), clamped, NaN becomes 0.
    REGAIN_HOST_DEVICE explicit Sheen(Real weight, const Color& color = Color(Real(1)))
        : _color(
              detail::per_channel(color, [](Real v) { return detail::sanitised(v, 0, 100, 0); }) *
              detail::saturate(weight))
    {}

    REGAIN_HOST_DEVICE const Color& color() const { return _color; }

    REGAIN_HOST_DEVICE Traits traits() const
    {
        Traits t;
        t.reciprocal = true;
        t.exact_pdf = true;
        t.random_numbers = random_numbers;
        return t;
    }

    class Prepared
    {
    public:
        REGAIN_HOST_DEVICE Prepared(const Sheen& closure, const Vec3<Real>& wo)
            : _valid(detail::is_above_horizon(wo)),
              _wo(detail::normalised(
                  detail::select(_valid, wo, Vec3<Real>(Real(0), Real(0), Real(1))))),
              _weight(detail::select(_valid, closure._color, Color(Real(0))))
        {
            const Real mu2 = _wo.z * _wo.z;
            _even = detail::constant<Real>(0.05) + detail::constant<Real>(0.95) * mu2 * mu2;
        }

        REGAIN_HOST_DEVICE const Vec3<Real>& wo() const { return _wo; }
        REGAIN_HOST_DEVICE void scale_by(const Color& weight) { _weight *= weight; }

        REGAIN_HOST_DEVICE Color eval(const Vec3<Real>& wi) const
        {
            const Terms t = terms(wi);
            return detail::select(t.valid, _weight * t.value, Color(Real(0)));
        }

        REGAIN_HOST_DEVICE Sample<Real> sample(const Vec3<Real>& u) const
        {
            const Real phi = detail::constant<Real>(6.28318530717958647692) * detail::saturate(u.y);
            const Real x = detail::cos(phi), y = detail::sin(phi), v = detail::saturate(u.x);
            const Mask even = detail::saturate(u.z) < _even;

            // About -wo: (1 - wo.wi) / 2 is distributed as the 9th root of v. The logarithm inside
            // a vector's pow takes no 0.
            const Real opposed = detail::pow(detail::max(v, detail::constant<Real>(1e-30)),
                                             detail::constant<Real>(1.0 / (exponent + 1)));
            const Real axial = detail::select(even, v, Real(2) * opposed - Real(1));
            const Real sine =
                detail::sqrt(detail::max(detail::select(even, (Real(1) - v) * (Real(1) + v),
                                                        Real(4) * opposed * (Real(1) - opposed)),
                                         Real(0)));
            const Vec3<Real> axis =
                detail::select(even, Vec3<Real>(Real(0), Real(0), Real(1)), -_wo);
            Vec3<Real> wi = turned(axis, Vec3<Real>(sine * x, sine * y, axial));
            wi.z = detail::max(detail::abs(wi.z), detail::constant<Real>(2 * detail::horizon));
            const Terms t = terms(wi);

            Sample<Real> s;
            s.valid = t.valid;
            s.wi = detail::select(s.valid, wi, Vec3<Real>(Real(0), Real(0), Real(1)));
            s.weight = detail::select(s.valid, _weight * (t.value / t.density), Color(Real(0)));
            s.pdf = detail::select(s.valid, t.density, Real(0));
            return s;
        }

        REGAIN_HOST_DEVICE Real pdf(const Vec3<Real>& wi) const
        {
            const Terms t = terms(wi);
            return detail::select(t.valid, t.density, Real(0));
        }

        /// By a polynomial: within 2e-6 of the integral.
        REGAIN_HOST_DEVICE Albedo<Real> albedo() const
        {
            constexpr double c[] = {0.08845450,  -0.24951544, 0.25672843,  -0.06981698,
                                    -0.12432510, 0.18309152,  -0.11148756, 0.02712946};
            const Real mu = detail::min(_wo.z, Real(1));
            Real sum = detail::constant<Real>(c[7]);
            for (int i = 6; i >= 0; --i) sum = sum * mu + detail::constant<Real>(c[i]);
            return {_weight * sum, Color(Real(0))};
        }

    private:
        static constexpr int exponent = 8;

        struct Terms
        {
            Mask valid;
            Real value;    // f cos theta_i of a white one
            Real density;  // per steradian
        };
        REGAIN_HOST_DEVICE Terms terms(const Vec3<Real>& direction) const
        {
            Terms t;
            t.valid = detail::both<Real>(_valid, detail::is_above_horizon(direction));
            const Vec3<Real> wi =
                detail::select(t.valid, direction, Vec3<Real>(Real(0), Real(0), Real(1)));

            const Vec3<Real> sum = _wo + wi;
            const Real cos_d = Real(0.5f) * detail::sqrt(detail::dot(sum, sum));
            const Real profile = detail::max(Real(1) - cos_d, Real(0)),
                       profile2 = profile * profile;
            t.value = profile2 * profile2 * profile * wi.z;

            // (1 - wo.wi) / 2 of wi and of its image below.
            const Real above = Real(0.5f) * (Real(1) - detail::dot(_wo, wi));
            const Real forwards =
                power(detail::saturate(above)) + power(detail::saturate(above + _wo.z * wi.z));
            t.density = (Real(1) - _even) * forwards *
                            detail::constant<Real>((exponent + 1) * 0.0795774715459476678844) +
                        _even * detail::constant<Real>(0.159154943091895335769);
            return t;
        }
        REGAIN_HOST_DEVICE static Real power(Real x)
        {
            const Real x2 = x * x, x4 = x2 * x2;
            return x4 * x4;
        }

        // A vector given about the z axis, turned to be about `axis` (Duff et al. 2017).
        REGAIN_HOST_DEVICE static Vec3<Real> turned(const Vec3<Real>& axis, const Vec3<Real>& v)
        {
            const Real sign = detail::select(axis.z < Real(0), Real(-1), Real(1));
            const Real a = Real(-1) / (sign + axis.z), b = axis.x * axis.y * a;
            const Vec3<Real> s(Real(1) + sign * axis.x * axis.x * a, sign * b, -sign * axis.x);
            const Vec3<Real> t(b, sign + axis.y * axis.y * a, -axis.y);
            return s * v.x + t * v.y + axis * v.z;
        }

        Mask _valid;
        Vec3<Real> _wo;
        Color _weight;
        Real _even;  // share of samples that are even over the hemisphere
    };

    REGAIN_HOST_DEVICE Prepared prepare(const Vec3<Real>& wo) const { return Prepared(*this, wo); }

private:
    Color _color;
};

/// Burley's `sheenTint`: from white (tint 0) to the hue and saturation of the base colour (tint 1),
/// which is the base colour at a luminance of 1. `luminance` is the base colour's, in the working
/// space; where it is not positive the sheen stays white.
template <class Real>
REGAIN_HOST_DEVICE Color3<Real> sheen_color(const Color3<Real>& base, Real luminance, Real tint)
{
    const Real t = detail::saturate(tint);
    const Real Y = detail::sanitised(luminance, 0, 1e6, 0);
    const MaskOf<Real> dark = !(Y > detail::constant<Real>(1e-6));
    const Real scale = Real(1) / detail::select(dark, Real(1), Y);
    return detail::per_channel(base, [&](Real v) {
        const Real hue = detail::select(dark, Real(1), detail::sanitised(v, 0, 1e6, 0) * scale);
        return Real(1) + (hue - Real(1)) * t;
    });
}

/// A base under Burley's sheen: the method `burley-sheen`.
template <class Base>
REGAIN_HOST_DEVICE Sum<Base, Sheen<typename Base::Real>> burley_sheen(
    const Base& base, typename Base::Real weight,
    const Color3<typename Base::Real>& color = Color3<typename Base::Real>(typename Base::Real(1)))
{
    return {base, Sheen<typename Base::Real>(weight, color)};
}

REGAIN_NAMESPACE_END
