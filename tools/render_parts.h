// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What a part of a render has: the sums of its pixels, to the last bit.

#pragma once

#include "part_file.h"
#include "preview/film.h"

#include <filesystem>
#include <string>
#include <vector>

namespace regain::tools {

/// Films one below the other, of which the tiles of the part are done.
void write_render_part(const std::filesystem::path& file, const std::vector<preview::Film*>& films,
                       const JobDescription& job, const Part& part);

/// Fills the films. Throws as all_parts does.
void merge_render_parts(const std::vector<std::string>& files,
                        const std::vector<preview::Film*>& films, const JobDescription& job);

}  // namespace regain::tools
