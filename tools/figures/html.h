// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What pages of measurements are made of.

#pragma once

#include "figure.h"

#include <string>

namespace regain::tools::figures {

/// Text as it stands in HTML and SVG, quotes too.
std::string escaped(const std::string& text);

std::string html_table(const Table& table);

/// CSS of all pages.
extern const char* const page_style;

}  // namespace regain::tools::figures
