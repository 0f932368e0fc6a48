// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What a part of `regain conform` has found, with everything that any report says of it.

#pragma once

#include "part_file.h"

#include <regain/conformance/report.h>
#include <regain/conformance/subject.h>

#include <filesystem>
#include <string>
#include <vector>

namespace regain::tools {

void write_conform_part(const std::filesystem::path& file, const conformance::Report& report,
                        const JobDescription& job, const Part& part);

/// The report of one run over all subjects, in their order; its time is that of all parts. Throws
/// as all_parts does.
conformance::Report merge_conform_parts(const std::vector<std::string>& files,
                                        const JobDescription& job,
                                        const std::vector<const conformance::Subject*>& subjects);

}  // namespace regain::tools
