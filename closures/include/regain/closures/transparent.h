// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Light that goes straight on: OSL's transparent_bsdf. A delta lobe, the same from both sides:
/// every sample is wi = -wo with the weight color. Hosts that know opacity are better told that.

#pragma once

#include <regain/closures/closure.h>

REGAIN_NAMESPACE_BEGIN

template <class RealType>
class Transparent : public Shorthands<Transparent<RealType>, RealType>
{
public:
    using Real = RealType;
    using Mask = MaskOf<Real>;
    using Color = Color3<Real>;
    static constexpr int random_numbers = 2;
    static constexpr bool passes_straight = true;  ///< nothing of it has a density

    /// Colour in [0, 1] per channel; outside it is clamped, NaN becomes 0.
    REGAIN_HOST_DEVICE explicit Transparent(const Color& color = Color(Real(1)))
        : _color(detail::per_channel(color, [](Real v) { return detail::saturate(v); }))
    {}

    REGAIN_HOST_DEVICE const Color& color() const { return _color; }

    REGAIN_HOST_DEVICE Traits traits() const
    {
        Traits t;
        t.reciprocal = t.energy_preserving = t.exact_pdf = true;
        t.delta = t.transmissive = true;
        t.random_numbers = random_numbers;
        return t;
    }

    class Prepared
    {
    public:
        REGAIN_HOST_DEVICE Prepared(const Transparent& closure, const Vec3<Real>& wo)
            : _valid(detail::both<Real>(
                  detail::is_direction(wo),
                  detail::quiet_less(detail::constant<Real>(detail::horizon), detail::abs(wo.z)))),
              _wo(detail::normalised(
                  detail::select(_valid, wo, Vec3<Real>(Real(0), Real(0), Real(1))))),
              _weight(detail::select(_valid, closure._color, Color(Real(0))))
        {}

        REGAIN_HOST_DEVICE const Vec3<Real>& wo() const { return _wo; }
        REGAIN_HOST_DEVICE void scale_by(const Color& weight) { _weight *= weight; }

        REGAIN_HOST_DEVICE Color eval(const Vec3<Real>&) const { return Color(Real(0)); }
        REGAIN_HOST_DEVICE Real pdf(const Vec3<Real>&) const { return Real(0); }

        REGAIN_HOST_DEVICE Sample<Real> sample(const Vec2<Real>&) const { return sample(); }
        REGAIN_HOST_DEVICE Sample<Real> sample(const Vec3<Real>&) const { return sample(); }

        REGAIN_HOST_DEVICE Albedo<Real> albedo() const { return {Color(Real(0)), _weight}; }

    private:
        REGAIN_HOST_DEVICE Sample<Real> sample() const
        {
            Sample<Real> s;
            s.valid = s.delta = s.transmitted = _valid;
            s.wi = detail::select(_valid, -_wo, Vec3<Real>(Real(0), Real(0), Real(1)));
            s.weight = _weight;
            s.pdf = detail::select(_valid, Real(1), Real(0));
            return s;
        }

        Mask _valid;
        Vec3<Real> _wo;
        Color _weight;
    };

    REGAIN_HOST_DEVICE Prepared prepare(const Vec3<Real>& wo) const { return Prepared(*this, wo); }

private:
    Color _color;
};

REGAIN_NAMESPACE_END
