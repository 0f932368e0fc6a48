// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Baking on all cores: each part once, and what goes wrong in one comes out.

#include "parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

using namespace regain;

namespace {

TEST(ParallelFor, calls_every_index_once_and_ends_its_progress_with_1)
{
    for (const std::size_t count : {std::size_t(0), std::size_t(1), std::size_t(1000)})
    {
        std::vector<std::atomic<int>> calls(count);
        double last = -1;
        luts::parallel_for(
            count,
            [&](double done) {
                EXPECT_TRUE(count == 0 || done >= last);
                last = done;
                return true;
            },
            [&](std::size_t i) { ++calls[i]; });
        for (const auto& n : calls) EXPECT_EQ(n, 1);
        EXPECT_EQ(last, 1);
    }
}

TEST(ParallelFor, what_a_body_throws_ends_the_work_and_comes_out)
{
    constexpr std::size_t count = 100000000;
    std::atomic<std::size_t> calls{0};
    const auto fails_early = [&](std::size_t i) {
        ++calls;
        if (i == 5) throw std::runtime_error("five");
    };
    try
    {
        luts::parallel_for(count, {}, fails_early);
        FAIL() << "nothing was thrown";
    }
    catch (const std::runtime_error& e)
    {
        EXPECT_STREQ(e.what(), "five");
    }
    EXPECT_LT(calls, count);
}

TEST(ParallelFor, what_the_callback_throws_comes_out)
{
    const auto fails = [](double) -> bool { throw std::runtime_error("enough"); };
    EXPECT_THROW(luts::parallel_for(10, fails, [](std::size_t) {}), std::runtime_error);
    EXPECT_THROW(luts::parallel_for(
                     10, [](double) { return false; }, [](std::size_t) {}),
                 luts::BakeStopped);
}

}  // namespace
