// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "configs.h"
#include "temporary.h"

#include <regain/shaders/metals.h>

using namespace regain::shaders;
using test::message_of;
using test::says;

TEST(ColorConfigEnvironment, unset_and_empty_mean_builtin)
{
    for (const auto& value : {std::optional<std::string>(), std::optional<std::string>("")})
    {
        const test::OcioVariable ocio(value);
        EXPECT_EQ(ColorConfig::active().name(), "regain-builtin");
    }
}

TEST(ColorConfigEnvironment, config_in_ocio_is_honoured)
{
    const test::TemporaryFolder folder;
    const auto file = folder.write("studio.ocio", test::working_in("lin_rec709"));
    const test::OcioVariable ocio(file.string());
    const auto studio = ColorConfig::active();
    EXPECT_EQ(studio.scene_linear(), "Linear Rec.709 (sRGB)");

    // The same metal in both working spaces is one colour.
    const auto to_rec709 = ColorConfig::builtin().convert("ACEScg", "lin_rec709");
    for (const std::string& metal : metal_names())
        for (const double mu : {1.0, 0.5, 0.1})
        {
            const C3d aces = metal_reflectance(metal, mu, ColorConfig::builtin());
            const C3d here = metal_reflectance(metal, mu, studio);
            SCOPED_TRACE(metal);
            test::expect_near(to_rec709(Imath::C3f(aces)), here, 2e-5);
        }
}

TEST(ColorConfigEnvironment, broken_ocio_is_an_error_that_helps)
{
    const test::TemporaryFolder folder;
    const std::string paths[] = {
        (folder / "missing.ocio").string(),
        folder.write("garbage.ocio", "this is no config: [").string(),
        folder.write("empty.ocio", "").string(),
        folder.path().string(),
    };
    for (const std::string& path : paths)
    {
        const test::OcioVariable ocio(path);
        const auto message = message_of([] { ColorConfig::active(); });
        EXPECT_TRUE(says(message, path)) << message;
        EXPECT_TRUE(says(message, "unset OCIO")) << message;
        EXPECT_NO_THROW(ColorConfig::builtin());
    }
}

TEST(ColorConfigEnvironment, config_without_scene_linear_is_an_error)
{
    const test::TemporaryFolder folder;
    const auto file = folder.write(
        "config.ocio", test::replaced(test::working_in("ACEScg"), "  scene_linear: ACEScg\n", ""));
    const auto message = message_of([&] { ColorConfig::from_file(file); });
    EXPECT_TRUE(says(message, "scene_linear") && says(message, file.string())) << message;
}

TEST(ColorConfigEnvironment, raw_is_a_view_even_where_the_config_has_none)
{
    const test::TemporaryFolder folder;
    const auto config = ColorConfig::from_file(folder.write("old.ocio", test::version_1));
    EXPECT_EQ(config.views(), (std::vector<std::string>{"plain", "raw"}));
    EXPECT_TRUE(config.display_transform("monitor", "raw").is_identity());
}
