// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Cloth by a linearly transformed cosine: mode "zeltner" of MaterialX's and OSL's sheen_bsdf
/// (Zeltner, Burley and Chiang 2022, a fit to walks in a layer of fibres):
///
///   f cos theta_i = color R z / (pi l^4) a^2,    l = |M wi|,  M wi = (a x + b z, a y, z)
///
/// wi = (x, y, z) in the frame in which wo has no y. R is the directional albedo, so that is known
/// without error, and every sample has the weight color R. a, b and R are functions of cos_o and
/// the roughness: the closed forms with which MaterialX replaces the paper's tables
/// (mx_microfacet_sheen.glsl, 1.39). It is not reciprocal.

#pragma once

#include <regain/closures/smooth_reflection.h>

REGAIN_NAMESPACE_BEGIN

namespace detail {

template <class RealType>
class ZeltnerModel
{
public:
    using Real = RealType;
    using Color = Color3<Real>;
    static constexpr int random_numbers = 2;
    static constexpr bool is_diffuse = false;

    REGAIN_HOST_DEVICE ZeltnerModel(const Color& color, Real roughness)
        : _color(per_channel(color, [](Real v) { return saturate(v); })),
          _r(sanitised(roughness, least_roughness, 1, 0.3))
    {}

    REGAIN_HOST_DEVICE const Color& color() const { return _color; }
    REGAIN_HOST_DEVICE Real roughness() const { return _r; }

    REGAIN_HOST_DEVICE void describe(Traits&) const {}

    class View
    {
    public:
        REGAIN_HOST_DEVICE View(const ZeltnerModel& model, const Vec3<Real>& wo)
            : _color(model._color), _frame(wo)
        {
            const auto k = [](double x) { return constant<Real>(x); };
            const Real x = min(wo.z, Real(1)), y = model._r, y2 = y * y;
            _a = (k(2.58126) * x + k(0.813703) * y) * y /
                 (Real(1) + k(0.310327) * x * x + k(2.60994) * x * y);
            _b = sqrt(Real(1) - x) * (y - Real(1)) * y2 * y /
                 (k(0.0000254053) + k(1.71228) * x - k(1.71506) * x * y + k(1.34174) * y2);

            const Real s =
                y * (k(0.0206607) + k(1.58491) * y) / (k(0.0379424) + y * (k(1.32227) + y));
            const Real m = y *
                           (k(-0.193854) + y * (k(-1.14885) + y * (k(1.7932) - k(0.95943) * y2))) /
                           (k(0.046391) + y);
            const Real o = y * (k(0.000654023) + (k(-0.0207818) + k(0.119681) * y) * y) /
                           (k(1.26264) + y * (k(-1.92021) + y));
            const Real d = (x - m) / s;
            _R = saturate(detail::exp(Real(-0.5f) * d * d) / s * k(0.39894228040143267794) + o);
        }

        REGAIN_HOST_DEVICE ReflectionTerms<Real> terms(const Vec3<Real>& direction) const
        {
            const Vec3<Real> wi = _frame.to(direction);
            const Real x = _a * wi.x + _b * wi.z, y = _a * wi.y;
            const Real length2 = x * x + y * y + wi.z * wi.z;
            const Real q = _a / length2;
            const Real density = constant<Real>(inverse_pi) * wi.z * q * q;
            return {_color * (_R * density), density};
        }

        REGAIN_HOST_DEVICE Vec3<Real> draw(const Vec3<Real>& u) const
        {
            const Vec3<Real> v = cosine_direction(u.x, u.y);
            const Vec3<Real> wi(v.x - _b * v.z, v.y, _a * v.z);
            return _frame.from(normalised(wi));
        }

        REGAIN_HOST_DEVICE Color albedo() const { return _color * _R; }

    private:
        Color _color;
        AzimuthFrame<Real> _frame;
        Real _a, _b, _R;
    };

private:
    // The closed forms fold at 0.
    static constexpr double least_roughness = 0.01;

    Color _color;
    Real _r;
};

}  // namespace detail

template <class Real>
class ZeltnerSheen : public SmoothReflection<detail::ZeltnerModel<Real>>
{
public:
    /// color in [0, 1] per channel, clamped, NaN becomes 0. roughness in [0.01, 1], clamped, NaN
    /// becomes 0.3.
    REGAIN_HOST_DEVICE explicit ZeltnerSheen(const Color3<Real>& color,
                                             Real roughness = detail::constant<Real>(0.3))
        : SmoothReflection<detail::ZeltnerModel<Real>>(detail::ZeltnerModel<Real>(color, roughness))
    {}

    REGAIN_HOST_DEVICE const Color3<Real>& color() const { return this->model().color(); }
    REGAIN_HOST_DEVICE Real roughness() const { return this->model().roughness(); }
};

REGAIN_NAMESPACE_END
