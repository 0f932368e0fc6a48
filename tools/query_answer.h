// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What `regain query` answers: one JSON object a line, numbers in the shortest form that reads
/// back as the same number.

#pragma once

#include <fmt/format.h>

#include <string_view>

namespace regain::tools {

struct Query;

/// Appends the answer without a line end. Throws BadInput where there is none; `out` may then hold
/// a part of it.
void write_answer(const Query& query, fmt::memory_buffer& out);

/// Reads the line and appends its answer, or {"error": ...}. Returns whether it was an answer.
bool answer_line(std::string_view line, fmt::memory_buffer& out);

/// Appends {"error": message}.
void write_error(std::string_view message, fmt::memory_buffer& out);

}  // namespace regain::tools
