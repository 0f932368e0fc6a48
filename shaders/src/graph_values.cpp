// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "graph_values.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <tuple>

REGAIN_NAMESPACE_BEGIN
namespace shaders {
namespace {

using Imath::V4f;

constexpr int deepest_chain = 400;

// A node of stdlib that is one operation: its inputs in order, each with what it is by default.
struct Operand
{
    const char* name;
    float otherwise;
};
struct Operation
{
    const char* category;
    ValueOp op;
    Operand operands[4];
};
constexpr Operation operations[] = {
    {"add", ValueOp::add, {{"in1", 0}, {"in2", 0}}},
    {"subtract", ValueOp::subtract, {{"in1", 0}, {"in2", 0}}},
    {"multiply", ValueOp::multiply, {{"in1", 0}, {"in2", 1}}},
    {"divide", ValueOp::divide, {{"in1", 0}, {"in2", 1}}},
    {"modulo", ValueOp::modulo, {{"in1", 0}, {"in2", 1}}},
    {"power", ValueOp::power, {{"in1", 0}, {"in2", 1}}},
    {"safepower", ValueOp::power, {{"in1", 0}, {"in2", 1}}},
    {"min", ValueOp::minimum, {{"in1", 0}, {"in2", 0}}},
    {"max", ValueOp::maximum, {{"in1", 0}, {"in2", 0}}},
    {"absval", ValueOp::absolute, {{"in", 0}}},
    {"sign", ValueOp::sign, {{"in", 0}}},
    {"floor", ValueOp::floor, {{"in", 0}}},
    {"ceil", ValueOp::ceil, {{"in", 0}}},
    {"round", ValueOp::round, {{"in", 0}}},
    {"sqrt", ValueOp::square_root, {{"in", 0}}},
    {"exp", ValueOp::exponential, {{"in", 0}}},
    {"ln", ValueOp::logarithm, {{"in", 1}}},
    {"sin", ValueOp::sine, {{"in", 0}}},
    {"cos", ValueOp::cosine, {{"in", 0}}},
    {"tan", ValueOp::tangent, {{"in", 0}}},
    {"asin", ValueOp::arc_sine, {{"in", 0}}},
    {"acos", ValueOp::arc_cosine, {{"in", 0}}},
    {"clamp", ValueOp::clamp, {{"in", 0}, {"low", 0}, {"high", 1}}},
    {"mix", ValueOp::mix, {{"bg", 0}, {"fg", 0}, {"mix", 0}}},
    {"smoothstep", ValueOp::smooth_step, {{"in", 0}, {"low", 0}, {"high", 1}}},
    {"ifgreater", ValueOp::if_greater, {{"value1", 1}, {"value2", 0}, {"in1", 0}, {"in2", 0}}},
    {"ifgreatereq",
     ValueOp::if_greater_or_equal,
     {{"value1", 1}, {"value2", 0}, {"in1", 0}, {"in2", 0}}},
    {"ifequal", ValueOp::if_equal, {{"value1", 0}, {"value2", 0}, {"in1", 0}, {"in2", 0}}},
    {"normalize", ValueOp::normalise, {{"in", 0}}},
    {"rgbtohsv", ValueOp::rgb_to_hsv, {{"in", 0}}},
    {"hsvtorgb", ValueOp::hsv_to_rgb, {{"in", 0}}},
};

// One component is meant: of a condition, of an amount that is one.
bool is_condition(const char* name)
{
    return std::string(name) == "value1" || std::string(name) == "value2";
}

int channel_index(char c)
{
    switch (c)
    {
        case 'r':
        case 'x': return 0;
        case 'g':
        case 'y': return 1;
        case 'b':
        case 'z': return 2;
        case 'a':
        case 'w': return 3;
        default: return -1;
    }
}

AddressMode address_mode(const std::string& name)
{
    return name == "constant" ? AddressMode::constant
           : name == "clamp"  ? AddressMode::clamp
           : name == "mirror" ? AddressMode::mirror
                              : AddressMode::periodic;
}

}  // namespace

// By no locale: the host's may write numbers with commas.
bool parse_numbers(const std::string& text, int count, float* result)
{
    const char *at = text.data(), *const end = at + text.size();
    const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
    for (int k = 0; k < count; ++k)
    {
        while (at != end && (is_space(*at) || (k > 0 && *at == ','))) ++at;
        if (at != end && *at == '+') ++at;
        const auto [next, error] = std::from_chars(at, end, result[k]);
        if (error != std::errc() || !std::isfinite(result[k])) return false;
        at = next;
    }
    while (at != end && is_space(*at)) ++at;
    return at == end;
}

int components(const std::string& type)
{
    struct Type
    {
        const char* name;
        int components;
    };
    constexpr Type types[] = {{"float", 1},  {"integer", 1}, {"boolean", 1}, {"color3", 3},
                              {"color4", 4}, {"vector2", 2}, {"vector3", 3}, {"vector4", 4}};
    for (const Type& t : types)
        if (type == t.name) return t.components;
    return 0;
}

GraphValues::GraphValues(const DocumentSource& document, const DocumentSettings& settings,
                         ValueProgram& program, std::vector<DocumentNote>& notes)
    : _document(document), _settings(settings), _program(program), _notes(notes)
{}

void GraphValues::note(const Element& e, const std::string& text)
{
    const DocumentNote one{_document.file_name(e),
                           _document.line(e),
                           e.has("name") ? e.name() : e.category(),
                           text,
                           {}};
    if (_said.insert(one.message()).second) _notes.push_back(one);
}

const DocumentColor& GraphValues::space_of(const Element& e)
{
    const std::string name = DocumentSource::inherited(e, "colorspace");
    const auto found = _spaces.find(name);
    if (found != _spaces.end()) return found->second;
    const auto space = DocumentColor::named(_settings.config, name);
    if (!space)
        note(e, "nobody knows the colour space '" + name +
                    "'; its colours are taken for scene_linear");
    return _spaces.emplace(name, space ? *space : DocumentColor()).first->second;
}

// --- where a number comes from ---

// The element that gives an input, in the place where it is given.
struct GraphValues::Given
{
    Element input;
    Call call = nullptr;
    // Where nodes that it names are looked for; the document where that is none.
    Element scope;
};

// What a definition says of an input that nobody gives.
GraphValues::Given GraphValues::declared(const Element& definition, const std::string& input)
{
    const Element e = definition ? DocumentSource::input(definition, input) : Element();
    return e && e.has("value") ? Given{e, nullptr, Element()} : Given();
}

GraphValues::Given GraphValues::find(const Element& node, const char* name, Call call)
{
    Element user = node;
    std::string wanted = name;
    for (int step = 0; step < deepest_chain; ++step)
    {
        Element input = DocumentSource::input(user, wanted);
        const Element parent = _document.parent(user);
        if (!input) return {};
        if (!input.has("interfacename"))
            return {input, call, DocumentSource::is_root(parent) ? Element() : parent};
        wanted = input.attribute("interfacename");
        if (call && parent.xml == call->graph.xml)
        {
            user = call->caller;
            if (!DocumentSource::input(user, wanted)) return declared(call->declaration, wanted);
            call = call->outer;
        }
        else
        {
            user = parent;
            if (!DocumentSource::input(user, wanted) && user.has("nodedef"))
                return declared(_document.named(user.attribute("nodedef"), user), wanted);
        }
    }
    _document.fail(node, "its input '" + std::string(name) + "' leads through too many graphs");
}

const std::string* GraphValues::override_of(const Element& node, const char* input)
{
    for (std::size_t i = 0; i < _settings.overrides.size(); ++i)
    {
        const std::string& name = _settings.overrides[i].first;
        if (name != input && name != node.name() + "." + input) continue;
        _used.insert(i);
        return &_settings.overrides[i].second;
    }
    return nullptr;
}

void GraphValues::note_unused_overrides(const Element& material)
{
    for (std::size_t i = 0; i < _settings.overrides.size(); ++i)
    {
        const std::string& name = _settings.overrides[i].first;
        if (_used.count(i) == 0)
            _notes.push_back({_document.file_name(material), _document.line(material),
                              material.name(), "'" + name + "' is no input of any of its nodes",
                              name});
    }
}

bool GraphValues::has(const Element& node, const char* input, Call call)
{
    if (override_of(node, input)) return true;
    return static_cast<bool>(find(node, input, call).input);
}

GraphValues::Source GraphValues::source(const Element& node, const char* name, Call call)
{
    if (override_of(node, name)) return {};
    const Given given = find(node, name, call);
    if (!given.input) return {};
    const Element& input = given.input;
    Source s;
    s.call = given.call;
    s.output = input.attribute("output");
    if (input.has("nodegraph"))
    {
        s.node = _document.named(input.attribute("nodegraph"), input);
        if (!s.node || s.node.category() != "nodegraph")
            _document.fail(input, "there is no graph '" + input.attribute("nodegraph") + "'");
        s.call = nullptr;
        return s;
    }
    std::string wanted = input.attribute("nodename");
    if (wanted.empty() && !input.has("value")) wanted = s.output;
    if (wanted.empty()) return {};
    s.node =
        given.scope ? _document.child_named(given.scope, wanted) : _document.named(wanted, input);
    if (!s.node) _document.fail(input, "there is no node '" + wanted + "'");
    return s;
}

// The document's own definition of a node, by its name or by category and type; none of a node that
// is not defined here.
Element GraphValues::definition_of(const Element& node) const
{
    const std::string type = node.attribute("type");
    Element any;
    for (const Element& e : _document.definitions(node.category()))
    {
        if (node.has("nodedef"))
        {
            if (node.attribute("nodedef") == e.name()) return e;
            continue;
        }
        // Several definitions of one category differ in what comes out.
        const pugi::xml_node output = e.xml.child("output");
        if (type == output.attribute("type").value() || e.attribute("type") == type) return e;
        if (!any) any = e;
    }
    return any;
}

GraphValues::Source GraphValues::answering(const Source& from)
{
    Source s = from;
    for (int step = 0; step < deepest_chain; ++step)
    {
        Element graph;
        if (s.node.category() == "nodegraph")
            graph = s.node;
        else if (s.node.category() == "output")
        {
            // Looks like an input.
            Source next;
            next.output = s.node.attribute("output");
            next.call = s.call;
            const Element parent = _document.parent(s.node);
            const std::string wanted = s.node.attribute("nodename"),
                              other = s.node.attribute("nodegraph");
            if (!other.empty())
            {
                next.node = _document.named(other, s.node);
                next.call = nullptr;
            }
            else if (!wanted.empty())
                next.node = DocumentSource::is_root(parent) ? _document.named(wanted, s.node)
                                                            : _document.child_named(parent, wanted);
            if (!next.node) _document.fail(s.node, "the output leads to no node");
            s = next;
            continue;
        }
        else if (const Element definition = definition_of(s.node))
        {
            graph = _document.graph_of(definition);
            if (!graph) return s;
            auto& call = _calls[{s.node.xml.hash_value(), s.call}];
            if (!call) call.reset(new GraphCall{s.node, graph, definition, s.call});
            s.call = call.get();
        }
        else
            return s;
        Element output;
        for (const pugi::xml_node& child : graph.xml.children("output"))
            if (s.output.empty() || s.output == child.attribute("name").value())
            {
                output = {child, graph.file};
                break;
            }
        if (!output)
            _document.fail(graph, s.output.empty() ? "the graph has no output"
                                                   : "the graph has no output '" + s.output + "'");
        s.node = output;
        s.output.clear();
    }
    _document.fail(from.node, "graphs lead to one another without end");
}

// --- values ---

Value GraphValues::constant(const Element& input, const std::string& text, int width)
{
    const std::string type = input.attribute("type");
    const int declared = components(type);
    if (type == "boolean")
    {
        if (text != "true" && text != "false")
            _document.fail(input, "'" + text + "' is neither true nor false");
        return Value(text == "true" ? 1.0f : 0.0f).as(width);
    }
    const int count = declared > 0 ? declared : width;
    float v[4] = {0, 0, 0, 0};
    if (!parse_numbers(text, count, v))
        _document.fail(input, "'" + text + "' is no " +
                                  (declared > 0 ? type : std::to_string(count) + " numbers"));
    if (type == "color3" || type == "color4")
    {
        const DocumentColor& space = space_of(input);
        const Imath::C3f given(v[0], v[1], v[2]), c = space(given);
        for (int k = 0; k < 3; ++k) v[k] = c[k];
        const auto is_within = [](const Imath::C3f& x) {
            return std::min({x.x, x.y, x.z}) > -1e-4f && std::max({x.x, x.y, x.z}) < 1 + 1e-4f;
        };
        if (!space.is_identity() && is_within(given) && !is_within(c))
        {
            note(input, "the colour " + text + " is outside the working space " +
                            _settings.config.scene_linear() + "; one near it was used instead");
            const C3d limited = limited_to_unit(C3d(c));
            for (int k = 0; k < 3; ++k) v[k] = static_cast<float>(limited[k]);
        }
    }
    if (count == 1) v[1] = v[2] = v[3] = v[0];
    return {count, V4f(v[0], v[1], v[2], v[3])};
}

Value GraphValues::swizzled(const Value& v, const std::string& channels, const Element& at)
{
    Value part[4] = {Value(0.0f), Value(0.0f), Value(0.0f), Value(0.0f)};
    const std::size_t n = channels.size();
    if (n < 1 || n > 4) _document.fail(at, "'" + channels + "' is no choice of channels");
    for (std::size_t k = 0; k < n; ++k)
    {
        const char c = channels[k];
        if (c == '0' || c == '1')
            part[k] = Value(c == '1' ? 1.0f : 0.0f);
        else if (channel_index(c) < 0)
            _document.fail(at, "'" + channels + "' is no choice of channels");
        else
            part[k] = lane(v, channel_index(c));
    }
    if (n == 1) return part[0];
    return _program.apply(ValueOp::combine, {part[0], part[1], part[2], part[3]},
                          static_cast<int>(n));
}

Value GraphValues::lane(const Value& v, int k)
{
    if (v.width() == 1) return v;
    return _program.apply(ValueOp::lane, {v, Value(static_cast<float>(k))}, 1);
}

Value GraphValues::pair(const Value& a, const Value& b)
{
    return _program.apply(ValueOp::combine, {a, b}, 2);
}

Value GraphValues::two(ValueOp op, const Value& a, const Value& b)
{
    return _program.apply(op, {a, b}, std::max(a.width(), b.width()));
}

Value GraphValues::multiply(const Value& a, const Value& b)
{
    if (a.is(1) && a.width() == 1) return b;
    if (b.is(1) && b.width() == 1) return a;
    return two(ValueOp::multiply, a, b);
}

Value GraphValues::mix(const Value& a, const Value& b, const Value& amount)
{
    if (amount.width() == 1 && amount.is(0)) return a;
    if (amount.width() == 1 && amount.is(1)) return b;
    return _program.apply(ValueOp::mix, {a, b, amount},
                          std::max({a.width(), b.width(), amount.width()}));
}

Value GraphValues::clamp(const Value& a, float low, float high)
{
    return _program.apply(ValueOp::clamp, {a, Value(low), Value(high)}, a.width());
}

// alpha = r^2, aspect = sqrt(1 - anisotropy), (alpha / aspect, alpha aspect).
Value GraphValues::widths(const Value& roughness, const Value& anisotropy)
{
    const Value r = clamp(roughness, 0, 1), alpha = multiply(r, r);
    if (anisotropy.is(0)) return alpha;
    const Value aspect = square_root(rest(clamp(anisotropy, 0, 0.98f)));
    return pair(_program.apply(ValueOp::minimum, {divide(alpha, aspect), Value(1.0f)}, 1),
                multiply(alpha, aspect));
}

Value GraphValues::number(const Element& node, const char* name, const Value& otherwise, Call call)
{
    const int width = otherwise.width();
    if (const std::string* text = override_of(node, name))
    {
        if (*text == "true" || *text == "false") return Value(*text == "true" ? 1.0f : 0.0f);
        float v[4] = {0, 0, 0, 0};
        if (parse_numbers(*text, 1, v)) return Value(v[0]);
        if (width == 1 || !parse_numbers(*text, width, v))
            _document.fail(node, std::string("'") + name + "': '" + *text + "' is no number" +
                                     (width == 1 ? "" : ", nor " + std::to_string(width)));
        return {width, V4f(v[0], v[1], v[2], v[3])};
    }
    const Given given = find(node, name, call);
    if (!given.input) return otherwise;
    Value v = otherwise;
    if (const Source from = source(node, name, call); from.node)
    {
        v = result(from, width);
        if (given.input.has("channels"))
            v = swizzled(v, given.input.attribute("channels"), given.input);
    }
    else if (given.input.has("value"))
        v = constant(given.input, given.input.attribute("value"), width);
    else
        return otherwise;
    if (v.width() != width && v.width() != 1 && width != 1)
        note(given.input, "has " + std::to_string(v.width()) + " components, where " +
                              std::to_string(width) + " are asked for");
    if (v.width() != 1 && width == 1) return lane(v, 0);
    return v.as(v.width() == 1 ? 1 : width);
}

std::string GraphValues::word(const Element& node, const char* name, const std::string& otherwise,
                              Call call)
{
    if (const std::string* text = override_of(node, name)) return *text;
    const Given given = find(node, name, call);
    if (!given.input) return otherwise;
    if (given.input.has("value")) return given.input.attribute("value");
    note(given.input, "is connected, which words cannot be; '" + otherwise + "' was used");
    return otherwise;
}

bool GraphValues::flag(const Element& node, const char* name, bool otherwise, Call call)
{
    const Value v = number(node, name, Value(otherwise ? 1.0f : 0.0f), call);
    if (!v.varies()) return v.x() != 0;
    note(node, std::string("'") + name + "' varies, which it cannot here; " +
                   (otherwise ? "true" : "false") + " was used");
    return otherwise;
}

Value GraphValues::result(const Source& from, int width)
{
    const Source s = answering(from);
    const Key key{s.node.xml.hash_value(), s.call, s.output, width};
    if (const auto known = _known.find(key); known != _known.end()) return known->second;
    if (!_open.insert(key).second) _document.fail(s.node, "nodes lead back to themselves");
    if (++_depth > deepest_chain)
        _document.fail(s.node,
                       "more than " + std::to_string(deepest_chain) + " nodes lead to one another");
    const Value v = node(s.node, s.output, width, s.call);
    --_depth;
    _open.erase(key);
    _known.emplace(key, v);
    return v;
}

Value GraphValues::ramp(const Element& e, int width, Call call, int k)
{
    const bool along_u = k == 0;
    const Value uv = has(e, "texcoord", call) ? number(e, "texcoord", Value(0.0f).as(2), call)
                                              : _program.texcoord();
    return mix(number(e, along_u ? "valuel" : "valueb", Value(0.0f).as(width), call),
               number(e, along_u ? "valuer" : "valuet", Value(0.0f).as(width), call),
               clamp(lane(uv, k), 0, 1));
}

Value GraphValues::node(const Element& e, const std::string& output, int wanted, Call call)
{
    const std::string category = e.category(), type = e.attribute("type");
    const int declared = components(type), width = declared > 0 ? declared : wanted;
    const auto in = [&](const char* name, float otherwise, int w) {
        return number(e, name, Value(otherwise).as(w), call);
    };

    for (const Operation& o : operations)
    {
        if (category != o.category) continue;
        Value v[4] = {Value(0.0f), Value(0.0f), Value(0.0f), Value(0.0f)};
        for (int k = 0; k < 4 && o.operands[k].name; ++k)
            v[k] = in(o.operands[k].name, o.operands[k].otherwise,
                      is_condition(o.operands[k].name) ? 1 : width);
        if (o.op == ValueOp::multiply) return multiply(v[0], v[1]);
        if (o.op == ValueOp::mix) return mix(v[0], v[1], v[2]);
        return _program.apply(o.op, {v[0], v[1], v[2], v[3]}, width);
    }
    if (category == "constant") return in("value", 0, width);
    if (category == "dot") return in("in", 0, width);
    if (category == "invert") return subtract(in("amount", 1, width), in("in", 0, width));
    if (category == "contrast")
    {
        const Value pivot = in("pivot", 0.5f, width);
        return add(multiply(subtract(in("in", 0, width), pivot), in("amount", 1, width)), pivot);
    }
    if (category == "remap" || category == "range")
    {
        const Value low = in("inlow", 0, width), high = in("inhigh", 1, width);
        Value t = divide(subtract(in("in", 0, width), low), subtract(high, low));
        if (category == "range")
        {
            const Value gamma = in("gamma", 1, width);
            if (!gamma.is(1)) t = power(t, divide(Value(1.0f), gamma));
        }
        const Value out_low = in("outlow", 0, width), out_high = in("outhigh", 1, width);
        const Value v = mix(out_low, out_high, t);
        if (category == "range" && flag(e, "doclamp", false, call))
            return _program.apply(ValueOp::clamp, {v, out_low, out_high}, width);
        return v;
    }
    if (category == "atan2")
        return _program.apply(ValueOp::arc_tangent2,
                              {has(e, "iny", call) ? in("iny", 0, width) : in("in1", 0, width),
                               has(e, "inx", call) ? in("inx", 1, width) : in("in2", 1, width)},
                              width);
    if (category == "luminance")
    {
        const V4f rec709(0.2126729f, 0.7151522f, 0.0721750f, 0);
        return _program.apply(ValueOp::luminance,
                              {in("in", 0, width), number(e, "lumacoeffs", Value(3, rec709), call)},
                              width);
    }
    if (category == "saturate")
    {
        const V4f rec709(0.2126729f, 0.7151522f, 0.0721750f, 0);
        const Value c = in("in", 0, width);
        const Value grey = _program.apply(
            ValueOp::luminance, {c, number(e, "lumacoeffs", Value(3, rec709), call)}, width);
        return mix(grey, c, in("amount", 1, 1));
    }
    if (category == "hsvadjust")
    {
        const Value hsv = _program.apply(ValueOp::rgb_to_hsv, {in("in", 0, width)}, width),
                    amount = number(e, "amount", Value(3, V4f(0, 1, 1, 0)), call);
        const Value turned = _program.apply(
            ValueOp::combine,
            {add(lane(hsv, 0), lane(amount, 0)), multiply(lane(hsv, 1), lane(amount, 1)),
             multiply(lane(hsv, 2), lane(amount, 2)), width == 4 ? lane(hsv, 3) : Value(0.0f)},
            width);
        return _program.apply(ValueOp::hsv_to_rgb, {turned}, width);
    }
    if (category == "dotproduct" || category == "magnitude" || category == "distance")
    {
        const char* first = category == "magnitude" ? "in" : "in1";
        const Element given = DocumentSource::input(e, first);
        const int n = given && components(given.attribute("type")) > 1
                          ? components(given.attribute("type"))
                          : 3;
        const Value a = in(first, 0, n).as(n);
        if (category == "magnitude") return _program.apply(ValueOp::magnitude, {a}, 1);
        const Value b = in("in2", 0, n).as(n);
        if (category == "distance")
            return _program.apply(ValueOp::magnitude, {subtract(a, b).as(n)}, 1);
        return _program.apply(ValueOp::dot, {a, b}, 1);
    }
    if (category == "crossproduct")
        return _program.apply(ValueOp::cross, {in("in1", 0, 3), in("in2", 0, 3)}, 3);
    if (category == "combine2" || category == "combine3" || category == "combine4")
    {
        // Of combine2 and combine4 parts may be wider: a colour and its alpha, two pairs.
        std::vector<Value> parts;
        for (const char* name : {"in1", "in2", "in3", "in4"})
        {
            const Element given = DocumentSource::input(e, name);
            const int n = given ? std::max(components(given.attribute("type")), 1) : 1;
            const Value v = in(name, 0, n);
            for (int k = 0; k < n && parts.size() < 4; ++k) parts.push_back(lane(v, k));
        }
        parts.resize(4, Value(0.0f));
        return _program.apply(ValueOp::combine, {parts[0], parts[1], parts[2], parts[3]}, width);
    }
    if (category == "separate2" || category == "separate3" || category == "separate4")
    {
        const int n = category.back() - '0';
        if (output.size() != 4 || channel_index(output[3]) < 0)
            _document.fail(e, "it has no output '" + output + "'");
        return lane(in("in", 0, n), channel_index(output[3]));
    }
    if (category == "extract")
    {
        const Element given = DocumentSource::input(e, "in");
        const int n = given ? std::max(components(given.attribute("type")), 1) : 3;
        return _program.apply(ValueOp::lane, {in("in", 0, n).as(n), in("index", 0, 1)}, 1);
    }
    if (category == "swizzle")
    {
        const Element given = DocumentSource::input(e, "in");
        const int n = given ? std::max(components(given.attribute("type")), 1) : 3;
        return swizzled(in("in", 0, n), word(e, "channels", "rgb", call), e);
    }
    if (category == "convert")
    {
        const Element given = DocumentSource::input(e, "in");
        const int n = given ? std::max(components(given.attribute("type")), 1) : width;
        const Value v = in("in", 0, n);
        if (n == 3 && width == 4)
            return _program.apply(ValueOp::combine,
                                  {lane(v, 0), lane(v, 1), lane(v, 2), Value(1.0f)}, 4);
        return n > 1 && width == 1 ? lane(v, 0) : v.as(n == 1 ? 1 : width);
    }
    if (category == "switch")
    {
        const Value which = in("which", 0, 1);
        const char* names[] = {"in1", "in2", "in3", "in4", "in5",
                               "in6", "in7", "in8", "in9", "in10"};
        Value v = in(names[9], 0, width);
        for (int k = 8; k >= 0; --k)
            v = _program.apply(ValueOp::if_greater,
                               {Value(static_cast<float>(k + 1)), which, in(names[k], 0, width), v},
                               width);
        return v;
    }
    if (category == "premult" || category == "unpremult")
    {
        const Value c = in("in", 0, 4), alpha = lane(c, 3);
        const Value scaled = category == "premult" ? multiply(c, alpha) : divide(c, alpha);
        return _program.apply(ValueOp::combine,
                              {lane(scaled, 0), lane(scaled, 1), lane(scaled, 2), alpha}, 4);
    }
    if (category == "texcoord" || category == "UsdPrimvarReader") return _program.texcoord();
    if (category == "geompropvalue" && (type == "vector2" || type == "vector3"))
        return _program.texcoord();
    if (category == "position") return _program.position();
    if (category == "normal") return _program.normal();
    if (category == "ramplr" || category == "ramptb")
        return ramp(e, width, call, category == "ramptb");
    if (category == "splitlr" || category == "splittb")
    {
        const bool along_u = category == "splitlr";
        const Value uv = has(e, "texcoord", call) ? number(e, "texcoord", Value(0.0f).as(2), call)
                                                  : _program.texcoord();
        return _program.apply(ValueOp::if_greater,
                              {in("center", 0.5f, 1), lane(uv, along_u ? 0 : 1),
                               in(along_u ? "valuel" : "valueb", 0, width),
                               in(along_u ? "valuer" : "valuet", 0, width)},
                              width);
    }
    if (category == "checkerboard")
    {
        const Value uv = has(e, "texcoord", call) ? number(e, "texcoord", Value(0.0f).as(2), call)
                                                  : _program.texcoord();
        const Value at =
            _program.apply(ValueOp::floor,
                           {subtract(multiply(uv, in("uvtiling", 8, 2)), in("uvoffset", 0, 2))}, 2);
        const Value odd =
            _program.apply(ValueOp::modulo, {add(lane(at, 0), lane(at, 1)), Value(2.0f)}, 1);
        return mix(in("color1", 1, 3), in("color2", 0, 3), odd);
    }
    if (category == "place2d")
    {
        const Value uv = has(e, "texcoord", call) ? number(e, "texcoord", Value(0.0f).as(2), call)
                                                  : _program.texcoord();
        const Value pivot = in("pivot", 0, 2);
        Value p = divide(subtract(uv, pivot), in("scale", 1, 2));
        const Value turn = in("rotate", 0, 1);
        if (!turn.is(0))
        {
            const Value angle = multiply(turn, Value(-3.14159265f / 180)),
                        s = _program.apply(ValueOp::sine, {angle}, 1),
                        c = _program.apply(ValueOp::cosine, {angle}, 1);
            p = pair(subtract(multiply(c, lane(p, 0)), multiply(s, lane(p, 1))),
                     add(multiply(s, lane(p, 0)), multiply(c, lane(p, 1))));
        }
        return add(subtract(p, in("offset", 0, 2)), pivot);
    }
    if (category == "roughness_anisotropy")
    {
        const Value r = in("roughness", 0, 1), alpha = multiply(r, r), a = in("anisotropy", 0, 1);
        return a.is(0) ? alpha : widths(r, a);
    }
    if (category == "roughness_dual")
    {
        const Value r = clamp(in("roughness", 0, 2), 0, 1), squared = multiply(r, r);
        return squared;
    }
    if (category == "artistic_ior")
    {
        // Gulbrandsen 2014: n and k of a reflectance at normal incidence and of an edge tint.
        const Value r = clamp(in("reflectivity", 0.8f, 3), 0, 0.999f),
                    edge = in("edge_color", 1, 3), root = square_root(r);
        const Value least = divide(rest(r), add(Value(1.0f), r)),
                    most = divide(add(Value(1.0f), root), rest(root)), n = mix(most, least, edge);
        if (output != "extinction") return n;
        const Value a = add(n, Value(1.0f)), b = subtract(n, Value(1.0f));
        return square_root(divide(subtract(multiply(r, multiply(a, a)), multiply(b, b)), rest(r)));
    }
    if (category == "UsdUVTexture")
    {
        const Value v = add(multiply(picture(e, 4, call), in("scale", 1, 4)), in("bias", 0, 4));
        return output.size() == 1 && channel_index(output[0]) >= 0
                   ? lane(v, channel_index(output[0]))
                   : v.as(wanted);
    }
    if (category == "image" || category == "tiledimage" || category == "gltf_image" ||
        category == "gltf_colorimage")
        return picture(e, width, call);
    return unknown(e, width, call);
}

Value GraphValues::unknown(const Element& e, int width, Call call)
{
    for (const char* name : {"in", "default", "value", "in1"})
        if (has(e, name, call))
        {
            note(e, "the node '" + e.category() + "' is not supported; its input '" + name +
                        "' was used instead");
            return number(e, name, Value(0.0f).as(width), call);
        }
    note(e, "the node '" + e.category() + "' is not supported; 0 was used instead");
    return Value(0.0f).as(width);
}

Value GraphValues::picture(const Element& e, int width, Call call)
{
    const bool usd = e.category() == "UsdUVTexture";
    const Value otherwise = number(e, usd ? "fallback" : "default", Value(0.0f).as(width), call);
    const Given file = find(e, "file", call);
    std::string name = file.input ? file.input.attribute("value") : "";
    if (name.empty())
    {
        note(e, "no picture is named; the default was used instead");
        return otherwise;
    }
    name = DocumentSource::prefixes(file.input, "fileprefix") + name;
    if (const auto udim = name.find("<UDIM>"); udim != std::string::npos)
    {
        note(e, "tiles of a <UDIM> picture are not supported; 1001 was used for all");
        name.replace(udim, 6, "1001");
    }
    if (!_settings.textures)
    {
        note(e, "pictures are not read here; the default was used instead of '" + name + "'");
        return otherwise;
    }
    const std::string type = e.attribute("type");
    const bool is_color = type == "color3" || type == "color4" || (usd && type.empty());
    const Element declared = file.input;
    const std::string space = is_color ? DocumentSource::inherited(declared, "colorspace") : "";
    if (is_color) space_of(declared);
    const auto path = _document.resolved(name, file.input);
    auto& texture = _pictures[{path.string(), space}];
    if (!texture)
    {
        try
        {
            texture = _settings.textures(path, space);
        }
        catch (const std::runtime_error& error)
        {
            _document.fail(e, error.what());
        }
    }
    Value uv = has(e, usd ? "st" : "texcoord", call)
                   ? number(e, usd ? "st" : "texcoord", Value(0.0f).as(2), call)
                   : _program.texcoord();
    if (e.category() == "tiledimage")
    {
        const Value tiling = number(e, "uvtiling", Value(1.0f).as(2), call),
                    offset = number(e, "uvoffset", Value(0.0f).as(2), call),
                    image_size = number(e, "realworldimagesize", Value(1.0f).as(2), call),
                    tile_size = number(e, "realworldtilesize", Value(1.0f).as(2), call);
        uv = divide(multiply(subtract(multiply(uv, tiling), offset), tile_size), image_size);
    }
    const std::string filter = word(e, "filtertype", "linear", call);
    if (filter != "linear")
        note(e, "the filter '" + filter + "' is not supported; linear was used instead");
    if (has(e, "layer", call) && !word(e, "layer", "", call).empty())
        note(e, "layers of a picture are not supported; the first channels were used");
    const auto mode = [&](const char* input) {
        return address_mode(word(e, input, "periodic", call));
    };
    const Value v = _program.image(texture, uv, otherwise, mode(usd ? "wrapS" : "uaddressmode"),
                                   mode(usd ? "wrapT" : "vaddressmode"), std::max(width, 1));
    if (e.category() == "gltf_image" || e.category() == "gltf_colorimage")
        return multiply(v, number(e, "factor", Value(1.0f).as(width), call));
    return v;
}

}  // namespace shaders
REGAIN_NAMESPACE_END
