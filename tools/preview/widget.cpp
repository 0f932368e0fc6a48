// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "widget.h"

#include <Imath/ImathVec.h>

#include <cmath>

namespace regain::tools::preview {

using Imath::V2f;
using Imath::V3f;

namespace {

constexpr float kPi = 3.14159265358979f;
constexpr int kFillet = 6;  // segments of a rounded quarter edge

float radians(float degrees) { return degrees * kPi / 180.0f; }
float lerp(float a, float b, int i, int n)
{
    return a + (b - a) * static_cast<float>(i) / static_cast<float>(n);
}

/// A point of a profile in the half plane (distance from the axis, height), and its normal there.
struct ProfilePoint
{
    V2f position, normal;
};

/// Turns a vector of the profile's half plane to azimuth phi; phi = 0 is +z.
V3f turn(const V2f& v, float phi) { return {v.x * std::sin(phi), v.y, v.x * std::cos(phi)}; }
V3f azimuth(float phi) { return {std::cos(phi), 0.0f, -std::sin(phi)}; }

void add_revolution(Mesh& mesh, const std::vector<ProfilePoint>& profile, float phi0, float phi1,
                    int segments)
{
    const bool closed = phi1 - phi0 > 2.0f * kPi - 1e-4f;
    add_grid(mesh, static_cast<int>(profile.size()), closed ? segments : segments + 1, closed,
             [&](int row, int column) {
                 const float phi = lerp(phi0, phi1, column, segments);
                 const ProfilePoint& p = profile[static_cast<std::size_t>(row)];
                 return Vertex{turn(p.position, phi), turn(p.normal, phi), azimuth(phi)};
             });
}

/// A regular prism with every edge rounded: the inner prism's corners, moved out by the fillet
/// radius along each direction that belongs to the corner. Flat faces come out flat because both
/// of their ends carry the same normal.
void add_rounded_prism(Mesh& mesh, int sides, float inner_radius, float height, float fillet,
                       bool closed)
{
    std::vector<V2f> corners, directions;  // x, z; a facet faces +z
    for (int side = 0; side < sides; ++side)
    {
        const float corner = 2.0f * kPi * (static_cast<float>(side) + 0.5f) / float(sides);
        for (int i = 0; i <= kFillet; ++i)
        {
            const float half = kPi / static_cast<float>(sides);
            const float phi = lerp(corner - half, corner + half, i, kFillet);
            corners.push_back(V2f(std::sin(corner), std::cos(corner)) * inner_radius);
            directions.push_back(V2f(std::sin(phi), std::cos(phi)));
        }
    }
    std::vector<V2f> edge;  // fillet along the vertical: outwards, upwards
    for (int i = 0; i <= kFillet; ++i)
    {
        const float e = lerp(-0.5f * kPi, 0.0f, i, kFillet);
        edge.push_back({std::cos(e), std::sin(e)});
    }
    for (int i = 0; i <= kFillet; ++i)
    {
        const float e = lerp(0.0f, 0.5f * kPi, i, kFillet);
        edge.push_back({std::cos(e), std::sin(e)});
    }
    add_grid(mesh, static_cast<int>(edge.size()), static_cast<int>(corners.size()), true,
             [&](int row, int column) {
                 const V2f c = corners[static_cast<std::size_t>(column)];
                 const V2f d = directions[static_cast<std::size_t>(column)];
                 const V2f e = edge[static_cast<std::size_t>(row)];
                 const float base = row <= kFillet ? fillet : height - fillet;
                 const V3f n(e.x * d.x, e.y, e.x * d.y);
                 return Vertex{V3f(c.x, base, c.y) + n * fillet, n, V3f(d.y, 0.0f, -d.x)};
             });
    std::vector<V3f> top, bottom;
    for (std::size_t i = 0; i < corners.size(); i += kFillet + 1)
    {
        top.push_back({corners[i].x, height, corners[i].y});
        bottom.push_back({corners[i].x, 0.0f, corners[i].y});
    }
    add_polygon(mesh, top, {0, 1, 0});
    if (closed) add_polygon(mesh, bottom, {0, -1, 0});
}

void add_ring(Mesh& mesh, float height, float radius, float thickness)
{
    std::vector<ProfilePoint> profile;
    for (int i = 0; i <= 32; ++i)
    {
        const float a = lerp(0.0f, 2.0f * kPi, i, 32);
        const V2f n(std::cos(a), std::sin(a));
        profile.push_back({V2f(radius, height) + n * thickness, n});
    }
    add_revolution(mesh, profile, 0.0f, 2.0f * kPi, 96);
}

/// A part of a spherical shell about the height `centre`, with rounded rims: polar angles theta0 to
/// theta1 (0 is up; a pole has no rim), azimuths phi0 to phi1.
struct ShellPart
{
    float centre, inner, outer, fillet;
    float theta0, theta1, phi0, phi1;
};

void add_shell(Mesh& mesh, const ShellPart& s)
{
    const auto radial = [](float theta) { return V2f(std::sin(theta), std::cos(theta)); };
    const auto polar = [](float theta) { return V2f(std::cos(theta), -std::sin(theta)); };
    const V2f middle(0.0f, s.centre);
    const int arc = 40;

    std::vector<ProfilePoint> profile;
    const auto corner = [&](float radius, float theta, const V2f& from, const V2f& to) {
        for (int i = 0; i <= kFillet; ++i)
        {
            const float a = lerp(0.0f, 0.5f * kPi, i, kFillet);
            const V2f n = from * std::cos(a) + to * std::sin(a);
            profile.push_back({middle + radial(theta) * radius + n * s.fillet, n});
        }
    };
    const float core_in = s.inner + s.fillet, core_out = s.outer - s.fillet;

    for (int i = 0; i <= arc; ++i)
    {
        const float theta = lerp(s.theta0, s.theta1, i, arc);
        profile.push_back({middle + radial(theta) * s.outer, radial(theta)});
    }
    if (s.theta1 < kPi)
    {
        corner(core_out, s.theta1, radial(s.theta1), polar(s.theta1));
        corner(core_in, s.theta1, polar(s.theta1), -radial(s.theta1));
    }
    for (int i = arc; i >= 0; --i)
    {
        const float theta = lerp(s.theta0, s.theta1, i, arc);
        profile.push_back({middle + radial(theta) * s.inner, -radial(theta)});
    }
    if (s.theta0 > 0.0f)
    {
        corner(core_in, s.theta0, -radial(s.theta0), -polar(s.theta0));
        corner(core_out, s.theta0, -polar(s.theta0), radial(s.theta0));
    }
    add_revolution(mesh, profile, s.phi0, s.phi1, 128);
    if (s.phi1 - s.phi0 > 2.0f * kPi - 1e-4f) return;

    // The two cut ends: the profile's core moved out of the cut by the fillet, and a flat face.
    for (const bool last : {false, true})
    {
        const float phi = last ? s.phi1 : s.phi0;
        const V3f out = last ? azimuth(phi) : -azimuth(phi);
        add_grid(mesh, kFillet + 1, static_cast<int>(profile.size()), false,
                 [&](int row, int column) {
                     const ProfilePoint& p = profile[static_cast<std::size_t>(column)];
                     const float e = lerp(0.0f, 0.5f * kPi, row, kFillet);
                     const V3f n = turn(p.normal, phi) * std::cos(e) + out * std::sin(e);
                     const V2f core = p.position - p.normal * s.fillet;
                     const V3f t = turn({p.normal.y, -p.normal.x}, phi);
                     return Vertex{turn(core, phi) + n * s.fillet, n, t};
                 });
        add_grid(mesh, arc + 1, 2, false, [&](int row, int column) {
            const float theta = lerp(s.theta0, s.theta1, row, arc);
            const V2f p = middle + radial(theta) * (column ? core_in : core_out);
            return Vertex{turn(p, phi) + out * s.fillet, out, turn(radial(theta), phi)};
        });
    }
}

}  // namespace

Mesh make_widget(bool closed)
{
    Mesh mesh;
    add_rounded_prism(mesh, 8, 1.0f, 0.3f, 0.045f, closed);
    add_ring(mesh, 0.37f, 0.5f, 0.12f);

    const float centre = 1.2f, full = 2.0f * kPi;
    const float inner = 0.7f, outer = 0.85f, fillet = 0.025f;
    add_shell(mesh, {centre, inner, outer, fillet, 0.0f, radians(42), 0.0f, full});
    add_shell(mesh, {centre, inner, outer, fillet, radians(46), radians(112), radians(62),
                     radians(62 + 250)});
    add_shell(mesh, {centre, inner, outer, fillet, radians(116), kPi, 0.0f, full});
    add_sphere(mesh, {0.0f, centre, 0.0f}, 0.52f, 96);
    return mesh;
}

Mesh make_standing_sphere()
{
    Mesh mesh;
    add_sphere(mesh, {0.0f, 0.5f * kSphereHeight, 0.0f}, 0.5f * kSphereHeight, 192);
    return mesh;
}

Mesh make_inner_sphere()
{
    Mesh mesh;
    add_sphere(mesh, {0.0f, 0.5f * kSphereHeight, 0.0f}, 0.25f * kSphereHeight, 192);
    return mesh;
}

Mesh make_floor(float half_size)
{
    Mesh mesh;
    const float s = half_size;
    add_polygon(mesh, {{-s, 0, -s}, {-s, 0, s}, {s, 0, s}, {s, 0, -s}}, {0, 1, 0});
    mesh.mapping = Mapping::planar;
    mesh.centre = V3f(0.0f);
    return mesh;
}

}  // namespace regain::tools::preview
