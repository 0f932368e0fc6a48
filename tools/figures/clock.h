// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// How long closures take, side by side: all in one run, in turns, medians.

#pragma once

#include "figure.h"
#include "measures.h"

#include <functional>
#include <vector>

namespace regain::tools::figures {

/// Directions and numbers, the same for all. Both sides of the surface where `both_sides`.
struct Inputs
{
    static constexpr int count = 256;
    std::vector<Vec3<float>> wo, wi, u;

    explicit Inputs(bool both_sides = false);
};

/// Nanoseconds of eval and of sample, each with prepare; the argument is how often all inputs are
/// gone through.
struct Clocked
{
    std::function<double(int)> eval, sample;
};

struct Times
{
    double eval = 0, sample = 0;
};

/// `inputs` outlive the clock.
template <class Closure>
Clocked clock_of(const Closure& closure, const Inputs& inputs)
{
    Clocked c;
    c.eval = [closure, &inputs](int repeats) {
        return nanoseconds(repeats, Inputs::count, [&](int i) {
            const auto k = static_cast<std::size_t>(i);
            return double(evaluate(closure.prepare(inputs.wo[k]), inputs.wi[k], inputs.u[k]).y);
        });
    };
    c.sample = [closure, &inputs](int repeats) {
        return nanoseconds(repeats, Inputs::count, [&](int i) {
            const auto k = static_cast<std::size_t>(i);
            return double(closure.prepare(inputs.wo[k]).sample(inputs.u[k]).weight.y);
        });
    };
    return c;
}

/// Rounds of all in turn, so that a slow moment of the machine meets all of them; the median over
/// the rounds of each. What is slow takes fewer. Throws Stopped.
std::vector<Times> clocked(const std::vector<Clocked>& clocks, int rounds,
                           const std::function<bool()>& stopped);
std::vector<Times> clocked(const std::vector<Clocked>& clocks, const Request& request);

}  // namespace regain::tools::figures
