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

struct Task
{
    const RenderTarget* target;
    Tile tile;
};

std::vector<Task> make_tasks(const RenderJob& job)
{
    std::vector<Task> tasks;
    for (const RenderTarget& target : job.targets)
        for (int y = 0; y < target.film->height(); y += kTile)
            for (int x = 0; x < target.film->width(); x += kTile)
                tasks.push_back({&target, Tile{x, y, std::min(x + kTile, target.film->width()),
                                               std::min(y + kTile, target.film->height())}});
    return tasks;
}

}  // namespace

std::uint64_t total_samples(const RenderJob& job)
{
    std::uint64_t pixels = 0;
    for (const RenderTarget& target : job.targets)
        pixels += static_cast<std::uint64_t>(target.film->width()) *
                  static_cast<std::uint64_t>(target.film->height());
    return pixels * static_cast<std::uint64_t>(job.samples);
}

bool render(const RenderJob& job)
{
    const int cores = tbb::info::default_concurrency();
    tbb::task_arena arena(job.threads > 0 ? std::min(job.threads, cores) : cores);

    const std::vector<Task> tasks = make_tasks(job);
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
                    const Task& task = tasks[i];
                    // All of a tile has as many.
                    const int has =
                        static_cast<int>(task.target->film->samples(task.tile.x0, task.tile.y0));
                    if (has < first + count)
                        task.target->integrator->render(task.tile, has, first + count - has,
                                                        *task.target->film);
                    finished.fetch_add(1, std::memory_order_relaxed);
                    if (job.progress)
                        job.progress->advance(
                            static_cast<std::uint64_t>(task.tile.x1 - task.tile.x0) *
                            static_cast<std::uint64_t>(task.tile.y1 - task.tile.y0) *
                            static_cast<std::uint64_t>(count));
                },
                tbb::simple_partitioner());
        });
    }
    return finished.load() == started;
}

}  // namespace regain::tools::preview
