// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What reports say in words.

#pragma once

#include <regain/conformance/report.h>

#include <functional>

REGAIN_NAMESPACE_BEGIN
namespace conformance {

/// Three digits.
std::string short_number(double x);

/// Of a failure: how much was measured, what is accepted, how likely that is by chance.
std::string in_short(const Failure& failure);

/// "12 subjects, tier commit, interrupted: 30 checks passed, 1 failed, 4 not applicable"
std::string counts(const Report& report);

/// Calls `visit` with the verdicts of each subject, as [first, last).
using Verdicts = std::vector<Verdict>::const_iterator;
void for_each_subject(const Report& report, const std::function<void(Verdicts, Verdicts)>& visit);

/// Writes a file whole or not at all; throws std::runtime_error that names it.
void write_text(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write);

}  // namespace conformance
REGAIN_NAMESPACE_END
