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

/// Where pictures lie on a mesh, in its own space: on the plane y = 0, one picture a unit, or as on
/// a globe about `centre`, u around and v up.
enum class Mapping { planar, globe };

struct Mesh
{
    std::vector<Vertex> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    Mapping mapping = Mapping::globe;
    Imath::V3f centre{0.0f, 1.0f, 0.0f};
};

/// Texture coordinates of a point of the mesh.
Imath::V2f texture_coordinates(Mapping, const Imath::V3f& from_centre);

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
