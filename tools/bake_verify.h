// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// `regain bake --verify`: which of the shipped tables are no longer what baking gives.

#pragma once

#include "preview/interrupt.h"

#include <string>
#include <vector>

namespace regain::tools {

/// Checks the tables that are `given` by name, compiled in or in the file that the library would
/// load, and EXR files (all compiled-in tables, if none is given) and prints a report. spots > 0:
/// at that many places only, without baking. Throws CheckFailed where a table differs.
int verify_tables(const std::vector<std::string>& given, int spots, bool json,
                  const InterruptGuard& guard);

}  // namespace regain::tools
