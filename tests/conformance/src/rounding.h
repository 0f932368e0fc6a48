// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// How far two answers are apart, and how far they may be because directions are rounded.

#pragma once

#include <regain/conformance/tested_closure.h>

REGAIN_NAMESPACE_BEGIN
namespace conformance {

/// Of two values, relative to the larger; 1 where one is NaN, 0 where both are next to nothing.
double difference(double a, double b);

/// wi, turned down (sign -1) or up (1) by a few roundings of double or float.
Direction turned_by_rounding(const Direction& wi, bool in_double, int sign);

/// How much eval and pdf change, relative, where wi is so turned: near an upright facet or a
/// critical angle by all there is.
double rounding_of(const TestedClosure& prepared, const Direction& wi, bool in_double);

}  // namespace conformance
REGAIN_NAMESPACE_END
