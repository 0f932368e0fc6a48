// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "kinds.h"
#include "lobes.h"

#include <regain/closures/std.h>

namespace regain::tests {

void add_std(std::vector<Kind<float>>& out) { KindsOf<STD<float>>(out, "std").add_all(); }
void add_std(std::vector<Kind<double>>& out) { KindsOf<STD<double>>(out, "std").add_all(); }

}  // namespace regain::tests
