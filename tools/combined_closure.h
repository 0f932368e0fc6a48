// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// MaterialX's layer, mix, add and multiply of closures that are known at run time only: what
/// layer.h has for those whose types are known.

#pragma once

#include "any_closure.h"

namespace regain::tools {

/// Throws BadInput as make_closure does, for either part.
std::unique_ptr<AnyClosure> make_combined_closure(const ClosureSpec&);

}  // namespace regain::tools
