// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "closure_builder.h"

REGAIN_NAMESPACE_BEGIN
namespace shaders {
namespace {

double number(const Value& v) { return static_cast<double>(v.x()); }

// Of what varies, anything in the middle: tables do not depend on it.
ColorD color(const Value& v)
{
    if (v.varies()) return ColorD(0.5);
    const Imath::V4f& c = v.constant();
    if (v.width() == 1) return ColorD(static_cast<double>(c.x));
    return {static_cast<double>(c.x), static_cast<double>(c.y), static_cast<double>(c.z)};
}
double number_or(const Value& v, double otherwise) { return v.varies() ? otherwise : number(v); }

bool is_black(const Value& v) { return !v.varies() && color(v) == ColorD(0.0); }

// Whether tables are there for a method of a surface, which is asked once and for all.
bool goes_with(const Compensation& method, MicrofacetMaterial material)
{
    material.method = method;
    try
    {
        material.bind_tables(true);
    }
    catch (const std::invalid_argument&)
    {
        return false;
    }
    return true;
}

}  // namespace

ClosureBuilder::Node ClosureBuilder::facets(MicrofacetMaterial m, const Facets& f, const char* name)
{
    m.distribution = f.distribution;
    m.gamma = f.gamma;
    if (f.alpha.varies())
    {
        // Two widths have tables of their own.
        m.alpha_x = 0.5;
        m.alpha_y = f.alpha.width() > 1 ? 0.4 : 0.5;
    }
    else
    {
        m.alpha_x = number(f.alpha);
        m.alpha_y = f.alpha.width() > 1 ? static_cast<double>(f.alpha.constant().y) : m.alpha_x;
    }
    m.method = recommended_compensation(m.surface);
    if (_method && goes_with(*_method, m)) m.method = *_method;
    // Interfaces of a distribution with a tail have tables of single gammas, which nobody ships.
    if (m.is_interface() && has_gamma(m.distribution)) m.method = Method::none;
    const Node node = _tree.tree.lobe(m, name);
    _tree.vary(node, MaterialNumber::alpha, f.alpha);
    return node;
}

ClosureBuilder::Node ClosureBuilder::schlick(const Value& F0, const Value& F82, const Value& F90,
                                             const Value& exponent, const Facets& f,
                                             const char* name)
{
    MicrofacetMaterial m;
    m.surface = SchlickSurface{color(F0), color(F82), color(F90), number_or(exponent, 5)};
    const Node node = facets(m, f, name);
    _tree.vary(node, MaterialNumber::F0, F0);
    _tree.vary(node, MaterialNumber::F82, F82);
    _tree.vary(node, MaterialNumber::F90, F90);
    _tree.vary(node, MaterialNumber::exponent, exponent);
    return node;
}

ClosureBuilder::Node ClosureBuilder::conductor(const Value& n, const Value& k, const Facets& f)
{
    MicrofacetMaterial m;
    m.surface = ConductorSurface{color(n), color(k)};
    const Node node = facets(m, f, nullptr);
    _tree.vary(node, MaterialNumber::n, n);
    _tree.vary(node, MaterialNumber::k, k);
    return node;
}

ClosureBuilder::Node ClosureBuilder::dielectric(const Value& eta, ScatterMode mode,
                                                const Value& reflection_tint,
                                                const Value& transmission_tint, const Facets& f,
                                                bool thin_walled, const char* name)
{
    if ((mode == ScatterMode::R && is_black(reflection_tint)) ||
        (mode == ScatterMode::T && is_black(transmission_tint)))
        return nothing;
    MicrofacetMaterial m;
    InterfaceSurface s;
    s.eta = number_or(eta, 1.5);
    s.mode = mode;
    // The form that added lobes continue.
    s.shadowing = thin_walled || mode == ScatterMode::R ? TransmissionShadowing::correlated
                                                        : TransmissionShadowing::beta;
    s.thin_walled = thin_walled;
    s.reflection_tint = color(reflection_tint);
    s.transmission_tint = color(transmission_tint);
    m.surface = s;
    const Node node = facets(m, f, name);
    _tree.vary(node, MaterialNumber::eta, eta);
    _tree.vary(node, MaterialNumber::reflection_tint, reflection_tint);
    _tree.vary(node, MaterialNumber::transmission_tint, transmission_tint);
    return node;
}

ClosureBuilder::Node ClosureBuilder::oren_nayar(const Value& c, const Value& roughness,
                                                bool energy_compensation)
{
    if (is_black(c)) return nothing;
    const Node node = _tree.tree.lobe(
        PlainMaterial{OrenNayarSurface{color(c), number_or(roughness, 0.5), energy_compensation}});
    _tree.vary(node, MaterialNumber::color, c);
    _tree.vary(node, MaterialNumber::roughness, roughness);
    return node;
}

ClosureBuilder::Node ClosureBuilder::burley(const Value& c, const Value& roughness)
{
    if (is_black(c)) return nothing;
    const Node node =
        _tree.tree.lobe(PlainMaterial{BurleyDiffuseSurface{color(c), number_or(roughness, 0.5)}});
    _tree.vary(node, MaterialNumber::color, c);
    _tree.vary(node, MaterialNumber::roughness, roughness);
    return node;
}

ClosureBuilder::Node ClosureBuilder::subsurface(const Value& c)
{
    if (is_black(c)) return nothing;
    const Node node = _tree.tree.lobe(PlainMaterial{SubsurfaceSurface{color(c)}});
    _tree.vary(node, MaterialNumber::color, c);
    return node;
}

ClosureBuilder::Node ClosureBuilder::translucent(const Value& c)
{
    if (is_black(c)) return nothing;
    const Node node = _tree.tree.lobe(PlainMaterial{TranslucentSurface{color(c)}});
    _tree.vary(node, MaterialNumber::color, c);
    return node;
}

ClosureBuilder::Node ClosureBuilder::transparent(const Value& c)
{
    if (is_black(c)) return nothing;
    const Node node = _tree.tree.lobe(PlainMaterial{TransparentSurface{color(c)}});
    _tree.vary(node, MaterialNumber::color, c);
    return node;
}

ClosureBuilder::Node ClosureBuilder::cloth(const Value& c, const Value& roughness, ClothMode mode)
{
    if (is_black(c)) return nothing;
    const Node node =
        _tree.tree.lobe(PlainMaterial{ClothSurface{color(c), number_or(roughness, 0.5), mode}});
    _tree.vary(node, MaterialNumber::color, c);
    _tree.vary(node, MaterialNumber::roughness, roughness);
    return node;
}

ClosureBuilder::Node ClosureBuilder::layer(Node top, Node base)
{
    return top == nothing ? base : base == nothing ? top : _tree.tree.layer(top, base);
}

ClosureBuilder::Node ClosureBuilder::add(Node a, Node b)
{
    return a == nothing ? b : b == nothing ? a : _tree.tree.add(a, b);
}

ClosureBuilder::Node ClosureBuilder::multiply(Node node, const Value& weight)
{
    if (node == nothing || is_black(weight)) return nothing;
    if (weight.varies()) return _tree.tree.multiply(node, _tree.parameter(weight));
    return color(weight) == ColorD(1.0) ? node : _tree.tree.multiply(node, color(weight));
}

ClosureBuilder::Node ClosureBuilder::mix(Node foreground, Node background, const Value& amount)
{
    const Value a = _values.clamp(amount, 0, 1);
    if (foreground == nothing || is_black(a)) return multiply(background, _values.rest(a));
    if (background == nothing || (!a.varies() && color(a) == ColorD(1.0)))
        return multiply(foreground, a);
    if (a.varies()) return _tree.tree.mix(foreground, background, _tree.parameter(a));
    if (a.width() == 1) return _tree.tree.mix(foreground, background, number(a));
    return add(multiply(foreground, a), multiply(background, _values.rest(a)));
}

}  // namespace shaders
REGAIN_NAMESPACE_END
