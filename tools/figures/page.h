// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Figures on paper: a page for people, and the same as JSON for machines.

#pragma once

#include "figure.h"

namespace regain::tools::figures {

/// One HTML page that needs nothing but the pictures beside it.
std::string html_page(const std::vector<Figure>& figures);

nlohmann::ordered_json as_json(const Figure& figure);

/// Title, findings and tables for a terminal.
std::string as_text(const Figure& figure);

}  // namespace regain::tools::figures
