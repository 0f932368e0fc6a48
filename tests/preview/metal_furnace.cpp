// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The project's own metals through both adapters, in the renderer: a white compensated metal under
// a light of 1 everywhere is 1, a mirror too, and an uncompensated rough one is darker.

#include "doubles.h"
#include "preview/row.h"

#include <gtest/gtest.h>

namespace regain::tools::preview { namespace {

using namespace doubles;

double furnace(Host host, float alpha, Method method)
{
    const SphereWorld w(constant_image(1.0f), 16);
    const RowIntegrator integrator(
        host, w.world, {shaders::SchlickMetal{C3f(1.0f), C3f(1.0f), alpha, alpha, method}});
    Film film(16, 16);
    EXPECT_TRUE(render({{{&integrator.get(), &film}}, 256, 1}));
    EXPECT_EQ(film.non_finite(), 0u);
    // The middle, where every ray meets the sphere.
    double sum = 0.0;
    for (int y = 5; y < 11; ++y)
        for (int x = 5; x < 11; ++x) sum += film.mean(x, y).y / 36.0;
    return sum;
}

class MetalFurnace : public testing::TestWithParam<Host>
{};

TEST_P(MetalFurnace, CompensatedIsOne)
{
    for (const float alpha : {0.0f, 0.05f, 0.3f, 0.6f, 1.0f})
        EXPECT_NEAR(furnace(GetParam(), alpha, Method::turquin), 1.0, 5e-3) << alpha;
}

TEST_P(MetalFurnace, UncompensatedDarkensWithRoughness)
{
    double former = 1.001;
    for (const float alpha : {0.0f, 0.3f, 0.6f, 1.0f})
    {
        const double value = furnace(GetParam(), alpha, Method::none);
        EXPECT_LT(value, former) << alpha;
        former = value;
    }
    EXPECT_LT(former, 0.6);
}

INSTANTIATE_TEST_SUITE_P(Hosts, MetalFurnace, testing::ValuesIn(all_hosts),
                         [](const auto& host) { return std::string(name(host.param)); });

}}  // namespace regain::tools::preview
