// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Whites, and the adaptation of colours from one to another by the linear Bradford transform
/// (Lam 1985, as ICC.1:2022 annex E states it):  B^-1 diag(B to / B from) B.

#pragma once

#include <regain/closures/version.h>
#include <regain/shaders/color.h>

#include <Imath/ImathColor.h>
#include <Imath/ImathMatrix.h>

REGAIN_NAMESPACE_BEGIN
namespace shaders {

/// XYZ, with Y = 1, of the chromaticity (x, y); y > 0.
inline C3d xyz_of_chromaticity(double x, double y) { return {x / y, 1.0, (1.0 - x - y) / y}; }

/// The white of D65 as Rec.709, sRGB and OpenColorIO use it: rounded to four digits.
inline C3d d65_white() { return xyz_of_chromaticity(0.3127, 0.3290); }

/// The white of ACES2065-1 and ACEScg (SMPTE ST 2065-1, about 6000 K).
inline C3d aces_white() { return xyz_of_chromaticity(0.32168, 0.33767); }

/// matrix * column; Imath's own product takes rows.
inline C3d times_column(const Imath::M33d& m, const C3d& v)
{
    return {m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z,
            m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z,
            m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z};
}

/// The matrix, for columns, that takes XYZ seen under the white `from` to XYZ seen under `to`. Both
/// whites are XYZ with positive entries, or the answer is meaningless. Takes `from` to `to`
/// exactly, up to rounding.
inline Imath::M33d bradford_adaptation(const C3d& from, const C3d& to)
{
    const Imath::M33d bradford(0.8951, 0.2664, -0.1614,   //
                               -0.7502, 1.7135, 0.0367,   //
                               0.0389, -0.0685, 1.0296);  //
    const C3d a = times_column(bradford, from), b = times_column(bradford, to);
    const Imath::M33d scale(b.x / a.x, 0, 0, 0, b.y / a.y, 0, 0, 0, b.z / a.z);
    return bradford.inverse() * scale * bradford;
}

}  // namespace shaders
REGAIN_NAMESPACE_END
