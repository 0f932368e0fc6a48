// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A varying tree put together of closures whose numbers are values. A closure that gives nothing
/// is `nothing`; whatever is made of it gives nothing there either.

#pragma once

#include "graph_values.h"

REGAIN_NAMESPACE_BEGIN
namespace shaders {

/// What closures with facets have in common.
struct Facets
{
    Value alpha = Value(0.05f);  ///< one width, or two
    DistributionKind distribution = DistributionKind::ggx;
    double gamma = 2;
};

class ClosureBuilder
{
public:
    using Node = ClosureTree::Node;
    static constexpr Node nothing = -1;

    ClosureBuilder(VaryingTree& tree, GraphValues& values,
                   const std::optional<Compensation>& method)
        : _tree(tree), _values(values), _method(method)
    {}

    // Colours are in scene_linear. `name` is for light path expressions.
    Node schlick(const Value& F0, const Value& F82, const Value& F90, const Value& exponent,
                 const Facets&, const char* name = nullptr);
    Node conductor(const Value& n, const Value& k, const Facets&);
    /// An index below the least that there is counts as that; an index of 0 is left to who asks.
    Node dielectric(const Value& eta, ScatterMode, const Value& reflection_tint,
                    const Value& transmission_tint, const Facets&, bool thin_walled = false,
                    const char* name = nullptr);
    Node oren_nayar(const Value& color, const Value& roughness, bool energy_compensation);
    Node burley(const Value& color, const Value& roughness);
    Node subsurface(const Value& color);
    Node translucent(const Value& color);
    Node transparent(const Value& color);
    Node cloth(const Value& color, const Value& roughness, ClothMode);

    Node layer(Node top, Node base);
    Node add(Node, Node);
    Node multiply(Node, const Value& weight);
    Node mix(Node foreground, Node background, const Value& amount);

private:
    Node facets(MicrofacetMaterial, const Facets&, const char* name);

    VaryingTree& _tree;
    GraphValues& _values;
    const std::optional<Compensation>& _method;
};

}  // namespace shaders
REGAIN_NAMESPACE_END
