// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Progress of long work on standard error: a bar with the time left on a terminal, a line every
/// few seconds otherwise.

#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

namespace regain::tools {

class Progress
{
public:
    enum class Style { Silent, Bar, Lines };

    /// Silent when `quiet`, otherwise by what standard error is.
    static Style style(bool quiet);

    Progress(std::string label, std::uint64_t total, Style);
    ~Progress();  ///< clears the bar
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Any number of threads.
    void advance(std::uint64_t steps = 1);

    /// "3 s", "2 min 05 s", "1 h 02 min".
    static std::string duration(double seconds);

private:
    using Clock = std::chrono::steady_clock;
    void show(Clock::time_point now) const;

    const std::string _label;
    const std::uint64_t _total;
    const Style _style;
    const Clock::time_point _start;
    std::mutex _mutex;
    std::uint64_t _done = 0;
    Clock::time_point _next;
    bool _shown = false;
};

}  // namespace regain::tools
