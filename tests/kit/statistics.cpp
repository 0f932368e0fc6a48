// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace regain::conformance;

namespace {

struct TableValue
{
    double x, degrees, probability;
};

}  // namespace

// Abramowitz and Stegun, Handbook of Mathematical Functions, Table 26.8. The bound is the rounding
// of the printed points.
TEST(KitStatistics, chi_squared_is_that_of_the_tables)
{
    for (const TableValue& v : std::vector<TableValue>{{3.84146, 1, 0.05},
                                                       {10.828, 1, 0.001},
                                                       {2.15585, 10, 0.995},
                                                       {18.3070, 10, 0.05},
                                                       {29.588, 10, 0.001},
                                                       {77.9295, 100, 0.95},
                                                       {124.342, 100, 0.05},
                                                       {149.449, 100, 0.001}})
        EXPECT_NEAR(chi_squared_tail(v.x, v.degrees) / v.probability, 1, 5e-4) << v.x;
    // Far out, where alarms are raised; by mpmath 1.3 with 30 digits.
    EXPECT_NEAR(chi_squared_tail(500, 255) / 4.3849619168e-18, 1, 1e-9);
    EXPECT_EQ(chi_squared_tail(0, 7), 1);
    // Of two degrees it is exp(-x / 2).
    for (double x : {1e-3, 0.5, 1.9, 2.1, 40.0, 700.0})
        EXPECT_NEAR(chi_squared_tail(x, 2) / std::exp(-x / 2), 1, 1e-12) << x;
}

// Table 26.10, two-sided.
TEST(KitStatistics, students_t_is_that_of_the_tables)
{
    for (const TableValue& v : std::vector<TableValue>{{12.706, 1, 0.05},
                                                       {636.619, 1, 0.001},
                                                       {2.228, 10, 0.05},
                                                       {4.587, 10, 0.001},
                                                       {2.042, 30, 0.05},
                                                       {3.646, 30, 0.001},
                                                       {3.373, 120, 0.001}})
        EXPECT_NEAR(student_tail(v.x, v.degrees) / v.probability, 1, 2e-3) << v.x;
    EXPECT_NEAR(student_tail(8, 31) / 4.9402637019e-9, 1, 1e-9);  // mpmath, as above
    EXPECT_EQ(student_tail(0, 31), 1);
    // Of one degree it is Cauchy's.
    for (double t : {0.01, 1.0, 100.0})
        EXPECT_NEAR(student_tail(t, 1), 1 - 2 / std::acos(-1.0) * std::atan(t), 1e-12) << t;
}

// P(N >= 3) with 2 expected: 1 - e^-2 (1 + 2 + 2).
TEST(KitStatistics, counts_are_those_of_poisson)
{
    EXPECT_NEAR(count_tail(3, 2), 1 - 5 * std::exp(-2.0), 1e-14);
    EXPECT_NEAR(count_tail(1, 1e-6), 1e-6, 1e-11);
    EXPECT_EQ(count_tail(0, 0.5), 1);
}

TEST(KitStatistics, all_tests_together_have_the_level_of_the_family)
{
    for (std::size_t tests : {1u, 10u, 100000u})
    {
        const double level = sidak_level(1e-3, tests);
        const double family = -std::expm1(static_cast<double>(tests) * std::log1p(-level));
        EXPECT_NEAR(family / 1e-3, 1, 1e-12) << tests;
    }
    EXPECT_NEAR(sidak_level(0.05, 10), 1 - std::pow(0.95, 0.1), 1e-15);
}

// Values that a sum of squares would not tell apart.
TEST(KitStatistics, means_far_from_zero_keep_their_variance)
{
    RunningMean mean;
    for (double x : {4.0, 7.0, 13.0, 16.0}) mean.add(1e9 + x);
    EXPECT_EQ(mean.count(), 4u);
    EXPECT_EQ(mean.mean(), 1e9 + 10);
    EXPECT_EQ(mean.variance(), 30);
    EXPECT_EQ(mean.standard_error(), std::sqrt(30.0 / 4));
}

TEST(KitStatistics, a_mean_within_the_bound_is_no_surprise_and_nan_is)
{
    RunningMean mean;
    for (double x : {0.9, 1.0, 1.1}) mean.add(x);
    EXPECT_EQ(tail_beyond(mean, 1.05, 0.1), 1);
    const double error = mean.standard_error();
    EXPECT_NEAR(tail_beyond(mean, 1.3, 0.1), student_tail(0.2 / error, 2), 1e-12);
    mean.add(std::nan(""));
    EXPECT_EQ(tail_beyond(mean, 1, 1), 0);
}
