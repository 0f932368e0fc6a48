// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// On what times were measured: processor and compiler. No name by which a machine is known.

#pragma once

#include <string>

namespace regain::tools::cost {

std::string processor();  ///< its model; "unknown" where nothing says it
int processors();
std::string compiler();

}  // namespace regain::tools::cost
