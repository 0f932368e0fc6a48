// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The colour type of the colour computations, which are done in double; Imath names none.

#pragma once

#include <regain/closures/version.h>

#include <Imath/ImathColor.h>

#include <algorithm>
#include <cmath>

REGAIN_NAMESPACE_BEGIN
namespace shaders {

using C3d = Imath::Color3<double>;

/// A colour in [0, 1] in the place of one that the working space has no light for. Where a channel
/// is above 1, all are divided by its 3/4th power before they are limited: for gold in Rec. 709,
/// whose red is 1.038, the nearest colour by CIEDE2000 is such a one, 0.77 away, where limiting the
/// red alone is 1.28 and darkening alone 0.85. NaN becomes 0.
inline C3d limited_to_unit(const C3d& color)
{
    const double most = std::max({color.x, color.y, color.z, 1.0}),
                 scale = most < 1e30 ? std::pow(most, -0.75) : 1;
    C3d limited;
    for (int c = 0; c < 3; ++c)
    {
        const double v = color[c] * scale;
        limited[c] = v > 0 ? std::min(v, 1.0) : 0;
    }
    return limited;
}

}  // namespace shaders
REGAIN_NAMESPACE_END
