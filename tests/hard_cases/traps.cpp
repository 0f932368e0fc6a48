// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// That a program which is said to trap floating-point exceptions, does.

#include "subject.h"

#include <gtest/gtest.h>

#include <csignal>

namespace {

#if defined(REGAIN_HARD_CASES_TRAPS) && !defined(__SANITIZE_ADDRESS__)
// Hosts that debug run with exceptions trapped: a closure that divides by 0 and throws the result
// away stops them. This is how the rest of the suite notices.
TEST(TrapsDeathTest, a_division_by_zero_stops_the_program)
{
    EXPECT_EXIT(
        {
            const regain::tests::WhileLibraryRuns guard;
            volatile double zero = 0;
            volatile double quotient = 1 / zero;
            static_cast<void>(quotient);
        },
        testing::KilledBySignal(SIGFPE), "");
}
#endif

}  // namespace
