// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What an interrupted render has, to the last bit, so that going on gives the picture that it
/// would have been: an EXR of whole numbers beside the picture, and what it is a picture of.

#pragma once

#include "preview/film.h"

#include <filesystem>
#include <string>
#include <vector>

namespace regain::tools {

/// Films one below the other. Throws std::runtime_error that names the file.
void write_resume_file(const std::filesystem::path& file,
                       const std::vector<const preview::Film*>& films, const std::string& job);

/// Throws BadInput where the file is none, damaged, of other sizes, or of another job, which it
/// then says.
void read_resume_file(const std::filesystem::path& file, const std::vector<preview::Film*>& films,
                      const std::string& job);

}  // namespace regain::tools
