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
    explicit Transparent(const Color& color = Color(Real(1)))
        : _color(detail::per_channel(color, [](Real v) { return detail::saturate(v); }))
    {}

    const Color& color() const { return _color; }

    Traits traits() const
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
        Prepared(const Transparent& closure, const Vec3<Real>& wo)
            : _valid(detail::both<Real>(
                  detail::is_direction(wo),
                  detail::quiet_less(detail::constant<Real>(detail::horizon), detail::abs(wo.z)))),
              _wo(detail::normalised(
                  detail::select(_valid, wo, Vec3<Real>(Real(0), Real(0), Real(1))))),
              _weight(detail::select(_valid, closure._color, Color(Real(0))))
        {}

        const Vec3<Real>& wo() const { return _wo; }
        void scale_by(const Color& weight) { _weight *= weight; }

        Color eval(const Vec3<Real>&) const { return Color(Real(0)); }
        Real pdf(const Vec3<Real>&) const { return Real(0); }

        Sample<Real> sample(const Vec2<Real>&) const { return sample(); }
        Sample<Real> sample(const Vec3<Real>&) const { return sample(); }

        Albedo<Real> albedo() const { return {Color(Real(0)), _weight}; }

    private:
        Sample<Real> sample() const
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

    Prepared prepare(const Vec3<Real>& wo) const { return Prepared(*this, wo); }

private:
    Color _color;
};

REGAIN_NAMESPACE_END
