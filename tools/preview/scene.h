// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What rays meet: meshes, placed by translation, each placement with a material index. World
/// units, y up.

#pragma once

#include "mesh.h"

#include <Imath/ImathVec.h>

#include <memory>
#include <vector>

namespace regain::tools::preview {

struct Ray
{
    Imath::V3f origin, direction;  ///< direction unit
};

/// A point on a surface. `normal` is bent, where tessellation would turn it away from the viewer,
/// to face the side from which the ray came; `geometric_normal` is on the side of the mesh's own
/// normals.
struct Hit
{
    Imath::V3f position;
    Imath::V3f geometric_normal, normal, tangent;  ///< unit; tangent perpendicular to normal
    int material = 0;
    Imath::V3f in_object;  ///< the position in the mesh's own space, from its centre
    Mapping mapping = Mapping::globe;

    Imath::V2f uv() const { return texture_coordinates(mapping, in_object); }

    /// A ray that leaves the surface: its origin is moved off by a distance below anything the
    /// widget shows, so that it does not meet the surface again.
    Ray leave(const Imath::V3f& direction) const;
};

class Scene
{
public:
    Scene();
    ~Scene();
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    /// Index of the mesh, to place it by.
    int add_mesh(Mesh mesh);
    /// Turned by so many radians about its own vertical, anticlockwise from above, then moved.
    void place(int mesh, const Imath::V3f& offset, int material, float turn = 0);

    /// Call once, after the last `place`. The tree is built by one thread: built by several it may
    /// differ from run to run, and rays that meet an edge would be told different triangles.
    void commit();

    /// Nearest hit; false when the ray leaves the scene. Any number of threads.
    bool intersect(const Ray&, Hit*) const;
    bool occluded(const Ray&) const;

private:
    struct Impl;
    std::unique_ptr<Impl> _impl;
};

}  // namespace regain::tools::preview
