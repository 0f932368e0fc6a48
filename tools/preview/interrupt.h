// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Ctrl-C as a request to stop soon and keep what there is.

#pragma once

#include <atomic>
#include <csignal>

namespace regain::tools {

/// While one lives, the first SIGINT or SIGTERM sets the flag; a second one ends the process as
/// usual. The former handlers come back afterwards. One at a time.
class InterruptGuard
{
public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    const std::atomic<bool>& flag() const;

private:
    struct sigaction _former_int, _former_term;
};

}  // namespace regain::tools
