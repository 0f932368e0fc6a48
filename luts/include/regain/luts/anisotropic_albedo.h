// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Single-scattering albedo, F = 1, of a rough mirror whose slopes are those of an isotropic law,
/// stretched along x and y: what albedo_integral.h does for the law itself.
///
/// The integral is taken over the slopes before stretching, which have the density of the law.
/// Smith's projected area of a direction w is then that of (s_x w.x, s_y w.y, w.z) under the law.

#pragma once

#include <regain/closures/vector.h>
#include <regain/luts/slope_law.h>

REGAIN_NAMESPACE_BEGIN
namespace luts {

/// Stretches are positive, w is unit, w.z in (0, 1]. Of `nodes` a piece 14 are good to 3e-4
/// relative, 24 to 5e-5, with widths up to 20 : 1.
REGAIN_LUTS_API double anisotropic_albedo(const SlopeLaw& law, double stretch_x, double stretch_y,
                                          const Vec3<double>& w, int nodes = 24);

}  // namespace luts
REGAIN_NAMESPACE_END
