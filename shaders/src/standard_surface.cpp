// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Autodesk Standard Surface 1.0.1, put together as MaterialX's reference graph has it, but for
// transmission: where the graph layers reflection over transmission, one interface of both is taken
// here, which loses nothing.

#include "graph_closures.h"

REGAIN_NAMESPACE_BEGIN
namespace shaders {

ShadedSurface standard_surface(const NodeInputs& in, ClosureBuilder& make)
{
    GraphValues& v = in.values;
    const bool from_1_39 = v.document().version(in.node) >= 39;
    const Value one(1.0f);

    in.note_unless_zero("emission", "emission is not supported; there is none");
    in.note_unless_zero("thin_film_thickness", "thin films are not supported; there is none");
    in.note_unless_zero("transmission_depth",
                        "absorption inside is not supported; 'transmission_color' tints what "
                        "passes the surface");
    in.note_unless_zero("transmission_extra_roughness",
                        "transmission is as rough as reflection here");
    in.note_unless_zero("specular_rotation", "rotation is not supported; there is none");
    in.note_unless_zero("coat_rotation", "rotation is not supported; there is none");
    const bool thin_walled = in.flag("thin_walled", false);

    const Value coat = v.clamp(in.number("coat", 0), 0, 1),
                coat_roughness = in.number("coat_roughness", 0.1f);
    // A coat darkens and blurs what is below it.
    const Value coat_gamma = v.add(v.multiply(coat, in.number("coat_affect_color", 0)), one);
    const auto darkened = [&](const Value& color) {
        return coat_gamma.is(1) ? color : v.power(v.maximum(color, Value(0.0f)), coat_gamma);
    };
    const Value roughness =
        v.mix(in.number("specular_roughness", 0.2f), one,
              v.multiply(v.multiply(coat, in.number("coat_affect_roughness", 0)), coat_roughness));
    Facets facets;
    facets.alpha = v.widths(roughness, in.number("specular_anisotropy", 0));

    const Value base = in.number("base", from_1_39 ? 1.0f : 0.8f),
                base_color = in.color("base_color", from_1_39 ? 0.8f : 1.0f),
                specular = in.number("specular", 1), specular_color = in.color("specular_color", 1),
                eta = in.number("specular_IOR", 1.5f);
    const auto diffuse = make.multiply(
        make.oren_nayar(darkened(base_color), in.number("diffuse_roughness", 0), false), base);

    const Value subsurface = in.number("subsurface", 0);
    auto body = diffuse;
    if (!subsurface.is(0))
    {
        const Value color = darkened(in.color("subsurface_color", 1));
        if (!thin_walled)
            in.note("subsurface scattering is shown as diffuse reflection of the same colour");
        body = make.mix(thin_walled ? make.translucent(color) : make.subsurface(color), diffuse,
                        subsurface);
    }
    const Value sheen = in.number("sheen", 0);
    if (!sheen.is(0))
        body = make.layer(
            make.multiply(make.cloth(in.color("sheen_color", 1), in.number("sheen_roughness", 0.3f),
                                     ClothMode::conty_kulla),
                          sheen),
            body);

    const Value reflection = v.multiply(specular_color, specular),
                transmission = in.number("transmission", 0), metalness = in.number("metalness", 0);
    auto dielectric = ClosureBuilder::nothing;
    if (!metalness.is(1))
    {
        if (!transmission.is(1))
            dielectric = make.layer(
                make.dielectric(eta, ScatterMode::R, reflection, one, facets, false, "coat"), body);
        if (!transmission.is(0))
            dielectric =
                make.mix(make.dielectric(eta, ScatterMode::RT, reflection,
                                         in.color("transmission_color", 1), facets, thin_walled),
                         dielectric, transmission);
    }
    auto whole = dielectric;
    if (!metalness.is(0))
    {
        // The index of Gulbrandsen 2014 with that reflectance and edge tint.
        const Value r = v.clamp(v.multiply(base_color, base), 0, 0.999f), root = v.square_root(r),
                    edge = v.clamp(reflection, 0, 1);
        const Value n = v.mix(v.divide(v.add(one, root), v.rest(root)),
                              v.divide(v.rest(r), v.add(one, r)), edge);
        const Value a = v.add(n, one), b = v.subtract(n, one);
        const Value k = v.square_root(
            v.divide(v.subtract(v.multiply(r, v.multiply(a, a)), v.multiply(b, b)), v.rest(r)));
        whole = make.mix(make.conductor(n, k, facets), dielectric, metalness);
    }
    if (!coat.is(0))
    {
        Facets top;
        top.alpha = v.widths(coat_roughness, in.number("coat_anisotropy", 0));
        const auto reflects =
            make.multiply(make.dielectric(in.number("coat_IOR", 1.5f), ScatterMode::R, one, one,
                                          top, false, "coat"),
                          coat);
        whole =
            make.layer(reflects, make.multiply(whole, v.mix(one, in.color("coat_color", 1), coat)));
    }
    const Value opacity = in.color("opacity", 1);
    ShadedSurface made{whole, opacity};
    if (opacity.width() > 1)
    {
        const Imath::V4f grey(0.2126f, 0.7152f, 0.0722f, 0);
        made.presence = v.program().apply(ValueOp::dot, {opacity, Value(3, grey)}, 1);
    }
    return made;
}

}  // namespace shaders
REGAIN_NAMESPACE_END
