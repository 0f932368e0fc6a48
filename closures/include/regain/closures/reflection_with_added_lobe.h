// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A MicrofacetReflection and an added lobe with what it loses, as one closure: what
/// `kulla-conty` and `tail` of a mirror have in common. `Added` tells loss(), which is 1 -
/// E_ss(wo), of its prepared form, and bound(), whether it has its tables.

#pragma once

#include <regain/closures/count.h>
#include <regain/closures/sum.h>

REGAIN_NAMESPACE_BEGIN

template <class LobeType, class AddedType>
class ReflectionWithAddedLobe
    : public Shorthands<ReflectionWithAddedLobe<LobeType, AddedType>, typename LobeType::Real>
{
public:
    using Lobe = LobeType;
    using Added = AddedType;
    using Real = typename Lobe::Real;
    using Color = Color3<Real>;
    using Mixture = Sum<Lobe, Added>;
    static constexpr int random_numbers = Mixture::random_numbers;

    /// strength is what the added lobe was built with; clamped to [0, 1], NaN becomes 0.
    REGAIN_HOST_DEVICE ReflectionWithAddedLobe(const Lobe& lobe, const Added& added, Real strength)
        : _mixture(lobe, added), _F_ss(lobe.fresnel().average())
    {
        const auto& distribution = lobe.distribution();
        // Of two widths the tables know to one per cent, which is no promise.
        _preserves = added.bound() && detail::all<Real>(detail::saturate(strength) == Real(1)) &&
                     detail::all<Real>(distribution.alpha_x() == distribution.alpha_y());
    }

    REGAIN_HOST_DEVICE const Lobe& lobe() const { return _mixture.first(); }
    REGAIN_HOST_DEVICE const Added& added_lobe() const { return _mixture.second(); }

    REGAIN_HOST_DEVICE Traits traits() const
    {
        Traits t = _mixture.traits();
        t.energy_preserving = _preserves;
        return t;
    }

    class Prepared : public Mixture::Prepared
    {
    public:
        REGAIN_HOST_DEVICE Prepared(const ReflectionWithAddedLobe& closure, const Vec3<Real>& wo)
            : Prepared(closure, closure.lobe().prepare(wo), closure.added_lobe().prepare(wo))
        {}

    private:
        // The lobe's own albedo would cost more look-ups, or an integral where there are none.
        REGAIN_HOST_DEVICE Prepared(const ReflectionWithAddedLobe& closure,
                                    const typename Lobe::Prepared& lobe,
                                    const typename Added::Prepared& added)
            : Mixture::Prepared(lobe, added, total(closure._F_ss) * (Real(1) - added.loss()),
                                total(added.albedo().reflect))
        {
            REGAIN_COUNTED(gains);
        }
        REGAIN_HOST_DEVICE static Real total(const Color& c) { return c.x + c.y + c.z; }
    };

    REGAIN_HOST_DEVICE Prepared prepare(const Vec3<Real>& wo) const { return Prepared(*this, wo); }

private:
    Mixture _mixture;
    Color _F_ss;
    bool _preserves;
};

REGAIN_NAMESPACE_END
