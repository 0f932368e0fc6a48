// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "configs.h"
#include "temporary.h"

#include <regain/closures/schlick_fresnel.h>
#include <regain/shaders/metals.h>

#include <cmath>

using namespace regain::shaders;

namespace {

// The cosine-weighted mean square difference, by midpoints in mu.
C3d square_error(const std::string& name, const C3d& F0, const C3d& F82, const ColorConfig& config)
{
    const regain::SchlickFresnel<double> fitted(F0, F82);
    constexpr int n = 200;
    C3d sum(0.0);
    for (int i = 0; i < n; ++i)
    {
        const double mu = (i + 0.5) / n;
        const C3d d = fitted.at(mu) - metal_reflectance(name, mu, config);
        sum += d * d * (2 * mu / n);
    }
    return sum;
}

}  // namespace

TEST(MetalFit, error_is_small_in_the_working_space)
{
    for (const std::string& name : metal_names())
    {
        const MetalColor metal = metal_color(name, ColorConfig::builtin());
        EXPECT_LT(metal.fit_error, 0.012) << name;
        EXPECT_FALSE(metal.out_of_gamut) << name;
    }
}

TEST(MetalFit, error_is_what_it_says)
{
    const auto config = ColorConfig::builtin();
    for (const std::string& name : metal_names())
    {
        const MetalColor metal = metal_color(name, config);
        const C3d square = square_error(name, metal.F0, metal.F82, config);
        EXPECT_NEAR(std::sqrt(std::max({square.x, square.y, square.z})), metal.fit_error, 2e-5)
            << name;
    }
}

TEST(MetalFit, no_other_f82_is_better)
{
    const auto config = ColorConfig::builtin();
    for (const std::string& name : metal_names())
    {
        const MetalColor metal = metal_color(name, config);
        const C3d best = square_error(name, metal.F0, metal.F82, config);
        for (const double step : {-0.02, 0.02})
        {
            C3d moved;
            for (int c = 0; c < 3; ++c) moved[c] = std::clamp(metal.F82[c] + step, 0.0, 1.0);
            const C3d other = square_error(name, metal.F0, moved, config);
            for (int c = 0; c < 3; ++c) EXPECT_GE(other[c], best[c] - 1e-9) << name << ' ' << c;
        }
    }
}

TEST(MetalFit, f0_is_the_colour_at_normal_incidence)
{
    const auto config = ColorConfig::builtin();
    for (const std::string& name : metal_names())
        EXPECT_EQ(metal_color(name, config).F0, metal_reflectance(name, 1.0, config)) << name;
}

TEST(MetalFit, clamping_is_told)
{
    // Gold's red is outside Rec.709, inside ACEScg.
    const test::TemporaryFolder folder;
    const auto rec709 =
        ColorConfig::from_file(folder.write("c.ocio", test::working_in("lin_rec709")));
    const MetalColor gold = metal_color("gold", rec709);
    EXPECT_TRUE(gold.out_of_gamut);
    EXPECT_EQ(gold.F0.x, 1.0);
    EXPECT_GT(metal_reflectance("gold", 1.0, rec709).x, 1.0);

    // The blue of gold and brass rises faster towards grazing than any F82 in [0, 1] lets it.
    EXPECT_TRUE(metal_color("gold", ColorConfig::builtin()).F82_limited);
    EXPECT_FALSE(metal_color("copper", ColorConfig::builtin()).F82_limited);
    for (const std::string& name : metal_names())
        for (const auto& config : {ColorConfig::builtin(), rec709})
        {
            const MetalColor metal = metal_color(name, config);
            for (int c = 0; c < 3; ++c)
            {
                EXPECT_TRUE(metal.F0[c] >= 0 && metal.F0[c] <= 1) << name;
                EXPECT_TRUE(metal.F82[c] >= 0 && metal.F82[c] <= 1) << name;
            }
        }
}
