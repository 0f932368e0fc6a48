// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Renders films by passes over tiles, on several threads.

#pragma once

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
};

/// Pixel samples of the whole job: what its progress counts.
std::uint64_t total_samples(const RenderJob&);

/// Every pass gives a few more samples to every pixel, so a picture that is stopped is evenly
/// noisy. The finished films are bit-equal for any number of threads, and if they were stopped and
/// gone on with. False when it was stopped.
bool render(const RenderJob&);

}  // namespace regain::tools::preview
