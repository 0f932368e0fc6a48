// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The surfaces of two exchange formats: glTF 2.0 with its material extensions (Khronos), and the
// UsdPreviewSurface specification (Pixar), both with Schlick's Fresnel over a diffuse.

#include "graph_closures.h"

REGAIN_NAMESPACE_BEGIN
namespace shaders {
namespace {

Value squared(GraphValues& v, const Value& x) { return v.multiply(x, x); }

Value normal_reflectance(GraphValues& v, const Value& eta)
{
    return squared(v, v.divide(v.subtract(eta, Value(1.0f)), v.add(eta, Value(1.0f))));
}

// 1 or 0 where there is a cutoff.
Value presence(GraphValues& v, const Value& alpha, const Value& cutoff)
{
    if (cutoff.is(0)) return alpha;
    return v.program().apply(ValueOp::if_greater_or_equal,
                             {alpha, cutoff, Value(1.0f), Value(0.0f)}, 1);
}

}  // namespace

ShadedSurface gltf_pbr(const NodeInputs& in, ClosureBuilder& make)
{
    GraphValues& v = in.values;
    const Value one(1.0f);
    in.note_unless_zero("iridescence", "thin films are not supported; there is none");
    in.note_unless_zero("thickness", "absorption inside is not supported; there is none");
    in.note_unless_zero("dispersion", "dispersion is not supported; there is none");
    const Value emissive = in.color("emissive", 0);
    if (emissive.varies() ||
        !(emissive.constant().x + emissive.constant().y + emissive.constant().z == 0))
        in.note("'emissive': emission is not supported; there is none");
    in.note_if_connected({"occlusion"}, "occlusion is not supported; light finds its own way");

    const Value color = in.color("base_color", 1), metallic = in.number("metallic", 1),
                eta = in.number("ior", 1.5f), specular = in.number("specular", 1),
                transmission = in.number("transmission", 0);
    Facets facets;
    facets.alpha = v.widths(in.number("roughness", 1), in.number("anisotropy_strength", 0));

    auto whole = ClosureBuilder::nothing;
    if (!metallic.is(1))
    {
        const Value F0 = v.multiply(
            v.clamp(v.multiply(in.color("specular_color", 1), normal_reflectance(v, eta)), 0, 1),
            specular);
        if (!transmission.is(1))
            whole = make.layer(make.schlick(F0, one, specular, Value(5.0f), facets, "coat"),
                               make.oren_nayar(color, Value(0.0f), false));
        if (!transmission.is(0))
            whole = make.mix(make.dielectric(eta, ScatterMode::RT, one, color, facets), whole,
                             transmission);
    }
    if (!metallic.is(0))
        whole = make.mix(make.schlick(color, one, one, Value(5.0f), facets), whole, metallic);
    whole = make.layer(make.cloth(in.color("sheen_color", 0), in.number("sheen_roughness", 0),
                                  ClothMode::conty_kulla),
                       whole);
    const Value coat = in.number("clearcoat", 0);
    if (!coat.is(0))
    {
        Facets top;
        top.alpha = v.widths(in.number("clearcoat_roughness", 0), Value(0.0f));
        whole = make.layer(make.multiply(make.dielectric(Value(1.5f), ScatterMode::R, one, one, top,
                                                         false, "coat"),
                                         v.clamp(coat, 0, 1)),
                           whole);
    }
    const Value mode = in.number("alpha_mode", 0), alpha = in.number("alpha", 1);
    if (mode.is(0)) return {whole, one};
    return {whole, presence(v, alpha, mode.is(1) ? in.number("alpha_cutoff", 0.5f) : Value(0.0f))};
}

ShadedSurface usd_preview_surface(const NodeInputs& in, ClosureBuilder& make)
{
    GraphValues& v = in.values;
    const Value one(1.0f);
    const Value emissive = in.color("emissiveColor", 0);
    if (emissive.varies() ||
        !(emissive.constant().x + emissive.constant().y + emissive.constant().z == 0))
        in.note("'emissiveColor': emission is not supported; there is none");
    in.note_if_connected({"occlusion"}, "occlusion is not supported; light finds its own way");
    in.note_if_connected({"displacement"}, "displacement is not supported; there is none");

    const Value color = in.color("diffuseColor", 0.18f), metallic = in.number("metallic", 0),
                dielectric = normal_reflectance(v, in.number("ior", 1.5f));
    const bool by_colour = in.flag("useSpecularWorkflow", false);
    Facets facets;
    facets.alpha = v.widths(in.number("roughness", 0.5f), Value(0.0f));
    const Value F0 = by_colour ? in.color("specularColor", 0) : v.mix(dielectric, color, metallic);
    const auto body = make.multiply(make.oren_nayar(color, Value(0.0f), false),
                                    by_colour ? one : v.rest(v.clamp(metallic, 0, 1)));
    auto whole = make.layer(make.schlick(F0, one, one, Value(5.0f), facets), body);
    const Value coat = in.number("clearcoat", 0);
    if (!coat.is(0))
    {
        Facets top;
        top.alpha = v.widths(in.number("clearcoatRoughness", 0.01f), Value(0.0f));
        whole =
            make.layer(make.multiply(make.schlick(dielectric, one, one, Value(5.0f), top, "coat"),
                                     v.clamp(coat, 0, 1)),
                       whole);
    }
    return {whole, presence(v, in.number("opacity", 1), in.number("opacityThreshold", 0))};
}

}  // namespace shaders
REGAIN_NAMESPACE_END
