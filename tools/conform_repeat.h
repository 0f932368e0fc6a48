// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The kit's own test: of closures with nothing wrong, how many runs raise an alarm?

#pragma once

#include <regain/conformance/run.h>

#include <functional>
#include <string>
#include <vector>

namespace regain::tools {

struct Alarm
{
    std::uint64_t salt;
    std::string subject, check, setting, reproduce;
};

struct Repetition
{
    std::size_t runs = 0, runs_with_alarm = 0;
    double expected = 0;  ///< runs with an alarm, if nothing is wrong
    double odds = 1;      ///< of at least as many
    bool interrupted = false;
    std::vector<Alarm> alarms;

    /// Too many to be chance.
    bool passed() const { return !interrupted && odds >= 1e-3; }
};

/// Runs those checks of `options` that random numbers decide, all where it names none, with salts 1
/// to `runs`. Throws std::invalid_argument as conformance::run does, and where it names a check
/// that chance has no part in. `progress` is called with the fraction done; false stops.
Repetition repeat(const std::vector<const conformance::Subject*>& subjects,
                  conformance::Options options, std::size_t runs,
                  const std::function<bool(double)>& progress);

/// "3 of 1000 runs raised a false alarm; ...", then each alarm.
std::string text(const Repetition& repetition);
std::string json(const Repetition& repetition);

}  // namespace regain::tools
