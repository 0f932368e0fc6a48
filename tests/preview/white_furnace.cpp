// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// A white Lambert world under a light of 1 everywhere is 1 wherever one looks, through either host:
// next-event estimation, weighting, lobe mixing, roulette and self-intersection all have to be
// right.

#include "doubles.h"

#include <gtest/gtest.h>

namespace regain::tools::preview { namespace {

using namespace doubles;

/// A convex body alone: every path ends in the light after one bounce.
struct SphereWorld
{
    SphereWorld()
    {
        Mesh sphere;
        add_sphere(sphere, V3f(0.0f), 1.0f, 256);
        scene.place(scene.add_mesh(std::move(sphere)), V3f(0.0f), 0);
        scene.commit();
    }
    Scene scene;
    Environment environment{constant_image(1.0f)};
    Camera camera{V3f(0, 0, 10), V3f(0.0f), 1.1f, 1.1f};
    World world{scene, environment, camera, 24, 24};
};

void expect_one_everywhere(const Integrator& integrator)
{
    Film film(24, 24);
    ASSERT_TRUE(render({{{&integrator, &film}}, 256, 1}));
    EXPECT_EQ(film.non_finite(), 0u);
    const C3f average = mean(film);
    for (unsigned k = 0; k < 3; ++k) EXPECT_NEAR(average[k], 1.0f, 1e-3f);
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x) EXPECT_NEAR(film.mean(x, y).y, 1.0f, 0.03f) << x << ' ' << y;
}

TEST(WhiteFurnace, GridHostSphere)
{
    const SphereWorld w;
    GridLambert white(C3f(1.0f));
    expect_one_everywhere(GridIntegrator(w.world, {{&white, nullptr}}));
}

TEST(WhiteFurnace, PointHostSphere)
{
    const SphereWorld w;
    const C3f white(1.0f);
    const auto one = PointLambert::callbacks<1>(), three = PointLambert::callbacks<3>();
    expect_one_everywhere(PointIntegrator(w.world, {{&one, &white}}));
    expect_one_everywhere(PointIntegrator(w.world, {{&three, &white}}));
}

/// With interreflection: albedo 1 never ends a path by itself, so what is missing is what the
/// bounce limit cuts. With a generous limit next to nothing is.
TEST(WhiteFurnace, WidgetOnFloor)
{
    WidgetWorld w(constant_image(1.0f), 24, 24);
    w.world.max_bounces = 2000;
    TwoLamberts white(C3f(1.0f), C3f(1.0f));
    for (const auto& integrator : {white.grid(w.world), white.point(w.world)})
    {
        Film film(24, 24);
        ASSERT_TRUE(render({{{integrator.get(), &film}}, 64, 1}));
        EXPECT_NEAR(mean(film).y, 1.0f, 4e-3f);
        EXPECT_EQ(film.non_finite(), 0u);
    }
}

}}  // namespace regain::tools::preview
