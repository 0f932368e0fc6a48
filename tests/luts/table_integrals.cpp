// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Tables of integrals that were shared out are the tables of one bake.

#include <regain/luts/table_integrals.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace regain;

namespace {

// Every third row by each of three, put where they belong.
std::vector<double> by_three(const luts::TableIntegrals& integrals)
{
    std::vector<double> all(integrals.rows() * integrals.length());
    for (std::size_t one = 0; one < 3; ++one)
    {
        std::vector<std::size_t> rows;
        for (std::size_t row = one; row < integrals.rows(); row += 3) rows.push_back(row);
        const std::vector<double> some = integrals.integrate(rows);
        EXPECT_EQ(some.size(), rows.size() * integrals.length());
        for (std::size_t i = 0; i < rows.size(); ++i)
            std::copy_n(some.begin() + static_cast<std::ptrdiff_t>(i * integrals.length()),
                        integrals.length(),
                        all.begin() + static_cast<std::ptrdiff_t>(rows[i] * integrals.length()));
    }
    return all;
}

}  // namespace

TEST(TableIntegrals, that_are_shared_out_make_the_same_table)
{
    for (const char* name : {"ggx_E_avg", "ggx_E_ss", "ggx_q_ms"})
    {
        const luts::Table whole = luts::bake(name);
        const luts::Table shared = luts::bake(name, by_three(luts::TableIntegrals(name)));
        EXPECT_EQ(shared.values(), whole.values()) << name;
        EXPECT_EQ(shared.info().error, whole.info().error) << name;
        EXPECT_EQ(shared.name(), whole.name());
    }
}

// Of every kind of table, also those that take minutes.
TEST(TableIntegrals, a_row_is_the_same_whatever_it_is_integrated_with)
{
    for (const char* name :
         {"ggx_E_ss", "gtr_dip", "std_balance", "ggx_E_S_beta_inside", "ggx_anisotropy",
          "beckmann_anisotropy_beta_outside", "ggx_R_later_outside"})
    {
        const luts::TableIntegrals integrals(name);
        const std::size_t last = integrals.rows() - 1, length = integrals.length();
        const std::vector<double> two = integrals.integrate({last, 0}),
                                  one = luts::TableIntegrals(name).integrate({last});
        ASSERT_EQ(two.size(), 2 * length) << name;
        EXPECT_TRUE(std::equal(one.begin(), one.end(), two.begin())) << name;
        EXPECT_TRUE(std::all_of(two.begin(), two.end(), [](double v) { return std::isfinite(v); }));
        EXPECT_TRUE(std::any_of(one.begin(), one.end(), [](double v) { return v != 0; })) << name;
    }
}

TEST(TableIntegrals, tables_of_one_integral_share_its_name)
{
    const auto name = [](const char* table) { return luts::TableIntegrals(table).name(); };
    EXPECT_EQ(name("ggx_E_ss"), name("ggx_dip"));
    EXPECT_EQ(name("ggx_R_share_beta_outside"), name("ggx_R_share_correlated_outside"));
    EXPECT_EQ(name("ggx_anisotropy_beta_inside"), name("ggx_anisotropy_correlated_inside"));
    for (const char* other : {"beckmann_E_ss", "ggx_E_avg", "ggx_balance", "ggx_anisotropy"})
        EXPECT_NE(name("ggx_E_ss"), name(other)) << other;
    EXPECT_NE(name("gtr_1.3_E_S_beta_inside"), name("gtr_1.4_E_S_beta_inside"));
    EXPECT_NE(name("ggx_E_S_beta_inside"), name("ggx_E_S_beta_outside"));
}

TEST(TableIntegrals, wrong_names_rows_and_numbers_are_refused)
{
    EXPECT_THROW(luts::TableIntegrals("ggx_E"), std::invalid_argument);
    const luts::TableIntegrals integrals("ggx_E_avg");
    EXPECT_THROW(integrals.integrate({integrals.rows()}), std::invalid_argument);
    EXPECT_TRUE(integrals.integrate({}).empty());
    const std::size_t size = integrals.rows() * integrals.length();
    EXPECT_THROW(luts::bake("ggx_E_avg", std::vector<double>(size - 1)), std::invalid_argument);
    EXPECT_THROW(luts::bake("ggx_E_avg", std::vector<double>(size + 1)), std::invalid_argument);
}

TEST(TableIntegrals, can_be_stopped)
{
    EXPECT_THROW(luts::TableIntegrals("ggx_E_ss").integrate({0, 1}, [](double) { return false; }),
                 luts::BakeStopped);
}
