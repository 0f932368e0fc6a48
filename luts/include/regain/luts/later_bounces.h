// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What light does on a microsurface after its first bounce, measured on random walks: the two
/// numbers of the compensation method `directional` (regain/closures/directional_gain.h), the shape
/// and, of a dielectric, the split that `tail` takes.

#pragma once

#include <regain/closures/version.h>
#include <regain/luts/export.h>

#include <string>

REGAIN_NAMESPACE_BEGIN
namespace luts {

struct LaterBounces
{
    /// Of walks that met two facets the share that met a third, and so on, were it the same each
    /// time: 1 - 1 / (k - 1) for the mean number k of facets of all walks that met at least two.
    double q;
    /// The cosine mu for which the albedo of later bounces,
    ///   A_1 (1 - E_ss) / E_ss  x (1 - q) / (1 - q x),    x = F(mu),
    /// is nearest to that of the walks, by least squares over Schlick's term with F0 from 0.02 to
    /// 0.95; A_1 is what leaves after the first bounce.
    double mu;
};

/// `distribution` is "ggx", "beckmann", "gtr" or "std", anything else a std::invalid_argument;
/// alpha in (0, 1]; gamma of the latter two; wo at mu = cos theta_o in (0, 1], whose single-
/// scattering albedo is E_ss. The same `walks`, at least 1, are taken for all arguments, so that
/// the answers change smoothly. Of 2^17 both numbers are good to 1e-2, and to more where much of
/// the light is scattered again; where none is they are estimates that nothing depends on.
REGAIN_LUTS_API LaterBounces later_bounces(const std::string& distribution, double alpha,
                                           double gamma, double mu, double E_ss, int walks);

/// The shape of what leaves after two facets or more, in the terms of the method `tail`
/// (regain/closures/fitted_tail.h, azimuth_spread.h).
struct LaterShape
{
    double k,
        m;  ///< of the spread in azimuth: variance in rad^2, and the share of it that goes on ahead
    double c;  ///< of P: Cov(mu_o, mu_i) / (Var(mu_o) Var(mu_i)) over such walks
};

/// From `walks` walks whose wo are cosine-weighted; c from their moments, k and m by largest
/// likelihood. The rest as above.
REGAIN_LUTS_API LaterShape later_shape(const std::string& distribution, double alpha, double gamma,
                                       int walks);

/// The share of what leaves a rough interface between two dielectrics after two facets or more that
/// leaves on the side it came from (regain/closures/dielectric_tail.h). eta_o > 0 is the index
/// ahead of wo over the index on its side; the rest as above. In [0, 1]. Where next to no light
/// meets a second facet it passes to the average Fresnel reflectance.
REGAIN_LUTS_API double later_reflected_share(const std::string& distribution, double alpha,
                                             double gamma, double eta_o, double mu, int walks);

}  // namespace luts
REGAIN_NAMESPACE_END
