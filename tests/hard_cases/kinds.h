// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The parts of the list of kinds, each in a file of its own because it takes long to compile.

#pragma once

#include "subject.h"

namespace regain::tests {

void add_ggx(std::vector<Kind<float>>& out);
void add_ggx(std::vector<Kind<double>>& out);
void add_beckmann(std::vector<Kind<float>>& out);
void add_beckmann(std::vector<Kind<double>>& out);
void add_gtr(std::vector<Kind<float>>& out);
void add_gtr(std::vector<Kind<double>>& out);
void add_std(std::vector<Kind<float>>& out);
void add_std(std::vector<Kind<double>>& out);

}  // namespace regain::tests
