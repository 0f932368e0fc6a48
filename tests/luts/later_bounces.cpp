// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// What is measured of walks after their first bounce.

#include <regain/luts/albedo_integral.h>
#include <regain/luts/dielectric_integral.h>
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

// An interface that is none reflects nothing, however often it is met; one of which single
// scattering loses nothing has no later bounces, and what is usual takes their place.
TEST(LaterBounces, of_no_interface_nothing_is_reflected)
{
    EXPECT_EQ(luts::later_reflected_share("ggx", 0.7, 0, 1, 0.5, 512), 0);
    const double flat = luts::later_reflected_share("ggx", 1e-4, 0, 1.5, 1, 512);
    EXPECT_NEAR(flat, 0.092, 1e-3);  // the average Fresnel reflectance of index 1.5
}

// What passes one way passes the other way, times the index squared: 2 int (1 - E^S) (1 - r) mu dmu
// from outside is eta^2 of that from inside. E^S is quadrature's.
TEST(LaterBounces, what_is_transmitted_is_so_both_ways)
{
    for (const double eta : {1.2, 1.5})
        for (const double alpha : {0.5, 1.0})
        {
            const auto passed = [&](double eta_o) {
                constexpr int n = 24;
                double sum = 0;
                for (int i = 0; i < n; ++i)
                {
                    const double mu = (i + 0.5) / n;
                    const auto a =
                        luts::dielectric_albedo(luts::SlopeLaw::ggx(alpha), mu, eta_o, 12);
                    const double r = luts::later_reflected_share("ggx", alpha, 0, eta_o, mu, 8192);
                    sum += 2 * mu / n * (1 - a.reflected - a.transmitted_beta) * (1 - r);
                }
                return sum;
            };
            EXPECT_NEAR(passed(eta) / (eta * eta * passed(1 / eta)), 1, 0.06)
                << eta << " " << alpha;
        }
}

TEST(LaterBounces, unknown_distributions_are_refused)
{
    EXPECT_THROW(luts::later_bounces("phong", 0.5, 0, 0.5, 0.9, 16), std::invalid_argument);
    EXPECT_THROW(luts::later_reflected_share("phong", 0.5, 0, 1.5, 0.9, 16), std::invalid_argument);
}

}  // namespace
