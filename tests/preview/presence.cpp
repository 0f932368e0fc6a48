// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Surfaces that are there in part, through both hosts: light goes by the rest, from lights as from
// the camera, and loses nothing.

#include "doubles.h"
#include "preview/bound_material.h"
#include "preview/row.h"

#include <gtest/gtest.h>

namespace regain::tools::preview { namespace {

using namespace doubles;
using shaders::ClosureTree;
using shaders::ColorD;
using shaders::PlainMaterial;

ClosureTree diffuse(double color, double presence)
{
    ClosureTree tree(PlainMaterial{shaders::OrenNayarSurface{ColorD(color), 0.0, true}});
    tree.set_presence(presence);
    return tree;
}

std::unique_ptr<RowIntegrator> integrator(Host host, const World& world,
                                          const std::vector<ClosureTree>& materials)
{
    std::vector<std::unique_ptr<BoundMaterial>> bound;
    for (const ClosureTree& tree : materials) bound.push_back(bind(tree));
    return std::make_unique<RowIntegrator>(host, world, std::move(bound));
}

// Outside and in: what goes by the near side may meet the far one many times.
TEST(Presence, a_white_sphere_that_is_half_there_disappears_in_a_furnace)
{
    SphereWorld w(constant_image(1.0f), 16);
    w.world.max_bounces = 1000;
    for (const Host host : all_hosts)
        for (const double presence : {0.5, 0.1})
        {
            const auto row = integrator(host, w.world, {diffuse(1, presence)});
            Film film(16, 16);
            ASSERT_TRUE(render({{{&row->get(), &film}}, 64, 1}));
            EXPECT_EQ(film.non_finite(), 0u);
            EXPECT_NEAR(mean(film).y, 1.0f, 4e-3f) << name(host);
        }
}

// To go by a surface is no bounce.
TEST(Presence, a_sphere_that_is_not_there_costs_no_bounce)
{
    SphereWorld w(constant_image(1.0f), 8);
    w.world.max_bounces = 1;
    for (const Host host : all_hosts)
    {
        const auto row = integrator(host, w.world, {diffuse(0, 0)});
        Film film(8, 8);
        ASSERT_TRUE(render({{{&row->get(), &film}}, 16, 1}));
        EXPECT_FLOAT_EQ(mean(film).y, 1.0f) << name(host);
    }
}

// Black, it lets by what goes by its near and its far side.
TEST(Presence, a_black_sphere_lets_by_its_absence_squared)
{
    const SphereWorld w(constant_image(1.0f), 16);
    for (const Host host : all_hosts)
    {
        const auto row = integrator(host, w.world, {diffuse(0, 0.4)});
        Film film(16, 16);
        ASSERT_TRUE(render({{{&row->get(), &film}}, 256, 1}));
        EXPECT_NEAR(film.mean(8, 8).y, 0.36f, 0.1f);
        double centre = 0.0;
        for (int y = 6; y < 10; ++y)
            for (int x = 6; x < 10; ++x) centre += double(film.mean(x, y).y) / 16;
        EXPECT_NEAR(centre, 0.36, 0.02) << name(host);
    }
}

// A veil over a floor: found by rays to lights and by rays of the floor alike, it halves the light.
// With shadows of the whole veil, or of none, the weighting of the two would make another number.
TEST(Presence, a_veil_lets_by_its_share_of_the_light)
{
    const Environment studio(make_studio());
    const Camera camera(V3f(0, 0.8f, 1), V3f(0.0f), 1.0f, 1.0f);
    for (const Host host : all_hosts)
    {
        double light[2];
        for (const bool veiled : {false, true})
        {
            Scene scene;
            const int plane = scene.add_mesh(make_floor(50.0f));
            scene.place(plane, V3f(0.0f), 0);
            if (veiled) scene.place(plane, V3f(0.0f, 1.0f, 0.0f), 1);
            scene.commit();
            const World world{scene, studio, camera, 8, 8};
            const auto row = integrator(host, world, {diffuse(0.8, 1), diffuse(0, 0.5)});
            Film film(8, 8);
            ASSERT_TRUE(render({{{&row->get(), &film}}, 1024, 1}));
            light[veiled] = double(mean(film).y);
        }
        EXPECT_NEAR(light[1] / light[0], 0.5, 5e-3) << name(host);
    }
}

// Opacity of three colours, of a renderer's own material.
class Glaze final : public renderman::Factory
{
public:
    renderman::Bxdf* beginScatter(const renderman::ShadingContext* ctx,
                                  const renderman::LobeSet& wanted, renderman::ShadeMode mode,
                                  void* parent, void* data) override
    {
        return _black.beginScatter(ctx, wanted, mode, parent, data);
    }
    bool computesPresence(const void*) const override { return true; }
    renderman::Opacity* beginOpacity(const renderman::ShadingContext* ctx, renderman::ShadeMode,
                                     void*, void*) override
    {
        return new (ctx->alloc<Red>()) Red(ctx->numPts);
    }
    static C3f opacity() { return {0.0f, 0.5f, 1.0f}; }

private:
    class Red final : public renderman::Opacity
    {
    public:
        explicit Red(int n) : _n(n) {}
        bool presence(float*) const override { return false; }
        bool opacity(C3f* result) const override
        {
            for (int i = 0; i < _n; ++i) result[i] = Glaze::opacity();
            return true;
        }

    private:
        int _n;
    };
    GridLambert _black{C3f(0.0f)};
};

TEST(Presence, opacity_has_colour)
{
    const SphereWorld w(constant_image(1.0f), 8);
    Glaze glaze;
    const C3f black(0.0f);
    auto callbacks = PointLambert::callbacks<1>();
    callbacks.opacity = [](const void*, const clarisse::shading_point<float>&) {
        return Glaze::opacity();
    };
    const GridIntegrator grid(w.world, {{&glaze, nullptr}});
    const PointIntegrator point(w.world, {{&callbacks, &black}});
    for (const Integrator* integrator :
         {static_cast<const Integrator*>(&grid), static_cast<const Integrator*>(&point)})
    {
        Film film(8, 8);
        ASSERT_TRUE(render({{{integrator, &film}}, 1024, 1}));
        C3f centre(0.0f);
        for (int y = 3; y < 5; ++y)
            for (int x = 3; x < 5; ++x) centre += film.mean(x, y) * 0.25f;
        EXPECT_NEAR(centre.x, 1.0f, 0.05f);
        EXPECT_NEAR(centre.y, 0.25f, 0.025f);
        EXPECT_EQ(centre.z, 0.0f);
    }
}

}}  // namespace regain::tools::preview
