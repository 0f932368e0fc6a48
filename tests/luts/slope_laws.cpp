// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The slope laws and the albedos integrated over them, against closed forms and against numbers
// found by other means.

#include <regain/luts/albedo_integral.h>
#include <regain/luts/slope_law.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace regain::luts;

namespace {

const double pi = std::acos(-1.0);
const double angles[] = {0.01, 0.3, 0.8, 1.2, 1.5, 1.57};

double lambda(const SlopeLaw& law, double theta)
{
    return law.projected_area(std::cos(theta)) / std::cos(theta) - 1;
}

TEST(SlopeLaw, densities_integrate_to_one)
{
    for (const auto& [name, gamma] :
         std::initializer_list<std::pair<const char*, double>>{{"ggx", 0},
                                                               {"beckmann", 0},
                                                               {"gtr", 0},
                                                               {"gtr", 0.7},
                                                               {"gtr", 1},
                                                               {"gtr", 10},
                                                               {"std", 1.51},
                                                               {"std", 4},
                                                               {"std", 100}})
        for (double alpha : {1e-3, 0.1, 1.0})
        {
            const SlopeLaw law = SlopeLaw::named(name, alpha, gamma);
            double sum = 0;
            for (double y = -25; y < 40; y += 0.05)  // over the logarithm of the slope
                sum += 0.05 * 2 * pi * std::exp(2 * y) * law.density(std::exp(y));
            EXPECT_NEAR(sum, 1, 1e-8) << name << " " << gamma << " " << alpha;
        }
}

TEST(SlopeLaw, the_lever_is_the_density_times_the_cube_of_the_slope)
{
    for (const char* name : {"ggx", "beckmann", "gtr", "std"})
        for (double alpha : {1e-3, 0.1, 1.0})
        {
            const SlopeLaw law = SlopeLaw::named(name, alpha, 1.7);
            for (double r : {1e-6, 0.01, 0.3, 2.0, 1e3})
            {
                const double expected = law.density(r) * r * r * r;
                EXPECT_NEAR(law.lever(std::log(r)), expected, 1e-9 * expected)
                    << name << " " << alpha << " " << r;
            }
            EXPECT_TRUE(std::isfinite(law.lever(600)));  // the square of such a slope is not
        }
}

// GTR of gamma 1 has an elementary Lambda: with s = cot theta,
// (sqrt(1 + s^2) - sqrt(a^2 + s^2) - s (ln 1/a + asinh s - asinh s/a)) / (2 s ln 1/a).
TEST(SlopeLaw, gtr_of_gamma_1_has_its_elementary_lambda)
{
    for (double a : {1e-3, 0.01, 0.1, 0.5})
        for (double theta : angles)
        {
            const double s = 1 / std::tan(theta), l = std::log(1 / a);
            const double expected = (std::sqrt(1 + s * s) - std::sqrt(a * a + s * s) -
                                     s * (l + std::asinh(s) - std::asinh(s / a))) /
                                    (2 * s * l);
            EXPECT_NEAR(lambda(SlopeLaw::gtr(a, 1), theta) / (1 + expected),
                        expected / (1 + expected), 1e-9);
        }
}

TEST(SlopeLaw, families_meet_where_they_are_the_same)
{
    for (double alpha : {1e-3, 0.1, 0.6, 1.0})
        for (double theta : angles)
        {
            const double mu = std::cos(theta), ggx = SlopeLaw::ggx(alpha).projected_area(mu);
            EXPECT_NEAR(SlopeLaw::gtr(alpha, 2).projected_area(mu), ggx, 1e-9);
            EXPECT_NEAR(SlopeLaw::std(alpha, 2).projected_area(mu), ggx, 1e-9);
            for (double gamma : {0.1, 1.0, 7.0})
                EXPECT_NEAR(SlopeLaw::gtr(1, gamma).projected_area(mu),
                            SlopeLaw::ggx(1).projected_area(mu), 1e-9);
            EXPECT_NEAR(SlopeLaw::std(alpha, 9e4).projected_area(mu),
                        SlopeLaw::beckmann(alpha).projected_area(mu), 2e-6);
            EXPECT_EQ(SlopeLaw::std(alpha, 1e5).projected_area(mu),
                      SlopeLaw::beckmann(alpha).projected_area(mu));
        }
}

// Average albedos of height-correlated surfaces by adaptive quadrature over outgoing directions,
// an earlier and separate computation; its numbers are rounded to five digits, and near normal
// incidence, where STD's albedo has a kink, they are good to 2e-5.
TEST(AlbedoIntegral, matches_averages_found_by_other_means)
{
    const double alpha[] = {0.01, 0.1, 0.25, 0.5, 0.75, 1};
    const double beckmann[] = {.99995, .99526, .97115, .89342, .78451, .66368};
    const double gtr[] = {.87237, .76542, .66723, .55339, .47131, .40914};
    const double student[] = {.95666, .66922, .42053, .22880, .14099, .09454};
    for (int i = 0; i < 6; ++i)
    {
        EXPECT_NEAR(average_albedo(SlopeLaw::beckmann(alpha[i]), {32}), beckmann[i], 1e-5);
        EXPECT_NEAR(average_albedo(SlopeLaw::gtr(alpha[i], 1), {32}), gtr[i], 1e-5);
        EXPECT_NEAR(average_albedo(SlopeLaw::std(alpha[i], 1.55), {32}), student[i], 2e-5);
    }
    const double mu[] = {.01, .05, .1, .2, .35, .5, .7, .9, 1},
                 E[] = {.3276, .2196, .1739, .1325, .1052, .0921, .0849, .0878, .1096};
    for (int i = 0; i < 9; ++i)
        EXPECT_NEAR(albedo(SlopeLaw::std(1, 1.55), mu[i], {}, {48}), E[i], 6e-5);
}

TEST(AlbedoIntegral, has_converged_for_every_law)
{
    for (double alpha : {1e-3, 0.1, 1.0})
        for (double mu : {1e-3, 0.1, 0.7, 1.0})
            for (const SlopeLaw& law : {SlopeLaw::beckmann(alpha), SlopeLaw::gtr(alpha, 0.3),
                                        SlopeLaw::gtr(alpha, 7), SlopeLaw::std(alpha, 1.51)})
                EXPECT_NEAR(albedo(law, mu, {}, {48}) / albedo(law, mu, {}, {80}), 1, 4e-6);
}

TEST(SlopeLaw, what_is_no_law_is_refused)
{
    EXPECT_THROW(SlopeLaw::ggx(0), std::invalid_argument);
    EXPECT_THROW(SlopeLaw::std(0.5, 1.5), std::invalid_argument);
    EXPECT_THROW(SlopeLaw::gtr(0.5, -1), std::invalid_argument);
    const double nan = std::nan("");
    for (double alpha : {-1.0, 1.01, nan})
        EXPECT_THROW(SlopeLaw::beckmann(alpha), std::invalid_argument) << alpha;
    EXPECT_THROW(SlopeLaw::gtr(0.5, 101), std::invalid_argument);
    EXPECT_THROW(SlopeLaw::gtr(0.5, nan), std::invalid_argument);
    EXPECT_THROW(SlopeLaw::std(0.5, nan), std::invalid_argument);
    EXPECT_THROW(SlopeLaw::named("phong", 0.5, 1), std::invalid_argument);
}

}  // namespace
