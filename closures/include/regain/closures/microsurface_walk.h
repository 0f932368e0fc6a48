// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What the random walks on a Smith microsurface have in common (Heitz, Hanika, d'Eon, Dachsbacher
/// 2016, "Multiple-scattering microfacet BSDFs with the Smith model").
///
/// The walk is written in optical depth. With C1(h) the share of the surface below the height h,
///     tau = -log C1(h)       0 at the top, Exp-distributed at the first hit
/// and heights themselves are never needed. A ray along d that would next hit a facet from the
/// direction v = -d does so after an exponentially distributed step in tau with the rate
///     r(d) = sigma(v) / |d_z|     which is Lambda(d) for d upwards, 1 + Lambda(-d) downwards
/// (Heitz et al. 2016, Eqs. 12 to 16, in other words): downwards tau grows, upwards it shrinks, and
/// where it would pass 0 the ray has left. One logarithm a bounce.
///
/// Less than one, in fact. The first hit has the law Exp(a), a = r(-wo). Of a ray that goes up from
/// there at the rate b the share a / (a + b) leaves, which is G2 / G1; and the next hit of one that
/// does not is again at a depth of the law Exp(a), because an exponential law has no memory. So as
/// long as a path only goes up its depth need not be drawn at all, and most paths need no logarithm
/// whatever.

#pragma once

#include <regain/closures/closure.h>
#include <regain/closures/count.h>
#include <regain/closures/random_stream.h>
#include <regain/closures/refraction.h>

#include <limits>

REGAIN_NAMESPACE_BEGIN

/// One walk, from wo until it has left the surface.
template <class Real>
struct WalkPath
{
    using Mask = MaskOf<Real>;

    Vec3<Real> wi;               ///< unit
    Color3<Real> weight;         ///< product of the facets' reflectances and of the closure's tints
    Real bounces;                ///< facets met, 1 or more
    Mask escaped = Mask(false);  ///< false: the walk was given up, see walk_limit
    Mask transmitted = Mask(false);  ///< wi is on the other side of the surface
};

/// A walk that has not left after so many facets is given up. No conductor's is: on the surface
/// that holds light longest, STD at gamma 1.51 and alpha 1, where the mean is 38 bounces, 1 of 40
/// walks leaves at each, and 0.975^4096 is 1e-45. Light that grazes an interface of index near 1
/// crosses it some 10 / mu times, hardly deflected; so below mu = 0.003 it can be given up, and
/// then leaves along the way it has, with nothing lost.
constexpr int walk_limit = 4096;

namespace detail {

/// What lies between 1 and the number below it.
template <class Real>
constexpr ScalarOf<Real> half_epsilon = std::numeric_limits<ScalarOf<Real>>::epsilon() / 2;

/// Exponentially distributed for u uniform in [0, 1); finite for 1, too.
template <class Real>
REGAIN_HOST_DEVICE Real exponential(const Real& u)
{
    return -detail::log(detail::max(Real(1) - u, Real(half_epsilon<Real>)));
}

/// Optical depth of a walk, lane by lane: drawn, or known only to have the law of the first hit.
template <class Real>
class WalkDepth
{
public:
    using Mask = MaskOf<Real>;

    /// The first hit of a ray from wo; mu = wo.z > 0, area = sigma(wo).
    REGAIN_HOST_DEVICE WalkDepth(const Real& mu, const Real& area)
        : _mu(mu), _area(area), _tau(Real(0)), _drawn(false)
    {}

    /// To be assigned to.
    WalkDepth() = default;

    /// Calls numbers(x) for each of its numbers, masks(m) for its mask.
    template <class Numbers, class Masks>
    REGAIN_HOST_DEVICE void each(const Numbers& numbers, const Masks& masks)
    {
        numbers(_mu);
        numbers(_area);
        numbers(_tau);
        masks(_drawn);
    }

    /// Probability that a ray from here leaves along w; z = w.z > 0, area = sigma(-w).
    REGAIN_HOST_DEVICE Real escape_probability(const Real& z, const Real& area) const
    {
        const Real out = _area * z;
        const Real fresh = out / (out + area * _mu);
        if (!any<Real>(_drawn)) return fresh;
        return select(_drawn, detail::exp(-_tau * area / z), fresh);
    }

    /// True where a ray along d leaves without its depth being drawn; z = d.z, area = sigma(-d).
    REGAIN_HOST_DEVICE Mask leaves_at_once(const Real& z, const Real& area, const Real& u) const
    {
        const Real out = _area * z;
        return both<Real>(both<Real>(!_drawn, z > constant<Real>(horizon)),
                          u * (out + area * _mu) < out);
    }

    /// Takes the ray along d to its next hit; true where it leaves instead. u decides about the
    /// step, `first` is the number that the first hit is drawn by: the same one throughout a walk.
    /// Only lanes in `active` matter.
    REGAIN_HOST_DEVICE Mask move(const Real& z, const Real& area, const Real& u, const Real& first,
                                 const Mask& active)
    {
        REGAIN_COUNTED(bounces);
        const Mask left = leaves_at_once(z, area, u);
        const Mask up = z > constant<Real>(horizon);
        if (!any<Real>(both<Real>(active, _drawn | !up))) return left;

        draw(first, both<Real>(active, !up));
        const Real step = exponential(u) * detail::abs(z);
        const Mask ends = both<Real>(both<Real>(up, _drawn), step >= _tau * area);
        const Real difference = step / area;
        _tau = select(up, detail::max(_tau - difference, Real(0)), _tau + difference);
        return left | ends;
    }

