// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Baking one table, with progress on standard error and an end to it on Ctrl-C.

#pragma once

#include "preview/interrupt.h"

#include <regain/luts/table.h>

#include <string>

namespace regain::tools {

/// Whether luts::bake knows the name.
bool is_table(const std::string& name);

/// Throws luts::BakeStopped after an interrupt.
luts::Table bake_showing(const std::string& name, const InterruptGuard& guard);

}  // namespace regain::tools
