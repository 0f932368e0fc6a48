// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Tables of four and five axes: what look-ups answer, and that files say which axis is which.

#include "../support/temporary_folder.h"

#include <regain/closures/grid_view.h>
#include <regain/closures/xsimd.h>
#include <regain/luts/exr.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

using namespace regain;

namespace {

constexpr int lengths[] = {4, 3, 2, 5, 3};

// Linear along every axis, and different along each.
template <class Real>
Real truth(const Real (&x)[5])
{
    Real product(1);
    for (int axis = 0; axis < 5; ++axis)
        product = product * (Real(1) + x[axis] / Real(static_cast<float>(axis + 2)));
    return product;
}

luts::Table table_of_five_axes()
{
    luts::TableInfo info;
    info.quantity = "E_ss";
    info.distribution = "ggx";
    info.axis_x = info.axis_y = info.axis_z = "even";
    info.axis_4 = "the fourth";
    info.axis_5 = "the fifth";
    info.length_4 = lengths[3];
    info.length_5 = lengths[4];
    info.scale = 8.0 / 65535;
    std::vector<float> values;
    int i[5];
    const auto at = [&](int axis) { return i[axis] / (lengths[axis] - 1.0); };
    for (i[4] = 0; i[4] < lengths[4]; ++i[4])
        for (i[3] = 0; i[3] < lengths[3]; ++i[3])
            for (i[2] = 0; i[2] < lengths[2]; ++i[2])
                for (i[1] = 0; i[1] < lengths[1]; ++i[1])
                    for (i[0] = 0; i[0] < lengths[0]; ++i[0])
                    {
                        const double x[] = {at(0), at(1), at(2), at(3), at(4)};
                        values.push_back(static_cast<float>(truth(x)));
                    }
    return {info, lengths[0], lengths[1], lengths[2] * lengths[3] * lengths[4], values};
}

TEST(GridView, is_linear_along_every_axis)
{
    EXPECT_FALSE(GridView<5>());
    const luts::Table table = table_of_five_axes();
    const GridView<5> grid = table.grid<5>();
    ASSERT_TRUE(grid);
    std::uint32_t bits = 1;
    const auto unit = [&] {
        bits = bits * 1664525u + 1013904223u;
        return static_cast<double>(bits >> 8) * 0x1p-24;
    };
    for (int i = 0; i < 200; ++i)
    {
        double x[5];
        float y[5];
        xsimd::batch<float> z[5];
        for (int axis = 0; axis < 5; ++axis)
        {
            x[axis] = i % 7 == axis ? 1 : i % 11 == axis ? 0 : unit();
            y[axis] = static_cast<float>(x[axis]);
            z[axis] = xsimd::batch<float>(y[axis]);
        }
        EXPECT_NEAR(grid.at(x), truth(x), 8e-5);
        EXPECT_NEAR(grid.at(y), truth(x), 9e-5);
        const xsimd::batch<float> all = grid.at(z);
        EXPECT_FLOAT_EQ(all.get(0), grid.at(y));
        EXPECT_FLOAT_EQ(all.get(xsimd::batch<float>::size - 1), grid.at(y));
    }
}

TEST(GridView, an_axis_of_one_node_is_none)
{
    luts::Table table = table_of_five_axes();
    luts::TableInfo info = table.info();
    info.axis_5.clear();
    info.length_5 = 1;
    table = {info, table.width(), table.height(), table.depth() / lengths[4],
             std::vector<float>(table.values().begin(), table.values().end() - 2 * 4 * 3 * 2 * 5)};
    const double four[] = {0.3, 0.8, 0.1, 0.6}, five[] = {0.3, 0.8, 0.1, 0.6, 0.7};
    EXPECT_EQ(table.grid<5>().at(five), table.grid<4>().at(four));
}

TEST(GridView, coordinates_are_limited)
{
    const luts::Table table = table_of_five_axes();
    const float outside[] = {-1, 2, std::numeric_limits<float>::quiet_NaN(), 7, -0.1f};
    const float inside[] = {0, 1, 0, 1, 0};
    EXPECT_EQ(table.grid<5>().at(outside), table.grid<5>().at(inside));
}

TEST(GridView, files_keep_all_axes)
{
    const test::TemporaryFolder folder;
    const luts::Table table = table_of_five_axes();
    const auto file = folder.path() / "five.exr";
    luts::write_table(file, table);
    const luts::Table copy = luts::read_table(file);
    EXPECT_EQ(copy.values(), table.values());
    EXPECT_EQ(copy.info().axis_5, "the fifth");
    for (int axis = 0; axis < 5; ++axis) EXPECT_EQ(copy.grid<5>().size[axis], lengths[axis]);
    EXPECT_THROW(copy.grid<4>(), std::logic_error);
}

TEST(GridView, axes_that_do_not_fill_the_slices_are_refused)
{
    const luts::Table table = table_of_five_axes();
    const auto refused = [&](const auto& change) {
        luts::TableInfo info = table.info();
        change(info);
        EXPECT_THROW(
            luts::Table(info, table.width(), table.height(), table.depth(), table.values()),
            std::invalid_argument);
    };
    refused([](luts::TableInfo& info) { info.length_4 = 4; });
    refused([](luts::TableInfo& info) { info.length_5 = 0; });
    refused([](luts::TableInfo& info) { info.length_4 = -5; });
    refused([](luts::TableInfo& info) { info.length_5 = 2 * lengths[4]; });
    refused([](luts::TableInfo& info) { info.axis_4.clear(); });
    refused([](luts::TableInfo& info) { info.axis_5.clear(); });
}

}  // namespace
