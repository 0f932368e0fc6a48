// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "kinds.h"
#include "lobes.h"

#include <regain/closures/beckmann.h>

namespace regain::tests {

void add_beckmann(std::vector<Kind<float>>& out)
{
    KindsOf<Beckmann<float>>(out, "beckmann").add_all();
    KindsOf<Beckmann<Batch>>(out, "beckmann").add_all();
}
void add_beckmann(std::vector<Kind<double>>& out)
{
    KindsOf<Beckmann<double>>(out, "beckmann").add_all();
}

}  // namespace regain::tests
