// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The shading normal N against the geometric one, Ng: which frame a closure works in, and which
/// directions of that frame there are. All adapters take it from here.
///
/// What is scattered is a matter of N, on which side of the surface a direction lies a matter of
/// Ng. Both are unit and on the same side of the surface, but N may be bumped or interpolated, so
/// there are directions that are above one and below the other. In each case:
///
///  - Back faces. A closure that only reflects is the same from both sides: V decides by Ng, and
///    both normals are turned together (facing), never one of them alone, which would turn bumps
///    into dents. An interface between two media has an outside: its normals stay (of), and wo.z <
///    0 is inside.
///  - V above Ng and below N, as bumps do at grazing angles. The closure is asked about no
///    direction, and is black (known): no wo below the horizon, no table read at a negative cosine,
///    no NaN. To bend N until V sees it is the host's decision, to be made before it hands N over.
///  - L above N and below Ng, or the other way round. The value and the pdf are 0, sampled or
///    evaluated (is_on_its_side): reflection would leak through the surface, transmission would be
///    light that has not passed it.
///  - What sampling loses to such L is not given to the others: the pdf is that of the sampler, and
///    integrates to 1 less the chance of no sample. So values stay what the closure says, and
///    bumped surfaces lose some energy. Sampling again would need the lost share for every pdf.
///  - Cosines. Those in values are of N, |cos(N, L)|, and positive wherever there is a value.
///
/// A direction on the horizon of either normal is on no side; neither is one that is no number.

#pragma once

#include <regain/closures/vector.h>

REGAIN_NAMESPACE_BEGIN

/// A direction is on one side of both normals, by its cosines with them.
template <class Real>
REGAIN_HOST_DEVICE MaskOf<Real> sides_agree(const Real& with_shading, const Real& with_geometric)
{
    const Real none(0);
    const MaskOf<Real> above = detail::both<Real>(detail::quiet_less(none, with_shading),
                                                  detail::quiet_less(none, with_geometric)),
                       below = detail::both<Real>(detail::quiet_less(with_shading, none),
                                                  detail::quiet_less(with_geometric, none));
    return above | below;
}

/// What a closure is prepared for where the known direction is `local` in its frame: that, or no
/// direction where the normals do not agree on its side.
template <class Real>
REGAIN_HOST_DEVICE Vec3<Real> known_direction(const Vec3<Real>& local, const Real& with_geometric)
{
    return detail::select(sides_agree(local.z, with_geometric), local, Vec3<Real>(Real(0)));
}

/// Orthonormal and right-handed: y = z x x.
template <class Real>
struct ShadingFrame
{
    Vec3<Real> x, y, z;  ///< in world space; z is the shading normal
    Vec3<Real> geometric;

    /// As the normals are. N and Ng are unit; x is along T, which is any vector, and along some
    /// axis where T is within a thousandth of parallel to N.
    REGAIN_HOST_DEVICE static ShadingFrame of(const Vec3<Real>& N, const Vec3<Real>& Ng,
                                              const Vec3<Real>& T)
    {
        const auto across = [&](const Vec3<Real>& w) { return w - N * detail::dot(N, w); };
        const Vec3<Real> first(Real(1), Real(0), Real(0)), second(Real(0), Real(1), Real(0));
        const MaskOf<Real> is_first = detail::quiet_less(N.x * N.x, detail::constant<Real>(0.5));
        const Vec3<Real> t = across(T);
        // Of what is all but parallel to N, only its rounding would be left.
        const MaskOf<Real> usable =
            detail::quiet_less(detail::constant<Real>(1e-6) * detail::dot(T, T), detail::dot(t, t));
        ShadingFrame f;
        f.geometric = Ng;
        f.z = N;
        f.x = detail::normalised(
            detail::select(usable, t, across(detail::select(is_first, first, second))));
        f.y = f.z.cross(f.x);
        return f;
    }

    /// On the side of V by Ng.
    REGAIN_HOST_DEVICE static ShadingFrame facing(const Vec3<Real>& V, const Vec3<Real>& N,
                                                  const Vec3<Real>& Ng, const Vec3<Real>& T)
    {
        const MaskOf<Real> behind = detail::quiet_less(detail::dot(Ng, V), Real(0));
        return of(detail::select(behind, -N, N), detail::select(behind, -Ng, Ng), T);
    }

    REGAIN_HOST_DEVICE Vec3<Real> to_local(const Vec3<Real>& w) const
    {
        return {detail::dot(w, x), detail::dot(w, y), detail::dot(w, z)};
    }
    REGAIN_HOST_DEVICE Vec3<Real> to_world(const Vec3<Real>& w) const
    {
        return x * w.x + y * w.y + z * w.z;
    }

    /// Both normals agree on the side of w, which is `local` in the frame.
    REGAIN_HOST_DEVICE MaskOf<Real> is_on_its_side(const Vec3<Real>& w,
                                                   const Vec3<Real>& local) const
    {
        return sides_agree(local.z, detail::dot(geometric, w));
    }

    /// w in the frame, for a closure to be prepared for.
    REGAIN_HOST_DEVICE Vec3<Real> known(const Vec3<Real>& w) const
    {
        return known_direction(to_local(w), detail::dot(geometric, w));
    }
};

REGAIN_NAMESPACE_END
