// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// A white Lambert world under a light of 1 everywhere is 1 wherever one looks, through either host:
// next-event estimation, weighting, lobe mixing, roulette and self-intersection all have to be
// right.

#include "doubles.h"

#include <gtest/gtest.h>

namespace regain::tools::preview { namespace {

using namespace doubles;

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
    const SphereWorld w(constant_image(1.0f), 24);
    GridLambert white(C3f(1.0f));
    expect_one_everywhere(GridIntegrator(w.world, {{&white, nullptr}}));
}

TEST(WhiteFurnace, PointHostSphere)
{
    const SphereWorld w(constant_image(1.0f), 24);
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

/// A light that is not the same everywhere, against quadrature: what an even light cannot show is
/// whether direction, density and radiance of a light sample belong together.
TEST(WhiteFurnace, FloorUnderTheStudioIsItsIrradiance)
{
    Scene scene;
    scene.place(scene.add_mesh(make_floor(50.0f)), V3f(0.0f), 0);
    scene.commit();
    const Environment studio(make_studio());
    const Camera camera(V3f(0, 5, 1), V3f(0.0f), 1.0f, 1.0f);
    const World world{scene, studio, camera, 8, 8};

    C3f expected(0.0f);
    constexpr int kRows = 512, kColumns = 2048;
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column)
        {
            const float v = (static_cast<float>(row) + 0.5f) / (2 * kRows);
            const V3f d = latlong_direction((static_cast<float>(column) + 0.5f) / kColumns, v);
            const float sine = std::sqrt(1.0f - d.y * d.y), pi = static_cast<float>(M_PI);
            expected += studio.at(d).radiance *
                        (d.y * sine * kInvPi * pi / (2 * kRows) * 2.0f * pi / kColumns);
        }

    GridLambert grid_white(C3f(1.0f));
    const C3f white(1.0f);
    const auto callbacks = PointLambert::callbacks<2>();
    const GridIntegrator grid(world, {{&grid_white, nullptr}});
    const PointIntegrator point(world, {{&callbacks, &white}});
    for (const Integrator* integrator :
         {static_cast<const Integrator*>(&grid), static_cast<const Integrator*>(&point)})
    {
        Film film(8, 8);
        ASSERT_TRUE(render({{{integrator, &film}}, 1024, 1}));
        const C3f average = mean(film);
        for (unsigned k = 0; k < 3; ++k) EXPECT_NEAR(average[k] / expected[k], 1.0f, 3e-3f);
    }
}

}}  // namespace regain::tools::preview
