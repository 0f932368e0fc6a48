// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace regain::tools {

namespace {

using namespace std::chrono_literals;
constexpr auto kBarEvery = 100ms;
constexpr auto kLineEvery = 5s;

}  // namespace

Progress::Style Progress::style(bool quiet)
{
    if (quiet) return Style::Silent;
    return ::isatty(STDERR_FILENO) ? Style::Bar : Style::Lines;
}

Progress::Progress(std::string label, std::uint64_t total, Style style)
    : _label(std::move(label)),
      _total(std::max<std::uint64_t>(total, 1)),
      _style(style),
      _start(Clock::now()),
      _next(style == Style::Lines ? _start + kLineEvery : _start)
{}

Progress::~Progress()
{
    if (_style == Style::Bar && _shown) fmt::print(stderr, "\r\x1b[K");
}

void Progress::advance(std::uint64_t steps)
{
    if (_style == Style::Silent) return;
    const std::lock_guard<std::mutex> lock(_mutex);
    _done = std::min(_done + steps, _total);
    const Clock::time_point now = Clock::now();
    if (now < _next) return;
    _next = now + (_style == Style::Bar ? Clock::duration(kBarEvery) : Clock::duration(kLineEvery));
    show(now);
    _shown = true;
}

void Progress::show(Clock::time_point now) const
{
    const double share = static_cast<double>(_done) / static_cast<double>(_total);
    const double spent = std::chrono::duration<double>(now - _start).count();
    const std::string left =
        _done ? duration(spent * (1.0 / share - 1.0)) + " left" : std::string("starting");
    if (_style == Style::Lines)
    {
        fmt::print(stderr, "{}: {:.0f} %, {}\n", _label, 100.0 * share, left);
        return;
    }
    constexpr int kWidth = 32;
    const int filled = static_cast<int>(share * kWidth);
    fmt::print(stderr, "\r{} [{:=<{}}{: <{}}] {:3.0f} %  {}\x1b[K", _label, "", filled, "",
               kWidth - filled, 100.0 * share, left);
    std::fflush(stderr);
}

std::string Progress::duration(double seconds)
{
    const auto s = static_cast<long>(std::max(seconds, 0.0) + 0.5);
    if (s < 60) return fmt::format("{} s", s);
    if (s < 3600) return fmt::format("{} min {:02d} s", s / 60, s % 60);
    return fmt::format("{} h {:02d} min", s / 3600, s % 3600 / 60);
}

}  // namespace regain::tools
