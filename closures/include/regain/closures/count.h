// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What shading does, counted, for tests that something is not done: only where REGAIN_COUNT is
/// defined, which a whole program has to be compiled with; its names are then in an inline
/// namespace of their own, so nothing else links with it. Otherwise nothing is counted or compiled.
/// Closures of vectors count once for all lanes.

#pragma once

#include <regain/closures/version.h>

#ifdef REGAIN_COUNT

#include <atomic>

REGAIN_NAMESPACE_BEGIN

struct Counts
{
    std::atomic<long> closures{0};  ///< that shaders::ClosureTree built
    std::atomic<long> gains{0};     ///< gains computed, and added lobes prepared
    std::atomic<long> bounces{0};   ///< steps of walks from one facet to the next, or away
};
inline Counts counts;

REGAIN_NAMESPACE_END

#define REGAIN_COUNTED(what) regain::counts.what.fetch_add(1, std::memory_order_relaxed)

#else

#define REGAIN_COUNTED(what) static_cast<void>(0)

#endif
