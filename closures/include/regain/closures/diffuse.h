// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Lambertian reflection, f = albedo / pi. MaterialX's oren_nayar_diffuse_bsdf at roughness 0,
/// OSL's diffuse. Sampled by the cosine, so every weight is the albedo.

#pragma once

#include <regain/closures/closure.h>

REGAIN_NAMESPACE_BEGIN

template <class RealType>
class Diffuse : public Shorthands<Diffuse<RealType>, RealType>
{
public:
    using Real = RealType;
    using Mask = MaskOf<Real>;
    using Color = Color3<Real>;
    static constexpr int random_numbers = 2;
    static constexpr bool is_diffuse = true;

    /// Albedo in [0, 1] per channel; outside it is clamped, NaN becomes 0.
    REGAIN_HOST_DEVICE explicit Diffuse(const Color& albedo)
        : _albedo(detail::per_channel(albedo, [](Real v) { return detail::saturate(v); }))
    {}

    REGAIN_HOST_DEVICE const Color& color() const { return _albedo; }

    REGAIN_HOST_DEVICE Traits traits() const
    {
        Traits t;
        t.reciprocal = true;
        t.energy_preserving = true;
        t.exact_pdf = true;
        t.random_numbers = random_numbers;
        return t;
    }

    class Prepared
    {
    public:
        REGAIN_HOST_DEVICE Prepared(const Diffuse& closure, const Vec3<Real>& wo)
            : _valid(detail::is_above_horizon(wo)),
              _wo(detail::select(_valid, wo, Vec3<Real>(Real(0), Real(0), Real(1)))),
              _weight(detail::select(_valid, closure._albedo, Color(Real(0))))
        {}

        REGAIN_HOST_DEVICE const Vec3<Real>& wo() const { return _wo; }
        REGAIN_HOST_DEVICE void scale_by(const Color& weight) { _weight *= weight; }

        REGAIN_HOST_DEVICE Color eval(const Vec3<Real>& wi) const { return _weight * pdf(wi); }

        REGAIN_HOST_DEVICE Sample<Real> sample(const Vec2<Real>& u) const
        {
            return sample(detail::two_numbers<Diffuse>(u));
        }
        REGAIN_HOST_DEVICE Sample<Real> sample(const Vec3<Real>& u) const
        {
            // The horizon itself has no density.
            const Real sine2 = detail::saturate(u.x);
            const Real z = detail::max(detail::sqrt(Real(1) - sine2),
                                       detail::constant<Real>(2 * detail::horizon));
            const Real sine = detail::sqrt(sine2);
            const Real phi = detail::constant<Real>(6.28318530717958647692) * detail::saturate(u.y);

            Sample<Real> s;
            s.valid = _valid;
            s.wi = detail::select(_valid,
                                  Vec3<Real>(sine * detail::cos(phi), sine * detail::sin(phi), z),
                                  Vec3<Real>(Real(0), Real(0), Real(1)));
            s.weight = _weight;
            s.pdf = pdf(s.wi);
            return s;
        }

        REGAIN_HOST_DEVICE Real pdf(const Vec3<Real>& wi) const
        {
            const Mask valid = detail::both<Real>(_valid, detail::is_above_horizon(wi));
            return detail::select(valid, wi.z, Real(0)) *
                   detail::constant<Real>(0.318309886183790671538);
        }

        REGAIN_HOST_DEVICE Albedo<Real> albedo() const { return {_weight, Color(Real(0))}; }

    private:
        Mask _valid;
        Vec3<Real> _wo;
        Color _weight;
    };

    REGAIN_HOST_DEVICE Prepared prepare(const Vec3<Real>& wo) const { return Prepared(*this, wo); }

private:
    Color _albedo;
};

REGAIN_NAMESPACE_END
