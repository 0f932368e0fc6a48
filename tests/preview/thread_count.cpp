// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The number of threads leaves every bit of the picture as it was.

#include "doubles.h"

#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

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

/// Its first tile waits for a second thread to come.
class Rendezvous final : public Integrator
{
public:
    void render(const Tile& tile, int, int, Film& film) const override
    {
        std::unique_lock<std::mutex> lock(_mutex);
        ++_arrived;
        _changed.notify_all();
        if (_arrived == 1)
            _met = _changed.wait_for(lock, std::chrono::seconds(10), [&] { return _arrived > 1; });
        film.add(tile.x0, tile.y0, C3f(0.0f));
    }
    bool met() const { return _met; }

private:
    mutable std::mutex _mutex;
    mutable std::condition_variable _changed;
    mutable int _arrived = 0;
    mutable bool _met = false;
};

// Also while a scene is there: its ray tracer shares the threads.
TEST(ThreadCount, ThereAreAsManyThreadsAsAskedFor)
{
    if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "one processor";
    WidgetWorld w(make_studio(), 16, 16);
    Rendezvous integrator;
    Film film(64, 64);
    ASSERT_TRUE(render({{{&integrator, &film}}, 1, 2}));
    EXPECT_TRUE(integrator.met());
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
