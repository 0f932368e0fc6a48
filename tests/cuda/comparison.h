// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// When the answers of another machine are those of the CPU.
///
/// All numbers agree but for rounding, and two matters of luck. A distribution with a tail draws
/// from a stream that is hashed from its random numbers, and where a lobe was picked by one of them
/// before, its rounding makes it another stream; so a sample may be another one, of which the CPU
/// has to say the same value and density. Of a random walk, which compares many random numbers with
/// what was rounded, a few answers may be others altogether.

#pragma once

#include "subjects.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace regain::tests {

/// Relative, of what a narrow lobe makes of rounding; and absolute, of small sums of larger terms.
constexpr float relative_tolerance = 2e-3f, absolute_tolerance = 2e-5f;
/// The shares of all answers that may be others.
constexpr double other_samples = 0.25, other_walks = 0.05;

inline bool same_number(float a, float b)
{
    return std::abs(a - b) <=
           absolute_tolerance + relative_tolerance * std::max(std::abs(a), std::abs(b));
}

/// The first number from `begin` to `end` that differs; -1 where none does.
inline int first_difference(const Answer& a, const Answer& b, int begin, int end)
{
    for (int k = begin; k < end; ++k)
        if (!same_number(a.numbers[k], b.numbers[k])) return k;
    return -1;
}

/// Whether a sample that was found has the value and density that `there`, the CPU's answer about
/// its direction, says.
inline bool is_a_sample_of(const Answer& there, const Answer& found)
{
    const float *n = found.numbers, density = n[Answer::sample_pdf];
    if (n[Answer::valid] == 0) return density == 0;
    bool same = same_number(there.numbers[Answer::pdf], density);
    for (int channel = 0; channel < 3; ++channel)
        same = same && same_number(there.numbers[Answer::value + channel],
                                   n[Answer::weight + channel] * density);
    return same;
}

/// What differs, a line for each question; empty where nothing does that should not.
inline std::string differences(const Subject& cpu, const Surface& surface,
                               const std::vector<Question>& questions,
                               const std::vector<Answer>& found)
{
    std::vector<Question> about_samples = questions;
    for (std::size_t i = 0; i < questions.size(); ++i)
    {
        const float* w = found[i].numbers + Answer::direction;
        about_samples[i].wi = {w[0], w[1], w[2]};
    }
    const std::vector<Answer> expected = cpu.ask(surface, questions),
                              there = cpu.ask(surface, about_samples);
    std::ostringstream text;
    std::size_t others = 0;
    bool wrong = false;
    for (std::size_t i = 0; i < questions.size(); ++i)
    {
        int k = first_difference(expected[i], found[i], 0, Answer::direction);
        if (k < 0) k = first_difference(expected[i], found[i], Answer::after_sample, Answer::size);
        bool luck = cpu.walks;
        if (k < 0)
        {
            k = first_difference(expected[i], found[i], Answer::direction, Answer::after_sample);
            const bool elsewhere =
                first_difference(expected[i], found[i], Answer::direction, Answer::weight) >= 0;
            luck = luck || (elsewhere && is_a_sample_of(there[i], found[i]));
        }
        if (k < 0) continue;
        text << "question " << i << ", " << name_of_number(k) << ": " << found[i].numbers[k]
             << " in place of " << expected[i].numbers[k] << '\n';
        if (luck)
            ++others;
        else
            wrong = true;
    }
    const double allowed = cpu.walks ? other_walks : other_samples;
    wrong = wrong || static_cast<double>(others) > allowed * static_cast<double>(questions.size());
    return wrong ? text.str() : "";
}

}  // namespace regain::tests