    /// The same for a ray that is not to leave: returns the probability that it does not.
    REGAIN_HOST_DEVICE Real stay(const Real& z, const Real& area, const Real& u, const Real& first,
                                 const Mask& active)
    {
        const Mask up = z > constant<Real>(horizon);
        const Real stays =
            select(up, Real(1) - escape_probability(select(up, z, Real(1)), area), Real(1));
        move(z, area, u * stays, first, active);
        return stays;
    }

    /// Probability that a ray from here leaves on the other side of the surface; z and area as
    /// above, in the frame of that side.
    REGAIN_HOST_DEVICE Real escape_beyond(const Real& z, const Real& area, const Real& first) const
    {
        WalkDepth other = *this;
        other.cross(first, Mask(true));
        return detail::exp(-other._tau * area / z);
    }

    /// The ray passes to the other side of the surface, where light in `lanes` goes on. What was
    /// below is above, and C1 becomes 1 - C1.
    REGAIN_HOST_DEVICE void cross(const Real& first, const Mask& lanes)
    {
        draw(first, lanes);
        // Half an ulp is as near to the far end as C1 can tell.
        const Real above = detail::max(Real(1) - detail::exp(-_tau), Real(half_epsilon<Real>));
        _tau = select(lanes, -detail::log(above), _tau);
    }

private:
    // Draws the depth of the first hit in these lanes, unless that has been done.
    REGAIN_HOST_DEVICE void draw(const Real& first, const Mask& lanes)
    {
        const Mask now = both<Real>(lanes, !_drawn);
        if (!any<Real>(now)) return;
        _tau = select(now, exponential(first) * _mu / _area, _tau);
        _drawn = _drawn | now;
    }

    Real _mu = Real(1), _area = Real(1);  // of wo
    Real _tau = Real(0);                  // where drawn
    Mask _drawn = Mask(false);
};

/// A facet that reflects v into wi, z of either sign: D(h) / 4, which over sigma(v) is the density
/// of wi, per steradian, among the reflections of v at the normals visible from v; and v.h.
template <class Real>
struct FacetReflection
{
    Real quarter_D, cosine;

    template <class Distribution>
    REGAIN_HOST_DEVICE FacetReflection(const Distribution& distribution, const Vec3<Real>& v,
                                       const Vec3<Real>& wi)
    {
        const Vec3<Real> sum = half_vector(v, wi);
        // Squares of less than this underflow.
        const MaskOf<Real> facing = sum.z > constant<Real>(1e-15);
        const Vec3<Real> h = select(facing, sum, Vec3<Real>(Real(0), Real(0), Real(1)));
        const Real length2 = dot(h, h);
        quarter_D = select(facing, distribution.D(h, length2) * Real(0.25f), Real(0));
        cosine = detail::min(Real(0.5f) * detail::sqrt(length2), Real(1));
    }
};

/// A facet that refracts v into wi, from the side of v: 1 / sigma(v) times this is the density of
/// wi, per steradian, among the refractions of v at the normals visible from v; and the cosines
/// about the facet. eta: index ahead of v over the one behind.
template <class Real>
struct FacetRefraction
{
    Real D_jacobian, cosine, cosine_beyond;

    template <class Distribution>
    REGAIN_HOST_DEVICE FacetRefraction(const Distribution& distribution, const Vec3<Real>& v,
                                       const Vec3<Real>& wi, const RelativeIndex<Real>& eta)
    {
        const Vec3<Real> sum = refraction_half_vector(v, wi, eta);
        const Real along = dot(v, sum), beyond = -dot(wi, sum), sum2 = dot(sum, sum);
        const MaskOf<Real> facing =
            both<Real>(both<Real>(sum.z > constant<Real>(1e-15), sum2 > constant<Real>(1e-20)),
                       both<Real>(along > Real(0), beyond > Real(0)));
        const Vec3<Real> h = select(facing, sum, Vec3<Real>(Real(0), Real(0), Real(1)));
        const Real length2 = select(facing, sum2, Real(1)), inv = Real(1) / detail::sqrt(length2);
        cosine = select(facing, detail::min(along * inv, Real(1)), Real(1));
        cosine_beyond = select(facing, detail::min(beyond * inv, Real(1)), Real(1));
        const Real jacobian = eta.eta * eta.eta * cosine_beyond / length2;
        D_jacobian = select(facing, distribution.D(h, length2) * cosine * jacobian, Real(0));
    }
};

/// sigma(v) of prepared visible normals. Straight from below nothing is visible, and less than
/// nothing underflows; such a ray leaves, so it does not matter what is put in its place.
template <class Visible>
REGAIN_HOST_DEVICE auto visible_area(const Visible& visible)
{
    const auto area = visible.projected_area();
    return detail::max(area, constant<std::decay_t<decltype(area)>>(1e-30));
}

/// A direction seen in a mirror on the surface: what one side's frame is to the other's.
template <class Real>
REGAIN_HOST_DEVICE Vec3<Real> mirrored(const Vec3<Real>& w)
{
    return {w.x, w.y, -w.z};
}

/// The numbers of the i-th of several walks from the host's: shifted along an additive recurrence
/// (Roberts 2018), so that the first bounces of the walks are spread evenly.
template <class Real>
REGAIN_HOST_DEVICE Vec3<Real> shifted_numbers(const Vec3<Real>& u, int i)
{
    const auto shifted = [i](const Real& x, double step) {
        const double shift = i * step;
        const Real y = saturate(x) + constant<Real>(shift - std::floor(shift));
        return select(y >= Real(1), y - Real(1), y);
    };
    return {shifted(u.x, 0.81917251339616444), shifted(u.y, 0.67104360670378920),
            shifted(u.z, 0.54970047790197027)};
}

}  // namespace detail

REGAIN_NAMESPACE_END
