// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Both host shapes give the same picture within noise.

#include "doubles.h"

#include <gtest/gtest.h>

namespace regain::tools::preview { namespace {

using namespace doubles;

TEST(HostsAgree, ColouredLambertUnderTheStudio)
{
    constexpr int kSize = 32, kRuns = 8;
    WidgetWorld w(make_studio(), kSize, kSize);
    TwoLamberts materials(C3f(0.3f), C3f(0.9f, 0.6f, 0.2f));

    // Independent runs tell how noisy each pixel is; a real difference shows as a mean of squared
    // standardised differences above 1.
    std::vector<double> sum[2], square[2];
    for (int host = 0; host < 2; ++host)
    {
        sum[host].assign(kSize * kSize, 0.0);
        square[host].assign(kSize * kSize, 0.0);
        for (int run = 0; run < kRuns; ++run)
        {
            World world = w.world;
            world.seed = static_cast<std::uint32_t>(1 + run + host * kRuns);
            const auto integrator = host ? materials.point(world) : materials.grid(world);
            Film film(kSize, kSize);
            ASSERT_TRUE(render({{{integrator.get(), &film}}, 32, 1}));
            for (int i = 0; i < kSize * kSize; ++i)
            {
                const double v = film.mean(i % kSize, i / kSize).y;
                sum[host][static_cast<std::size_t>(i)] += v / kRuns;
                square[host][static_cast<std::size_t>(i)] += v * v / kRuns;
            }
        }
    }
    double total = 0.0, difference = 0.0, variance = 0.0, light = 0.0;
    for (std::size_t i = 0; i < kSize * kSize; ++i)
    {
        double v = 1e-12;
        for (int host = 0; host < 2; ++host)
            v += (square[host][i] - sum[host][i] * sum[host][i]) / (kRuns - 1);
        const double d = sum[0][i] - sum[1][i];
        total += d * d / v;
        difference += d;
        variance += v;
        light += sum[0][i];
    }
    const double pixels = kSize * kSize;
    // Student's t with 14 degrees of freedom has variance 14/12; its mean over 1024 pixels spreads
    // by about 0.06.
    EXPECT_LT(total / pixels, 14.0 / 12.0 + 0.3);
    // The pictures as a whole: within four standard errors, which themselves are small.
    EXPECT_LT(std::abs(difference), 4.0 * std::sqrt(variance));
    EXPECT_LT(std::sqrt(variance), 2e-3 * light);
}

}}  // namespace regain::tools::preview
