// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Fresnel reflectance of a conductor by two colours: r, what it reflects at normal incidence, and
/// g, the tint of its edge (Gulbrandsen 2014, "Artist Friendly Metallic Fresnel"):
///
///   n   = g (1 - r) / (1 + r) + (1 - g) (1 + sqrt r) / (1 - sqrt r)
///   k^2 = ((n + 1)^2 r - (n - 1)^2) / (1 - r)
///
/// and then conductor_fresnel.h, so that at(1) is r. MaterialX's artistic_ior gives the same n and
/// k. Interface as in constant_fresnel.h.

#pragma once

#include <regain/closures/conductor_fresnel.h>

REGAIN_NAMESPACE_BEGIN

template <class RealType>
class ArtistFresnel
{
public:
    using Real = RealType;
    using Color = Color3<Real>;

    /// Above this reflectivity n and k run away; it is what all above it becomes.
    static constexpr double largest_reflectivity = 0.999;

    /// Reflectivity r in [0, 0.999] and edge tint g in [0, 1] per channel, clamped; NaN becomes 0.
    REGAIN_HOST_DEVICE ArtistFresnel(const Color& reflectivity, const Color& edge_tint)
        : ArtistFresnel(
              detail::per_channel(
                  reflectivity,
                  [](Real v) { return detail::sanitised(v, 0, largest_reflectivity, 0); }),
              detail::per_channel(edge_tint, [](Real v) { return detail::saturate(v); }), Clean())
    {}

    REGAIN_HOST_DEVICE const Color& reflectivity() const { return _reflectivity; }
    REGAIN_HOST_DEVICE const Color& edge_tint() const { return _edge_tint; }
    /// The same metal by n and k.
    REGAIN_HOST_DEVICE const ConductorFresnel<Real>& conductor() const { return _conductor; }

    REGAIN_HOST_DEVICE Color at(Real mu) const { return _conductor.at(mu); }
    REGAIN_INLINE detail::ChannelsOf<Real> channels_at(Real mu) const
    {
        return _conductor.channels_at(mu);
    }
    REGAIN_HOST_DEVICE Color normal_incidence() const { return _reflectivity; }
    REGAIN_HOST_DEVICE Color mean(const FresnelMoments<Real>& moments) const
    {
        return _conductor.mean(moments);
    }
    /// As a conductor's; better than the fit to r and g.
    REGAIN_HOST_DEVICE Color average() const { return _conductor.average(); }
    REGAIN_HOST_DEVICE Color exact_average() const { return _conductor.exact_average(); }

private:
    struct Clean
    {};
    REGAIN_HOST_DEVICE ArtistFresnel(const Color& r, const Color& g, Clean)
        : _reflectivity(r), _edge_tint(g), _conductor(index(r, g), extinction(r, g))
    {}

    // n at g = 1.
    REGAIN_HOST_DEVICE static Real smallest_index(Real r) { return (Real(1) - r) / (Real(1) + r); }
    REGAIN_HOST_DEVICE static Real index(Real r, Real g)
    {
        const Real root = detail::sqrt(r);
        // (1 + sqrt r) / (1 - sqrt r) without the difference of nearly equal numbers.
        const Real largest = (Real(1) + root) * (Real(1) + root) / (Real(1) - r);
        return largest + (smallest_index(r) - largest) * g;
    }
    // k^2 as a product of the sum and the difference of (n + 1) sqrt r and n - 1, of which the
    // second is proportional to g.
    REGAIN_HOST_DEVICE static Real extinction(Real r, Real g)
    {
        const Real root = detail::sqrt(r), complement = (Real(1) - r) / (Real(1) + root);
        const Real difference = g * (Real(1) + root - smallest_index(r) * complement);
        const Real sum = index(r, g) * (Real(1) + root) - complement;
        return detail::sqrt(detail::max(difference * sum, Real(0)) / (Real(1) - r));
    }
    REGAIN_HOST_DEVICE static Color index(const Color& r, const Color& g)
    {
        return {index(r.x, g.x), index(r.y, g.y), index(r.z, g.z)};
    }
    REGAIN_HOST_DEVICE static Color extinction(const Color& r, const Color& g)
    {
        return {extinction(r.x, g.x), extinction(r.y, g.y), extinction(r.z, g.z)};
    }

    Color _reflectivity, _edge_tint;
    ConductorFresnel<Real> _conductor;
};

REGAIN_NAMESPACE_END
