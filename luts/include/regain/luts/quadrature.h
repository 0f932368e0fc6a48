// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Deterministic numerical integration in double precision.

#pragma once

#include <regain/closures/version.h>
#include <regain/luts/export.h>

#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace luts {

/// Nodes and weights for an integral over [0, 1].
struct QuadratureRule
{
    std::vector<double> x, weight;
};

/// Gauss-Legendre rule of n >= 1 nodes: exact for polynomials of degree 2 n - 1.
REGAIN_LUTS_API QuadratureRule gauss_legendre(int n);

}  // namespace luts
REGAIN_NAMESPACE_END
