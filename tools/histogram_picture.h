// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A histogram of the conformance kit for eyes: found, expected and their difference side by side.

#pragma once

#include <regain/conformance/report.h>

namespace regain::tools {

/// PNG. Counts go by their square root, whose noise is the same everywhere, from dark blue (none)
/// to yellow (the most that either has); the difference by the standard deviation of a count, from
/// blue (5 too few) over white to red (5 too many). Throws std::runtime_error where the file cannot
/// be written, or its name does not end in .png.
void write_histogram_picture(const std::filesystem::path& file,
                             const conformance::Histogram& histogram);

}  // namespace regain::tools
