// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What a rough anisotropic interface between two dielectrics reflects and transmits in one
/// scattering: the integrals of dielectric_integral.h for a law of slopes that is stretched by ax
/// along x and by ay along y, in double precision.
///
/// Facets are taken by their slopes before stretching, (a, b), a along the stretched wo and b
/// across it. Weights P22(a, b) (mu + T a) / sigma(wo) then know nothing of the widths, T being the
/// length of (ax wo.x, ay wo.y); and for each b everything begins and ends where a quadratic of a
/// has its roots: wr and wt at the horizon, total reflection and, for eta > 1, where Fresnel's term
/// rises steeply.

#pragma once

#include <regain/closures/vector.h>
#include <regain/luts/dielectric_integral.h>

REGAIN_NAMESPACE_BEGIN
namespace luts {

/// `unit` is the law of alpha 1 of a distribution that is stretched without changing its form, GGX
/// or Beckmann. ax and ay in (0, 1], wo unit with wo.z in (0, 1], eta_o > 0 the index ahead of wo
/// over the index on its side. `nodes` along each piece: 24 give 2e-4, and 10 of GGX or 16 of
/// Beckmann 1e-4 but for places near a critical angle, where they give 6e-3.
REGAIN_LUTS_API DielectricAlbedo anisotropic_dielectric_albedo(const SlopeLaw& unit, double ax,
                                                               double ay, const Vec3<double>& wo,
                                                               double eta_o, int nodes = 16);

}  // namespace luts
REGAIN_NAMESPACE_END
