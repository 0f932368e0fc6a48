// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// As alpha goes to 0 the lobe becomes a mirror, without a jump.

#include "../support/closures.h"
#include "../support/reflection_integral.h"

#include <gtest/gtest.h>

using namespace regain;
using namespace regain::tests;

namespace {

TEST(DeltaLimit, a_mirror_samples_its_direction_and_has_no_density)
{
    for (double alpha : {0.0, 1e-6, 1e-5})
    {
        const auto lobe = gold<float>(alpha, alpha);
        const auto wo = direction<float>(0.6, 1.0);
        const auto s = lobe.sample(wo, {0.3f, 0.9f});
        ASSERT_TRUE(s.valid);
        EXPECT_TRUE(s.delta);
        EXPECT_TRUE(lobe.traits().delta);
        EXPECT_TRUE(s.wi.equalWithAbsError(Vec3<float>(-wo.x, -wo.y, wo.z), 2e-7f));
        EXPECT_EQ(s.pdf, 1);
        EXPECT_TRUE(s.weight.equalWithAbsError(lobe.fresnel().at(wo.z), 1e-6f));
        EXPECT_EQ(lobe.pdf(wo, s.wi), 0);
        EXPECT_EQ(lobe.eval(wo, s.wi), Color3<float>(0.0f));
        EXPECT_TRUE(lobe.albedo(wo).reflect.equalWithAbsError(s.weight, 1e-5f));
    }
}

// On either side of the bound the albedo, by integration or from the tables, is nearly the same.
TEST(DeltaLimit, no_albedo_jumps_at_the_bound)
{
    for (Method method : all_methods)
        for (double mu : {1e-3, 0.05, 0.5, 1.0})
        {
            const auto wo = direction<double>(mu);
            const double above = 1.0001e-5, below = 0.9999e-5;
            const auto rough = compensated(gold<float>(above, above), method, luts::ggx_tables());
            const auto smooth = compensated(gold<float>(below, below), method, luts::ggx_tables());
            ASSERT_TRUE(smooth.traits().delta && !rough.traits().delta);
            const Vec3<float> single(wo);
            const auto precise =
                compensated(gold<double>(above, above), method, luts::ggx_tables());
            const auto integral = integrate_reflections(
                wo, above, above, 40, [&](const auto& wi) { return precise.eval(wo, wi); });
            const auto mirror = smooth.sample(single, {0.5f, 0.5f}).weight;
            for (int c = 0; c < 3; ++c)
            {
                EXPECT_NEAR(integral[c], mirror[c], 1e-3) << name(method) << ", mu " << mu;
                EXPECT_NEAR(rough.albedo(single).reflect[c], smooth.albedo(single).reflect[c],
                            1e-3);
            }
        }
}

// One narrow axis is a line of mirrors, not a mirror.
TEST(DeltaLimit, one_axis_at_zero_is_finite)
{
    const auto lobe = white<float>(0, 0.3);
    EXPECT_FALSE(lobe.traits().delta);
    Random random(2);
    double sum = 0;
    for (int i = 0; i < 20000; ++i)
    {
        const auto s = lobe.sample(direction<float>(0.5, 0.3), random.square<float>());
        sum += s.weight.x / 20000;
        EXPECT_TRUE(std::isfinite(s.pdf) && std::isfinite(s.weight.x));
    }
    const auto wo = direction<double>(0.5, 0.3);
    const auto precise = white<double>(1e-5, 0.3);
    const double E = integrate_reflections(wo, 1e-5, 0.3, 64,
                                           [&](const auto& wi) { return precise.eval(wo, wi).x; });
    EXPECT_NEAR(sum, E, 5e-3);
}

}  // namespace
