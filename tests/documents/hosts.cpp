// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// A document whose numbers vary, as the three hosts see it: the same weights, values and pdfs at a
// point, and the same picture.

#include "documents.h"
#include "preview/bound_material.h"
#include "preview/environment.h"
#include "preview/osl_shader.h"
#include "preview/render_job.h"
#include "preview/row.h"
#include "texture_file.h"

#include "../colour/configs.h"
#include "../support/color_difference.h"
#include "../support/temporary_folder.h"
#include "../support/working_space.h"

#include <OpenImageIO/imageio.h>

#include <cmath>

using namespace regain;
using namespace regain::shaders;
using namespace regain::tests;
using namespace regain::tools::preview;

namespace {

namespace fs = std::filesystem;

VaryingTree from_file(const char* file, const char* material)
{
    const tools::TextureFiles pictures(ColorConfig::builtin());
    DocumentSettings with = settings();
    with.textures = pictures.loader();
    std::vector<DocumentNote> notes;
    VaryingTree s =
        MaterialDocument::read(fs::path(REGAIN_DOCUMENTS) / file, with).surface(material, notes);
    s.tree.bind_tables(true);
    return s;
}

constexpr int size = 32;

// Of one sphere.
void picture(Film& film, Host host, const VaryingTree& surface, std::uint32_t seed, int samples,
             bool furnace)
{
    RowLayout layout;
    layout.object = Object::sphere;
    layout.floor = false;
    layout.transparent = true;
    const RowScene scene(layout);
    const Environment light(furnace ? LatLongImage{2, 1, {Imath::C3f(1.0f), Imath::C3f(1.0f)}}
                                    : make_studio());
    const Camera camera = scene.camera(1);
    std::vector<std::unique_ptr<BoundMaterial>> materials;
    auto floor = floor_material();
    floor.bind_tables();
    materials.push_back(bind(floor));
    materials.push_back(bind(surface));
    const World world{scene.scene(), light, camera, size, size, seed, 16};
    const RowIntegrator integrator(host, world, std::move(materials));
    EXPECT_TRUE(render({{{&integrator.get(), &film}}, samples}));
    EXPECT_EQ(film.non_finite(), 0u);
}

// Mean of 16 tiles, of several runs: what they are, and how sure that is.
struct Tiles
{
    double mean[16] = {}, error[16] = {};
};
Tiles tiles_of(Host host, const VaryingTree& surface)
{
    constexpr int runs = 6;
    Tiles t;
    for (int run = 0; run < runs; ++run)
    {
        Film film(size, size);
        picture(film, host, surface, std::uint32_t(1 + run + 100 * int(host)), 16, false);
        for (int k = 0; k < 16; ++k)
        {
            double sum = 0;
            for (int i = 0; i < 64; ++i)
            {
                const Imath::C3f c = film.mean(8 * (k % 4) + i % 8, 8 * (k / 4) + i / 8);
                sum += double(c.x + c.y + c.z) / 3 / 64;
            }
            t.mean[k] += sum / runs;
            t.error[k] += sum * sum / runs;
        }
    }
    for (int k = 0; k < 16; ++k)
        t.error[k] = std::sqrt(std::max(t.error[k] - t.mean[k] * t.mean[k], 0.0) / (runs - 1));
    return t;
}

void expect_agreement(const VaryingTree& surface)
{
    ASSERT_TRUE(surface.varies());
    const Tiles a = tiles_of(Host::renderman, surface), b = tiles_of(Host::clarisse, surface),
                c = tiles_of(Host::osl, surface);
    for (int k = 0; k < 16; ++k)
        for (const Tiles* other : {&b, &c})
        {
            const double noise = std::hypot(a.error[k], other->error[k]);
            EXPECT_NEAR(a.mean[k], other->mean[k], 4.5 * noise + 2e-3) << "tile " << k;
        }
}

TEST(DocumentHosts, agree_where_widths_vary)
{
    expect_agreement(from_file("metals_textured.mtlx", "Copper"));
}
TEST(DocumentHosts, agree_where_colours_vary)
{
    expect_agreement(from_file("procedural_tiles.mtlx", "Tiles"));
}
TEST(DocumentHosts, agree_where_the_mixture_varies)
{
    expect_agreement(from_file("gltf_boombox.mtlx", "BoomBox"));
}
TEST(DocumentHosts, agree_where_presence_varies)
{
    expect_agreement(from_file("opacity_cutout.mtlx", "Cutout"));
}

// White, of a width that goes from that of a mirror to 1, half of it a diffuse: nothing is lost.
TEST(DocumentHosts, white_surfaces_that_vary_disappear_in_a_furnace)
{
    VaryingTree surface = surface_of(document(
        "<ramplr name='r' type='float'><input name='valuel' type='float' value='0'/><input "
        "name='valuer' type='float' value='1'/></ramplr><open_pbr_surface name='s' "
        "type='surfaceshader'><input name='base_color' type='color3' value='1, 1, 1'/><input "
        "name='specular_roughness' type='float' nodename='r'/><input name='base_metalness' "
        "type='float' nodename='r'/></open_pbr_surface>"));
    surface.tree.bind_tables(true);
    for (const Host host : all_hosts)
    {
        Film film(size, size);
        picture(film, host, surface, 3, 64, true);
        double sum = 0;
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) sum += double(film.mean(x, y).y) / (size * size);
        EXPECT_NEAR(sum, 1, 3e-3) << name(host);
    }
}

