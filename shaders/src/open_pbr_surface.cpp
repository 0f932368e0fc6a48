// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// OpenPBR Surface 1.1 (Academy Software Foundation): fuzz over coat over a base that is metal,
// glass, or glossy over diffuse. The darkening of what is coated is that of its section "Coat",
// with the estimates of MaterialX's reference graph.

#include "graph_closures.h"

REGAIN_NAMESPACE_BEGIN
namespace shaders {
namespace {

// alpha_x = r^2 sqrt(2 / (1 + (1 - a)^2)), alpha_y = (1 - a) alpha_x.
Value widths(GraphValues& v, const Value& roughness, const Value& anisotropy)
{
    const Value r = v.clamp(roughness, 0, 1), alpha = v.multiply(r, r);
    if (anisotropy.is(0)) return alpha;
    const Value rest = v.rest(v.clamp(anisotropy, 0, 1));
    const Value x = v.multiply(
        alpha, v.square_root(v.divide(Value(2.0f), v.add(Value(1.0f), v.multiply(rest, rest)))));
    return v.pair(x, v.multiply(rest, x));
}

Value normal_reflectance(GraphValues& v, const Value& eta)
{
    const Value r = v.divide(v.subtract(eta, Value(1.0f)), v.add(eta, Value(1.0f)));
    return v.multiply(r, r);
}

// The index whose reflectance at normal incidence is `weight` times as much.
Value scaled_index(GraphValues& v, const Value& eta, const Value& weight)
{
    if (weight.is(1)) return eta;
    const Value one(1.0f);
    const Value root = v.clamp(
        v.square_root(v.multiply(normal_reflectance(v, eta), v.maximum(weight, Value(0.0f)))), 0,
        0.999f);
    const Value sign = v.program().apply(ValueOp::sign, {v.subtract(eta, one)}, 1),
                e = v.multiply(sign, root);
    return v.divide(v.add(one, e), v.subtract(one, e));
}

}  // namespace

ShadedSurface open_pbr_surface(const NodeInputs& in, ClosureBuilder& make)
{
    GraphValues& v = in.values;
    const Value one(1.0f);
    in.note_unless_zero("emission_luminance", "emission is not supported; there is none");
    in.note_unless_zero("thin_film_weight", "thin films are not supported; there is none");
    in.note_unless_zero("transmission_depth",
                        "absorption inside is not supported; 'transmission_color' tints what "
                        "passes the surface");
    in.note_unless_zero("transmission_dispersion_scale",
                        "dispersion is not supported; there is none");
    const bool thin_walled = in.flag("geometry_thin_walled", false);

    const Value base_weight = in.number("base_weight", 1),
                base_color = in.color("base_color", 0.8f),
                metalness = in.number("base_metalness", 0),
                specular_weight = in.number("specular_weight", 1),
                specular_color = in.color("specular_color", 1),
                coat = v.clamp(in.number("coat_weight", 0), 0, 1),
                coat_roughness = in.number("coat_roughness", 0),
                coat_eta = in.number("coat_ior", 1.6f);

    // A rough coat blurs what is below it, and its index is what light comes from there.
    Value roughness = in.number("specular_roughness", 0.3f), eta = in.number("specular_ior", 1.5f);
    if (!coat.is(0))
    {
        const Value below = v.power(roughness, Value(4.0f)),
                    above = v.multiply(Value(2.0f), v.power(coat_roughness, Value(4.0f))),
                    both = v.program().apply(ValueOp::minimum, {v.add(below, above), one}, 1);
        roughness = v.mix(roughness, v.power(both, Value(0.25f)), coat);
        const Value ratio = v.divide(eta, coat_eta);
        // Below 1 it would reflect all of some light: the same the other way round does not.
        const Value safe =
            v.program().apply(ValueOp::if_greater, {ratio, one, ratio, v.divide(one, ratio)}, 1);
        eta = v.mix(eta, safe, coat);
    }
    Facets facets;
    facets.alpha = widths(v, roughness, in.number("specular_roughness_anisotropy", 0));
    eta = scaled_index(v, eta, specular_weight);

    const Value subsurface = in.number("subsurface_weight", 0),
                subsurface_color = in.color("subsurface_color", 0.8f),
                transmission = in.number("transmission_weight", 0);
    auto base = ClosureBuilder::nothing;
    if (!metalness.is(1))
    {
        auto body = make.multiply(
            make.oren_nayar(base_color, in.number("base_diffuse_roughness", 0), true), base_weight);
        if (!subsurface.is(0))
        {
            in.note(thin_walled ? "subsurface scattering of a sheet is half diffuse reflection, "
                                  "half diffuse transmission of the same colour"
                                : "subsurface scattering is shown as diffuse reflection of the "
                                  "same colour");
            const auto below =
                thin_walled
                    ? make.mix(make.translucent(subsurface_color),
                               make.oren_nayar(subsurface_color, Value(0.0f), true), Value(0.5f))
                    : make.subsurface(subsurface_color);
            body = make.mix(below, body, subsurface);
        }
        if (!transmission.is(1))
            base = make.layer(
                make.dielectric(eta, ScatterMode::R, specular_color, one, facets, false, "coat"),
                body);
        if (!transmission.is(0))
            base = make.mix(make.dielectric(eta, ScatterMode::RT, specular_color,
                                            in.color("transmission_color", 1), facets, thin_walled),
                            base, transmission);
    }
    if (!metalness.is(0))
        base = make.mix(make.multiply(make.schlick(v.multiply(base_color, base_weight),
                                                   specular_color, one, Value(5.0f), facets),
                                      v.clamp(specular_weight, 0, 1)),
                        base, metalness);
    if (!coat.is(0))
    {
        // Of the light that a coated base gives back, K is reflected down again inside the coat.
        const Value K = v.rest(
            v.divide(v.rest(normal_reflectance(v, coat_eta)), v.multiply(coat_eta, coat_eta)));
        const Value E = v.mix(v.mix(base_color, subsurface_color, subsurface),
                              v.multiply(base_color, specular_weight), metalness);
        const Value darkening = v.divide(v.rest(K), v.rest(v.multiply(E, K)));
        const Value dims =
            v.multiply(v.mix(one, darkening, v.multiply(coat, in.number("coat_darkening", 1))),
                       v.mix(one, in.color("coat_color", 1), coat));
        Facets top;
        top.alpha = widths(v, coat_roughness, in.number("coat_roughness_anisotropy", 0));
        base = make.layer(
            make.multiply(make.dielectric(coat_eta, ScatterMode::R, one, one, top, false, "coat"),
                          coat),
            make.multiply(base, dims));
    }
    const Value fuzz = in.number("fuzz_weight", 0);
    if (!fuzz.is(0))
        base = make.layer(
            make.multiply(make.cloth(in.color("fuzz_color", 1), in.number("fuzz_roughness", 0.5f),
                                     ClothMode::zeltner),
                          fuzz),
            base);
    return {base, in.number("geometry_opacity", 1)};
}

}  // namespace shaders
REGAIN_NAMESPACE_END
