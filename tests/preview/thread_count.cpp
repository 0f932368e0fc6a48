// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The number of threads leaves every bit of the picture as it was.

#include "doubles.h"

#include <gtest/gtest.h>

namespace regain::tools::preview { namespace {

using namespace doubles;

TEST(ThreadCount, LeavesThePictureBitEqual)
{
    constexpr int kSize = 48;
    WidgetWorld w(make_studio(), kSize, kSize);
    TwoLamberts materials(C3f(0.3f), C3f(0.9f, 0.6f, 0.2f));
    for (const auto& integrator : {materials.grid(w.world), materials.point(w.world)})
    {
        Film one(kSize, kSize);
        ASSERT_TRUE(render({{{integrator.get(), &one}}, 8, 1}));
        for (const int threads : {2, 5})
        {
            Film film(kSize, kSize);
            ASSERT_TRUE(render({{{integrator.get(), &film}}, 8, threads}));
            for (int y = 0; y < kSize; ++y)
                for (int x = 0; x < kSize; ++x) ASSERT_EQ(one.mean(x, y), film.mean(x, y));
        }
    }
}

TEST(ThreadCount, SeedChangesThePicture)
{
    WidgetWorld w(make_studio(), 16, 16);
    TwoLamberts materials(C3f(0.3f), C3f(0.5f));
    World other = w.world;
    other.seed = 2;
    Film a(16, 16), b(16, 16);
    const auto first = materials.grid(w.world), second = materials.grid(other);
    ASSERT_TRUE(render({{{first.get(), &a}}, 4, 1}));
    ASSERT_TRUE(render({{{second.get(), &b}}, 4, 1}));
    EXPECT_NE(mean(a), mean(b));
}

}}  // namespace regain::tools::preview
