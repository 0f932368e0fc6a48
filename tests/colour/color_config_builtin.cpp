// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "temporary.h"

#include <regain/shaders/color_config.h>
#include <regain/shaders/white_adaptation.h>

#include <algorithm>
#include <thread>

using namespace regain::shaders;
using Imath::C3f;
using test::message_of;
using test::says;

namespace {

bool contains(const std::vector<std::string>& list, const std::string& what)
{
    return std::find(list.begin(), list.end(), what) != list.end();
}

}  // namespace

TEST(ColorConfigBuiltin, is_valid)
{
    EXPECT_NO_THROW(ColorConfig::builtin().validate());
    EXPECT_EQ(ColorConfig::builtin().name(), "regain-builtin");
    EXPECT_EQ(ColorConfig::builtin().scene_linear(), "ACEScg");
}

TEST(ColorConfigBuiltin, survives_its_own_text)
{
    const test::TemporaryFolder folder;
    const auto file = folder.write("config.ocio", ColorConfig::builtin().text());
    const auto read = ColorConfig::from_file(file);
    EXPECT_NO_THROW(read.validate());
    EXPECT_EQ(read.views(), ColorConfig::builtin().views());
    const C3f color(0.9f, 0.5f, 0.1f);
    EXPECT_EQ(read.display_transform("", "")(color),
              ColorConfig::builtin().display_transform("", "")(color));
}

TEST(ColorConfigBuiltin, knows_the_usual_spaces_and_roles)
{
    const auto config = ColorConfig::builtin();
    for (const char* name :
         {"ACES2065-1", "ACEScg", "acescg", "lin_ap1", "lin_rec709", "srgb_texture", "g22_rec709",
          "Raw", "scene_linear", "aces_interchange", "cie_xyz_d65_interchange", "default", "data",
          "color_picking", "texture_paint", "rendering", "compositing_log"})
        EXPECT_TRUE(config.has_color_space(name)) << name;
    EXPECT_FALSE(config.has_color_space("no such space"));
}

TEST(ColorConfigBuiltin, white_and_primaries_are_known_values)
{
    const auto config = ColorConfig::builtin();
    test::expect_near(config.to_scene_linear_from_xyz_d65(d65_white()), C3d(1.0), 1e-6);
    // XYZ of Rec.709's red (IEC 61966-2-1); ACEScg of it: OpenColorIO's ACES configs.
    const C3d red = config.to_scene_linear_from_xyz_d65(C3d(0.4123908, 0.2126390, 0.0193308));
    test::expect_near(red, C3d(0.613097, 0.070194, 0.020616), 2e-5);
    test::expect_near(config.convert("scene_linear", "lin_rec709")(C3f(red)), C3d(1, 0, 0), 1e-4);
}

TEST(ColorConfigBuiltin, textures_follow_the_srgb_curve)
{
    const auto to_linear = ColorConfig::builtin().convert("srgb_texture", "lin_rec709");
    // IEC 61966-2-1: ((0.5 + 0.055) / 1.055)^2.4 and 0.04 / 12.92.
    test::expect_near(to_linear(C3f(0.5f)), C3f(0.2140411f), 1e-5);
    test::expect_near(to_linear(C3f(0.04f)), C3f(0.0030960f), 1e-6);
}

TEST(ColorConfigBuiltin, views_of_srgb)
{
    const auto config = ColorConfig::builtin();
    EXPECT_EQ(config.displays(), std::vector<std::string>{"sRGB"});
    EXPECT_EQ(config.default_view(), "ACES 1.0 - SDR Video");
    EXPECT_EQ(config.views(),
              (std::vector<std::string>{"ACES 1.0 - SDR Video", "Un-tone-mapped", "raw"}));

    // Un-tone-mapped is the sRGB curve and no more: mid-grey 0.18 is 0.4614 (IEC 61966-2-1).
    test::expect_near(config.display_transform("", "Un-tone-mapped")(C3f(0.18f)), C3f(0.461356f),
                      1e-4);
    // The ACES 1 output transform puts mid-grey near a tenth of white: 0.105 by the sRGB curve.
    test::expect_near(config.display_transform("sRGB", "")(C3f(0.18f)), C3f(0.356f), 2e-3);
}

TEST(ColorConfigBuiltin, raw_is_bit_exact)
{
    const auto config = ColorConfig::builtin();
    const C3f color(-0.1f, 0.3f, 70000.0f);
    for (const char* raw : {"raw", "Raw", "RAW"})
    {
        const auto transform = config.display_transform("", raw);
        EXPECT_TRUE(transform.is_identity());
        EXPECT_EQ(transform(color), color);
    }
    EXPECT_EQ(config.convert("data", "scene_linear")(color), color);
}

TEST(ColorConfigBuiltin, unknown_names_list_the_known)
{
    const auto config = ColorConfig::builtin();
    const auto display = message_of([&] { config.display_transform("P3", ""); });
    EXPECT_TRUE(says(display, "'P3'") && says(display, "sRGB")) << display;
    const auto view = message_of([&] { config.display_transform("", "Filmic"); });
    EXPECT_TRUE(says(view, "'Filmic'") && says(view, "Un-tone-mapped") && says(view, "raw"))
        << view;
    const auto space = message_of([&] { config.convert("Rec.2020", "scene_linear"); });
    EXPECT_TRUE(says(space, "'Rec.2020'") && says(space, "ACEScg")) << space;
    EXPECT_TRUE(contains(config.color_spaces(), "ACEScg"));
}

TEST(ColorConfigBuiltin, packed_pixels_equal_single_ones)
{
    const auto transform = ColorConfig::builtin().display_transform("", "");
    std::vector<C3f> pixels;
    // More than are converted in one piece.
    for (int i = 0; i < 70000; ++i) pixels.emplace_back(i * 1e-5f, i * 2e-5f, i * 5e-6f);
    auto all = pixels;
    transform.apply(all);
    for (std::size_t i = 0; i < pixels.size(); i += 373)
        EXPECT_EQ(all[i], transform(pixels[i])) << i;
    transform.apply(nullptr, 0);
}

TEST(ColorConfigBuiltin, threads_agree)
{
    const C3f color(0.7f, 0.4f, 0.2f);
    const C3f expected = ColorConfig::builtin().display_transform("", "")(color);
    C3f results[4];
    std::vector<std::thread> threads;
    for (C3f& result : results)
        threads.emplace_back(
            [&result, color] { result = ColorConfig::builtin().display_transform("", "")(color); });
    for (auto& thread : threads) thread.join();
    for (const C3f& result : results) EXPECT_EQ(result, expected);
}
