// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// How far a picture is from another, for eyes: white where it is the same, red where it is more,
/// blue where it is less, with a bar that says how much the colours mean.

#pragma once

#include "picture.h"

namespace regain::tools {

struct Difference
{
    double most = 0;  ///< largest of a channel, its sign left out
    double rms = 0;   ///< over all pixels and channels
};

Difference difference_of(const Picture& a, const Picture& b);

/// From -1 (blue) over 0 (white) to 1 (red), as a display takes it; what is beyond is an end.
Imath::C3f difference_colour(double t);

/// a - b, in the mean of the channels, from -scale (blue) to scale (red); a bar below it is
/// labelled where there is a font. Pictures are of one size, scale above 0.
DisplayPicture false_colour(const Picture& a, const Picture& b, double scale);

}  // namespace regain::tools
