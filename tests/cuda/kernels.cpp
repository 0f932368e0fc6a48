// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Where there is no GPU: that each closure compiles for one. This program links a kernel for each.

#include "subjects.h"

#include <gtest/gtest.h>

#include <set>

using namespace regain::tests;

TEST(Kernels, every_closure_has_one)
{
    const struct
    {
        const char* list;
        std::vector<Subject> subjects;
        std::size_t least;  // lobes with methods
    } lists[] = {{"ggx", ggx_on_gpu(), 20},
                 {"beckmann", beckmann_on_gpu(), 20},
                 {"gtr", gtr_on_gpu(), 15},
                 {"std", std_on_gpu(), 15},
                 {"plain", plain_on_gpu(), 5}};
    for (const auto& l : lists)
    {
        EXPECT_GE(l.subjects.size(), l.least) << l.list;
        std::set<std::string> names;
        for (const Subject& s : l.subjects)
        {
            EXPECT_TRUE(names.insert(s.name).second) << l.list << " has twice: " << s.name;
            EXPECT_TRUE(s.ask) << s.name;
        }
    }
}

TEST(Kernels, answer_as_the_cpu_does)
{
    GTEST_SKIP() << "configured without a GPU (REGAIN_CUDA_COMPARE): " << why_no_gpu();
}
