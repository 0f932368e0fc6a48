// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The single-scattering albedo of a rough mirror as an integral over microfacet slopes, in double
/// precision and without any of the closures' code, so that each can be checked against the other:
///
///   E(wo) = int P22(p, q) max(0, wo.m) / (cos theta_o m_z) F(wo.m) G2(wo, wi) dp dq
///
/// (Turquin 2019, Eq. 3 with Eq. 1, changed to slopes), height-correlated Smith. The slopes that
/// reflect wo upwards fill a disc about (tan theta_o, 0) of radius 1 / cos theta_o, which is
/// integrated in polar coordinates about slope 0, where P22 peaks.

#pragma once

#include <regain/luts/slope_law.h>

#include <functional>

REGAIN_NAMESPACE_BEGIN
namespace luts {

/// Accuracy of the quadrature: `nodes` along each piece. 64 gives 1e-9 where alpha >= 0.1 and 1e-6
/// down to alpha and mu of 1e-3.
struct AlbedoAccuracy
{
    int nodes = 64;
};

/// mu = cos theta_o in (0, 1]. `fresnel` is F at the cosine wo.m; none means F = 1, and the result
/// is E_ss. Returns a value in [0, 1].
REGAIN_LUTS_API double albedo(const SlopeLaw& law, double mu,
                              const std::function<double(double)>& fresnel = {},
                              AlbedoAccuracy accuracy = {});

/// E_ss and, weighted alike, the means over all that is scattered once of the two curves of
/// Schlick's term with its tint: (1 - wo.m)^5 and wo.m (1 - wo.m)^6.
struct AlbedoMoments
{
    double E_ss, falloff, dip;
};

REGAIN_LUTS_API AlbedoMoments albedo_moments(const SlopeLaw& law, double mu,
                                             AlbedoAccuracy accuracy = {});

/// 2 int_0^1 E_ss(mu) mu dmu (Turquin 2019, below Eq. 7).
REGAIN_LUTS_API double average_albedo(const SlopeLaw& law, AlbedoAccuracy accuracy = {});

/// The same of GGX.
REGAIN_LUTS_API double ggx_albedo(double mu, double alpha,
                                  const std::function<double(double)>& fresnel = {},
                                  AlbedoAccuracy accuracy = {});
REGAIN_LUTS_API double ggx_average_albedo(double alpha, AlbedoAccuracy accuracy = {});

}  // namespace luts
REGAIN_NAMESPACE_END
