// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// A render that is stopped leaves a film that can be shown, and says that it is not whole.

#include "doubles.h"
#include "preview/interrupt.h"

#include <gtest/gtest.h>

#include <csignal>

namespace regain::tools::preview { namespace {

using namespace doubles;

/// Passes the work on, and asks to stop after a number of tiles.
class StopAfter final : public Integrator
{
public:
    StopAfter(const Integrator& inner, int tiles) : _inner(inner), _left(tiles) {}
    void render(const Tile& tile, int first, int count, Film& film) const override
    {
        _inner.render(tile, first, count, film);
        if (--_left == 0) std::raise(SIGINT);
    }

private:
    const Integrator& _inner;
    mutable std::atomic<int> _left;
};

TEST(InterruptedRender, IsEvenlyNoisyAndMarked)
{
    constexpr int kSize = 64, kTiles = 16;
    WidgetWorld w(constant_image(1.0f), kSize, kSize);
    TwoLamberts white(C3f(1.0f), C3f(1.0f));
    const auto grid = white.grid(w.world);
    const StopAfter stopping(*grid, 3 * kTiles + 5);

    const InterruptGuard interrupt;
    Film film(kSize, kSize);
    RenderJob job{{{&stopping, &film}}, 64, 2, &interrupt.flag()};
    EXPECT_FALSE(render(job));

    // Passes of 1, 1 and 2 samples are done, and some tiles of the next.
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x)
        {
            EXPECT_GE(film.samples(x, y), 4u);
            EXPECT_LE(film.samples(x, y), 8u);
        }
    EXPECT_NEAR(mean(film).y, 1.0f, 0.1f);
}

TEST(InterruptedRender, FinishedBeforeTheStopIsWhole)
{
    WidgetWorld w(constant_image(1.0f), 16, 16);
    TwoLamberts white(C3f(1.0f), C3f(1.0f));
    const auto grid = white.grid(w.world);
    const StopAfter stopping(*grid, 1);
    const InterruptGuard interrupt;
    Film film(16, 16);
    EXPECT_TRUE(render({{{&stopping, &film}}, 1, 1, &interrupt.flag()}));
}

}}  // namespace regain::tools::preview
