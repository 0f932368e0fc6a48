// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Presets: MaterialX documents that come with the library, each with what it is and where its
/// numbers are from. A preset is known by the name of its file without the ending.

#pragma once

#include <regain/closures/version.h>
#include <regain/shaders/export.h>

#include <filesystem>
#include <string>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace shaders {

/// Where presets are looked for, in order: the folders of the environment variable REGAIN_PRESETS,
/// divided by colons, `presets` beside the folders of tables (regain/luts/library.h), the source.
REGAIN_SHADERS_API std::vector<std::filesystem::path> preset_folders();

/// Names of all there are, sorted; of the same name the first counts.
REGAIN_SHADERS_API std::vector<std::string> preset_names();

/// Throws DocumentError, which says which there are, where there is no such preset.
REGAIN_SHADERS_API std::filesystem::path preset_file(const std::string& name);

/// A file of that name; where there is none and it is no path, the preset. Throws as preset_file.
REGAIN_SHADERS_API std::filesystem::path document_or_preset(const std::string& name);

}  // namespace shaders
REGAIN_NAMESPACE_END
