// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What a rough interface between two dielectrics reflects and transmits in one scattering, in
/// double precision and without any of the closures' code but their rule for which pairs of
/// directions a facet joins (refraction.h), so that tables and closures leave out the same:
///
///   E^R(wo) = int D_visible(m) F(wo.m) G2(wo, wr) / G1(wo) dm          over wr above the surface
///   E^T(wo) = int D_visible(m) (1 - F(wo.m)) G2(wo, wt) / G1(wo) dm    over wt below it
///
/// (Turquin 2019, Eq. 17; Walter et al. 2007), energies, with exact unpolarised Fresnel F, Smith's
/// D_visible(m) = max(0, wo.m) D(m) / sigma(wo), and for G2
///
///   1 / (1 + Lambda_o + Lambda_i)          reflection; transmission, "correlated"
///   B(1 + Lambda_o, 1 + Lambda_i)          transmission, "beta" (Heitz et al. 2016)
///
/// Facets are taken by the length of their slope, along which P22 is known whatever its tail, and
/// by azimuth, along which wo.m is a cosine: Fresnel's term, total reflection and the horizons of
/// wr and wt all begin at known values of it.

#pragma once

#include <regain/luts/slope_law.h>

REGAIN_NAMESPACE_BEGIN
namespace luts {

struct DielectricAlbedo
{
    double reflected;
    double transmitted_correlated, transmitted_beta;  ///< by the form of shadowing
};

/// mu = cos theta_o in (0, 1]; eta_o > 0 is the index ahead of wo over the index on its side.
/// `nodes` along each piece: 24 gives 1e-6, of STD below gamma 1.7 1e-4.
REGAIN_LUTS_API DielectricAlbedo dielectric_albedo(const SlopeLaw& law, double mu, double eta_o,
                                                   int nodes = 24);

/// Unpolarised Fresnel reflectance at the cosine c in (0, 1], eta_o as above (Walter et al. 2007,
/// Eq. 22).
REGAIN_LUTS_API double dielectric_reflectance(double c, double eta_o);

}  // namespace luts
REGAIN_NAMESPACE_END
