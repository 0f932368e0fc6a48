// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Tables as OpenEXR files: one channel "Y" of width x height pixels, the slices of a third
/// axis below each other, "regain:depth" of them, and every field of TableInfo as an attribute
/// "regain:FIELD" of the header. The channel is of half floats where that loses nothing.

#pragma once

#include <regain/luts/table.h>

#include <filesystem>

REGAIN_NAMESPACE_BEGIN
namespace luts {

/// Writes the table whole or not at all; throws std::runtime_error that names the file.
REGAIN_LUTS_API void write_table(const std::filesystem::path& file, const Table& table);

/// Reads a table. Throws std::runtime_error that names the file and says what is wrong with it: not
/// there, no EXR file, cut short, no table of this project, an attribute missing, a number that is
/// not finite or out of range, or a definition other than table_definition (a stale table).
REGAIN_LUTS_API Table read_table(const std::filesystem::path& file);

}  // namespace luts
REGAIN_NAMESPACE_END
