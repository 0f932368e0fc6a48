// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/shaders/closure_tree.h>

#include <stdexcept>

REGAIN_NAMESPACE_BEGIN
namespace shaders {

namespace {

const char* own_name(const ClosureTree::Material& material)
{
    return std::visit([](const auto& m) { return m.lobe_name(); }, material);
}

ColorD clamped(const ColorD& weight)
{
    return detail::per_channel(weight, [](double v) { return detail::sanitised(v, 0, 1e6, 0); });
}

}  // namespace

ClosureTree::ClosureTree(const Material& material, const char* name)
{
    set_root(lobe(material, name));
}

ClosureTree::Node ClosureTree::add_node(const NodeData& node)
{
    _nodes.push_back(node);
    return static_cast<Node>(_nodes.size()) - 1;
}

ClosureTree::Node ClosureTree::lobe(const Material& material, const char* name)
{
    _all.push_back({material, name ? name : own_name(material), static_cast<Node>(_nodes.size())});
    return add_node({{Kind::lobe, -1, -1, ColorD(1.0)}, _all.size() - 1});
}

ClosureTree::Node ClosureTree::layer(Node top, Node base)
{
    return add_node({{Kind::layer, top, base, ColorD(1.0)}});
}

ClosureTree::Node ClosureTree::mix(Node foreground, Node background, double amount)
{
    return add_node({{Kind::mix, foreground, background, ColorD(detail::saturate(amount))}});
}

ClosureTree::Node ClosureTree::mix(Node foreground, Node background, Parameter amount)
{
    return add_node({{Kind::mix, foreground, background, ColorD(0.5), amount.index}});
}

ClosureTree::Node ClosureTree::add(Node a, Node b)
{
    return add_node({{Kind::add, a, b, ColorD(1.0)}});
}

ClosureTree::Node ClosureTree::multiply(Node node, const ColorD& weight)
{
    return add_node({{Kind::multiply, node, -1, clamped(weight)}});
}

ClosureTree::Node ClosureTree::multiply(Node node, Parameter weight)
{
    return add_node({{Kind::multiply, node, -1, ColorD(1.0), weight.index}});
}

void ClosureTree::set_root(Node root)
{
    _lobes.clear();
    _steps.clear();
    bool any = false;
    flatten(root, 0, ColorD(1.0), any);
    _root = root;
}

ClosureTree::NodeData& ClosureTree::lobe_node(Node node)
{
    const bool there = node >= 0 && node < static_cast<Node>(_nodes.size());
    if (!there || made(node).kind != Kind::lobe)
        throw std::invalid_argument("node " + std::to_string(node) + " of a tree of " +
                                    std::to_string(_nodes.size()) + " nodes is no lobe");
    return _nodes[static_cast<std::size_t>(node)];
}

void ClosureTree::set_material(Node node, const Material& material)
{
    _all[lobe_node(node).lobe].material = material;
    for (Lobe& l : _lobes)
        if (l.node == node) l.material = material;
}

void ClosureTree::leave_out(Node node)
{
    lobe_node(node).left_out = true;
    if (_root >= 0) set_root(_root);
}

void ClosureTree::bind_tables(bool for_albedo)
{
    // Of several, each is asked for its albedo at every point.
    const bool asked = for_albedo || _lobes.size() > 1;
    for (Lobe& l : _lobes)
        if (auto* m = std::get_if<MicrofacetMaterial>(&l.material)) m->bind_tables(asked);
}

// `any` becomes true where a closure is left in, whose energy is then on the stack.
void ClosureTree::flatten(Node node, int depth, const ColorD& passing, bool& any)
{
    if (node < 0 || node >= static_cast<Node>(_nodes.size()))
        throw std::invalid_argument("a tree of " + std::to_string(_nodes.size()) +
                                    " nodes has no node " + std::to_string(node));
    if (depth > deepest)
        throw std::invalid_argument("combinations of closures are in one another more than " +
                                    std::to_string(deepest) + " deep");
    if (passing == ColorD(0.0)) return;

    const Made n = made(node);
    const auto weighed = [&](Node part, const ColorD& weight, bool rest, bool& some) {
        if (n.parameter < 0 && weight == ColorD(1.0))
            return flatten(part, depth + 1, passing, some);
        const Imath::C3f w(weight);
        const std::size_t start = _steps.size();
        _steps.push_back({StepKind::weigh, 0, w, n.parameter, rest});
        flatten(part, depth + 1, passing * weight, some);
        if (some)
            _steps.push_back({StepKind::weighed, 0, w, n.parameter, rest});
        else
            _steps.resize(start);
    };
    const auto together = [&](bool first, bool second) {
        if (first && second) _steps.push_back({StepKind::add});
        any = first || second;
    };
    switch (n.kind)
    {
        case Kind::lobe:
            if (_nodes[static_cast<std::size_t>(node)].left_out) break;
            if (static_cast<int>(_lobes.size()) == most_lobes)
                throw std::invalid_argument("a material has more than " +
                                            std::to_string(most_lobes) + " closures");
            _lobes.push_back(_all[_nodes[static_cast<std::size_t>(node)].lobe]);
            _steps.push_back({StepKind::lobe, static_cast<int>(_lobes.size()) - 1});
            any = true;
            break;
        case Kind::multiply: weighed(n.first, n.weight, false, any); break;
        case Kind::mix: {
            bool first = false, second = false;
            weighed(n.first, n.weight, false, first);
            weighed(n.second, ColorD(1.0) - n.weight, true, second);
            together(first, second);
            break;
        }
        case Kind::add: {
            bool first = false, second = false;
            flatten(n.first, depth + 1, passing, first);
            flatten(n.second, depth + 1, passing, second);
            together(first, second);
            break;
        }
        case Kind::layer: {
            bool top = false, base = false;
            flatten(n.first, depth + 1, passing, top);
            if (!top)
            {
                flatten(n.second, depth + 1, passing, any);
                break;
            }
            const std::size_t start = _steps.size();
            _steps.push_back({StepKind::pass});
            flatten(n.second, depth + 1, passing, base);
            if (base)
                _steps.push_back({StepKind::passed});
            else
                _steps.resize(start);
            any = true;
        }
    }
}

}  // namespace shaders
REGAIN_NAMESPACE_END
