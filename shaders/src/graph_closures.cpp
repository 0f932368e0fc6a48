// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "graph_closures.h"

#include "known_inputs.h"

#include <regain/shaders/metals.h>

#include <cmath>
#include <sstream>

REGAIN_NAMESPACE_BEGIN
namespace shaders {

using Imath::V4f;

namespace {

bool ends_with(const std::string& name, const std::string& end)
{
    return name.size() >= end.size() &&
           name.compare(name.size() - end.size(), end.size(), end) == 0;
}

// What the number of that name has to be, where v is not.
const char* range_left_by(const std::string& name, float v)
{
    if (ends_with(name, "ior") || ends_with(name, "IOR"))
        return v > 0 ? nullptr : "an index above 0";
    // The specular weight of OpenPBR may be above 1: it scales the reflectance.
    if (name == "specular_weight") return v >= 0 ? nullptr : "a number from 0";
    if (ends_with(name, "roughness") || ends_with(name, "weight"))
        return v >= 0 && v <= 1 ? nullptr : "a number from 0 to 1";
    return nullptr;
}

}  // namespace

Value NodeInputs::number(const char* name, float otherwise) const
{
    const Value v = values.number(node, name, Value(otherwise), call);
    if (!v.varies())
        if (const char* range = range_left_by(name, v.x()))
        {
            std::ostringstream text;
            text << "'" << name << "' is " << v.x() << ", and has to be " << range
                 << "; the nearest that is possible was used";
            note(text.str());
        }
    return v;
}

void NodeInputs::note_unless_zero(const char* name, const std::string& what) const
{
    const Value v = number(name, 0);
    if (v.varies() || v.x() != 0) note(std::string("'") + name + "': " + what);
}

void NodeInputs::note_if_connected(std::initializer_list<const char*> names,
                                   const std::string& what) const
{
    for (const char* name : names)
        if (values.source(node, name, call).node)
            values.note(node, std::string("'") + name + "': " + what);
}

ShadedSurface GraphClosures::surface(const Element& e)
{
    if (e.category() != "surfacematerial") return shader({e, "", nullptr});
    const NodeInputs in{_values, e, nullptr};
    note_unknown_inputs(in);
    in.note_if_connected({"backsurfaceshader"}, "both sides are shaded by 'surfaceshader'");
    in.note_if_connected({"displacementshader"}, "displacement is not supported; there is none");
    const auto from = _values.source(e, "surfaceshader", nullptr);
    if (from.node) return shader(from);
    in.note("it has no surface shader; it is black");
    return {};
}

ShadedSurface GraphClosures::shader(const GraphValues::Source& from)
{
    const auto s = _values.answering(from);
    const NodeInputs in{_values, s.node, s.call};
    const std::string category = s.node.category();
    if (s.node.attribute("type") != "BSDF") note_unknown_inputs(in);
    const char* bump = "bump and normal maps are not supported; the surface's own is used";
    in.note_if_connected(
        {"normal", "coat_normal", "geometry_normal", "geometry_coat_normal", "clearcoat_normal",
         "tangent", "geometry_tangent", "geometry_coat_tangent"},
        bump);
    if (category == "standard_surface") return standard_surface(in, _builder);
    if (category == "open_pbr_surface") return open_pbr_surface(in, _builder);
    if (category == "gltf_pbr") return gltf_pbr(in, _builder);
    if (category == "UsdPreviewSurface") return usd_preview_surface(in, _builder);
    if (category == "surface")
    {
        ShadedSurface made;
        _thin_walled = in.flag("thin_walled", false);
        if (_values.source(s.node, "edf", s.call).node)
            in.note("'edf': emission is not supported; there is none");
        const auto closures = _values.source(s.node, "bsdf", s.call);
        if (closures.node)
            made.closure = bsdf(closures);
        else
            in.note("it has no BSDF; it is black");
        made.presence = in.number("opacity", 1);
        return made;
    }
    if (s.node.attribute("type") == "BSDF") return {bsdf(s), Value(1.0f)};
    in.note("the shader '" + category + "' is not supported; a grey diffuse was used instead");
    return {_builder.oren_nayar(Value(0.18f), Value(0.0f), true), Value(1.0f)};
}

GraphClosures::Node GraphClosures::bsdf(const GraphValues::Source& from)
{
    const auto s = _values.answering(from);
    const std::pair<std::size_t, GraphValues::Call> key{s.node.xml.hash_value(), s.call};
    if (const auto known = _known.find(key); known != _known.end()) return known->second;
    if (!_open.insert(key).second) _values.document().fail(s.node, "nodes lead back to themselves");
    if (static_cast<int>(_open.size()) > ClosureTree::deepest)
        _values.document().fail(s.node, "closures are in one another more than " +
                                            std::to_string(ClosureTree::deepest) + " deep");
    const Node node = made(s.node, s.call);
    _open.erase(key);
    _known.emplace(key, node);
    return node;
}

GraphClosures::Node GraphClosures::input(const Element& e, const char* name, GraphValues::Call call)
{
    const auto from = _values.source(e, name, call);
    return from.node ? bsdf(from) : ClosureBuilder::nothing;
}

GraphClosures::Node GraphClosures::weighed(const NodeInputs& in, Node node)
{
    return _builder.multiply(node, _values.clamp(in.number("weight", 1), 0, 1));
}

Facets GraphClosures::facets(const NodeInputs& in)
{
    Facets f;
    const Value alpha =
        _values.number(in.node, "roughness", Value(2, V4f(0.05f, 0.05f, 0, 0)), in.call);
    f.alpha = alpha;
    // The same twice is one width.
    if (!alpha.varies() && alpha.constant().x == alpha.constant().y) f.alpha = Value(alpha.x());
    const std::string named = in.word("distribution", "ggx");
    if (const auto known = distribution_named(named))
        f.distribution = *known;
    else
        in.note("the distribution '" + named + "' is not supported; ggx was used instead");
    const Value gamma = in.number("gamma", 2);
    if (gamma.varies())
        in.note("'gamma' varies, which it cannot; 2 was used instead");
    else
        f.gamma = static_cast<double>(gamma.x());
    in.note_if_connected({"normal", "tangent"},
                         "bump and normal maps are not supported; the surface's own is used");
    in.note_unless_zero("thinfilm_thickness", "thin films are not supported; there is none");
    if (in.flag("retroreflective", false))
        in.note("'retroreflective': reflection back is not supported; it is ahead");
    return f;
}

GraphClosures::Node GraphClosures::dielectric(const NodeInputs& in)
{
    const Facets f = facets(in);
    const std::string named = in.word("scatter_mode", "R");
    const ScatterMode mode = named == "RT"  ? ScatterMode::RT
                             : named == "T" ? ScatterMode::T
                                            : ScatterMode::R;
    if (named != "R" && named != "T" && named != "RT")
        in.note("the scatter mode '" + named + "' is not known; R was used instead");
    const Value tint = in.color("tint", 1), ior = in.number("ior", 1.5f);
    if (ior.is(0))
    {
        if (mode == ScatterMode::R)
            return _builder.schlick(tint, Value(1.0f), tint, Value(5.0f), f, "coat");
        in.note("an index of 0, for no Fresnel, goes with reflection alone; 1 was used instead");
        return _builder.dielectric(Value(1.0f), mode, tint, tint, f, _thin_walled);
    }
    const char* name = mode == ScatterMode::R ? "coat" : nullptr;
    return _builder.dielectric(ior, mode, tint, tint, f, _thin_walled && mode != ScatterMode::R,
                               name);
}

// The colour at 82 degrees, not what multiplies Schlick's curve there, is one that can be
// converted.
GraphClosures::Node GraphClosures::schlick(const NodeInputs& in)
{
    const Facets f = facets(in);
    const std::string mode = in.word("scatter_mode", "R");
    if (mode != "R")
        in.note("the scatter mode '" + mode +
                "' of generalized_schlick_bsdf is not supported; R was used instead");
    Value F82 = in.color("color82", 1);
    const Value F0 = in.color("color0", 1), F90 = in.color("color90", 1),
                exponent = in.number("exponent", 5);
    const Element given = DocumentSource::input(in.node, "color82");
    const bool is_overridden =
        _values.is_overridden(in.node, "color0") || _values.is_overridden(in.node, "color82");
    if (given && given.has("value") && !is_overridden && !F0.varies() && !F90.varies() &&
        !exponent.varies())
    {
        const DocumentColor& space = _values.space_of(given);
        if (!space.is_identity())
        {
            // The document's own numbers, before any conversion.
            const auto own = [&](const char* name) {
                Imath::C3f c(1.0f);
                const Element e = DocumentSource::input(in.node, name);
                if (e && !parse_numbers(e.attribute("value"), 3, &c.x)) c = Imath::C3f(1.0f);
                return c;
            };
            const Imath::C3f own0 = own("color0"), own82 = own("color82"), own90 = own("color90");
            const float t = std::pow(6.0f / 7, exponent.x());
            const auto curve = [&](float a, float b) { return a + (b - a) * t; };
            Imath::C3f there;
            for (int c = 0; c < 3; ++c) there[c] = own82[c] * curve(own0[c], own90[c]);
            there = space(there);
            V4f tint(1, 1, 1, 1);
            for (int c = 0; c < 3; ++c)
            {
                const float here = curve(F0.constant()[c], F90.constant()[c]);
                tint[c] = here > 0 ? there[c] / here : 1;
            }
            F82 = Value(3, tint);
        }
    }
    return _builder.schlick(F0, F82, F90, exponent, f);
}

GraphClosures::Node GraphClosures::conductor(const NodeInputs& in)
{
    const Facets f = facets(in);
    if (const std::string metal = in.word("metal", ""); !metal.empty())
    {
        try
        {
            const MetalIndex index = metal_index(metal, _values.config());
            const Imath::C3f n(index.n), k(index.k);
            return _builder.conductor(Value(3, V4f(n.x, n.y, n.z, 0)),
                                      Value(3, V4f(k.x, k.y, k.z, 0)), f);
        }
        catch (const std::invalid_argument& e)
        {
            in.note(std::string(e.what()) + "; 'ior' and 'extinction' were used instead");
        }
    }
    // Indices are no colours, whatever type and space a document declares.
    const auto index = [&](const char* name, float r, float g, float b) {
        const Element given = DocumentSource::input(in.node, name);
        V4f v(r, g, b, 0);
        if (_values.is_overridden(in.node, name) || !given ||
            !parse_numbers(given.attribute("value"), 3, &v.x))
            return in.color(name, r, g, b);
        return Value(3, v);
    };
    const Value n = index("ior", 0.183f, 0.421f, 1.373f),
                k = index("extinction", 3.424f, 2.346f, 1.770f);
    return _builder.conductor(n, k, f);
}

GraphClosures::Node GraphClosures::made(const Element& e, GraphValues::Call call)
{
    const NodeInputs in{_values, e, call};
    const std::string category = e.category();
    note_unknown_inputs(in);
    if (category == "dielectric_bsdf") return weighed(in, dielectric(in));
    if (category == "conductor_bsdf") return weighed(in, conductor(in));
    if (category == "generalized_schlick_bsdf") return weighed(in, schlick(in));
    if (category == "oren_nayar_diffuse_bsdf" || category == "diffuse_brdf")
        return weighed(in, _builder.oren_nayar(in.color("color", 0.18f), in.number("roughness", 0),
                                               in.flag("energy_compensation", false)));
    if (category == "burley_diffuse_bsdf")
        return weighed(in, _builder.burley(in.color("color", 0.18f), in.number("roughness", 0)));
    if (category == "translucent_bsdf")
        return weighed(in, _builder.translucent(in.color("color", 1)));
    if (category == "subsurface_bsdf")
    {
        in.note("subsurface scattering is shown as diffuse reflection of the same colour");
        return weighed(in, _builder.subsurface(in.color("color", 0.18f)));
    }
    if (category == "sheen_bsdf")
    {
        const std::string mode = in.word("mode", "conty_kulla");
        if (mode != "conty_kulla" && mode != "zeltner")
            in.note("the mode '" + mode + "' is not known; conty_kulla was used instead");
        return weighed(
            in, _builder.cloth(in.color("color", 1), in.number("roughness", 0.3f),
                               mode == "zeltner" ? ClothMode::zeltner : ClothMode::conty_kulla));
    }
    if (category == "layer")
    {
        const auto base = _values.source(e, "base", call);
        const bool volume = base.node && base.node.attribute("type") == "VDF";
        if (volume) in.note("'base': volumes are not supported; there is none");
        return _builder.layer(input(e, "top", call),
                              volume ? ClosureBuilder::nothing : input(e, "base", call));
    }
    if (category == "mix")
        return _builder.mix(input(e, "fg", call), input(e, "bg", call), in.number("mix", 0));
    if (category == "add") return _builder.add(input(e, "in1", call), input(e, "in2", call));
    if (category == "multiply")
    {
        const Element factor = DocumentSource::input(e, "in2");
        const Value weight = factor && components(factor.attribute("type")) == 1
                                 ? in.number("in2", 1)
                                 : in.color("in2", 1);
        return _builder.multiply(input(e, "in1", call), weight);
    }
    if (category == "dot") return input(e, "in", call);
    if (category == "thin_film_bsdf")
    {
        in.note("thin films are not supported; there is none");
        return ClosureBuilder::nothing;
    }
    in.note("the closure '" + category + "' is not supported; there is nothing in its place");
    return ClosureBuilder::nothing;
}

}  // namespace shaders
REGAIN_NAMESPACE_END
