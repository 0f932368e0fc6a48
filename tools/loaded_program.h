// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Which program this is, to the bit, and which instructions it runs by: what results that are to
/// be the same to the bit depend on.

#pragma once

#include <string>

namespace regain::tools {

/// A hash of the build identifiers that linkers give to programs and libraries, over all that are
/// loaded now.
std::string loaded_program();

/// The set that wide closures are chosen from, and what other libraries choose theirs by:
/// "avx2; x86_64 sse4.2 avx avx2 fma".
std::string instruction_set();

}  // namespace regain::tools
