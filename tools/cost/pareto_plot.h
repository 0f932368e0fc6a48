// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Fronts as a picture: time to the right, error upwards, both by their logarithm; each method a
/// named dot, those on the front joined.

#pragma once

#include "fronts.h"

#include <string>
#include <vector>

namespace regain::tools::cost {

/// SVG, a panel for each front, side by side with the same axes. `title` stands above.
std::string pareto_plot(const std::string& title, const std::vector<Front>&);

}  // namespace regain::tools::cost
