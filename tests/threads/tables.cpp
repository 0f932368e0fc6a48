// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Tables are loaded when they are first asked for, by whoever comes first.

#include "parallel.h"
#include "together.h"

#include <regain/luts/bake.h>
#include <regain/luts/library.h>

#include <gtest/gtest.h>

using namespace regain;
using regain::tests::together;

namespace {

TEST(Threads, a_table_is_loaded_once_whoever_asks_first)
{
    constexpr int threads = 6;
    MicrofacetTables mirrors[threads];
    DielectricTables glass[threads];
    together(threads, [&](int i) {
        const char* name = i % 2 ? "beckmann" : "ggx";
        mirrors[i] = luts::microfacet_tables(name);
        luts::add_later_bounces(mirrors[i], name);
        luts::add_balance(mirrors[i], name);
        luts::add_anisotropy(mirrors[i], name);
        glass[i] = luts::dielectric_tables(name, TransmissionShadowing::beta);
        luts::add_later_split(glass[i], name);
        luts::add_anisotropy(glass[i], name, TransmissionShadowing::beta);
    });
    for (int i = 2; i < threads; ++i)
    {
        EXPECT_EQ(glass[i].anisotropy, glass[i % 2].anisotropy);
        EXPECT_EQ(mirrors[i].E_ss.at(0.3, 0.4), mirrors[i % 2].E_ss.at(0.3, 0.4));
    }
    EXPECT_NE(glass[0].anisotropy, glass[1].anisotropy);
}

// Baking has threads of its own, which tell of their progress and can be stopped.
TEST(Threads, loops_of_bakes_run_side_by_side)
{
    std::vector<int> made[2] = {std::vector<int>(200), std::vector<int>(200)};
    together(2, [&](int i) {
        double told = 0;
        luts::parallel_for(
            made[i].size(),
            [&](double done) {
                told = done;
                return true;
            },
            [&](std::size_t k) { made[i][k] = int(k); });
        EXPECT_GT(told, 0);
        EXPECT_THROW(luts::parallel_for(
                         50, [](double) { return false; }, [](std::size_t) {}),
                     luts::BakeStopped);
    });
    EXPECT_EQ(made[0], made[1]);
    EXPECT_EQ(made[0][199], 199);
}

}  // namespace
