// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "configs.h"
#include "temporary.h"

#include <regain/shaders/metals.h>

#include <cmath>
#include <limits>

using namespace regain::shaders;
using test::message_of;
using test::says;

namespace {

ColorConfig rec709()
{
    const test::TemporaryFolder folder;
    return ColorConfig::from_file(folder.write("c.ocio", test::working_in("lin_rec709")));
}

}  // namespace

TEST(MetalTints, agree_with_a_separate_computation)
{
    // From the same tables, by a separate program in double that uses the real-valued form of the
    // Fresnel equations and derives the matrices from the primaries, without OpenColorIO.
    struct
    {
        const char* name;
        double mu;
        C3d acescg, rec709;
    } const expected[] = {
        {"aluminium", 1.0, {0.91094, 0.91534, 0.92131}, {0.90733, 0.91586, 0.92233}},
        {"aluminium", 0.5, {0.89482, 0.90032, 0.90841}, {0.89026, 0.90095, 0.90978}},
        {"brass", 1.0, {0.84199, 0.78269, 0.47183}, {0.90969, 0.77824, 0.42286}},
        {"brass", 0.5, {0.83365, 0.77913, 0.50635}, {0.89481, 0.77490, 0.46331}},
        {"copper", 1.0, {0.80740, 0.64310, 0.54176}, {0.93167, 0.62276, 0.52231}},
        {"copper", 0.5, {0.80237, 0.64294, 0.55069}, {0.92245, 0.62315, 0.53275}},
        {"gold", 1.0, {0.90067, 0.74508, 0.41839}, {1.03757, 0.72826, 0.36468}},
        {"gold", 0.5, {0.89494, 0.75317, 0.45069}, {1.02008, 0.73789, 0.40102}},
        {"silver", 1.0, {0.98698, 0.98425, 0.97873}, {0.98936, 0.98395, 0.97782}},
        {"silver", 0.5, {0.98523, 0.98238, 0.97780}, {0.98763, 0.98205, 0.97703}},
    };
    const auto linear709 = rec709();
    for (const auto& e : expected)
    {
        SCOPED_TRACE(e.name);
        test::expect_near(metal_reflectance(e.name, e.mu, ColorConfig::builtin()), e.acescg, 3e-5);
        test::expect_near(metal_reflectance(e.name, e.mu, linear709), e.rec709, 3e-5);
    }
}

TEST(MetalTints, agree_with_published_figures)
{
    const auto linear709 = rec709();
    // Hoffman, "Physics and Math of Shading", SIGGRAPH 2013 course Physically Based Shading in
    // Theory and Practice: gold, linear sRGB, red out of gamut. Measurements of gold differ among
    // themselves by that much (physicallybased.info, from another one: 1.059, 0.773, 0.307).
    test::expect_near(metal_reflectance("gold", 1.0, linear709), C3d(1.022, 0.782, 0.344), 0.06);
    // Unity's Metal Reflectance node, linear sRGB.
    test::expect_near(metal_reflectance("aluminium", 1.0, linear709), C3d(0.913, 0.921, 0.925),
                      0.01);
    test::expect_near(metal_reflectance("copper", 1.0, linear709), C3d(0.955, 0.637, 0.538), 0.03);
}

TEST(MetalTints, silver_is_near_neutral)
{
    const C3d F0 = metal_color("silver", ColorConfig::builtin()).F0;
    EXPECT_LT(F0.x - F0.z, 0.01);
    EXPECT_GT(F0.z, 0.97);
}

TEST(MetalTints, grazing_mirror_is_white_in_every_config)
{
    // Every metal reflects everything at grazing incidence, so there it is the perfect reflector.
    // In the last of these spaces, XYZ, the D65 white is far from (1, 1, 1).
    const test::TemporaryFolder folder;
    for (const std::string& text :
         {test::working_in("ACEScg"), test::working_in("lin_rec709"), test::without_aces_role(),
          std::string(test::version_1), test::working_in("CIE-XYZ-D65")})
    {
        const auto config = ColorConfig::from_file(folder.write("c.ocio", text));
        for (const std::string& metal : metal_names())
        {
            SCOPED_TRACE(metal + " in " + config.scene_linear());
            test::expect_near(metal_reflectance(metal, 0.0, config), C3d(1.0), 1e-4);
        }
    }
}

TEST(MetalTints, names_in_any_case_and_by_symbol)
{
    const auto config = ColorConfig::builtin();
    const std::pair<const char*, const char*> same[] = {
        {"aluminium", "aluminum"}, {"aluminium", "Al"}, {"gold", "Gold"}, {"gold", "au"},
        {"silver", "AG"},          {"copper", "Cu"}};
    for (const auto& [a, b] : same)
        EXPECT_EQ(metal_color(a, config).F0, metal_color(b, config).F0) << b;
    EXPECT_EQ(metal_names().size(), 30u);
    EXPECT_TRUE(says(metal_source("gold"), "Johnson"));
}

TEST(MetalTints, unknown_metal_lists_the_known)
{
    const auto message = message_of([] { metal_color("mithril", ColorConfig::builtin()); });
    EXPECT_TRUE(says(message, "'mithril'") && says(message, "brass")) << message;
    EXPECT_THROW(metal_reflectance("", 1.0, 500.0), std::invalid_argument);
}

TEST(MetalTints, wavelengths_clamp_and_interpolate)
{
    // Johnson and Christy's gold at 380 nm, n = 1.46221, k = 1.92881:
    // ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2).
    const double n = 1.46221, k = 1.92881;
    const double F = ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k);
    EXPECT_NEAR(metal_reflectance("gold", 1.0, 380.0), F, 1e-12);
    EXPECT_EQ(metal_reflectance("gold", 1.0, 100.0), metal_reflectance("gold", 1.0, 380.0));
    EXPECT_EQ(metal_reflectance("gold", 1.0, 2000.0), metal_reflectance("gold", 1.0, 780.0));
    const double a = metal_reflectance("gold", 1.0, 500.0);
    const double b = metal_reflectance("gold", 1.0, 505.0);
    const double between = metal_reflectance("gold", 1.0, 502.0);
    EXPECT_TRUE(between > std::min(a, b) && between < std::max(a, b));
}

TEST(MetalTints, bad_cosines)
{
    const auto config = ColorConfig::builtin();
    EXPECT_EQ(metal_reflectance("gold", 2.0, config), metal_reflectance("gold", 1.0, config));
    EXPECT_EQ(metal_reflectance("gold", -1.0, config), metal_reflectance("gold", 0.0, config));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(metal_reflectance("gold", nan, config), std::invalid_argument);
    EXPECT_THROW(metal_reflectance("gold", 1.0, nan), std::invalid_argument);
}
