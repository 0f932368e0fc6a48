// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// All variants of the kinds of a list on one machine, as functions that know no type of closure.

#pragma once

#include "question.h"

#include <functional>
#include <string>
#include <vector>

namespace regain::tests {

/// A surface's tables are in the CPU's memory, on either machine.
using Ask = std::function<std::vector<Answer>(const Surface&, const std::vector<Question>&)>;

struct Subject
{
    std::string name;
    bool walks;  ///< see kinds.h
    Ask ask;
};

template <class... Kinds>
struct List;

/// ask(Kind(), variant) makes an Ask.
template <class MakeAsk, class... Kinds>
std::vector<Subject> subjects_of(List<Kinds...>, const MakeAsk& ask)
{
    std::vector<Subject> subjects;
    const auto add = [&](auto kind) {
        using Kind = decltype(kind);
        for (int v = 0; v < Kind::variants; ++v)
            subjects.push_back({Kind::name(v), Kind::walks, ask(kind, v)});
    };
    (add(Kinds()), ...);
    return subjects;
}

// One source each: see CMakeLists.txt.
std::vector<Subject> ggx_on_cpu();
std::vector<Subject> ggx_on_gpu();
std::vector<Subject> beckmann_on_cpu();
std::vector<Subject> beckmann_on_gpu();
std::vector<Subject> gtr_on_cpu();
std::vector<Subject> gtr_on_gpu();
std::vector<Subject> std_on_cpu();
std::vector<Subject> std_on_gpu();
std::vector<Subject> plain_on_cpu();
std::vector<Subject> plain_on_gpu();

/// Why nothing can run on a GPU here; empty where it can.
std::string why_no_gpu();

}  // namespace regain::tests
