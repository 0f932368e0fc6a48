// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Exit codes of every command, and the exceptions that lead to them.

#pragma once

#include <functional>
#include <stdexcept>

namespace regain::tools {

enum ExitCode { kDone = 0, kCheckFailed = 1, kBadInput = 2, kInterrupted = 130 };

/// What the user gave cannot be used; the message says what was given, what is accepted, and what
/// to do. Exit code 2.
struct BadInput : std::runtime_error
{
    using std::runtime_error::runtime_error;
};

/// A check that the user asked for did not pass. Exit code 1.
struct CheckFailed : std::runtime_error
{
    using std::runtime_error::runtime_error;
};

/// Runs a command and turns whatever it throws into one line on standard error and an exit code.
int run_reporting(const std::function<int()>& command);

}  // namespace regain::tools