// Rendered in three working spaces, by the same random numbers: the colour of the middle.
TEST(DocumentHosts, metals_look_the_same_in_every_working_space)
{
    const test::TemporaryFolder folder;
    const ColorConfig configs[] = {
        ColorConfig::builtin(),
        ColorConfig::from_file(folder.write("a.ocio", test::working_in("ACEScg"))),
        ColorConfig::from_file(folder.write("b.ocio", test::working_in("lin_rec709")))};
    for (const char* metal : {"Gold", "Copper", "Brass"})
    {
        std::vector<Lab> looks;
        for (const ColorConfig& config : configs)
        {
            DocumentSettings with(config);
            const tools::TextureFiles pictures(config);
            with.textures = pictures.loader();
            std::vector<DocumentNote> notes;
            VaryingTree surface =
                MaterialDocument::read(fs::path(REGAIN_DOCUMENTS) / "metals_textured.mtlx", with)
                    .surface(metal, notes);
            surface.tree.bind_tables(true);
            Film film(size, size);
            picture(film, Host::renderman, surface, 5, 32, true);
            C3d sum(0.0);
            for (int y = 10; y < 22; ++y)
                for (int x = 10; x < 22; ++x) sum += C3d(film.mean(x, y)) / 144.0;
            const Imath::M33d to_working = to_working_space(config);
            looks.push_back(lab_of_xyz_d65(times_column(to_working.inverse(), sum)));
        }
        EXPECT_LT(ciede2000(looks[0], looks[1]), 0.01) << metal;
        EXPECT_LT(ciede2000(looks[0], looks[2]), 1) << metal;
        EXPECT_GT(looks[0].b, 5) << "it has a colour";
    }
}

// Of a picture of 4096 x 4096 those tiles that the few rays meet.
TEST(DocumentHosts, large_pictures_are_rendered_from_tiles)
{
    const test::TemporaryFolder folder;
    const auto file = folder / "large.exr";
    {
        auto out = OIIO::ImageOutput::create(file.string());
        OIIO::ImageSpec spec(4096, 4096, 3, OIIO::TypeDesc::HALF);
        spec.tile_width = spec.tile_height = 64;
        ASSERT_TRUE(out->open(file.string(), spec));
        const std::vector<float> tile(64 * 64 * 3, 0.5f);
        for (int y = 0; y < 4096; y += 64)
            for (int x = 0; x < 4096; x += 64)
                ASSERT_TRUE(out->write_tile(x, y, 0, OIIO::TypeDesc::FLOAT, tile.data()));
        out->close();
    }
    const tools::TextureFiles pictures(ColorConfig::builtin(), 8);
    DocumentSettings with = settings();
    with.textures = pictures.loader();
    VaryingTree surface = surface_of(
        document("<image name='i' type='color3'><input name='file' type='filename' value='" +
                 file.string() +
                 "' colorspace='lin_ap1'/></image><oren_nayar_diffuse_bsdf name='d' type='BSDF'>"
                 "<input name='color' type='color3' nodename='i'/></oren_nayar_diffuse_bsdf>"),
        nullptr, with);
    surface.tree.bind_tables(true);
    Film film(size, size);
    picture(film, Host::renderman, surface, 1, 16, true);
    EXPECT_NEAR(film.mean(size / 2, size / 2).y, 0.5f, 0.05f);
    EXPECT_GT(pictures.bytes_read(), 0);
    EXPECT_LT(pictures.bytes_held(), std::int64_t(10) << 20);
}

// What does not vary takes the way of all others, and no texture coordinates are asked for.
TEST(DocumentHosts, constants_are_shaded_as_constants)
{
    VaryingTree constant =
        surface_of(document("<open_pbr_surface name='s' type='surfaceshader'/>"));
    constant.tree.bind_tables(true);
    const auto bound = bind(constant);
    EXPECT_FALSE(bound->grid().textured);
    EXPECT_FALSE(bound->point().textured);
    EXPECT_FALSE(bound->osl().textured);
    const auto varied = bind(from_file("procedural_tiles.mtlx", "Tiles"));
    EXPECT_TRUE(varied->grid().textured);
    EXPECT_TRUE(varied->point().textured);
    EXPECT_TRUE(varied->osl().textured);
}

}  // namespace
