// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// `regain cost` in parts: the errors of some of its cases. Times are the merge's to take, on one
/// machine, or they could not be compared.

#pragma once

#include "cost/run.h"
#include "part_file.h"

#include <filesystem>
#include <string>
#include <vector>

namespace regain::tools {

/// What decides the errors.
JobDescription cost_job(const cost::RunOptions&);

/// Of all cases those that are the part's.
std::vector<cost::Case> cases_of(const std::vector<cost::Case>&, const Part&);

/// Measures them. Throws figures::Stopped, and then writes nothing.
void write_cost_part(const std::filesystem::path& file, const std::vector<cost::Case>& cases,
                     const cost::RunOptions&, const Part&);

/// The errors of all cases, in their order. Throws as all_parts does.
std::vector<cost::CaseErrors> merge_cost_parts(const std::vector<std::string>& files,
                                               const std::vector<cost::Case>& cases,
                                               const cost::RunOptions&);

}  // namespace regain::tools
