// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The shading frame of a point, and on which side of the surface a direction is. Which side the
/// viewer is on is a matter of geometry, so of Ngn; what is scattered is a matter of Nn.

#pragma once

#include <regain/renderman/host.h>

#include <cmath>

REGAIN_NAMESPACE_BEGIN
namespace renderman {

/// Orthonormal shading frame.
struct Frame
{
    Vec3 x, y, z, geometric;

    /// On the side of the viewer: both normals are turned to the side of V, Ng first.
    static Frame facing(const Vec3& V, const Vec3& N, const Vec3& Ng, const Vec3& T)
    {
        return Ng.dot(V) < 0 ? Frame::of(-N, -Ng, T) : Frame::of(N, Ng, T);
    }

    /// As the normals are. N and Ng are unit; T is any direction, used where it is not parallel to
    /// N.
    static Frame of(const Vec3& N, const Vec3& Ng, const Vec3& T)
    {
        Frame f;
        f.geometric = Ng;
        f.z = N;
        Vec3 t = T - f.z * f.z.dot(T);
        if (!(t.dot(t) > 1e-12f))
        {
            const Vec3 axis = f.z.x * f.z.x < 0.5f ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
            t = axis - f.z * f.z.dot(axis);
        }
        f.x = t * (1.0f / std::sqrt(t.dot(t)));
        f.y = f.z.cross(f.x);
        return f;
    }

    Vec3 to_local(const Vec3& w) const { return {w.dot(x), w.dot(y), w.dot(z)}; }
    Vec3 to_world(const Vec3& w) const { return x * w.x + y * w.y + z * w.z; }

    /// Both normals agree on the side of w, which is `local` in the frame. A bumped normal can send
    /// light to the wrong side of the surface; that light is dropped, and its share of the pdf with
    /// it.
    bool is_on_its_side(const Vec3& w, const Vec3& local) const
    {
        const float side = geometric.dot(w);
        return local.z < 0 ? side < 0 : side > 0;
    }

    /// w in the frame, for a closure to be prepared for; no direction, so a black closure, where a
    /// normal is bent so far that w is on its other side.
    Vec3 known(const Vec3& w) const
    {
        const Vec3 local = to_local(w);
        return (local.z < 0) != (geometric.dot(w) < 0) ? Vec3(0.0f) : local;
    }
};

}  // namespace renderman
REGAIN_NAMESPACE_END
