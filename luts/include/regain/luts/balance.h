// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The balance of a rough mirror's single scattering rho with F = 1: the one function g of the
/// cosine with
///
///   g(mu_o) int rho(wo, wi) g(mu_i) cos theta_i dwi = 1     for every wo
///
/// so that g(mu_o) g(mu_i) rho is reciprocal, as rho is, and loses nothing. It is what Sinkhorn and
/// Knopp 1967 call the scaling of a symmetric kernel to one whose rows sum to 1: it exists and is
/// unique, since rho is positive about every mirror direction, and found by g <- sqrt(g / row sum).

#pragma once

#include <regain/luts/slope_law.h>

#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace luts {

class REGAIN_LUTS_API Balance
{
public:
    /// `nodes` of the quadrature along each piece, as in albedo_integral.h; 64 give 1e-6.
    explicit Balance(const SlopeLaw& law, int nodes = 64);

    /// g at mu in [0, 1], positive.
    double at(double mu) const;

private:
    double _alpha;
    std::vector<double> _g;
};

}  // namespace luts
REGAIN_NAMESPACE_END
