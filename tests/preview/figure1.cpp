// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// What Figure 1 of Turquin 2019 shows: without compensation rough gold darkens; with it the
// brightness stays, and the gold grows more saturated. In both hosts, whose pictures agree within
// noise.

#include "doubles.h"
#include "preview/row.h"

#include <gtest/gtest.h>

namespace regain::tools::preview { namespace {

using namespace doubles;
using Imath::V3d;

constexpr int kWidgets = 4, kWidth = 192, kHeight = 56;
const float kAlphas[kWidgets] = {0.1f, 0.4f, 0.7f, 1.0f};

/// Mean colour of each widget's part of a row.
struct Columns
{
    V3d color[kWidgets] = {V3d(0.0), V3d(0.0), V3d(0.0), V3d(0.0)};
    double brightness(int i) const
    {
        return 0.2126 * color[i].x + 0.7152 * color[i].y + 0.0722 * color[i].z;
    }
    double saturation(int i) const { return 1.0 - color[i].z / color[i].x; }
};

Columns render_row(Host host, Method method)
{
    const RowScene scene(kWidgets);
    const Environment studio(make_studio());
    const Camera camera = scene.camera(static_cast<float>(kWidth) / kHeight);
    const World world{scene.scene(), studio, camera, kWidth, kHeight};

    // About ACEScg's gold.
    std::vector<shaders::MicrofacetMaterial> materials{floor_material()};
    for (const float alpha : kAlphas)
        materials.emplace_back(
            shaders::SchlickMetal{C3f(0.95f, 0.78f, 0.4f), C3f(1.0f), alpha, alpha, method});
    const RowIntegrator integrator(host, world, materials);
    Film film(kWidth, kHeight);
    EXPECT_TRUE(render({{{&integrator.get(), &film}}, 32}));
    EXPECT_EQ(film.non_finite(), 0u);

    Columns columns;
    for (int i = 0; i < kWidgets; ++i)
    {
        double pixels = 0.0;
        for (int y = kHeight / 6; y < kHeight * 5 / 6; ++y)
            for (int x = kWidth / kWidgets * i + 15; x < kWidth / kWidgets * (i + 1) - 15; ++x)
            {
                const C3f c = film.mean(x, y);
                columns.color[i] += V3d(c.x, c.y, c.z);
                ++pixels;
            }
        columns.color[i] /= pixels;
    }
    return columns;
}

class Figure1 : public testing::TestWithParam<Host>
{};

TEST_P(Figure1, WithoutCompensationRoughGoldDarkens)
{
    const Columns row = render_row(GetParam(), Method::none);
    EXPECT_LT(row.brightness(3), 0.8 * row.brightness(1));
    EXPECT_LT(row.brightness(2), row.brightness(1));
    EXPECT_LT(row.brightness(3), row.brightness(2));
}

TEST_P(Figure1, WithCompensationItStaysBrightAndSaturates)
{
    const Columns none = render_row(GetParam(), Method::none);
    const Columns row = render_row(GetParam(), Method::turquin);
    EXPECT_GT(row.brightness(3), 0.9 * row.brightness(1));
    for (int i = 1; i < kWidgets; ++i)
    {
        EXPECT_GT(row.brightness(i), none.brightness(i));
        EXPECT_GT(row.saturation(i), none.saturation(i));
    }
    EXPECT_GT(row.saturation(3) - none.saturation(3), row.saturation(1) - none.saturation(1));
}

INSTANTIATE_TEST_SUITE_P(Hosts, Figure1, testing::ValuesIn(all_hosts),
                         [](const auto& host) { return std::string(name(host.param)); });

}}  // namespace regain::tools::preview
