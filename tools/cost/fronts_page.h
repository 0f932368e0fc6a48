// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The fronts as a page of Markdown, for documentation that people read where it is stored.

#pragma once

#include "fronts.h"

#include <string>
#include <vector>

namespace regain::tools::cost {

/// One table for each distribution, of classes by roughness, and what each front says in words.
std::string fronts_page(const Results&, const std::vector<Front>&);

}  // namespace regain::tools::cost
