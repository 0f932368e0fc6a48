// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The colour of a reflectance spectrum R(lambda) under D65, as the CIE 1931 2-degree observer sees
/// it (CIE 015:2018, section 7):
///
///   (X, Y, Z) = sum R S (xbar, ybar, zbar) / sum R=1: S ybar     over 380, 381, ... 780 nm
///
/// S, tabulated each 5 nm, is interpolated linearly to the observer's 1 nm. What lies outside 380
/// to 780 nm is left out: it holds 3e-6 of Y.

#pragma once

#include <regain/closures/version.h>
#include <regain/shaders/color.h>
#include <regain/shaders/export.h>

#include <functional>

REGAIN_NAMESPACE_BEGIN
namespace shaders {

/// The wavelengths, in nm, at which a spectrum is looked at: first, first + 1, ... last.
constexpr int first_wavelength = 380;
constexpr int last_wavelength = 780;

/// Weights w(lambda) with  sum R(lambda) w(lambda) = XYZ  of the reflectance R, adapted by Bradford
/// from the white that the tables give to d65_white() (the two differ in the fourth digit), so that
/// a perfect reflector is exactly that white, with Y = 1. The wavelength, in nm, is taken as an
/// integer in [380, 780]; outside it the weight is 0.
REGAIN_SHADERS_API C3d xyz_d65_weight(int wavelength);

/// XYZ of a reflectance, with those weights. `reflectance` is called once for each wavelength in
/// nm; its values, in [0, 1] for a real surface, are taken as they are.
REGAIN_SHADERS_API C3d
xyz_d65_of_reflectance(const std::function<double(int wavelength)>& reflectance);

}  // namespace shaders
REGAIN_NAMESPACE_END
