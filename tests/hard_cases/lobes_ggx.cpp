// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "kinds.h"
#include "lobes.h"

#include <regain/closures/ggx.h>

namespace regain::tests {

void add_ggx(std::vector<Kind<float>>& out)
{
    KindsOf<GGX<float>>(out, "ggx").add_all();
    KindsOf<GGX<Batch>>(out, "ggx").add_all();
}
void add_ggx(std::vector<Kind<double>>& out) { KindsOf<GGX<double>>(out, "ggx").add_all(); }

}  // namespace regain::tests
