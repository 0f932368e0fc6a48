// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "planned_points.h"

#include <algorithm>
#include <cmath>

REGAIN_NAMESPACE_BEGIN
namespace shaders::planning {
namespace {

// Along each side. Pictures may have details that fall between.
constexpr int points = 64, points_of_pictures = 128;

class Walk
{
public:
    Walk(const VaryingTree& surface, const Imath::V4f* values) : _surface(surface), _values(values)
    {}

    std::vector<PlacedLobe> lobes()
    {
        if (_surface.tree.root() >= 0) visit(_surface.tree.root(), ColorD(1.0), false);
        return std::move(_lobes);
    }

private:
    void visit(ClosureTree::Node node, const ColorD& weight, bool covers)
    {
        const auto& made = _surface.tree.made(node);
        switch (made.kind)
        {
            case ClosureTree::Kind::lobe: add(node, weight, covers); break;
            case ClosureTree::Kind::multiply: visit(made.first, weight * by(made), covers); break;
            case ClosureTree::Kind::mix: {
                const ColorD amount = by(made);
                visit(made.first, weight * amount, covers);
                visit(made.second, weight * (ColorD(1.0) - amount), covers);
                break;
            }
            case ClosureTree::Kind::add:
                visit(made.first, weight, covers);
                visit(made.second, weight, covers);
                break;
            case ClosureTree::Kind::layer:
                visit(made.first, weight, true);
                visit(made.second, weight, covers);
                break;
        }
    }
    ColorD by(const ClosureTree::Made& made) const
    {
        ColorD w = made.weight;
        if (made.parameter >= 0) w = ColorD(_surface.weight(made.parameter, _values));
        if (made.kind == ClosureTree::Kind::mix)
            for (int c = 0; c < 3; ++c) w[c] = std::clamp(w[c], 0.0, 1.0);
        return w;
    }
    void add(ClosureTree::Node node, const ColorD& weight, bool covers)
    {
        const auto same = std::find_if(_lobes.begin(), _lobes.end(),
                                       [&](const PlacedLobe& l) { return l.node == node; });
        if (same == _lobes.end())
        {
            _lobes.push_back({node, _surface.material_of(node, _values), weight, covers});
            return;
        }
        same->weight += weight;
        same->covers = same->covers || covers;
    }

    const VaryingTree& _surface;
    const Imath::V4f* _values;
    std::vector<PlacedLobe> _lobes;
};

// What a number depends on besides texture coordinates goes along with them: a position in the unit
// cube, every normal.
SurfacePoint point_at(int i, int j, int n)
{
    SurfacePoint p;
    p.uv = Imath::V2f(float(i) + 0.5f, float(j) + 0.5f) / float(n);
    const float third = std::fmod(0.6180340f * float(i) + 0.7548777f * float(j), 1.0f);
    p.P = Imath::V3f(p.uv.x, p.uv.y, third) * 2.0f - Imath::V3f(1.0f);
    const float z = 1 - 2 * p.uv.y, r = std::sqrt(std::max(0.0f, 1 - z * z)),
                phi = 6.2831853f * p.uv.x;
    p.N = {r * std::cos(phi), r * std::sin(phi), z};
    return p;
}

}  // namespace

void at_planned_points(const VaryingTree& surface,
                       const std::function<void(const PlannedPlace&)>& visit)
{
    Imath::V4f values[VaryingTree::most_values];
    const int n = !surface.varies()              ? 1
                  : surface.program.images() > 0 ? points_of_pictures
                                                 : points;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
        {
            surface.values_at(point_at(i, j, n), values);
            visit({i, j, n, Walk(surface, values).lobes()});
        }
}

}  // namespace shaders::planning
REGAIN_NAMESPACE_END
