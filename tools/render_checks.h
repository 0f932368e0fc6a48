// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Checks of single options of `regain render`. Each throws BadInput: "OPTION GIVEN: ACCEPTED".

#pragma once

#include "render_options.h"

#include <regain/shaders/microfacet_material.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace regain::tools {

[[noreturn]] void refuse(const std::string& option, const std::string& given,
                         const std::string& accepted);

void check_count(const char* option, std::int64_t value, std::int64_t least, std::int64_t most);

/// `least_means` is put behind the least number in the message.
void check_number(const char* option, double value, double least, double most,
                  const char* least_means = "");

/// 1 to 16 numbers in [0, 1].
void check_list(const char* option, const std::vector<double>& values,
                const char* least_means = "");

/// The methods of that list, divided by commas; none of an empty one.
std::vector<shaders::Compensation> methods_named(const std::string& list);

/// --set of documents: "INPUT=VALUE" as a pair.
std::vector<std::pair<std::string, std::string>> overrides_of(const std::vector<std::string>&);

/// What belongs to other materials than the one chosen is not passed over in silence.
void check_belongings(const RenderOptions&);

/// The place of what is given among `names`, as an enumerator.
template <class Value, std::size_t n>
Value chosen(const char* option, const std::string& given, const char* what,
             const char* const (&names)[n])
{
    for (std::size_t i = 0; i < n; ++i)
        if (given == names[i]) return static_cast<Value>(i);
    refuse(option, given, fmt::format("no such {}; there are {}", what, fmt::join(names, ", ")));
}

}  // namespace regain::tools
