// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What the kit asks of a closure: the adapter that whoever tests a closure of their own writes.
/// Numbers go in and come out in double, whatever the closure computes in.
///
/// Directions are unit, in the local shading frame (z = shading normal), and point away from the
/// surface. eval is f(wo, wi) |cos theta_i| per channel, as energy: transmission carries no squared
/// ratio of indices. pdf is per steradian and integrates, over all that sample can return, to
/// 1 - P(nothing) - P(delta). See regain/closures/closure.h, whose Sample, Albedo and Traits these
/// are.

#pragma once

#include <regain/closures/closure.h>
#include <regain/conformance/export.h>

REGAIN_NAMESPACE_BEGIN
namespace conformance {

using Direction = Vec3<double>;
using Color = Color3<double>;

/// One closure, its parameters fixed. Used by one thread at a time.
class TestedClosure
{
public:
    virtual ~TestedClosure() = default;

    virtual Traits traits() const = 0;

    /// Makes wo the direction of all calls below.
    virtual void prepare(const Direction& wo) = 0;

    /// u in [0, 1)^3 is read where the value is an estimate.
    virtual Color eval(const Direction& wi, const Direction& u) const = 0;
    virtual double pdf(const Direction& wi) const = 0;
    /// u in [0, 1)^3, of which the first traits().random_numbers are read.
    virtual Sample<double> sample(const Direction& u) const = 0;
    virtual Albedo<double> albedo() const = 0;
};

}  // namespace conformance
REGAIN_NAMESPACE_END
