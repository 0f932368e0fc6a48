// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "configs.h"
#include "temporary.h"

#include <regain/shaders/metals.h>

using namespace regain::shaders;
using test::message_of;
using test::says;

TEST(ColorConfigInterchange, both_roles_lead_to_the_same_colour)
{
    const test::TemporaryFolder folder;
    const auto config = ColorConfig::from_file(folder.write("c.ocio", test::without_aces_role()));
    ASSERT_FALSE(config.has_color_space("aces_interchange"));
    for (const C3d& xyz : {C3d(0.95, 1.0, 1.09), C3d(0.4, 0.2, 0.02), C3d(0.1, 0.3, 0.8)})
        test::expect_near(config.to_scene_linear_from_xyz_d65(xyz),
                          ColorConfig::builtin().to_scene_linear_from_xyz_d65(xyz), 2e-6);
}

TEST(ColorConfigInterchange, old_configs_go_by_the_name_of_aces)
{
    const test::TemporaryFolder folder;
    const auto config = ColorConfig::from_file(folder.write("old.ocio", test::version_1));
    const auto today =
        ColorConfig::from_file(folder.write("c.ocio", test::working_in("lin_rec709")));
    const C3d xyz(0.4, 0.3, 0.1);
    // Its matrix has four digits.
    test::expect_near(config.to_scene_linear_from_xyz_d65(xyz),
                      today.to_scene_linear_from_xyz_d65(xyz), 1e-3);
}

TEST(ColorConfigInterchange, tone_curve_on_the_way_is_refused)
{
    const test::TemporaryFolder folder;
    const auto text =
        test::replaced(test::without_aces_role(), "default_view_transform: Un-tone-mapped",
                       "default_view_transform: ACES 1.0 - SDR Video");
    // Another name, so that it is not found by it.
    auto renamed = text;
    for (std::size_t at; (at = renamed.find("lin_ap0")) != std::string::npos;)
        renamed.replace(at, 7, "ap0");
    for (std::size_t at = 0; (at = renamed.find("name: ACES2065-1\n", at)) != std::string::npos;)
        renamed.replace(at, 16, "name: reference");

    const auto config = ColorConfig::from_file(folder.write("c.ocio", renamed));
    const auto message = message_of([&] { config.to_scene_linear_from_xyz_d65(C3d(1.0)); });
    EXPECT_TRUE(says(message, "'cie_xyz_d65_interchange' is not linearly related")) << message;
    EXPECT_TRUE(says(message, "Add the role aces_interchange")) << message;
}

TEST(ColorConfigInterchange, no_way_from_xyz_says_which_role_to_add)
{
    const test::TemporaryFolder folder;
    const auto config = ColorConfig::from_file(folder.write("old.ocio", test::without_a_way()));
    const auto message = message_of([&] { metal_color("gold", config); });
    EXPECT_TRUE(says(message, "aces_interchange")) << message;
    EXPECT_TRUE(says(message, "cie_xyz_d65_interchange")) << message;
    // What needs no XYZ still works.
    EXPECT_NO_THROW(config.display_transform("", ""));
}
