// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Triangle meshes with smooth normals and tangents. World units, y up. Triangle order carries no
/// meaning: the scene turns geometric normals to the side of the shading normals.

#pragma once

#include <Imath/ImathVec.h>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace regain::tools::preview {

struct Vertex
{
    Imath::V3f position;
    Imath::V3f normal;   ///< unit, outward
    Imath::V3f tangent;  ///< unit, perpendicular to the normal
};

struct Mesh
{
    std::vector<Imath::V3f> positions, normals, tangents;
    std::vector<std::array<std::uint32_t, 3>> triangles;

    /// Index of the new vertex.
    std::uint32_t add(const Vertex&);
};

/// Adds a grid of quads, two triangles each. `wrap` joins the last column to the first. A crease is
/// made by giving the same position twice, with both normals.
void add_grid(Mesh&, int rows, int columns, bool wrap,
              const std::function<Vertex(int row, int column)>&);

/// Adds a flat convex polygon as a fan.
void add_polygon(Mesh&, const std::vector<Imath::V3f>& corners, const Imath::V3f& normal);

/// Adds a sphere.
void add_sphere(Mesh&, const Imath::V3f& centre, float radius, int segments);

/// A unit vector perpendicular to unit `n`.
Imath::V3f perpendicular(const Imath::V3f& n);

}  // namespace regain::tools::preview
