// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Burley's diffuse reflection: MaterialX's and OSL's burley_diffuse_bsdf (Burley 2012, Section
/// 5.3), retro-reflective where it is rough and dark at grazing angles where it is smooth:
///
///   f = rho / pi (1 + k (1 - cos_o)^5) (1 + k (1 - cos_i)^5)
///   k = F_D90 - 1 = 2 r cos^2 theta_d - 1/2,    2 cos^2 theta_d = 1 + wo.wi
///
/// r being the roughness and theta_d the angle to the half-vector. It is reciprocal, and keeps no
/// account of energy: a white one's albedo is 0.95 at normal incidence, and at grazing incidence
/// 0.48 where r is 0 and 1.28 where r is 1.
///
/// k is linear in the cosine of the azimuth between wo and wi, so all of the integral of its albedo
/// is in polynomials; the header has it exactly. Sampled by the cosine.

#pragma once

#include <regain/closures/smooth_reflection.h>

REGAIN_NAMESPACE_BEGIN

namespace detail {

template <class RealType>
class BurleyDiffuseModel
{
public:
    using Real = RealType;
    using Color = Color3<Real>;
    static constexpr int random_numbers = 2;
    static constexpr bool is_diffuse = true;

    REGAIN_HOST_DEVICE BurleyDiffuseModel(const Color& color, Real roughness)
        : _color(per_channel(color, [](Real v) { return saturate(v); })), _r(saturate(roughness))
    {}

    REGAIN_HOST_DEVICE const Color& color() const { return _color; }
    REGAIN_HOST_DEVICE Real roughness() const { return _r; }

    REGAIN_HOST_DEVICE void describe(Traits& t) const { t.reciprocal = true; }

    class View
    {
    public:
        REGAIN_HOST_DEVICE View(const BurleyDiffuseModel& model, const Vec3<Real>& wo)
            : _wo(wo), _color(model._color), _r(model._r), _S(grazing(wo.z))
        {}

        REGAIN_HOST_DEVICE ReflectionTerms<Real> terms(const Vec3<Real>& wi) const
        {
            const Real k = _r * (Real(1) + dot(_wo, wi)) - Real(0.5f);
            const Real cosine = wi.z * constant<Real>(inverse_pi);
            const Real shape = (Real(1) + k * _S) * (Real(1) + k * grazing(wi.z));
            return {_color * (shape * cosine), cosine};
        }

        REGAIN_HOST_DEVICE Vec3<Real> draw(const Vec3<Real>& u) const
        {
            return cosine_direction(u.x, u.y);
        }

        // With a = r - 1/2 + r mu_o mu and b = r sin_o sin, k = a + b cos(phi), so over azimuth
        // the mean of (1 + k S_o)(1 + k S) is 1 + a (S_o + S) + (a^2 + b^2 / 2) S_o S. What is left
        // are the moments 2 int mu^(1 + n) S^m dmu.
        REGAIN_HOST_DEVICE Color albedo() const
        {
            const Real mu = min(_wo.z, Real(1)), sine2 = (Real(1) - mu) * (Real(1) + mu);
            const Real p = _r - Real(0.5f), q = _r * mu, h = Real(0.5f) * _r * _r * sine2;
            const Real m1 = constant<Real>(1.0 / 21), m2 = constant<Real>(1.0 / 84),
                       m3 = constant<Real>(1.0 / 252);
            const Real first = p * (_S + m1) + q * (constant<Real>(2.0 / 3) * _S + m2);
            const Real second = _S * ((p * p + h) * m1 + Real(2) * p * q * m2 + (q * q - h) * m3);
            return _color * (Real(1) + first + second);
        }

    private:
        REGAIN_HOST_DEVICE static Real grazing(const Real& mu)
        {
            const Real c = max(Real(1) - mu, Real(0)), c2 = c * c;
            return c2 * c2 * c;
        }

        Vec3<Real> _wo;
        Color _color;
        Real _r, _S;
    };

private:
    Color _color;
    Real _r;
};

}  // namespace detail

template <class Real>
class BurleyDiffuse : public SmoothReflection<detail::BurleyDiffuseModel<Real>>
{
public:
    /// color in [0, 1] per channel, roughness in [0, 1]; clamped, NaN becomes 0.
    REGAIN_HOST_DEVICE explicit BurleyDiffuse(const Color3<Real>& color, Real roughness = Real(0))
        : SmoothReflection<detail::BurleyDiffuseModel<Real>>(
              detail::BurleyDiffuseModel<Real>(color, roughness))
    {}

    REGAIN_HOST_DEVICE const Color3<Real>& color() const { return this->model().color(); }
    REGAIN_HOST_DEVICE Real roughness() const { return this->model().roughness(); }
};

REGAIN_NAMESPACE_END
