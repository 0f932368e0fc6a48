// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "configs.h"
#include "temporary.h"

#include <regain/closures/conductor_fresnel.h>
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
        // What a curve of Schlick's with one more number leaves; most are below 0.012.
        EXPECT_LT(metal.fit_error, 0.022) << name;
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
        EXPECT_NEAR(std::sqrt(std::max({square.x, square.y, square.z})), metal.fit_error,
                    2e-5 + 0.015 * metal.fit_error)
            << name;
    }
}

// Per channel an index does better than F0 and F82.
TEST(MetalFit, indices_have_the_colour_s_curve)
{
    const auto config = ColorConfig::builtin();
    for (const std::string& name : metal_names())
    {
        const MetalIndex index = metal_index(name, config);
        EXPECT_LT(index.fit_error, 1.2e-3) << name;
        const regain::ConductorFresnel<double> fresnel(index.n, index.k);
        const C3d F0 = metal_color(name, config).F0;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(fresnel.at(1.0)[c], F0[c], 1e-6) << name;
        for (const double mu : {0.05, 0.2, 0.4, 0.7})
        {
            const C3d color = metal_reflectance(name, mu, config);
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(fresnel.at(mu)[c], color[c], 6e-3) << name;
        }
    }
    EXPECT_THROW(metal_index("mithril", config), std::invalid_argument);
}

// What is below 1 stays; of what is above, the largest channel is 1 and none is negative.
TEST(MetalFit, colours_are_limited_to_what_the_space_has)
{
    const C3d inside(0.9, 0.1, 0.0);
    EXPECT_EQ(limited_to_unit(inside), inside);
    const C3d gold = limited_to_unit(C3d(1.038, 0.728, 0.364));
    EXPECT_EQ(gold.x, 1.0);
    EXPECT_NEAR(gold.y, 0.728 * std::pow(1.038, -0.75), 1e-12);
    EXPECT_EQ(limited_to_unit(C3d(-0.2, 0.5, std::nan(""))), C3d(0.0, 0.5, 0.0));
    const C3d huge = limited_to_unit(C3d(HUGE_VAL, 1.0, 0.0));
    for (int c = 0; c < 3; ++c) EXPECT_TRUE(huge[c] >= 0 && huge[c] <= 1);
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
    EXPECT_TRUE(metal_index("gold", rec709).out_of_gamut);
    EXPECT_FALSE(metal_index("gold", ColorConfig::builtin()).out_of_gamut);
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
