// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The part of Table 1 that is about glass.

#pragma once

#include "figure.h"

namespace regain::tools::figures {

/// Adds its table, findings and numbers to the figure.
void add_glass(const Request& request, Figure& figure);

}  // namespace regain::tools::figures
