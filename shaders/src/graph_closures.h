// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// From a document's BSDFs and shaders to closures.

#pragma once

#include "closure_builder.h"

REGAIN_NAMESPACE_BEGIN
namespace shaders {

/// Numbers of one node.
struct NodeInputs
{
    GraphValues& values;
    Element node;
    GraphValues::Call call;

    /// A roughness, weight or index that is constant and outside its range is noted.
    Value number(const char* name, float otherwise) const;
    Value color(const char* name, float otherwise) const
    {
        return values.number(node, name, Value(otherwise).as(3), call);
    }
    Value color(const char* name, float r, float g, float b) const
    {
        return values.number(node, name, Value(3, Imath::V4f(r, g, b, 0)), call);
    }
    bool flag(const char* name, bool otherwise) const
    {
        return values.flag(node, name, otherwise, call);
    }
    std::string word(const char* name, const std::string& otherwise) const
    {
        return values.word(node, name, otherwise, call);
    }
    void note(const std::string& text) const { values.note(node, text); }
    /// Notes that the input does something that nobody does here, unless it is 0.
    void note_unless_zero(const char* name, const std::string& what) const;
    /// Notes the inputs that are connected.
    void note_if_connected(std::initializer_list<const char*> names, const std::string& what) const;
};

/// What a surface shader is: its closures, and how much of it is there.
struct ShadedSurface
{
    ClosureBuilder::Node closure = ClosureBuilder::nothing;
    Value presence = Value(1.0f);
};

// The shaders that are put together of closures. Each says which specification it follows.
ShadedSurface standard_surface(const NodeInputs&, ClosureBuilder&);
ShadedSurface open_pbr_surface(const NodeInputs&, ClosureBuilder&);
ShadedSurface gltf_pbr(const NodeInputs&, ClosureBuilder&);
ShadedSurface usd_preview_surface(const NodeInputs&, ClosureBuilder&);

class GraphClosures
{
public:
    GraphClosures(GraphValues& values, ClosureBuilder& builder) : _values(values), _builder(builder)
    {}

    /// Of a surfacematerial, a surface shader, or a node of type BSDF.
    ShadedSurface surface(const Element&);

private:
    using Node = ClosureBuilder::Node;

    ShadedSurface shader(const GraphValues::Source&);
    Node bsdf(const GraphValues::Source&);
    Node made(const Element&, GraphValues::Call);
    Node input(const Element&, const char* name, GraphValues::Call);
    Node weighed(const NodeInputs&, Node);
    Node dielectric(const NodeInputs&);
    Node schlick(const NodeInputs&);
    Node conductor(const NodeInputs&);
    Facets facets(const NodeInputs&);

    GraphValues& _values;
    ClosureBuilder& _builder;
    bool _thin_walled = false;
    std::map<std::pair<std::size_t, GraphValues::Call>, Node> _known;
    std::set<std::pair<std::size_t, GraphValues::Call>> _open;
};

}  // namespace shaders
REGAIN_NAMESPACE_END
