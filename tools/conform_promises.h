// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What the library promises of its closures in numbers, as docs/support.md says it.

#pragma once

#include "closure_spec.h"

#include <regain/conformance/subject.h>

namespace regain::tools {

/// `spec` with all its parameters; wo unit.
conformance::Promises promises_of(const ClosureSpec& spec, const Imath::V3d& wo);

}  // namespace regain::tools
