// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "render_job.h"

#include "progress.h"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace regain::tools::preview {

namespace {

constexpr int kTile = 16;

std::vector<Film*> films_of(const RenderJob& job)
{
    std::vector<Film*> films;
    for (const RenderTarget& target : job.targets) films.push_back(target.film);
    return films;
}

std::uint64_t pixels(const Tile& tile)
{
    return static_cast<std::uint64_t>(tile.x1 - tile.x0) *
           static_cast<std::uint64_t>(tile.y1 - tile.y0);
}

}  // namespace

std::vector<FilmTile> tiles_of(const std::vector<Film*>& films, const Part& part)
{
    std::vector<FilmTile> tiles;
    std::size_t place = 0;
    for (std::size_t f = 0; f < films.size(); ++f)
    {
        const int width = films[f]->width(), height = films[f]->height();
        const auto across = static_cast<std::size_t>((width + kTile - 1) / kTile);
        for (int y = 0; y < height; y += kTile)
            for (int x = 0; x < width; x += kTile)
                if (part.holds(place++, across))
                    tiles.push_back(
                        {f, Tile{x, y, std::min(x + kTile, width), std::min(y + kTile, height)}});
    }
    return tiles;
}

std::uint64_t total_samples(const RenderJob& job)
{
    std::uint64_t all = 0;
    for (const FilmTile& t : tiles_of(films_of(job), job.part)) all += pixels(t.tile);
    return all * static_cast<std::uint64_t>(job.samples);
}

bool render(const RenderJob& job)
{
    const int cores = tbb::info::default_concurrency();
    tbb::task_arena arena(job.threads > 0 ? std::min(job.threads, cores) : cores);

    const std::vector<FilmTile> tasks = tiles_of(films_of(job), job.part);
    std::atomic<std::size_t> finished{0};
    std::size_t started = 0;
    const auto stopped = [&] { return job.stop && job.stop->load(std::memory_order_relaxed); };

    // The first pass is one sample, so that there is a picture early; later ones are larger, since
    // batches are.
    for (int first = 0, count = 1; first < job.samples; first += count)
    {
        if (stopped()) return false;
        count = std::min(first == 0 ? 1 : std::min(first, 8), job.samples - first);
        started += tasks.size();
        arena.execute([&] {
            tbb::parallel_for(
                std::size_t(0), tasks.size(),
                [&](std::size_t i) {
                    if (stopped()) return;
                    const Tile& tile = tasks[i].tile;
                    const RenderTarget& target = job.targets[tasks[i].film];
                    // All of a tile has as many.
                    const int has = static_cast<int>(target.film->samples(tile.x0, tile.y0));
                    if (has < first + count)
                        target.integrator->render(tile, has, first + count - has, *target.film);
                    finished.fetch_add(1, std::memory_order_relaxed);
                    if (job.progress)
                        job.progress->advance(pixels(tile) * static_cast<std::uint64_t>(count));
                },
                tbb::simple_partitioner());
        });
    }
    return finished.load() == started;
}

}  // namespace regain::tools::preview
