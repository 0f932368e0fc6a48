// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#pragma once

#include <regain/luts/quadrature.h>

REGAIN_NAMESPACE_BEGIN
namespace luts {

/// Gauss-Legendre rules are asked for again and again in the same few sizes: each is made once and
/// lives for good.
const QuadratureRule& rule_of(int nodes);

}  // namespace luts
REGAIN_NAMESPACE_END
