// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Lambertian transmission, f = color / pi on the other side of the surface: MaterialX's and OSL's
/// translucent_bsdf, a sheet of paper. It is the same from both sides, one medium is on either, and
/// no index is between them. Sampled by the cosine, so every weight is the colour.

#pragma once

#include <regain/closures/diffuse.h>

REGAIN_NAMESPACE_BEGIN

template <class RealType>
class Translucent : public Shorthands<Translucent<RealType>, RealType>
{
public:
    using Real = RealType;
    using Mask = MaskOf<Real>;
    using Color = Color3<Real>;
    static constexpr int random_numbers = Diffuse<Real>::random_numbers;
    static constexpr bool is_diffuse = true;

    /// Colour in [0, 1] per channel; outside it is clamped, NaN becomes 0.
    REGAIN_HOST_DEVICE explicit Translucent(const Color& color) : _diffuse(color) {}

    REGAIN_HOST_DEVICE const Color& color() const { return _diffuse.color(); }

    REGAIN_HOST_DEVICE Traits traits() const
    {
        Traits t = _diffuse.traits();
        t.transmissive = true;
        return t;
    }

    class Prepared
    {
    public:
        REGAIN_HOST_DEVICE Prepared(const Translucent& closure, const Vec3<Real>& wo)
            : _above(closure._diffuse, mirrored(wo, detail::quiet_less(wo.z, Real(0)))),
              _below(detail::quiet_less(wo.z, Real(0)))
        {
            _wo = mirrored(_above.wo(), _below);
        }

        REGAIN_HOST_DEVICE const Vec3<Real>& wo() const { return _wo; }
        REGAIN_HOST_DEVICE void scale_by(const Color& weight) { _above.scale_by(weight); }

        REGAIN_HOST_DEVICE Color eval(const Vec3<Real>& wi) const
        {
            return _above.eval(opposite(wi));
        }
        REGAIN_HOST_DEVICE Real pdf(const Vec3<Real>& wi) const { return _above.pdf(opposite(wi)); }

        REGAIN_HOST_DEVICE Sample<Real> sample(const Vec2<Real>& u) const
        {
            return sample(detail::two_numbers<Translucent>(u));
        }
        REGAIN_HOST_DEVICE Sample<Real> sample(const Vec3<Real>& u) const
        {
            Sample<Real> s = _above.sample(u);
            s.transmitted = s.valid;
            s.wi = detail::select(s.valid, opposite(s.wi), s.wi);
            return s;
        }

        REGAIN_HOST_DEVICE Albedo<Real> albedo() const
        {
            return {Color(Real(0)), _above.albedo().reflect};
        }

    private:
        REGAIN_HOST_DEVICE static Vec3<Real> mirrored(const Vec3<Real>& w, const Mask& below)
        {
            return {w.x, w.y, detail::select(below, -w.z, w.z)};
        }
        // Of a direction on the other side than wo, one above the horizon; and back.
        REGAIN_HOST_DEVICE Vec3<Real> opposite(const Vec3<Real>& w) const
        {
            return mirrored(w, !_below);
        }

        typename Diffuse<Real>::Prepared _above;
        Mask _below;
        Vec3<Real> _wo;
    };

    REGAIN_HOST_DEVICE Prepared prepare(const Vec3<Real>& wo) const { return Prepared(*this, wo); }

private:
    Diffuse<Real> _diffuse;
};

REGAIN_NAMESPACE_END
