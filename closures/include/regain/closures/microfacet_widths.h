// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What the distributions of microfacet normals have in common: two widths, and slopes stretched
/// by them. See distribution.h for the interface that this is a part of.

#pragma once

#include <regain/closures/distribution.h>

REGAIN_NAMESPACE_BEGIN

namespace detail {

/// The widths of a distribution of normals and what follows from them alone; Distribution derives
/// from it and has lambda(w).
template <class Distribution, class RealType>
class MicrofacetWidths
{
public:
    using Real = RealType;
    using Mask = MaskOf<Real>;

    /// At or below this alpha on both axes the lobe is a mirror. It is where D stops being
    /// meaningful in the number type: half-vectors are known to a few ulps, D varies over alpha.
    static constexpr double delta_alpha = sizeof(ScalarOf<Real>) == 4 ? 1e-5 : 1e-9;

    REGAIN_HOST_DEVICE Real alpha_x() const { return _alpha_x; }
    REGAIN_HOST_DEVICE Real alpha_y() const { return _alpha_y; }
    REGAIN_HOST_DEVICE Mask is_delta() const { return _delta; }

    /// One width in place of two, for what is tabulated over a single alpha: the root mean square,
    /// which of the simple means leaves the least error.
    REGAIN_HOST_DEVICE Real effective_alpha() const
    {
        const Real mean = sqrt(Real(0.5f) * (_alpha_x * _alpha_x + _alpha_y * _alpha_y));
        return detail::select(_alpha_x == _alpha_y, _alpha_x, mean);
    }

    REGAIN_HOST_DEVICE Real G1(const Vec3<Real>& w) const { return w.z / self().projected_area(w); }
    REGAIN_HOST_DEVICE Real G2(const Vec3<Real>& wo, const Vec3<Real>& wi) const
    {
        return Real(1) / (Real(1) + self().lambda(wo) + self().lambda(wi));
    }

protected:
    /// Widths along x and y in [0, 1]; outside they are clamped, NaN becomes 1. One axis narrower
    /// than delta_alpha is widened to it unless both are.
    REGAIN_HOST_DEVICE MicrofacetWidths(Real alpha_x, Real alpha_y)
    {
        const Real bound = constant<Real>(delta_alpha);
        const Real ax = sanitised(alpha_x, 0, 1, 1), ay = sanitised(alpha_y, 0, 1, 1);
        _delta = both<Real>(ax <= bound, ay <= bound);
        _alpha_x = detail::max(ax, bound);
        _alpha_y = detail::max(ay, bound);
        _inv_alpha_x = Real(1) / _alpha_x;
        _inv_alpha_y = Real(1) / _alpha_y;
        _normalisation = constant<Real>(0.318309886183790671538) * _inv_alpha_x * _inv_alpha_y;
    }

    /// The same of one width.
    REGAIN_HOST_DEVICE explicit MicrofacetWidths(Real alpha)
    {
        const Real bound = constant<Real>(delta_alpha), a = sanitised(alpha, 0, 1, 1);
        _delta = a <= bound;
        _alpha_x = _alpha_y = detail::max(a, bound);
        _inv_alpha_x = _inv_alpha_y = Real(1) / _alpha_x;
        _normalisation = constant<Real>(0.318309886183790671538) * _inv_alpha_x * _inv_alpha_y;
    }

    /// Squared length of the part of w along the surface, stretched by the widths.
    REGAIN_HOST_DEVICE Real tangential2(const Vec3<Real>& w) const
    {
        const Real x = _alpha_x * w.x, y = _alpha_y * w.y;
        return x * x + y * y;
    }
    /// The same of h, shrunk by the widths.
    REGAIN_HOST_DEVICE Real shrunk_tangential2(const Vec3<Real>& h) const
    {
        const Real x = h.x * _inv_alpha_x, y = h.y * _inv_alpha_y;
        return x * x + y * y;
    }

    Real _alpha_x, _alpha_y, _inv_alpha_x, _inv_alpha_y;
    Real _normalisation;  // 1 / (pi ax ay)
    Mask _delta;

private:
    REGAIN_HOST_DEVICE const Distribution& self() const
    {
        return static_cast<const Distribution&>(*this);
    }
};

/// Slopes in units of the widths, along and across a direction w as it looks after stretching:
/// there every distribution that is a function of the stretched slope looks the same from all
/// azimuths (Heitz 2014).
template <class Real>
class SlopeFrame
{
public:
    REGAIN_HOST_DEVICE SlopeFrame(Real alpha_x, Real alpha_y, const Vec3<Real>& w)
        : _alpha_x(alpha_x), _alpha_y(alpha_y)
    {
        const Real x = alpha_x * w.x, y = alpha_y * w.y;
        // Seen from straight above or below, all azimuths are alike.
        const Real length = detail::sqrt(x * x + y * y);
        const Mask none = length < constant<Real>(smallest);
        _length = detail::select(none, constant<Real>(smallest), length);
        _cos = detail::select(none, Real(1), x / _length);
        _sin = detail::select(none, Real(0), y / _length);
        _cotangent = w.z / _length;
    }

    /// Cotangent of w after stretching: w.m > 0 where along > -cotangent.
    REGAIN_HOST_DEVICE Real cotangent() const { return _cotangent; }

    /// The unit normal whose slopes lean towards w by `along` and sideways by `across`; z > 0.
    /// Slopes beyond 1e15 are taken for 1e15, whose normals lie in the surface for all purposes.
    REGAIN_HOST_DEVICE Vec3<Real> normal(const Real& along, const Real& across) const
    {
        const Real a = limited(along), b = limited(across);
        const Vec3<Real> m(_alpha_x * (a * _cos - b * _sin), _alpha_y * (a * _sin + b * _cos),
                           Real(1));
        return m * (Real(1) / detail::sqrt(dot(m, m)));
    }

private:
    using Mask = MaskOf<Real>;
    static constexpr double smallest = 1e-18;

    REGAIN_HOST_DEVICE static Real limited(const Real& slope)
    {
        const Real most = constant<Real>(1e15);
        return detail::max(detail::min(slope, most), -most);
    }

    Real _alpha_x, _alpha_y, _cos, _sin, _length, _cotangent;
};

}  // namespace detail

REGAIN_NAMESPACE_END
