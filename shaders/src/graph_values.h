// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Numbers of a document's nodes as values of a program: constants where they depend on nothing.

#pragma once

#include "document_source.h"

#include <regain/shaders/document_color.h>

#include <set>

REGAIN_NAMESPACE_BEGIN
namespace shaders {

/// Where a graph is used as a node: what its interface names are the inputs of `caller`.
struct GraphCall
{
    Element caller, graph, declaration;
    const GraphCall* outer = nullptr;
};

class GraphValues
{
public:
    GraphValues(const DocumentSource&, const DocumentSettings&, ValueProgram&,
                std::vector<DocumentNote>&);

    using Call = const GraphCall*;

    /// The input of a node, of so many components, or `otherwise` where the document says nothing.
    /// Colours are in scene_linear.
    Value number(const Element& node, const char* input, const Value& otherwise, Call);
    /// The same of a word, and of what is either true or false; these are constants.
    std::string word(const Element& node, const char* input, const std::string& otherwise, Call);
    bool flag(const Element& node, const char* input, bool otherwise, Call);

    /// What an input is connected to; `output` is then which of its outputs. None where it has a
    /// value or is not there. An input that is the interface's is followed to where it is given.
    struct Source
    {
        Element node;
        std::string output;
        Call call = nullptr;
    };
    Source source(const Element& node, const char* input, Call);
    /// From a node that is an instance of the document's own definition, or from a graph, to the
    /// node that answers for the output; any other is itself.
    Source answering(const Source&);

    /// The document or the interface gives the input.
    bool has(const Element& node, const char* input, Call);

    bool is_overridden(const Element& node, const char* input)
    {
        return override_of(node, input) != nullptr;
    }
    /// Notes overrides that nobody asked for.
    void note_unused_overrides(const Element& material);

    void note(const Element&, const std::string& text);
    const DocumentSource& document() const { return _document; }
    const ColorConfig& config() const { return _settings.config; }
    ValueProgram& program() { return _program; }

    // Operations, for what is put together of several.
    Value add(const Value& a, const Value& b) { return two(ValueOp::add, a, b); }
    Value subtract(const Value& a, const Value& b) { return two(ValueOp::subtract, a, b); }
    Value multiply(const Value& a, const Value& b);
    Value divide(const Value& a, const Value& b) { return two(ValueOp::divide, a, b); }
    Value mix(const Value& a, const Value& b, const Value& amount);
    Value clamp(const Value& a, float low, float high);
    Value square_root(const Value& a) { return one(ValueOp::square_root, a); }
    Value rest(const Value& a) { return subtract(Value(1.0f).as(a.width()), a); }
    Value lane(const Value& a, int k);
    Value pair(const Value& a, const Value& b);
    Value power(const Value& a, const Value& b) { return two(ValueOp::power, a, b); }
    Value maximum(const Value& a, const Value& b) { return two(ValueOp::maximum, a, b); }

    /// The space that is declared for an element; one that nobody knows is noted, and taken for
    /// scene_linear.
    const DocumentColor& space_of(const Element&);
    /// Two widths of facets by MaterialX's roughness_anisotropy: one where they are the same.
    Value widths(const Value& roughness, const Value& anisotropy);

private:
    // What the input has in place of what the document says; null where it has that.
    const std::string* override_of(const Element& node, const char* input);

    struct Given;
    Given find(const Element& node, const char* input, Call);
    static Given declared(const Element& definition, const std::string& input);
    Element definition_of(const Element& node) const;
    Value constant(const Element& input, const std::string& text, int width);
    Value swizzled(const Value&, const std::string& channels, const Element&);
    Value result(const Source&, int width);
    Value node(const Element&, const std::string& output, int width, Call);
    Value picture(const Element&, int width, Call);
    Value unknown(const Element&, int width, Call);
    Value ramp(const Element&, int width, Call, int lane);

    Value one(ValueOp op, const Value& a) { return _program.apply(op, {a}, a.width()); }
    Value two(ValueOp op, const Value& a, const Value& b);

    const DocumentSource& _document;
    const DocumentSettings& _settings;
    ValueProgram& _program;
    std::vector<DocumentNote>& _notes;
    // By node, call, output and width.
    using Key = std::tuple<std::size_t, Call, std::string, int>;
    std::map<Key, Value> _known;
    std::set<Key> _open;
    std::map<std::pair<std::size_t, Call>, std::unique_ptr<GraphCall>> _calls;
    std::map<std::pair<std::string, std::string>, std::shared_ptr<const Texture>> _pictures;
    std::map<std::string, DocumentColor> _spaces;
    std::set<std::string> _said;
    std::set<std::size_t> _used;  // overrides
    int _depth = 0;
};

/// So many finite numbers, divided by commas or spaces, and nothing else.
bool parse_numbers(const std::string& text, int count, float* result);

/// Components of a type: of float, integer and boolean 1, of color3 3; 0 where it is none of
/// numbers.
int components(const std::string& type);

}  // namespace shaders
REGAIN_NAMESPACE_END
