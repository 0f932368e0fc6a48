// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A run of `regain cost`: errors on all threads, then times on one, then pictures.

#pragma once

#include "results.h"

namespace regain::tools::cost {

struct RunOptions
{
    Choice choice;
    bool quick = false;
    std::uint64_t samples = 32768;  ///< of each direction; the walk takes four times as many
    double seconds_per_picture = 4;
    /// Seed, threads, progress and stop. Errors are the same for any number of threads.
    figures::Request request;
};

/// Throws figures::Stopped.
Results run(const RunOptions&);

}  // namespace regain::tools::cost
