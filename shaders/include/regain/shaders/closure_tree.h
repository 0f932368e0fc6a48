// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A material of several closures, put together by MaterialX's layer, mix, add and multiply:
///
///     ClosureTree plastic;
///     const auto coat = plastic.lobe(coat_material, "coat");
///     const auto body = plastic.lobe(PlainMaterial{OrenNayarSurface{}});
///     plastic.set_root(plastic.layer(coat, body));
///     plastic.bind_tables();
///
/// Hosts see its closures one by one, and what each is multiplied by at a direction. The weight of
/// a closure is the product of those on its way from the root; below the top of a layer it is
/// 1 - E_top per channel, E_top being what the top reflects and lets through at that direction by
/// its closures' albedos, compensation included. That weight is a gain: it takes no part in
/// directions and pdfs, and as it looks at one direction alone, a layer is not reciprocal.
///
/// A closure whose weight is 0 whatever the direction is left out by set_root, and its tables are
/// not bound.
///
/// Weights and amounts may be parameters: colours that lobe_weights is given at every point, see
/// VaryingTree.

#pragma once

#include <regain/shaders/microfacet_material.h>

#include <string>
#include <variant>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace shaders {

class ClosureTree
{
public:
    using Material = std::variant<MicrofacetMaterial, PlainMaterial>;
    using Node = int;
    enum class Kind { lobe, layer, mix, add, multiply };

    /// What a node was made of. lobe: no nodes; layer: top and base; mix: foreground, background
    /// and, as weight, the amount of the foreground; multiply: first and weight. parameter: of
    /// the weight, -1 where it is none.
    struct Made
    {
        Kind kind;
        Node first, second;
        ColorD weight;
        int parameter = -1;
    };

    /// The index of a colour that is given later; without one it is 1, half the foreground.
    struct Parameter
    {
        int index;
    };

    /// Closures that a tree may have, and combinations on the way to one.
    static constexpr int most_lobes = 16, deepest = 64;

    ClosureTree() = default;
    /// A tree of one closure.
    REGAIN_SHADERS_API explicit ClosureTree(const Material&, const char* name = nullptr);

    /// `name`, for light path expressions, is kept as it is; without one, the material's own.
    REGAIN_SHADERS_API Node lobe(const Material&, const char* name = nullptr);
    REGAIN_SHADERS_API Node layer(Node top, Node base);
    /// `amount` of the foreground in [0, 1], clamped; NaN becomes 0.
    REGAIN_SHADERS_API Node mix(Node foreground, Node background, double amount);
    REGAIN_SHADERS_API Node mix(Node foreground, Node background, Parameter amount);
    REGAIN_SHADERS_API Node add(Node, Node);
    /// In [0, 1e6] per channel, clamped; NaN becomes 0.
    REGAIN_SHADERS_API Node multiply(Node, const ColorD& weight);
    REGAIN_SHADERS_API Node multiply(Node, Parameter weight);

    /// What the material is. A node may be in several places. Throws std::invalid_argument for a
    /// node that there is none of, and where there are more closures than most_lobes or more
    /// combinations in one another than `deepest`, naming both numbers.
    REGAIN_SHADERS_API void set_root(Node);

    /// As it was put together, for hosts that want a tree of their own; -1 before set_root.
    Node root() const { return _root; }
    const Made& made(Node node) const { return _nodes[static_cast<std::size_t>(node)].made; }
    /// Of a node that is a lobe; as given, no tables bound.
    const Material& material_of(Node node) const
    {
        return _all[_nodes[static_cast<std::size_t>(node)].lobe].material;
    }

    /// Another closure, or method of compensation, in the place of a lobe, wherever the node is;
    /// its tables are not bound. Throws std::invalid_argument where the node is no lobe.
    REGAIN_SHADERS_API void set_material(Node lobe, const Material&);
    /// As if the lobe had a weight of 0. Throws as set_material.
    REGAIN_SHADERS_API void leave_out(Node lobe);

    /// The share of the surface that is there, in [0, 1], clamped; NaN becomes 1. It weighs no
    /// closure.
    void set_presence(double presence) { _presence = detail::sanitised(presence, 0, 1, 1); }
    double presence() const { return _presence; }

