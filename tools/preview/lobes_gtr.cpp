// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "lobe_maker.h"

#include <regain/closures/gtr.h>

namespace regain::tools::preview {

const LobeMaker gtr_lobes = MakesLobes<WithDistribution<GTR>>::maker;

}  // namespace regain::tools::preview
