// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A closure that reflects with a density everywhere, made from its formulas alone. A model is
///
///     using Real
///     static constexpr int random_numbers      2 or 3
///     static constexpr bool is_diffuse         what light path expressions call it
///     void describe(Traits&) const             what it promises besides an exact pdf
///     View(const Model&, const Vec3<Real>& wo) nested; wo is unit and above the horizon
///       .terms(wi)     a ReflectionTerms; wi is above the horizon, too
///       .draw(u)       a unit wi above the horizon for u in [0, 1]^3, distributed by the density
///       .albedo()      Color3<Real>, of wo
///
/// Garbage in directions gets what closure.h says; a model never sees it.

#pragma once

#include <regain/closures/closure.h>

REGAIN_NAMESPACE_BEGIN

/// What a model says of a pair of directions.
template <class Real>
struct ReflectionTerms
{
    Color3<Real> value;  ///< f cos theta_i
    Real density;        ///< of wi, per steradian; positive
};

template <class ModelType>
class SmoothReflection : public Shorthands<SmoothReflection<ModelType>, typename ModelType::Real>
{
public:
    using Model = ModelType;
    using Real = typename Model::Real;
    using Mask = MaskOf<Real>;
    using Color = Color3<Real>;
    static constexpr int random_numbers = Model::random_numbers;
    static constexpr bool is_diffuse = Model::is_diffuse;

    REGAIN_HOST_DEVICE explicit SmoothReflection(const Model& model) : _model(model) {}

    REGAIN_HOST_DEVICE const Model& model() const { return _model; }

    REGAIN_HOST_DEVICE Traits traits() const
    {
        Traits t;
        t.exact_pdf = true;
        t.random_numbers = random_numbers;
        _model.describe(t);
        return t;
    }

    class Prepared
    {
    public:
        REGAIN_HOST_DEVICE Prepared(const SmoothReflection& closure, const Vec3<Real>& wo)
            : _valid(detail::is_above_horizon(wo)),
              _wo(detail::normalised(
                  detail::select(_valid, wo, Vec3<Real>(Real(0), Real(0), Real(1))))),
              _weight(detail::select(_valid, Color(Real(1)), Color(Real(0)))),
              _view(closure._model, _wo)
        {}

        REGAIN_HOST_DEVICE const Vec3<Real>& wo() const { return _wo; }
        REGAIN_HOST_DEVICE void scale_by(const Color& weight) { _weight *= weight; }

        REGAIN_HOST_DEVICE Color eval(const Vec3<Real>& wi) const
        {
            const Mask valid = detail::both<Real>(_valid, detail::is_above_horizon(wi));
            return detail::select(valid, _weight * terms(valid, wi).value, Color(Real(0)));
        }

        REGAIN_HOST_DEVICE Sample<Real> sample(const Vec2<Real>& u) const
        {
            return sample(detail::two_numbers<SmoothReflection>(u));
        }
        REGAIN_HOST_DEVICE Sample<Real> sample(const Vec3<Real>& u) const
        {
            Vec3<Real> wi = _view.draw(
                Vec3<Real>(detail::saturate(u.x), detail::saturate(u.y), detail::saturate(u.z)));
            // The horizon itself has no density.
            wi.z = detail::max(wi.z, detail::constant<Real>(2 * detail::horizon));
            const ReflectionTerms<Real> t = terms(_valid, wi);

            Sample<Real> s;
            s.valid = _valid;
            s.wi = detail::select(_valid, wi, Vec3<Real>(Real(0), Real(0), Real(1)));
            s.weight =
                detail::select(_valid, _weight * t.value * (Real(1) / t.density), Color(Real(0)));
            s.pdf = detail::select(_valid, t.density, Real(0));
            return s;
        }

        REGAIN_HOST_DEVICE Real pdf(const Vec3<Real>& wi) const
        {
            const Mask valid = detail::both<Real>(_valid, detail::is_above_horizon(wi));
            return detail::select(valid, terms(valid, wi).density, Real(0));
        }

        REGAIN_HOST_DEVICE Albedo<Real> albedo() const
        {
            return {_weight * _view.albedo(), Color(Real(0))};
        }

    private:
        REGAIN_HOST_DEVICE ReflectionTerms<Real> terms(const Mask& valid,
                                                       const Vec3<Real>& wi) const
        {
            return _view.terms(detail::select(valid, wi, Vec3<Real>(Real(0), Real(0), Real(1))));
        }

        Mask _valid;
        Vec3<Real> _wo;
        Color _weight;
        typename Model::View _view;
    };

    REGAIN_HOST_DEVICE Prepared prepare(const Vec3<Real>& wo) const { return Prepared(*this, wo); }

private:
    Model _model;
};

namespace detail {

/// A unit wi by the cosine for u in [0, 1]^2.
template <class Real>
REGAIN_HOST_DEVICE Vec3<Real> cosine_direction(const Real& u, const Real& v)
{
    const Real sine = sqrt(u), phi = constant<Real>(6.28318530717958647692) * v;
    return {sine * detail::cos(phi), sine * detail::sin(phi), sqrt(Real(1) - u)};
}

/// Evenly over the hemisphere.
template <class Real>
REGAIN_HOST_DEVICE Vec3<Real> even_direction(const Real& u, const Real& v)
{
    const Real sine = sqrt(max((Real(1) - u) * (Real(1) + u), Real(0))),
               phi = constant<Real>(6.28318530717958647692) * v;
    return {sine * detail::cos(phi), sine * detail::sin(phi), u};
}

constexpr double inverse_pi = 0.318309886183790671538;

/// The frame about the normal in which wo has no y, and x >= 0.
template <class Real>
class AzimuthFrame
{
public:
    REGAIN_HOST_DEVICE explicit AzimuthFrame(const Vec3<Real>& wo)
    {
        const Real s2 = wo.x * wo.x + wo.y * wo.y;
        const MaskOf<Real> slanted = s2 > constant<Real>(1e-30);
        const Real scale = Real(1) / sqrt(select(slanted, s2, Real(1)));
        _cos = select(slanted, wo.x * scale, Real(1));
        _sin = select(slanted, wo.y * scale, Real(0));
    }
    REGAIN_HOST_DEVICE Vec3<Real> to(const Vec3<Real>& w) const
    {
        return {_cos * w.x + _sin * w.y, _cos * w.y - _sin * w.x, w.z};
    }
    REGAIN_HOST_DEVICE Vec3<Real> from(const Vec3<Real>& w) const
    {
        return {_cos * w.x - _sin * w.y, _sin * w.x + _cos * w.y, w.z};
    }

private:
    Real _cos, _sin;
};

}  // namespace detail

REGAIN_NAMESPACE_END
