// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "configs.h"
#include "temporary.h"

#include <regain/shaders/spectrum.h>
#include <regain/shaders/white_adaptation.h>

using namespace regain::shaders;

TEST(SpectrumWhite, perfect_reflector_is_d65_white_with_y_1)
{
    const C3d white = xyz_d65_of_reflectance([](int) { return 1.0; });
    test::expect_near(white, d65_white(), 1e-12);
    EXPECT_NEAR(white.y, 1.0, 1e-12);
}

TEST(SpectrumWhite, reflectance_is_linear)
{
    const auto slope = [](int nm) { return (nm - 380) / 400.0; };
    const C3d once = xyz_d65_of_reflectance(slope);
    const C3d halved = xyz_d65_of_reflectance([&](int nm) { return 0.5 * slope(nm); });
    test::expect_near(halved, C3d(0.5 * once), 1e-12);
}

TEST(SpectrumWhite, nothing_outside_the_visible)
{
    EXPECT_EQ(xyz_d65_weight(379), C3d(0.0));
    EXPECT_EQ(xyz_d65_weight(781), C3d(0.0));
    // The observer's peak, and D65 near its middle: about 1 / 106 of Y for each nm.
    EXPECT_NEAR(xyz_d65_weight(555).y, 1.0 / 106, 1e-3);
}

TEST(SpectrumWhite, white_is_1_1_1_in_scene_linear)
{
    const test::TemporaryFolder folder;
    const C3d white = xyz_d65_of_reflectance([](int) { return 1.0; });
    const std::string texts[] = {test::working_in("ACEScg"), test::working_in("lin_rec709"),
                                 test::working_in("ACES2065-1"), test::without_aces_role(),
                                 test::version_1};
    for (const std::string& text : texts)
    {
        const auto config = ColorConfig::from_file(folder.write("config.ocio", text));
        SCOPED_TRACE(config.scene_linear());
        test::expect_near(config.to_scene_linear_from_xyz_d65(white), C3d(1.0), 1e-4);
    }
}

TEST(SpectrumWhite, bradford_takes_white_to_white)
{
    const Imath::M33d m = bradford_adaptation(d65_white(), aces_white());
    test::expect_near(times_column(m, d65_white()), aces_white(), 1e-14);
    const Imath::M33d back = bradford_adaptation(aces_white(), d65_white());
    test::expect_near(times_column(back * m, C3d(0.3, 0.2, 0.1)), C3d(0.3, 0.2, 0.1), 1e-14);
}
