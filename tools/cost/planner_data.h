// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The price list for machines: of each class, distribution and method the largest error of the
/// albedo by alpha and material, and its time and tables. docs/cost.md describes it.

#pragma once

#include "results.h"

#include <string>

namespace regain::tools::cost {

/// JSON, an entry a line. Without the times of pictures, shapes and what else no plan reads.
std::string planner_data(const Results&);

}  // namespace regain::tools::cost
