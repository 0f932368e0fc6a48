// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "interrupt.h"

namespace regain::tools {

namespace {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler sets it");

extern "C" void on_interrupt(int) { interrupted.store(true); }

}  // namespace

InterruptGuard::InterruptGuard()
{
    interrupted.store(false);
    struct sigaction action = {};
    action.sa_handler = on_interrupt;
    // Reset: whoever presses twice wants out at once.
    action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, &_former_int);
    sigaction(SIGTERM, &action, &_former_term);
}

InterruptGuard::~InterruptGuard()
{
    sigaction(SIGINT, &_former_int, nullptr);
    sigaction(SIGTERM, &_former_term, nullptr);
}

const std::atomic<bool>& InterruptGuard::flag() const { return interrupted; }

}  // namespace regain::tools
