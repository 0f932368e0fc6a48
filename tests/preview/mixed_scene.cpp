// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// One scene of metal, glass, layered plastic, cloth and a mirror: every host shows the same, and
// white it disappears in a furnace.

#include "doubles.h"
#include "preview/bound_material.h"
#include "preview/row.h"

#include <gtest/gtest.h>

namespace regain::tools::preview { namespace {

using namespace doubles;
using shaders::ClosureTree;
using shaders::ColorD;
using shaders::MicrofacetMaterial;
using shaders::PlainMaterial;

MicrofacetMaterial metal(const ColorD& F0, double alpha)
{
    MicrofacetMaterial m;
    m.surface = shaders::SchlickSurface{F0, ColorD(1.0), ColorD(1.0), 5};
    m.alpha_x = m.alpha_y = alpha;
    m.method = shaders::Directional{};
    return m;
}

MicrofacetMaterial glass(double alpha, ScatterMode mode)
{
    MicrofacetMaterial m;
    shaders::InterfaceSurface interface;
    interface.eta = 1.5;
    interface.mode = mode;
    m.surface = interface;
    m.alpha_x = m.alpha_y = alpha;
    m.method = Method::turquin;
    return m;
}

PlainMaterial diffuse(const ColorD& color, double roughness)
{
    return {shaders::OrenNayarSurface{color, roughness, true}};
}

// The floor, and what stands on it: `colour` is that of all that has one.
std::vector<ClosureTree> materials(const ColorD& colour)
{
    std::vector<ClosureTree> all;
    all.emplace_back(diffuse(colour == ColorD(1.0) ? colour : ColorD(0.3), 0.5));
    all.emplace_back(metal(colour, 0.4));
    all.emplace_back(glass(0.2, ScatterMode::RT));

    ClosureTree plastic;
    const auto coat = plastic.lobe(glass(0.15, ScatterMode::R), "coat");
    const auto body =
        plastic.mix(plastic.lobe(diffuse(colour, 0.2)), plastic.lobe(metal(colour, 0.6)), 0.7);
    plastic.set_root(plastic.layer(coat, body));
    all.push_back(plastic);

    ClosureTree cloth;
    const auto fuzz =
        cloth.lobe(PlainMaterial{shaders::ClothSurface{colour, 0.4, shaders::ClothMode::zeltner}});
    cloth.set_root(cloth.layer(fuzz, cloth.lobe(diffuse(colour, 0.8))));
    all.push_back(cloth);

    all.emplace_back(metal(colour == ColorD(1.0) ? colour : ColorD(0.9), 0.0));
    for (ClosureTree& tree : all) tree.bind_tables(true);
    return all;
}

std::unique_ptr<RowIntegrator> integrator(Host host, const World& world, const ColorD& colour)
{
    std::vector<std::unique_ptr<BoundMaterial>> bound;
    for (const ClosureTree& tree : materials(colour)) bound.push_back(bind(tree));
    return std::make_unique<RowIntegrator>(host, world, std::move(bound));
}

// Uneven, with neither edges nor lamps, whose caustics would be all noise.
LatLongImage soft_light()
{
    LatLongImage image;
    image.width = 64;
    image.height = 32;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
        {
            const V3f d = latlong_direction((float(x) + 0.5f) / 64, (float(y) + 0.5f) / 32);
            image.pixels.push_back(C3f(1.0f, 0.9f, 0.8f) *
                                   (0.6f + 0.4f * d.y + 0.3f * d.x * (1 + d.z)));
        }
    return image;
}

// Five spheres in a row.
struct Spheres
{
    explicit Spheres(Environment light) : environment(std::move(light)) {}

    static constexpr int width = 64, height = 16;
    RowScene scene{RowLayout{5, Object::sphere, true, true}};
    Environment environment;
    Camera camera = scene.camera(float(width) / height);
    World world{scene.scene(), environment, camera, width, height};
};

TEST(MixedScene, every_host_shows_the_same)
{
    // Tiles, and independent runs of each, from which their noise is told.
    constexpr int tiles = 8, runs = 16, tile_width = Spheres::width / tiles,
                  tile_height = Spheres::height / tiles;
    Spheres s{Environment(soft_light())};
    s.world.max_bounces = 12;
    constexpr int hosts = int(std::size(all_hosts));
    double mean[hosts][tiles * tiles] = {}, square[hosts][tiles * tiles] = {};
    for (const Host host : all_hosts)
    {
        const int h = static_cast<int>(host);
        for (int run = 0; run < runs; ++run)
        {
            s.world.seed = std::uint32_t(1 + run + runs * h);
            const auto row = integrator(host, s.world, ColorD(0.9, 0.6, 0.3));
            Film film(Spheres::width, Spheres::height);
            ASSERT_TRUE(render({{{&row->get(), &film}}, 32}));
            EXPECT_EQ(film.non_finite(), 0u);
            double tile[tiles * tiles] = {};
            for (int y = 0; y < Spheres::height; ++y)
                for (int x = 0; x < Spheres::width; ++x)
                    tile[y / tile_height * tiles + x / tile_width] +=
                        double(film.mean(x, y).y) / (tile_width * tile_height);
            for (int t = 0; t < tiles * tiles; ++t)
            {
                mean[h][t] += tile[t] / runs;
                square[h][t] += tile[t] * tile[t] / runs;
            }
        }
    }
    // Each two hosts within 3 standard errors, which of 64 tiles one in six runs of this test would
    // pass; the seeds are fixed.
    double largest_error = 0;
    for (int t = 0; t < tiles * tiles; ++t)
        for (int h = 0; h < hosts; ++h)
            for (int g = 0; g < h; ++g)
            {
                double variance = 1e-12;
                for (const int i : {g, h})
                    variance += (square[i][t] - mean[i][t] * mean[i][t]) / (runs - 1);
                EXPECT_LT(std::abs(mean[g][t] - mean[h][t]), 3 * std::sqrt(variance))
                    << "tile " << t % tiles << ", " << t / tiles << " of " << name(all_hosts[g])
                    << " and " << name(all_hosts[h]) << ": " << mean[g][t] << " and " << mean[h][t];
                largest_error = std::max(largest_error, std::sqrt(variance) / mean[g][t]);
            }
    EXPECT_LT(largest_error, 0.03);
}

TEST(MixedScene, white_it_disappears_in_a_furnace)
{
    Spheres s{Environment(constant_image(1.0f))};
    s.world.max_bounces = 1000;
    for (const Host host : all_hosts)
    {
        const auto row = integrator(host, s.world, ColorD(1.0));
        Film film(Spheres::width, Spheres::height);
        ASSERT_TRUE(render({{{&row->get(), &film}}, 64}));
        EXPECT_EQ(film.non_finite(), 0u);
        EXPECT_NEAR(doubles::mean(film).y, 1.0f, 5e-3f) << name(host);
    }
}

}}  // namespace regain::tools::preview
