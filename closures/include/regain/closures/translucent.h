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
    explicit Translucent(const Color& color) : _diffuse(color) {}

    const Color& color() const { return _diffuse.color(); }

    Traits traits() const
    {
        Traits t = _diffuse.traits();
        t.transmissive = true;
        return t;
    }

    class Prepared
    {
    public:
        Prepared(const Translucent& closure, const Vec3<Real>& wo)
            : _above(closure._diffuse, mirrored(wo, detail::quiet_less(wo.z, Real(0)))),
              _below(detail::quiet_less(wo.z, Real(0)))
        {
            _wo = mirrored(_above.wo(), _below);
        }

        const Vec3<Real>& wo() const { return _wo; }
        void scale_by(const Color& weight) { _above.scale_by(weight); }

        Color eval(const Vec3<Real>& wi) const { return _above.eval(opposite(wi)); }
        Real pdf(const Vec3<Real>& wi) const { return _above.pdf(opposite(wi)); }

        Sample<Real> sample(const Vec2<Real>& u) const
        {
            return sample(detail::two_numbers<Translucent>(u));
        }
        Sample<Real> sample(const Vec3<Real>& u) const
        {
            Sample<Real> s = _above.sample(u);
            s.transmitted = s.valid;
            s.wi = detail::select(s.valid, opposite(s.wi), s.wi);
            return s;
        }

        Albedo<Real> albedo() const { return {Color(Real(0)), _above.albedo().reflect}; }

    private:
        static Vec3<Real> mirrored(const Vec3<Real>& w, const Mask& below)
        {
            return {w.x, w.y, detail::select(below, -w.z, w.z)};
        }
        // Of a direction on the other side than wo, one above the horizon; and back.
        Vec3<Real> opposite(const Vec3<Real>& w) const { return mirrored(w, !_below); }

        typename Diffuse<Real>::Prepared _above;
        Mask _below;
        Vec3<Real> _wo;
    };

    Prepared prepare(const Vec3<Real>& wo) const { return Prepared(*this, wo); }

private:
    Diffuse<Real> _diffuse;
};

REGAIN_NAMESPACE_END
