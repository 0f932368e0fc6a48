// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A Dielectric and added lobes with what it loses, as one closure: what `kulla-conty` and `tail`
/// of a dielectric have in common. `Added` tells loss(), which is 1 - E^S(wo), of its prepared
/// form, and bound(), whether it has its tables.

#pragma once

#include <regain/closures/count.h>
#include <regain/closures/dielectric.h>
#include <regain/closures/sum.h>

REGAIN_NAMESPACE_BEGIN

template <class LobeType, class AddedType>
class DielectricWithAddedLobes
    : public Shorthands<DielectricWithAddedLobes<LobeType, AddedType>, typename LobeType::Real>
{
public:
    using Lobe = LobeType;
    using Real = typename Lobe::Real;
    using Color = Color3<Real>;
    using Added = AddedType;
    using Mixture = Sum<Lobe, Added>;
    static constexpr int random_numbers = Mixture::random_numbers;

    /// strength is what the added lobes were built with; clamped to [0, 1], NaN becomes 0.
    REGAIN_HOST_DEVICE DielectricWithAddedLobes(const Lobe& lobe, const Added& added, Real strength)
        : _mixture(lobe, added)
    {
        const Real F = DielectricFresnel<Real>(lobe.eta()).average_reflectance();
        const bool reflects = lobe.scatter_mode() != ScatterMode::T,
                   transmits = lobe.scatter_mode() != ScatterMode::R;
        _scattered = (reflects ? total(lobe.reflection_tint()) * F : Real(0)) +
                     (transmits ? total(lobe.transmission_tint()) * (Real(1) - F) : Real(0));

        const auto& distribution = lobe.distribution();
        // The tables know one width; what they say of two is an estimate.
        _preserves = added.bound() && reflects && transmits &&
                     detail::all<Real>(detail::saturate(strength) == Real(1)) &&
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
        REGAIN_HOST_DEVICE Prepared(const DielectricWithAddedLobes& closure, const Vec3<Real>& wo)
            : Prepared(closure, closure.lobe().prepare(wo), closure.added_lobe().prepare(wo))
        {}

    private:
        // A sample of the lobe is worth about 1 or nothing, so its second moment is its albedo. In
        // proportion to albedos the largest weight would be 1 / E^S, 7 where this has 3.
        REGAIN_HOST_DEVICE Prepared(const DielectricWithAddedLobes& closure,
                                    const typename Lobe::Prepared& lobe,
                                    const typename Added::Prepared& added)
            : Mixture::Prepared(lobe, added, size(closure, lobe, Real(1) - added.loss()),
                                total(added.albedo()))
        {
            REGAIN_COUNTED(gains);
        }

        // Of reflection alone a sample is worth its share of E^S, which the average over directions
        // does not tell: near eta = 1 nothing reflects but what grazes. Of transmission alone the
        // average is better, since tables know little of a share that is next to nothing.
        REGAIN_HOST_DEVICE static Real size(const DielectricWithAddedLobes& closure,
                                            const typename Lobe::Prepared& lobe, Real E)
        {
            const Real root = detail::sqrt(detail::max(E, Real(0)));
            if (closure.lobe().scatter_mode() != ScatterMode::R || !closure.lobe().tables())
                return closure._scattered * root;
            return total(lobe.albedo()) / detail::max(root, detail::constant<Real>(1e-6));
        }
    };

    REGAIN_HOST_DEVICE Prepared prepare(const Vec3<Real>& wo) const { return Prepared(*this, wo); }

private:
    REGAIN_HOST_DEVICE static Real total(const Color& c) { return c.x + c.y + c.z; }
    REGAIN_HOST_DEVICE static Real total(const Albedo<Real>& a)
    {
        return total(a.reflect) + total(a.transmit);
    }

    Mixture _mixture;
    Real _scattered;  // how much of what is not lost is seen, over all directions of wo
    bool _preserves;
};

REGAIN_NAMESPACE_END
