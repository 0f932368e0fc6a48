// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Progress says how long work still takes, in words for people, and nothing when it is to be
// silent.

#include "preview/progress.h"

#include <gtest/gtest.h>

namespace regain::tools { namespace {

TEST(Progress, Durations)
{
    EXPECT_EQ(Progress::duration(0.0), "0 s");
    EXPECT_EQ(Progress::duration(59.4), "59 s");
    EXPECT_EQ(Progress::duration(59.6), "1 min 00 s");
    EXPECT_EQ(Progress::duration(125.0), "2 min 05 s");
    EXPECT_EQ(Progress::duration(3720.0), "1 h 02 min");
    EXPECT_EQ(Progress::duration(-1.0), "0 s");
}

TEST(Progress, SilentIsSilent)
{
    testing::internal::CaptureStderr();
    {
        Progress progress("work", 3, Progress::Style::Silent);
        progress.advance(3);
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Progress, BarEndsAtItsEndAndGoesAway)
{
    testing::internal::CaptureStderr();
    {
        Progress progress("work", 4, Progress::Style::Bar);
        progress.advance(1);
        progress.advance(300);
    }
    const std::string text = testing::internal::GetCapturedStderr();
    EXPECT_NE(text.find("work ["), std::string::npos);
    EXPECT_NE(text.find(" 25 %"), std::string::npos);
    EXPECT_EQ(text.substr(text.size() - 4), "\r\x1b[K");
}

TEST(Progress, NothingToDo)
{
    Progress progress("work", 0, Progress::Style::Silent);
    progress.advance();
}

}}  // namespace regain::tools
