// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The statistics that other tests lean on.

#include "../support/cells.h"

using namespace regain::tests;

namespace {

// Quantiles as tables of the normal and the chi-squared distribution have them.
TEST(Cells, bounds_are_those_of_the_tables)
{
    EXPECT_NEAR(two_sided_bound(0.0026997960632602), 3, 1e-9);
    EXPECT_NEAR(two_sided_bound(1e-3), 3.2905267, 1e-6);
    EXPECT_NEAR(furthest_of(1, 1e-3), 3.2905267, 1e-6);
    EXPECT_NEAR(furthest_of(2, 1 - 0.95 * 0.95), 1.9599640, 1e-6);
    EXPECT_NEAR(normal_of_chi_squared(67.505, 50), 1.6449, 5e-3);
    EXPECT_NEAR(normal_of_chi_squared(34.764, 50), -1.6449, 5e-3);
    EXPECT_NEAR(normal_of_chi_squared(135.807, 100), 2.3263, 5e-3);
}

// Ends of a die whose first face is drawn a little too often; and too often in every other group.
CellGroup thrown(double bias, double swing)
{
    Cells cells;
    Random random = random_of_test();
    constexpr int n = 20000, groups = 40;
    for (int g = 0; g < groups; ++g)
    {
        const double first = 0.2 + bias + (g % 2 ? swing : -swing);
        std::vector<double> counts(3);
        for (int i = 0; i < n; ++i)
        {
            const double u = random.unit();
            if (u < 0.8) ++counts[u < first ? 0 : u < 0.5 ? 1 : 2];
        }
        cells.add("die", std::to_string(g), n, counts, {0.2, 0.3, 0.3});
    }
    return cells.groups().front();
}

TEST(Cells, fair_counts_are_let_pass)
{
    const CellGroup fair = thrown(0, 0);
    EXPECT_EQ(fair.z.size(), 120u);
    EXPECT_LE(std::abs(fair.mean()), 3);
    EXPECT_LE(std::abs(fair.spread()), 3);
}

// Each of them below three standard errors of a single cell, which are 0.0085.
TEST(Cells, small_faults_are_found_by_what_they_have_in_common)
{
    // What the first face gains the second loses, and only a third of the cells says so.
    EXPECT_GT(thrown(0.005, 0).spread(), 3);
    EXPECT_GT(thrown(0, 0.005).spread(), 3);
    CellGroup shared;
    for (int i = 0; i < 100; ++i) shared.z.push_back(i % 2 ? 1.1 : -0.1);
    EXPECT_GT(shared.mean(), 3);
}

TEST(Cells, ends_too_rare_for_a_normal_law_stay_with_the_others)
{
    Cells cells;
    cells.add("g", "", 1000, {10, 500, 480}, {0.01, 0.5, 0.48});
    ASSERT_EQ(cells.groups().front().z.size(), 1u);
    EXPECT_EQ(cells.groups().front().z[0], 0);
}

}  // namespace
