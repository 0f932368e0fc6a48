// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Whether a preset is a material that could be: numbers in the range that they have in nature,
/// light kept, and a word on where it is from.

#pragma once

#include <regain/shaders/document.h>

#include <string>
#include <vector>

namespace regain::tools {

/// What is wrong with a preset, a sentence each; empty where nothing is. Of every material of it:
///  - `doc`, `kind` and `source` say what it is and where its numbers are from
///  - nothing of it is shown otherwise than the document says, but subsurface as diffuse
///  - colours are in [0, 1], widths in [0, 1], indices of glass from 1 to 3
///  - metals reflect from 0.15 to 1 in every channel at normal incidence
///  - no direction of six gives back more light than came, by its closures' albedos
/// The first fault of a material that cannot be read is why.
std::vector<std::string> preset_faults(const std::string& name,
                                       const shaders::DocumentSettings& settings);

}  // namespace regain::tools
