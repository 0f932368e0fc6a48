// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#pragma once

#include <regain/closures/version.h>

#include <filesystem>

REGAIN_NAMESPACE_BEGIN
namespace luts {

/// Throws std::runtime_error where the header of an EXR file says what no table's does. OpenEXR
/// takes memory for all that a header says before it looks whether the file has as much, so that a
/// broken file of a kilobyte would cost gigabytes. What is no EXR file at all is left to OpenEXR.
void require_header_of_table(const std::filesystem::path& file);

}  // namespace luts
REGAIN_NAMESPACE_END
