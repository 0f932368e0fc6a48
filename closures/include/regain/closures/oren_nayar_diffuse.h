// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Rough diffuse reflection: MaterialX's and OSL's oren_nayar_diffuse_bsdf. Of two directions it
/// knows their cosines and
///
///   s = wo.wi - cos_o cos_i = sin_o sin_i cos(phi_o - phi_i)
///
/// With energy_compensation, EON (Portsmouth, Kutz and Hill 2025, JCGT 14(1), Eqs. 13 to 18, with
/// Fujii's single scattering), r the roughness, rho the colour:
///
///   f = rho / pi A (1 + r s / t)  +  rho_ms / pi (1 - E(cos_o)) (1 - E(cos_i)) / (1 - <E>)
///   t = max(cos_o, cos_i) where s > 0, else 1
///   A = 1 / (1 + c1 r),  c1 = 1/2 - 2 / (3 pi),     <E> = A (1 + c2 r),  c2 = 2/3 - 28 / (15 pi)
///   E(cos) = A (1 + r G / pi),  G = sin (theta - sin cos) + 2/3 (sin / cos (1 - sin^3) - sin)
///   rho_ms = rho^2 <E> / (1 - rho (1 - <E>))
///
/// It loses nothing where rho = 1, and is reciprocal. Its albedo is rho E + rho_ms (1 - E).
///
/// Without, the qualitative model of Oren and Nayar 1994, Eq. 30, r the standard deviation of the
/// slopes' angle in radians:
///
///   f = rho / pi (A + B max(s, 0) / max(cos_o, cos_i))
///   A = 1 - r^2 / (2 (r^2 + 0.33)),    B = 0.45 r^2 / (r^2 + 0.09)
///
/// which loses up to 0.38 of a white one's light, and where r is about 0.2, at grazing angles,
/// makes 0.015. Its albedo is rho (A + B / pi (G + 2/3 sin)).
///
/// Both are sampled as the paper does (its Listing 2): a cosine lobe, clipped at the horizon of
/// what it becomes, through the linear map that fits EON best (numbers: that listing), and evenly
/// over the hemisphere as a defence.

#pragma once

#include <regain/closures/smooth_reflection.h>

REGAIN_NAMESPACE_BEGIN

namespace detail {

template <class RealType>
class OrenNayarModel
{
public:
    using Real = RealType;
    using Color = Color3<Real>;
    static constexpr int random_numbers = 3;
    static constexpr bool is_diffuse = true;

    REGAIN_HOST_DEVICE OrenNayarModel(const Color& color, Real roughness, bool compensated)
        : _color(per_channel(color, [](Real v) { return saturate(v); })),
          _r(saturate(roughness)),
          _compensated(compensated)
    {
        const Real r2 = _r * _r;
        if (!_compensated)
        {
            _A = Real(1) - Real(0.5f) * r2 / (r2 + constant<Real>(0.33));
            _B = constant<Real>(0.45) * r2 / (r2 + constant<Real>(0.09));
            return;
        }
        _A = Real(1) / (Real(1) + constant<Real>(c1) * _r);
        _B = _r * _A;
        const Real lost = _B * constant<Real>(c1 - c2);
        _later = per_channel(_color, [&](Real rho) {
            return rho * rho * (Real(1) - lost) / (Real(1) - rho * lost);
        });
    }

    REGAIN_HOST_DEVICE const Color& color() const { return _color; }
    REGAIN_HOST_DEVICE Real roughness() const { return _r; }
    REGAIN_HOST_DEVICE bool compensated() const { return _compensated; }

    REGAIN_HOST_DEVICE void describe(Traits& t) const
    {
        t.reciprocal = true;
        t.energy_preserving = _compensated;
    }

    /// (1 - E) / (r A) of the cosine mu in [0, 1], which needs no difference of what is nearly 1.
    REGAIN_HOST_DEVICE static Real loss(const Real& mu)
    {
        const Lost g(mu);
        return max(constant<Real>(c1) - constant<Real>(inverse_pi) * (g.ahead - g.behind), Real(0));
    }

    class View
    {
    public:
        REGAIN_HOST_DEVICE View(const OrenNayarModel& model, const Vec3<Real>& wo)
            : _model(model), _wo(wo), _frame(wo), _loss(loss(wo.z))
        {
            const Real mu = min(wo.z, Real(1)), r = model._r;
            const auto k = [](double x) { return constant<Real>(x); };
            _a = Real(1) + r * (k(0.303392) + (k(-0.518982) + k(0.111709) * mu) * mu +
                                (k(-0.276266) + k(0.335918) * mu) * r);
            _b = r * (k(-1.16407) + k(1.15859) * mu + (k(0.150815) - k(0.150105) * mu) * r) /
                 (mu * mu * mu - k(1.43545));
            _c = Real(1) + (k(0.20013) + (k(-0.506373) + k(0.261777) * mu) * mu) * r;
            // Along the normal the fit has a trace of the other sign, which would clip the other
            // side.
            _d = min((k(0.540852) + (k(-1.01625) + k(0.475392) * mu) * mu) * r /
                         (k(-1.0743) + (k(0.0725628) + mu) * mu),
                     Real(0));
            _even = select(r > Real(0), detail::pow(max(r, k(1e-30)), k(0.1)), Real(0)) *
                    (k(0.162925) + (k(-0.372058) + (k(0.538233) - k(0.290822) * mu) * mu) * mu);
            _cosine = Real(1) / sqrt(_d * _d + Real(1));
            _determinant = _a - _b * _d;
        }

