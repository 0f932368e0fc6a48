// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The formulas of regain/closures/analytic_albedo.h as shader source, for renderers that have no
/// room for tables.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace regain::tools {

/// Every function in a file: regain_ggx_E_ss and so on.
std::vector<std::string> exported_functions();

/// The text of a file in a language, "glsl" or "osl".
std::string exported_fits(const std::string& language);

/// The language that goes with a file's extension. Throws BadInput, which names those there are,
/// for any other.
std::string export_language(const std::filesystem::path& file);

/// Writes the text whole or not at all.
void export_fits(const std::filesystem::path& file);

}  // namespace regain::tools
