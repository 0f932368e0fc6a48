// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// A render that is stopped leaves a film that can be shown, and says that it is not whole.

#include "../support/temporary_folder.h"
#include "doubles.h"
#include "errors.h"
#include "preview/interrupt.h"
#include "resume_file.h"

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

// To the last bit, whatever was done when it was stopped, and with more samples than it was to
// have.
TEST(InterruptedRender, GoesOnToTheSameFilm)
{
    constexpr int kSize = 48;
    WidgetWorld w(constant_image(1.0f), kSize, kSize);
    TwoLamberts grey(C3f(0.7f), C3f(0.3f));
    const auto grid = grey.grid(w.world);
    Film whole(kSize, kSize);
    ASSERT_TRUE(render({{{grid.get(), &whole}}, 20}));

    const test::TemporaryFolder folder;
    const auto file = folder / "a.resume.exr";
    for (const int tiles : {3, 14, 31})
    {
        const StopAfter stopping(*grid, tiles);
        const InterruptGuard interrupt;
        Film stopped(kSize, kSize), resumed(kSize, kSize);
        RenderJob job{{{&stopping, &stopped}}, 13, 1, &interrupt.flag()};
        ASSERT_FALSE(render(job));
        write_resume_file(file, {&stopped}, "a job");
        read_resume_file(file, {&resumed}, "a job");
        ASSERT_TRUE(render({{{grid.get(), &resumed}}, 20}));
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x)
            {
                ASSERT_EQ(resumed.samples(x, y), 20u);
                for (int c = 0; c < 3; ++c)
                    ASSERT_EQ(resumed.pixel(x, y).sum[c], whole.pixel(x, y).sum[c]);
            }
    }
    Film other(kSize, kSize + 1), same(kSize, kSize);
    const auto error = [&](Film& film, const std::string& job,
                           const std::filesystem::path& from) -> std::string {
        try
        {
            read_resume_file(from, {&film}, job);
        }
        catch (const BadInput& e)
        {
            return e.what();
        }
        return {};
    };
    EXPECT_NE(error(other, "a job", file).find("another size"), std::string::npos);
    EXPECT_NE(error(same, "no job", file).find("of another render"), std::string::npos);
    const auto text = folder.write("b.resume.exr", "no picture");
    EXPECT_NE(error(same, "a job", text).find("cannot go on from"), std::string::npos);
    EXPECT_EQ(same.samples(0, 0), 0u);
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
