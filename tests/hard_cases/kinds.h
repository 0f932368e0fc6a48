// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The parts of the list of kinds, each in a file of its own because it takes long to compile.

#pragma once

#include "subject.h"

namespace regain::tests {

/// clang's -ffast-math reorders the sums by which xsimd keeps the digits of exponentials: those are
/// off by per cents, and so is what is made of them. See docs/support.md.
#if defined(__clang__) && defined(__FAST_MATH__)
constexpr bool vectors_are_promised = false;
#else
constexpr bool vectors_are_promised = true;
#endif

void add_ggx(std::vector<Kind<float>>& out);
void add_ggx(std::vector<Kind<double>>& out);
void add_beckmann(std::vector<Kind<float>>& out);
void add_beckmann(std::vector<Kind<double>>& out);
void add_gtr(std::vector<Kind<float>>& out);
void add_gtr(std::vector<Kind<double>>& out);
void add_std(std::vector<Kind<float>>& out);
void add_std(std::vector<Kind<double>>& out);

}  // namespace regain::tests