    /// Of all closures: see MicrofacetMaterial. Where there are several, each has to know its
    /// albedo.
    REGAIN_SHADERS_API void bind_tables(bool for_albedo = false);

    /// Of those that are left in.
    int lobes() const { return static_cast<int>(_lobes.size()); }
    const Material& material(int k) const { return _lobes[static_cast<std::size_t>(k)].material; }
    const char* lobe_name(int k) const { return _lobes[static_cast<std::size_t>(k)].name; }
    /// The node that closure k is.
    Node node_of(int k) const { return _lobes[static_cast<std::size_t>(k)].node; }

    template <class Real, class Visit>
    decltype(auto) with_lobe(int k, Real strength, const Visit& visit) const
    {
        const Material& m = material(k);
        if (const auto* plain = std::get_if<PlainMaterial>(&m))
            return plain->with_closure(strength, visit);
        return std::get<MicrofacetMaterial>(m).with_closure(strength, visit);
    }

    /// What each closure is multiplied by at a direction where `albedo` holds what each reflects
    /// and lets through. Both have lobes() entries. Answers what they do together. `parameters`,
    /// of amounts in [0, 1], of weights in [0, 1e6], may be null.
    template <class Real>
    Color3<Real> lobe_weights(const Color3<Real>* albedo, Color3<Real>* weight,
                              const Imath::C3f* parameters = nullptr) const
    {
        // The steps are in the order of a walk from the root, tops first; each energy is on a
        // stack until the combination that it is part of is complete.
        using Color = Color3<Real>;
        Color passing[deepest + 1], energy[most_lobes];
        int depth = 0, top = 0;
        passing[0] = Color(Real(1));
        for (const Step& s : _steps) switch (s.kind)
            {
                case StepKind::lobe:
                    weight[s.lobe] = passing[depth];
                    energy[top++] = albedo[s.lobe];
                    break;
                case StepKind::weigh:
                    passing[depth + 1] = passing[depth] * Color(s.weight_by(parameters));
                    ++depth;
                    break;
                case StepKind::weighed:
                    --depth;
                    energy[top - 1] *= Color(s.weight_by(parameters));
                    break;
                case StepKind::pass:
                    passing[depth + 1] = passing[depth] * rest(energy[top - 1]);
                    ++depth;
                    break;
                case StepKind::passed:
                    --depth;
                    --top;
                    energy[top - 1] += rest(energy[top - 1]) * energy[top];
                    break;
                case StepKind::add:
                    --top;
                    energy[top - 1] += energy[top];
                    break;
            }
        return top > 0 ? energy[0] : Color(Real(0));
    }

private:
    struct NodeData
    {
        Made made;
        std::size_t lobe = 0;  // in _all
        bool left_out = false;
    };
    struct Lobe
    {
        Material material;
        const char* name;
        Node node = -1;
    };
    enum class StepKind { lobe, weigh, weighed, pass, passed, add };
    struct Step
    {
        StepKind kind;
        int lobe = 0;
        Imath::C3f weight{1.0f};
        int parameter = -1;
        bool rest = false;  // of that, 1 less it

        Imath::C3f weight_by(const Imath::C3f* parameters) const
        {
            if (parameter < 0 || !parameters) return weight;
            return rest ? Imath::C3f(1.0f) - parameters[parameter] : parameters[parameter];
        }
    };

    // The part of the light that gets by.
    template <class Real>
    static Color3<Real> rest(const Color3<Real>& energy)
    {
        return detail::per_channel(energy, [](Real e) { return Real(1) - detail::saturate(e); });
    }

    Node add_node(const NodeData&);
    NodeData& lobe_node(Node);
    void flatten(Node, int depth, const ColorD& passing, bool& any);

    std::vector<Lobe> _all;
    std::vector<NodeData> _nodes;
    std::vector<Lobe> _lobes;
    std::vector<Step> _steps;
    Node _root = -1;
    double _presence = 1;
};

}  // namespace shaders
REGAIN_NAMESPACE_END
