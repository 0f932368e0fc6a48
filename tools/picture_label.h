// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Words on pictures.

#pragma once

#include "picture.h"

#include <string>

namespace regain::tools {

/// A font of this machine that labels can be set in; empty where it has none of those that are
/// looked for (REGAIN_FONT names another).
std::string label_font();

/// Sets `text` into the picture, its middle at x and its base line at y, both in pixels, in letters
/// `size` pixels high; `value` is their scene-linear grey. What does not fit is cut off. False
/// where there is no font, or the text cannot be set.
bool set_label(Picture&, const std::string& text, int x, int y, int size, float value = 0.8f);

}  // namespace regain::tools
