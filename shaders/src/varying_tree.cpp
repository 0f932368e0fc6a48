// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/shaders/varying_tree.h>

#include <algorithm>
#include <stdexcept>
#include <string>

REGAIN_NAMESPACE_BEGIN
namespace shaders {
namespace {

using Imath::C3f;
using Imath::V4f;

double number(float x) { return static_cast<double>(x); }
ColorD color(const V4f& v) { return {number(v.x), number(v.y), number(v.z)}; }

void set(SchlickSurface& s, MaterialNumber which, const V4f& v)
{
    if (which == MaterialNumber::F0) s.F0 = color(v);
    if (which == MaterialNumber::F82) s.F82 = color(v);
    if (which == MaterialNumber::F90) s.F90 = color(v);
    if (which == MaterialNumber::exponent) s.exponent = number(v.x);
}
void set(ConductorSurface& s, MaterialNumber which, const V4f& v)
{
    if (which == MaterialNumber::n) s.n = color(v);
    if (which == MaterialNumber::k) s.k = color(v);
}
void set(InterfaceSurface& s, MaterialNumber which, const V4f& v)
{
    if (which == MaterialNumber::eta) s.eta = number(v.x);
    if (which == MaterialNumber::reflection_tint) s.reflection_tint = color(v);
    if (which == MaterialNumber::transmission_tint) s.transmission_tint = color(v);
}
// Of what has a colour, or a roughness as well.
template <class Surface>
void set(Surface& s, MaterialNumber which, const V4f& v)
{
    if (which == MaterialNumber::color) s.color = color(v);
    if constexpr (std::is_same_v<Surface, OrenNayarSurface> ||
                  std::is_same_v<Surface, BurleyDiffuseSurface> ||
                  std::is_same_v<Surface, ClothSurface>)
        if (which == MaterialNumber::roughness) s.roughness = number(v.x);
}

}  // namespace

int VaryingTree::add(const Value& value)
{
    const int index = program.output(value);
    if (index >= most_values)
        throw std::length_error("more than " + std::to_string(most_values) +
                                " numbers that depend on the point");
    return index;
}

void VaryingTree::vary(ClosureTree::Node lobe, MaterialNumber which, const Value& value)
{
    if (value.varies()) _varied.push_back({lobe, which, add(value)});
}

ClosureTree::Parameter VaryingTree::parameter(const Value& value)
{
    const int index = add(value);
    const auto same = std::find(_parameters.begin(), _parameters.end(), index);
    if (same != _parameters.end()) return {static_cast<int>(same - _parameters.begin())};
    _parameters.push_back(index);
    return {static_cast<int>(_parameters.size()) - 1};
}

void VaryingTree::set_presence(const Value& value)
{
    _presence = -1;
    if (value.varies())
        _presence = add(value);
    else
        tree.set_presence(number(value.x()));
}

void VaryingTree::apply(ClosureTree::Node lobe, Material& material, const V4f* values) const
{
    for (const Varied& one : _varied)
    {
        if (one.lobe != lobe) continue;
        const V4f& v = values[one.value];
        auto* m = std::get_if<MicrofacetMaterial>(&material);
        if (m && one.number == MaterialNumber::alpha)
        {
            m->alpha_x = number(v.x);
            m->alpha_y = number(v.y);
        }
        else if (m)
            std::visit([&](auto& surface) { set(surface, one.number, v); }, m->surface);
        else
            std::visit([&](auto& surface) { set(surface, one.number, v); },
                       std::get<PlainMaterial>(material).surface);
    }
}

void VaryingTree::set_tiles(int across, std::vector<std::uint8_t> tree_of,
                            std::vector<ClosureTree> trees)
{
    if (across < 1 || tree_of.size() != static_cast<std::size_t>(across) * std::size_t(across))
        throw std::invalid_argument(std::to_string(tree_of.size()) + " tiles, " +
                                    std::to_string(across) + " across: takes a square of them");
    for (const std::uint8_t t : tree_of)
        if (t >= trees.size())
            throw std::invalid_argument("a tile of tree " + std::to_string(t) + ": there are " +
                                        std::to_string(trees.size()));
    for (const ClosureTree& t : trees)
    {
        bool same = t.lobes() == tree.lobes();
        for (int k = 0; same && k < t.lobes(); ++k) same = t.node_of(k) == tree.node_of(k);
        if (!same) throw std::invalid_argument("a tree of tiles has other closures");
    }
    _texcoord = add(program.texcoord());
    _across = across;
    _tree_of = std::move(tree_of);
    _trees = std::move(trees);
}

const ClosureTree& VaryingTree::tree_at(const V4f* values) const
{
    if (_across == 0) return tree;
    const V4f& uv = values[_texcoord];
    if (!(uv.x >= 0 && uv.x < 1 && uv.y >= 0 && uv.y < 1)) return tree;
    // Rounded, a coordinate just below 1 may be `across`.
    const auto place = [&](float x) {
        return std::min(static_cast<int>(x * static_cast<float>(_across)), _across - 1);
    };
    const int tile = place(uv.x) + _across * place(uv.y);
    return _trees[_tree_of[static_cast<std::size_t>(tile)]];
}

VaryingTree::Material VaryingTree::material(int k, const V4f* values) const
{
    Material m = tree_at(values).material(k);
    apply(tree.node_of(k), m, values);
    return m;
}

VaryingTree::Material VaryingTree::material_of(ClosureTree::Node node, const V4f* values) const
{
    Material m = tree_at(values).material_of(node);
    apply(node, m, values);
    return m;
}

C3f VaryingTree::weight(int parameter, const V4f* values) const
{
    const V4f& v = values[_parameters[static_cast<std::size_t>(parameter)]];
    C3f w;
    for (int c = 0; c < 3; ++c) w[c] = detail::sanitised(v[c], 0, 1e6f, 0);
    return w;
}

C3f VaryingTree::lobe_weights(const C3f* albedo, C3f* w, const V4f* values) const
{
    C3f parameters[most_values];
    for (std::size_t i = 0; i < _parameters.size(); ++i)
        parameters[i] = weight(static_cast<int>(i), values);
    return tree.lobe_weights(albedo, w, parameters);
}

double VaryingTree::presence(const V4f* values) const
{
    return _presence < 0 ? tree.presence()
                         : detail::sanitised(number(values[_presence].x), 0.0, 1.0, 1.0);
}

}  // namespace shaders
REGAIN_NAMESPACE_END
