// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What a distribution of microfacet normals answers. Every distribution is a value type with
///
///     random_numbers           static: how many numbers sampling a normal reads, 2 or 3
///     has_tail                 static: a tail parameter gamma exists, and so gamma() and tail()
///     alpha_x(), alpha_y()     widths per tangent axis, as sanitised
///     is_delta()               both widths at or below delta_alpha: the surface is flat
///     effective_alpha()        one width in place of two, for what is tabulated over one alpha
///     gamma(), tail()          tail parameter; its coordinate in [0, 1] along a table's third axis
///     tail_length()            of slopes, where anisotropy.h knows it: 0 Beckmann's, 1 GGX's
///     cosine_axis              static: how tables of it run along the cosine; root if not there
///     width_axis               static: how they run along the width; root if not there
///     D(m), D(h, length2)      density of normals, per steradian, int D(m) m_z dm = 1; h = m |h|
///                              need not be unit, length2 = h.h
///     projected_area(w)        sigma(w) = int max(0, w.m) D(m) dm, the area of the visible
///                              microsurface along w (Heitz 2014, Eqs. 11 to 13, 23);
///                              w.z of either sign, and sigma(-w) = sigma(w) - w.z
///     lambda(w)                sigma(w) / w.z - 1, for w.z > 0
///     G1(w), G2(wo, wi)        1 / (1 + lambda), 1 / (1 + lambda_o + lambda_i)
///     visible(wo)              the visible normals of wo, density max(0, wo.m) D(m) / sigma(wo);
///                              wo.z of either sign
///       .sample(u)             one of them, unit, z > 0; u in [0, 1)^3
///       .projected_area()      sigma(wo)
///     reflecting(wo)           the same for a reflection lobe, which may leave out normals that
///                              reflect below the horizon; wo.z > 0
///       .sample(u), .projected_area()
///       .reflected_density()   times D(m): density of the reflected direction, per steradian
///
/// Directions are unit, in the local frame. sigma / |w| is convex and smooth, and it is what is
/// finite at grazing angles, where lambda is not; so closures are written in sigma.

#pragma once

#include <regain/closures/vector.h>

REGAIN_NAMESPACE_BEGIN

/// How the cosine runs along the first axis of a table, and a width along the second: see table.h.
enum class CosineAxis { root, plain, tail };
enum class WidthAxis { root, gtr, std };

namespace detail {

template <class Distribution, class = void>
struct CosineAxisOf
{
    static constexpr CosineAxis value = CosineAxis::root;
};
template <class Distribution>
struct CosineAxisOf<Distribution, std::void_t<decltype(Distribution::cosine_axis)>>
{
    static constexpr CosineAxis value = Distribution::cosine_axis;
};

template <class Distribution, class = void>
struct WidthAxisOf
{
    static constexpr WidthAxis value = WidthAxis::root;
};
template <class Distribution>
struct WidthAxisOf<Distribution, std::void_t<decltype(Distribution::width_axis)>>
{
    static constexpr WidthAxis value = Distribution::width_axis;
};

/// The third table coordinate of a distribution: 0 where it has no tail parameter.
template <class Distribution>
REGAIN_HOST_DEVICE typename Distribution::Real tail_of(
    [[maybe_unused]] const Distribution& distribution)
{
    if constexpr (Distribution::has_tail)
        return distribution.tail();
    else
        return typename Distribution::Real(0);
}

}  // namespace detail

REGAIN_NAMESPACE_END
