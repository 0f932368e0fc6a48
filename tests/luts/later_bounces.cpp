// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// What is measured of walks after their first bounce.

#include <regain/luts/albedo_integral.h>
#include <regain/luts/later_bounces.h>

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

using namespace regain;

namespace {

luts::LaterBounces ggx(double alpha, double mu, int walks)
{
    return luts::later_bounces("ggx", alpha, 0, mu, luts::ggx_albedo(mu, alpha), walks);
}

// By another program, in its own way, walks on GGX of alpha 1 meet 2.30 facets on average from
// normal incidence. Of the 1 - E_ss = ln 2 that meet a second one, that is 1.30 / ln 2 more.
TEST(LaterBounces, q_is_what_the_mean_depth_says)
{
    EXPECT_NEAR(ggx(1, 1, 1 << 17).q, 1 - std::log(2.0) / 1.30, 5e-3);
}

// Along the surface later facets are met at grazing angles, along the normal they are not; and a
// wide distribution has them face any way.
TEST(LaterBounces, their_cosine_follows_wo)
{
    constexpr int walks = 1 << 15;
    for (double alpha : {0.25, 0.5, 1.0})
    {
        EXPECT_LT(ggx(alpha, 0.2, walks).mu, ggx(alpha, 1, walks).mu) << alpha;
        EXPECT_LT(ggx(alpha, 0.2, walks).mu, ggx(std::min(1.0, 1.5 * alpha), 0.2, walks).mu + 1e-9)
            << alpha;
    }
}

TEST(LaterBounces, more_walks_change_little)
{
    const luts::LaterBounces few = ggx(0.6, 0.5, 1 << 14), many = ggx(0.6, 0.5, 1 << 18);
    EXPECT_NEAR(few.q, many.q, 0.01);
    EXPECT_NEAR(few.mu, many.mu, 0.01);
}

TEST(LaterBounces, a_mirror_has_none)
{
    const luts::LaterBounces none = ggx(1e-4, 0.5, 4096);
    EXPECT_GE(none.q, 0);
    EXPECT_LT(none.q, 1);
    EXPECT_GE(none.mu, 0);
    EXPECT_LE(none.mu, 1);
}

TEST(LaterBounces, unknown_distributions_are_refused)
{
    EXPECT_THROW(luts::later_bounces("phong", 0.5, 0, 0.5, 0.9, 16), std::invalid_argument);
}

}  // namespace
