// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Glass through both adapters, in the renderer. Under a light of 1 everywhere a closed object that
// loses no energy is 1 wherever one looks: radiance gains the squared ratio of indices on the way
// in and loses it on the way out.

#include "doubles.h"
#include "preview/row.h"

#include <gtest/gtest.h>

namespace regain::tools::preview { namespace {

using namespace doubles;
using shaders::MicrofacetMaterial;

MicrofacetMaterial glass(double alpha, const shaders::Compensation& method, double eta = 1.5)
{
    MicrofacetMaterial material;
    shaders::InterfaceSurface surface;
    surface.eta = eta;
    material.surface = surface;
    material.alpha_x = material.alpha_y = alpha;
    material.method = method;
    return material;
}

struct Furnace
{
    double mean;
    float least, most;  // of blocks of 4 x 4 pixels
};

Furnace furnace(Host host, Object object, const MicrofacetMaterial& material, int samples = 48,
                int bounces = 64)
{
    constexpr int size = 24;
    const RowScene row(RowLayout{1, object, false, true});
    const Environment light(constant_image(1.0f));
    const Camera camera = row.camera(1.0f);
    World world{row.scene(), light, camera, size, size};
    world.max_bounces = bounces;
    const RowIntegrator integrator(host, world, {floor_material(), material});
    Film film(size, size);
    EXPECT_TRUE(render({{{&integrator.get(), &film}}, samples, 1}));
    EXPECT_EQ(film.non_finite(), 0u);
    Furnace f{double(mean(film).y), 1e9f, 0};
    for (int y = 0; y < size; y += 4)
        for (int x = 0; x < size; x += 4)
        {
            float block = 0;
            for (int k = 0; k < 16; ++k) block += film.mean(x + k % 4, y + k / 4).y / 16;
            f.least = std::min(f.least, block);
            f.most = std::max(f.most, block);
        }
    return f;
}

class Glass : public testing::TestWithParam<Host>
{};

TEST_P(Glass, SmoothGlassVanishesInAFurnace)
{
    for (const Object object : {Object::sphere, Object::nested, Object::widget})
        EXPECT_NEAR(furnace(GetParam(), object, glass(0, Method::none)).mean, 1, 0.01)
            << name(object);
}

TEST_P(Glass, NestedRoughSpheresVanishInAFurnace)
{
    for (const double alpha : {0.1, 0.6})
    {
        const Furnace f = furnace(GetParam(), Object::nested, glass(alpha, shaders::RandomWalk{}));
        EXPECT_NEAR(f.mean, 1, 0.02) << alpha;
        // Structure would be darker or brighter by more than single samples make a block.
        EXPECT_GT(f.least, 0.8f) << alpha;
        EXPECT_LT(f.most, 1.5f) << alpha;
    }
}

TEST_P(Glass, WithoutCompensationRoughGlassDarkens)
{
    const double smooth = furnace(GetParam(), Object::sphere, glass(0.1, Method::none)).mean;
    const double rough = furnace(GetParam(), Object::sphere, glass(1, Method::none)).mean;
    EXPECT_LT(rough, smooth - 0.1);
}

INSTANTIATE_TEST_SUITE_P(Hosts, Glass, testing::ValuesIn(all_hosts),
                         [](const auto& host) { return std::string(name(host.param)); });

// Through the batched host alone: to the other this is two lobes, whose albedos it asks a walk for.
TEST(GlassInRenderMan, AnObjectOfTheMediumAroundItIsNotSeen)
{
    const auto nothing = glass(0.5, shaders::RandomWalk{}, 1);
    EXPECT_NEAR(furnace(Host::renderman, Object::widget, nothing, 4).mean, 1, 1e-3);
}

}}  // namespace regain::tools::preview
