// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "lobe_maker.h"

#include <regain/closures/beckmann.h>

namespace regain::tools::preview {

const LobeMaker beckmann_lobes = MakesLobes<WithDistribution<Beckmann>>::maker;

}  // namespace regain::tools::preview
