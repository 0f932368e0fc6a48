// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "mesh.h"

#include <algorithm>
#include <cmath>

namespace regain::tools::preview {

using Imath::V3f;

void add_grid(Mesh& mesh, int rows, int columns, bool wrap,
              const std::function<Vertex(int row, int column)>& vertex)
{
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            mesh.vertices.push_back(vertex(row, column));

    const auto at = [&](int row, int column) {
        return first + static_cast<std::uint32_t>(row * columns + column % columns);
    };
    for (int row = 0; row + 1 < rows; ++row)
        for (int column = 0; column + (wrap ? 0 : 1) < columns; ++column)
        {
            const std::uint32_t a = at(row, column), b = at(row, column + 1);
            const std::uint32_t c = at(row + 1, column), d = at(row + 1, column + 1);
            mesh.triangles.push_back({a, b, d});
            mesh.triangles.push_back({a, d, c});
        }
}

void add_polygon(Mesh& mesh, const std::vector<V3f>& corners, const V3f& normal)
{
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const V3f tangent = perpendicular(normal);
    for (const V3f& corner : corners) mesh.vertices.push_back({corner, normal, tangent});
    for (std::uint32_t i = 2; i < corners.size(); ++i)
        mesh.triangles.push_back({first, first + i - 1, first + i});
}

void add_sphere(Mesh& mesh, const V3f& centre, float radius, int segments)
{
    const float pi = static_cast<float>(M_PI);
    add_grid(mesh, segments + 1, 2 * segments, true, [&](int row, int column) {
        const float theta = pi * static_cast<float>(row) / static_cast<float>(segments);
        const float phi = pi * static_cast<float>(column) / static_cast<float>(segments);
        const V3f n(std::sin(theta) * std::sin(phi), std::cos(theta),
                    std::sin(theta) * std::cos(phi));
        return Vertex{centre + n * radius, n, V3f(std::cos(phi), 0.0f, -std::sin(phi))};
    });
}

Imath::V2f texture_coordinates(Mapping mapping, const V3f& p)
{
    if (mapping == Mapping::planar) return {p.x, -p.z};
    const float pi = static_cast<float>(M_PI), length = p.length();
    if (!(length > 0)) return {0, 0};
    return {0.5f + std::atan2(p.x, p.z) / (2 * pi),
            1 - std::acos(std::min(std::max(p.y / length, -1.0f), 1.0f)) / pi};
}

V3f perpendicular(const V3f& n)
{
    const V3f axis = std::abs(n.y) < 0.9f ? V3f(0, 1, 0) : V3f(1, 0, 0);
    return axis.cross(n).normalized();
}

}  // namespace regain::tools::preview
