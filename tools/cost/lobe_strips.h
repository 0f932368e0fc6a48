// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Where a lobe differs from the walk's, for eyes.

#pragma once

#include "../picture.h"
#include "measure.h"

namespace regain::tools::cost {

/// What the ends of the colours mean: a share of the walk's brightest bin.
constexpr double strip_scale = 0.1;

/// The lobe minus the walk: a disc for each of shape_cosines, red where the lobe has too much, blue
/// where it has too little. A disc is the hemisphere seen from above, in equal areas, the mirror
/// direction to the right; where anything is transmitted, a second row has the other side.
DisplayPicture lobe_strip(const Lobe&, const Lobe& walk, const Part&);

}  // namespace regain::tools::cost
