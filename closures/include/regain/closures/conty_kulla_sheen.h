// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Cloth by a microfacet model of upright fibres: mode "conty_kulla" of MaterialX's and OSL's
/// sheen_bsdf (Estevez and Kulla 2017: an exponentiated sine; the shadowing that MaterialX has with
/// it is Neubelt and Pettineo's, 2013):
///
///   f = color D / (4 (cos_o + cos_i - cos_o cos_i)) / max(1, E)
///   D = (2 + 1 / r) sin(theta_h)^(1/r) / (2 pi)
///
/// r being the roughness and theta_h the angle of the half-vector. E is the directional albedo of
/// the rest, at wo: below r = 0.21 the model sends out more than arrives at grazing incidence, up
/// to 1.6 times at r = 0.07, and there, and only there, the division takes that away, and
/// reciprocity with it.
///
/// albedo() is exp of a polynomial in sqrt(cos_o) and ln r, fitted to double-precision quadrature
/// of 55 cosines and 20 roughnesses: within 1.5e-3. Sampled evenly over the hemisphere: no weight
/// is more than 2.8 times the colour.

#pragma once

#include <regain/closures/smooth_reflection.h>

REGAIN_NAMESPACE_BEGIN

namespace detail {

template <class RealType>
class ContyKullaModel
{
public:
    using Real = RealType;
    using Color = Color3<Real>;
    static constexpr int random_numbers = 2;
    static constexpr bool is_diffuse = false;

    REGAIN_HOST_DEVICE ContyKullaModel(const Color& color, Real roughness)
        : _color(per_channel(color, [](Real v) { return saturate(v); })),
          _r(sanitised(roughness, least_roughness, 1, 0.3)),
          _exponent(Real(1) / _r)
    {}

    REGAIN_HOST_DEVICE const Color& color() const { return _color; }
    REGAIN_HOST_DEVICE Real roughness() const { return _r; }

    REGAIN_HOST_DEVICE void describe(Traits& t) const
    {
        t.reciprocal = all<Real>(_r > constant<Real>(0.21));
    }

    /// E of the cosine mu in [0, 1].
    REGAIN_HOST_DEVICE Real albedo(const Real& mu) const
    {
        constexpr double c[7][4] = {{-0.449416, -0.180663, 0.0790144, 0.00686113},
                                    {-0.184009, -0.0521805, 0.0665093, 0.0317214},
                                    {-3.6509, 1.43314, -1.66014, -0.419068},
                                    {8.62928, -2.71309, 10.0984, 2.83199},
                                    {-13.3874, 1.44557, -28.0066, -7.49385},
                                    {11.0731, 2.77781, 34.1957, 8.8013},
                                    {-3.99561, -2.24291, -15.1002, -3.68413}};
        const Real s = sqrt(min(mu, Real(1))), b = detail::log(_r);
        Real sum(0);
        for (int i = 6; i >= 0; --i)
        {
            const auto k = [&](int j) { return constant<Real>(c[i][j]); };
            sum = sum * s + (k(0) + b * (k(1) + b * (k(2) + b * k(3))));
        }
        return detail::exp(sum);
    }

    class View
    {
    public:
        REGAIN_HOST_DEVICE View(const ContyKullaModel& model, const Vec3<Real>& wo)
            : _wo(wo), _color(model._color), _exponent(model._exponent)
        {
            const Real E = model.albedo(wo.z);
            _E = min(E, Real(1));
            _scale = (Real(2) + _exponent) * constant<Real>(inverse_pi / 8) / max(E, Real(1));
        }

        REGAIN_HOST_DEVICE ReflectionTerms<Real> terms(const Vec3<Real>& wi) const
        {
            const Vec3<Real> sum = _wo + wi;
            const Real across = sum.x * sum.x + sum.y * sum.y;
            const Real sine2 = across / max(across + sum.z * sum.z, constant<Real>(1e-30));
            // The logarithm inside a vector's pow takes no 0.
            const Real D = detail::pow(max(sine2, constant<Real>(1e-30)), Real(0.5f) * _exponent);
            const Real value = _scale * D * wi.z / (_wo.z + wi.z - _wo.z * wi.z);
            return {_color * value, constant<Real>(inverse_pi / 2)};
        }

        REGAIN_HOST_DEVICE Vec3<Real> draw(const Vec3<Real>& u) const
        {
            return even_direction(u.x, u.y);
        }

        REGAIN_HOST_DEVICE Color albedo() const { return _color * _E; }

    private:
        Vec3<Real> _wo;
        Color _color;
        Real _exponent, _E, _scale;
    };

private:
    static constexpr double least_roughness = 0.07;

    Color _color;
    Real _r, _exponent;
};

}  // namespace detail

template <class Real>
class ContyKullaSheen : public SmoothReflection<detail::ContyKullaModel<Real>>
{
public:
    /// color in [0, 1] per channel, clamped, NaN becomes 0. roughness in [0.07, 1], clamped, NaN
    /// becomes 0.3.
    REGAIN_HOST_DEVICE explicit ContyKullaSheen(const Color3<Real>& color,
                                                Real roughness = detail::constant<Real>(0.3))
        : SmoothReflection<detail::ContyKullaModel<Real>>(
              detail::ContyKullaModel<Real>(color, roughness))
    {}

    REGAIN_HOST_DEVICE const Color3<Real>& color() const { return this->model().color(); }
    REGAIN_HOST_DEVICE Real roughness() const { return this->model().roughness(); }
};

REGAIN_NAMESPACE_END
