// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The elements that plots are drawn of. Lengths in pixels, y downwards.

#pragma once

#include <Imath/ImathVec.h>

#include <string>

namespace regain::tools::figures {

/// anchor: "start", "middle" or "end".
std::string svg_text(double x, double y, const std::string& anchor, const std::string& words);

/// style: attributes, as stroke="black".
std::string svg_line(const Imath::V2d& a, const Imath::V2d& b, const std::string& style);

/// A whole picture, white behind `body`.
std::string svg_document(double width, double height, const std::string& body);

}  // namespace regain::tools::figures
