// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Renders films by passes over tiles, on several threads.

#pragma once

#include "../part.h"
#include "integrator.h"

#include <atomic>
#include <cstdint>
#include <vector>

namespace regain::tools {
class Progress;
}

namespace regain::tools::preview {

struct RenderTarget
{
    const Integrator* integrator = nullptr;
    Film* film = nullptr;
};

struct RenderJob
{
    std::vector<RenderTarget> targets;
    int samples = 64;                         ///< per pixel
    int threads = 0;                          ///< 0: one per core, which is also the most
    const std::atomic<bool>* stop = nullptr;  ///< set by anyone to end early
    Progress* progress = nullptr;             ///< advanced by pixel samples
    Part part = {};                           ///< of the tiles; the rest of the films is left alone
};

/// What a job is divided into.
struct FilmTile
{
    std::size_t film;
    Tile tile;
};
/// Those of a part, over films one below the other, in order.
std::vector<FilmTile> tiles_of(const std::vector<Film*>& films, const Part& part = {});

/// Pixel samples of the job: what its progress counts.
std::uint64_t total_samples(const RenderJob&);

/// Every pass gives a few more samples to every pixel of the part, so a picture that is stopped is
/// evenly noisy. The finished films are bit-equal for any number of threads, and if they were
/// stopped and gone on with. False when it was stopped.
bool render(const RenderJob&);

}  // namespace regain::tools::preview