        REGAIN_HOST_DEVICE ReflectionTerms<Real> terms(const Vec3<Real>& wi) const
        {
            const Real cos_o = _wo.z, cos_i = wi.z;
            const Real s = _wo.x * wi.x + _wo.y * wi.y;
            const Real ahead = max(s, Real(0)) / max(cos_o, cos_i);
            const Real scale = constant<Real>(inverse_pi) * cos_i;
            ReflectionTerms<Real> t;
            if (_model._compensated)
            {
                const Real single = max(_model._A + _model._B * (ahead + min(s, Real(0))), Real(0));
                const Real later = _model._B * _loss * loss(cos_i) * constant<Real>(1 / (c1 - c2));
                t.value = (_model._color * single + _model._later * later) * scale;
            }
            else
                t.value = _model._color * ((_model._A + _model._B * ahead) * scale);
            t.density = density(_frame.to(wi));
            return t;
        }

        REGAIN_HOST_DEVICE Vec3<Real> draw(const Vec3<Real>& u) const
        {
            const MaskOf<Real> even = u.z < _even;
            const Vec3<Real> disc = cosine_direction(u.x, u.y);
            const Real across = sqrt(max((Real(1) - disc.y) * (Real(1) + disc.y), Real(0)));
            const Real share = Real(0.5f) * (Real(1) + _cosine);
            const Real x = across * (share - Real(1)) - disc.x * share;
            const Real z = sqrt(max(across * across - x * x, Real(0)));
            const Vec3<Real> mapped(_a * x + _b * z, _c * disc.y, _d * x + z);
            const Vec3<Real> wi = _frame.from(normalised(mapped));
            return select(even, even_direction(u.x, u.y), wi);
        }

        REGAIN_HOST_DEVICE Color albedo() const
        {
            if (!_model._compensated)
            {
                const Lost g(_wo.z);
                return _model._color *
                       (_model._A + _model._B * constant<Real>(inverse_pi) * g.ahead);
            }
            const Real lost = _model._B * _loss;
            return _model._color * (Real(1) - lost) + _model._later * lost;
        }

    private:
        // wi in the frame of wo.
        REGAIN_HOST_DEVICE Real density(const Vec3<Real>& wi) const
        {
            // Back through the map, times its determinant over c.
            const Vec3<Real> v(wi.x - _b * wi.z, _determinant * wi.y / _c, _a * wi.z - _d * wi.x);
            const Real length2 = dot(v, v), up = max(v.z, Real(0));
            const Real lobe = up * _determinant * _determinant / (_c * length2 * length2) *
                              constant<Real>(2 * inverse_pi) / (Real(1) + _cosine);
            return (Real(1) - _even) * lobe + _even * constant<Real>(inverse_pi / 2);
        }

        OrenNayarModel _model;
        Vec3<Real> _wo;
        AzimuthFrame<Real> _frame;
        Real _loss;
        Real _a, _b, _c, _d;         // the map: (a x + b z, c y, d x + z)
        Real _even;                  // share of samples that are even over the hemisphere
        Real _cosine, _determinant;  // of the clipping plane; of the map over c
    };

private:
    static constexpr double c1 = 0.5 - 2 * inverse_pi / 3, c2 = 2.0 / 3 - 28 * inverse_pi / 15;

    // G of mu, in the parts of where s > 0 and where it is not.
    struct Lost
    {
        REGAIN_HOST_DEVICE explicit Lost(const Real& mu)
        {
            const Real m = min(mu, Real(1)), sine = sqrt((Real(1) - m) * (Real(1) + m));
            const Real theta = constant<Real>(1.57079632679489661923) - detail::asin(m);
            // sin / cos (1 - sin^3), which divides by no cosine so.
            const Real quotient = sine * m * (Real(1) + sine + sine * sine) / (Real(1) + sine);
            ahead = sine * (theta - sine * m) + constant<Real>(2.0 / 3) * quotient;
            behind = constant<Real>(2.0 / 3) * sine;
        }
        Real ahead, behind;
    };

    Color _color;
    Real _r;
    bool _compensated;
    Real _A, _B;
    Color _later = Color(Real(0));  // rho_ms
};

}  // namespace detail

template <class Real>
class OrenNayarDiffuse : public SmoothReflection<detail::OrenNayarModel<Real>>
{
public:
    /// color in [0, 1] per channel, roughness in [0, 1]; clamped, NaN becomes 0.
    REGAIN_HOST_DEVICE explicit OrenNayarDiffuse(const Color3<Real>& color,
                                                 Real roughness = Real(0),
                                                 bool energy_compensation = true)
        : SmoothReflection<detail::OrenNayarModel<Real>>(
              detail::OrenNayarModel<Real>(color, roughness, energy_compensation))
    {}

    REGAIN_HOST_DEVICE const Color3<Real>& color() const { return this->model().color(); }
    REGAIN_HOST_DEVICE Real roughness() const { return this->model().roughness(); }
    REGAIN_HOST_DEVICE bool energy_compensation() const { return this->model().compensated(); }
};

REGAIN_NAMESPACE_END
