// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "kinds.h"
#include "lobes.h"

#include <regain/closures/gtr.h>

namespace regain::tests {

void add_gtr(std::vector<Kind<float>>& out) { KindsOf<GTR<float>>(out, "gtr").add_all(); }
void add_gtr(std::vector<Kind<double>>& out) { KindsOf<GTR<double>>(out, "gtr").add_all(); }

}  // namespace regain::tests
