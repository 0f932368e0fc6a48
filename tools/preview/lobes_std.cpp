// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "lobe_maker.h"

#include <regain/closures/std.h>

namespace regain::tools::preview {

const LobeMaker std_lobes = MakesLobes<WithDistribution<STD>>::maker;

}  // namespace regain::tools::preview
