// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The way from XYZ to a config's scene_linear as a matrix, for what is measured in XYZ.

#pragma once

#include <regain/shaders/color_config.h>

#include <Imath/ImathMatrix.h>

namespace regain::tests {

/// Of column vectors, from XYZ by D65.
inline Imath::M33d to_working_space(const shaders::ColorConfig& config)
{
    Imath::M33d m;
    for (int k = 0; k < 3; ++k)
    {
        shaders::C3d unit(0.0);
        unit[k] = 1;
        const shaders::C3d column = config.to_scene_linear_from_xyz_d65(unit);
        for (int row = 0; row < 3; ++row) m[row][k] = column[row];
    }
    return m;
}

}  // namespace regain::tests
