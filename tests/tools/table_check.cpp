// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "table_check.h"
#include "command.h"

#include <regain/luts/bake.h>
#include <regain/luts/builtin.h>
#include <regain/luts/exr.h>

using namespace regain;
using namespace regain::tools;

namespace {

// Baked once: of the tables it is the quickest.
const luts::Table& baked()
{
    static const luts::Table table = luts::bake("ggx_E_avg");
    return table;
}

luts::Table changed(std::size_t node, float by)
{
    std::vector<float> values = baked().values();
    values[node] += by;
    return luts::Table(baked().info(), baked().width(), baked().height(), 1, values);
}

}  // namespace

TEST(table_check, what_is_compiled_in_is_what_is_baked)
{
    const TableCheck check = check_builtin(baked());
    EXPECT_TRUE(check.passed()) << check.worst->where;
    EXPECT_EQ(check.numbers, 32 + 2);
    EXPECT_EQ(check.largest_difference, 0);
}

TEST(table_check, one_stored_step_is_a_difference)
{
    const TableCheck check = check_builtin(changed(5, -1.0f / 65535));
    ASSERT_FALSE(check.passed());
    EXPECT_EQ(check.worst->where, "node (5, 0)");
    EXPECT_EQ(check.worst->shipped, check.worst->expected + 1);
    EXPECT_EQ(check.differing, 1);
}

TEST(table_check, a_file_may_differ_by_a_millionth)
{
    EXPECT_TRUE(check_file(baked(), changed(5, -9e-7f), "file").passed());
    const TableCheck check = check_file(baked(), changed(5, -2e-6f), "file");
    ASSERT_FALSE(check.passed());
    EXPECT_EQ(check.worst->where, "node (5, 0)");
    EXPECT_NEAR(check.largest_difference, 2e-6, 1e-7);
}

TEST(table_check, a_header_that_says_something_else_is_a_difference)
{
    luts::TableInfo info = baked().info();
    info.axis_x = "alpha";
    const luts::Table other(info, baked().width(), baked().height(), 1, baked().values());
    const TableCheck check = check_file(baked(), other, "file");
    ASSERT_FALSE(check.passed());
    EXPECT_EQ(check.worst->where, "header 'axis_x': 'alpha' in place of 'sqrt(alpha)'");
}

TEST(table_check, another_size_is_a_difference)
{
    const luts::Table reshaped(baked().info(), 16, 2, 1, baked().values());
    ASSERT_FALSE(check_file(baked(), reshaped, "file").passed());
    EXPECT_NE(check_file(baked(), reshaped, "file").worst->where.find("16 x 2"), std::string::npos);
}

TEST(table_check, spots_of_every_shipped_table_are_exact)
{
    for (const std::string& name : luts::compiled_in_tables())
    {
        const TableCheck check =
            check_spots(name, luts::builtin_table(name), spot_tolerance(name), "compiled in", 200);
        EXPECT_TRUE(check.passed()) << name << ": " << check.worst->where;
        // Each number of these takes half a million walks.
        const bool walked = luts::bakeable_info(name).method.find("walks") != std::string::npos;
        EXPECT_EQ(check.numbers, walked ? 10 : 200) << name;
    }
}

TEST(table_check, spots_find_a_damaged_table)
{
    const luts::Table damaged = changed(20, 0.01f);
    EXPECT_FALSE(check_spots("ggx_E_avg", damaged.view(), spot_tolerance("ggx_E_avg"), "file", 200)
                     .passed());
}
