// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Results for people: one page that needs no other file and no network.

#pragma once

#include "fronts.h"
#include "results.h"

#include <string>
#include <utility>
#include <vector>

namespace regain::tools::cost {

/// HTML that is well-formed XML, too; plots as SVG, pictures as PNG within it.
std::string html_page(const Results&, const std::vector<Front>&);

/// The plot of each class and distribution: a name for a file, and SVG.
std::vector<std::pair<std::string, std::string>> plots(const std::vector<Front>&);

}  // namespace regain::tools::cost
