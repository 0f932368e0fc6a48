// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "lobe_maker.h"

#include <regain/closures/ggx.h>

namespace regain::tools::preview {

const LobeMaker ggx_lobes = MakesLobes<WithDistribution<GGX>>::maker;

}  // namespace regain::tools::preview
