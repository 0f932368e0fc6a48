// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Closures and shaders of documents: what they become, what it weighs, and that white ones lose
// nothing.

#include "documents.h"
#include "preview/lobe_maker.h"

#include <cmath>

using namespace regain;
using namespace regain::shaders;
using namespace regain::tests;

namespace {

std::string in(const std::string& name, const std::string& type, const std::string& value)
{
    return "<input name='" + name + "' type='" + type + "' value='" + value + "'/>";
}
std::string closure(const std::string& category, const std::string& inputs,
                    const std::string& name = "c")
{
    return "<" + category + " name='" + name + "' type='BSDF'>" + inputs + "</" + category + ">";
}
std::string shader(const std::string& category, const std::string& inputs)
{
    return "<" + category + " name='s' type='surfaceshader'>" + inputs + "</" + category + ">";
}

TEST(DocumentSurfaces, closures_have_the_numbers_of_their_nodes)
{
    const auto metal = surface_of(
        document(closure("conductor_bsdf", in("ior", "color3", "0.2, 0.9, 1.1") +
                                               in("extinction", "color3", "3.9, 2.4, 2.2") +
                                               in("roughness", "vector2", "0.2, 0.1"))));
    ASSERT_EQ(metal.lobes(), 1);
    const auto& index = std::get<ConductorSurface>(facets(metal).surface);
    expect_color(index.n, 0.2, 0.9, 1.1);
    expect_color(index.k, 3.9, 2.4, 2.2);
    EXPECT_FLOAT_EQ(float(facets(metal).alpha_x), 0.2f);
    EXPECT_FLOAT_EQ(float(facets(metal).alpha_y), 0.1f);

    const auto glass = surface_of(document(
        closure("dielectric_bsdf", in("ior", "float", "1.7") + in("scatter_mode", "string", "RT") +
                                       in("tint", "color3", "0.9, 0.8, 0.7"))));
    const auto& interface = std::get<InterfaceSurface>(facets(glass).surface);
    EXPECT_FLOAT_EQ(float(interface.eta), 1.7f);
    EXPECT_EQ(interface.mode, ScatterMode::RT);
    expect_color(interface.transmission_tint, 0.9, 0.8, 0.7);
    EXPECT_TRUE(std::holds_alternative<Tail>(facets(glass).method));

    const auto cloth = surface_of(document(
        closure("sheen_bsdf", in("mode", "string", "zeltner") + in("roughness", "float", "0.7"))));
    EXPECT_EQ(plain<ClothSurface>(cloth).mode, ClothMode::zeltner);
    EXPECT_FLOAT_EQ(float(plain<ClothSurface>(cloth).roughness), 0.7f);

    // Defaults are pbrlib's.
    const auto standard = surface_of(document(closure("generalized_schlick_bsdf", "")));
    expect_color(std::get<SchlickSurface>(facets(standard).surface).F0, 1, 1, 1);
    EXPECT_FLOAT_EQ(float(facets(standard).alpha_x), 0.05f);
    EXPECT_EQ(
        plain<OrenNayarSurface>(surface_of(document(closure("oren_nayar_diffuse_bsdf", "")))).color,
        ColorD(double(0.18f)));
}

TEST(DocumentSurfaces, weights_go_where_the_tree_says)
{
    const std::string parts =
        closure("oren_nayar_diffuse_bsdf", "", "a") + closure("burley_diffuse_bsdf", "", "b") +
        closure(
            "multiply",
            "<input name='in1' type='BSDF' nodename='a'/>" + in("in2", "color3", "0.5, 0.25, 1"),
            "m") +
        closure("mix",
                "<input name='fg' type='BSDF' nodename='m'/>"
                "<input name='bg' type='BSDF' nodename='b'/>" +
                    in("mix", "float", "0.75"),
                "x");
    const auto mixed = surface_of(document(parts));
    ASSERT_EQ(mixed.lobes(), 2);
    auto w = weights(mixed, {1, 1});
    EXPECT_NEAR(w[0].x, 0.375f, 1e-6f);
    EXPECT_NEAR(w[0].z, 0.75f, 1e-6f);
    EXPECT_NEAR(w[1].y, 0.25f, 1e-6f);
    const auto layered = surface_of(
        document(parts + closure("dielectric_bsdf", in("weight", "float", "0.5"), "coat") +
                 closure("layer",
                         "<input name='top' type='BSDF' nodename='coat'/>"
                         "<input name='base' type='BSDF' nodename='x'/>",
                         "l")));
    ASSERT_EQ(layered.lobes(), 3);
    w = weights(layered, {0.4f, 1, 1});
    EXPECT_NEAR(w[0].x, 0.5f, 1e-6f);
    EXPECT_NEAR(w[1].x, 0.8f * 0.375f, 1e-6f);
    EXPECT_NEAR(w[2].x, 0.8f * 0.25f, 1e-6f);
}

TEST(DocumentSurfaces, weights_may_vary)
{
    const auto surface = surface_of(
        document(closure("oren_nayar_diffuse_bsdf", "", "a") +
                 closure("burley_diffuse_bsdf", "", "b") + "<ramplr name='r' type='float'>" +
                 in("valuel", "float", "0") + in("valuer", "float", "1") + "</ramplr>" +
                 closure("mix",
                         "<input name='fg' type='BSDF' nodename='a'/>"
                         "<input name='bg' type='BSDF' nodename='b'/>"
                         "<input name='mix' type='float' nodename='r'/>",
                         "x")));
    ASSERT_EQ(surface.lobes(), 2);
    EXPECT_TRUE(surface.varies());
    SurfacePoint point;
    for (const float u : {0.0f, 0.3f, 1.0f})
    {
        point.uv.x = u;
        const auto w = weights(surface, {1, 1}, point);
        EXPECT_NEAR(w[0].x, u, 1e-6f);
        EXPECT_NEAR(w[1].x, 1 - u, 1e-6f);
    }
}

// Of a white shader all that its closures keep by their albedos, whichever way it is put together.
float energy(const VaryingTree& surface)
{
    VaryingTree bound = surface;
    bound.tree.bind_tables(true);
    std::vector<float> albedo;
    const tools::preview::SeenPoint seen{{0.6f, 0, 0.8f}, {0, 0, 1}, {0, 0, 1}, {1, 0, 0}};
    for (int k = 0; k < bound.lobes(); ++k)
    {
        const auto& material = bound.tree.material(k);
        albedo.push_back(tools::preview::maker_of(material).albedo(material, 1.0f, seen).y);
    }
    float sum = 0;
    const auto w = weights(bound, albedo);
    for (std::size_t k = 0; k < albedo.size(); ++k) sum += w[k].y * albedo[k];
    return sum;
}

TEST(DocumentSurfaces, white_shaders_lose_nothing)
{
    const std::string white = in("base_color", "color3", "1, 1, 1");
    struct Case
    {
        const char* category;
        std::string inputs;
    };
    const Case cases[] = {
        {"open_pbr_surface", ""},
        {"open_pbr_surface", in("base_metalness", "float", "1")},
        {"open_pbr_surface", in("transmission_weight", "float", "1")},
        {"open_pbr_surface", in("transmission_weight", "float", "0.5") +
                                 in("subsurface_weight", "float", "0.5") +
                                 in("subsurface_color", "color3", "1, 1, 1")},
        {"open_pbr_surface",
         in("coat_weight", "float", "0.7") + in("base_metalness", "float", "0.3")},
        {"open_pbr_surface", in("fuzz_weight", "float", "1") + in("coat_weight", "float", "1")},
        {"standard_surface", in("base", "float", "1")},
        {"standard_surface", in("transmission", "float", "0.6") + in("base", "float", "1")},
        {"standard_surface", in("coat", "float", "1") + in("base", "float", "1") +
                                 in("coat_affect_color", "float", "1")},
        {"standard_surface", in("sheen", "float", "1") + in("base", "float", "1")},
        {"gltf_pbr", in("metallic", "float", "0.5") + in("clearcoat", "float", "0.5")},
        {"gltf_pbr", in("transmission", "float", "0.5") + in("metallic", "float", "0")},
        {"gltf_pbr", in("sheen_color", "color3", "1, 1, 1") + in("metallic", "float", "0")},
        {"UsdPreviewSurface", in("diffuseColor", "color3", "1, 1, 1")},
        {"UsdPreviewSurface", in("diffuseColor", "color3", "1, 1, 1") +
                                  in("metallic", "float", "1") + in("clearcoat", "float", "1")}};
    for (const Case& c : cases)
    {
        const std::string colour = c.category == std::string("UsdPreviewSurface") ? "" : white;
        const auto surface = surface_of(document(shader(c.category, colour + c.inputs)));
        // Diffuse without compensation is dark where it is rough; none here is.
        EXPECT_NEAR(energy(surface), 1, 6e-3) << c.category << ' ' << c.inputs;
    }
}

TEST(DocumentSurfaces, what_a_material_does_not_need_is_not_there)
{
    const auto lobes = [](const std::string& category, const std::string& inputs) {
        return surface_of(document(shader(category, inputs))).lobes();
    };
    EXPECT_EQ(lobes("standard_surface", in("metalness", "float", "1")), 1);
    EXPECT_EQ(lobes("standard_surface", ""), 2);
    EXPECT_EQ(lobes("standard_surface", in("transmission", "float", "1")), 1);
    EXPECT_EQ(lobes("standard_surface", in("specular", "float", "0")), 1);
    EXPECT_EQ(lobes("standard_surface", in("coat", "float", "1")), 3);
    EXPECT_EQ(lobes("open_pbr_surface", in("base_metalness", "float", "1")), 1);
    EXPECT_EQ(lobes("open_pbr_surface", in("base_weight", "float", "0")), 1);
    EXPECT_EQ(lobes("gltf_pbr", ""), 1);
    EXPECT_EQ(lobes("gltf_pbr", in("metallic", "float", "0")), 2);
    EXPECT_EQ(lobes("UsdPreviewSurface", in("metallic", "float", "1")), 1);
}

TEST(DocumentSurfaces, a_coat_of_openpbr_darkens_what_is_below)
{
    const auto below = [](float darkening) {
        const auto s = surface_of(document(shader(
            "open_pbr_surface", in("coat_weight", "float", "1") + in("coat_ior", "float", "1.5") +
                                    in("base_color", "color3", "0.5, 0.5, 0.5") +
                                    in("coat_darkening", "float", std::to_string(darkening)))));
        return weights(s, {0, 0, 1})[2].x;
    };
    // K = 1 - (1 - 0.04) / 2.25, and (1 - K) / (1 - 0.5 K).
    const double K = 1 - 0.96 / 2.25;
    EXPECT_NEAR(below(0), 1, 1e-6);
    EXPECT_NEAR(below(1), (1 - K) / (1 - 0.5 * K), 1e-5);
}

TEST(DocumentSurfaces, presence_is_the_opacity)
{
    EXPECT_FLOAT_EQ(float(surface_of(document(shader("standard_surface",
                                                     in("opacity", "color3", "0.5, 0.5, 0.5"))))
                              .presence(nullptr)),
                    0.5f);
    EXPECT_FLOAT_EQ(float(surface_of(document(shader("open_pbr_surface",
                                                     in("geometry_opacity", "float", "0.3"))))
                              .presence(nullptr)),
                    0.3f);
    // glTF's alpha counts in its modes alone.
    const std::string half = in("alpha", "float", "0.5");
    EXPECT_EQ(surface_of(document(shader("gltf_pbr", half))).presence(nullptr), 1);
    EXPECT_EQ(surface_of(document(shader("gltf_pbr", half + in("alpha_mode", "integer", "2"))))
                  .presence(nullptr),
              0.5);
    EXPECT_EQ(surface_of(document(shader("gltf_pbr", half + in("alpha_mode", "integer", "1") +
                                                         in("alpha_cutoff", "float", "0.6"))))
                  .presence(nullptr),
              0);
}

TEST(DocumentSurfaces, methods_go_where_they_can)
{
    DocumentSettings with = settings();
    with.method = compensation_named("kulla-conty");
    const auto s = surface_of(
        document(shader("open_pbr_surface", in("base_metalness", "float", "0.5") +
                                                in("geometry_thin_walled", "boolean", "true") +
                                                in("transmission_weight", "float", "1"))),
        nullptr, with);
    for (int k = 0; k < s.lobes(); ++k)
    {
        const auto& m = facets(s, k);
        const auto* i = std::get_if<InterfaceSurface>(&m.surface);
        EXPECT_EQ(name(m.method), i && i->thin_walled ? "turquin" : "kulla-conty");
    }
}

TEST(DocumentSurfaces, what_is_not_shown_is_noted)
{
    const auto noted = [](const std::string& text) {
        std::vector<DocumentNote> notes;
        surface_of(text, &notes);
        std::string all;
        for (const auto& n : notes) all += n.message() + "\n";
        return all;
    };
    EXPECT_EQ(noted(document(shader("standard_surface", ""))), "");
    EXPECT_EQ(noted(document(shader("open_pbr_surface", ""))), "");
    EXPECT_TRUE(says(noted(document(shader("standard_surface", in("emission", "float", "1")))),
                     "test.mtlx:3: s: 'emission': emission is not supported"));
    EXPECT_TRUE(
        says(noted(document(shader("standard_surface", in("thin_film_thickness", "float", "400")))),
             "thin films"));
    EXPECT_TRUE(says(noted(document(shader("standard_surface", in("subsurface", "float", "1")))),
                     "subsurface scattering is shown as diffuse"));
    EXPECT_TRUE(says(noted(document(shader("lama_surface", ""))), "a grey diffuse was used"));
    EXPECT_TRUE(says(noted(document(shader("UsdPreviewSurface", in("metalness", "float", "1")))),
                     "metalness: 'metalness' is no input of UsdPreviewSurface; it has no effect"));
    EXPECT_TRUE(says(noted(document(closure("sheen_bsdf", in("colour", "color3", "1, 1, 1")))),
                     "'colour' is no input of sheen_bsdf"));
    const auto open_pbr = [&](const char* name, const char* value) {
        return noted(document(shader("open_pbr_surface", in(name, "float", value))));
    };
    EXPECT_TRUE(says(open_pbr("specular_roughness", "-1"),
                     "'specular_roughness' is -1, and has to be a number from 0 to 1"));
    EXPECT_TRUE(says(open_pbr("coat_weight", "5"), "'coat_weight' is 5"));
    EXPECT_TRUE(says(open_pbr("specular_ior", "0"), "'specular_ior' is 0, and has to be an index"));
    for (const char* possible : {"0", "1"})
        EXPECT_EQ(open_pbr("specular_roughness", possible), "") << possible;
    EXPECT_EQ(open_pbr("specular_weight", "2"), "");
    EXPECT_TRUE(says(noted(document(closure("chiang_hair_bsdf", ""))), "nothing in its place"));
    EXPECT_TRUE(
        says(noted(document(closure("dielectric_bsdf", in("distribution", "string", "phong")))),
             "'phong' is not supported; ggx was used"));
    EXPECT_TRUE(says(
        noted(document(closure("generalized_schlick_bsdf", in("scatter_mode", "string", "RT")))),
        "R was used instead"));
    EXPECT_TRUE(says(noted(document("<normalmap name='n' type='vector3'/>" +
                                    shader("standard_surface",
                                           "<input name='normal' type='vector3' nodename='n'/>"))),
                     "bump and normal maps are not supported"));
}

}  // namespace
