// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Any closure of the library behind one type. Numbers go in and come out in double; the closure
/// inside is of the precision that was asked for, and what it answers is passed on to the bit.

#pragma once

#include "closure_spec.h"

#include <regain/closures/closure.h>

#include <memory>
#include <optional>

namespace regain::tools {

/// What compensation multiplies the single-scattering closure by, for one wo.
struct GainAnswer
{
    ColorD gain{1.0};
    const char* form = "none";  ///< how it acts: "gain(wo)", "gain(wo, wi)", "added lobe"
};

class AnyClosure
{
public:
    virtual ~AnyClosure() = default;

    virtual Traits traits() const = 0;

    /// Makes wo the direction of all calls below. Before the first call there is none.
    virtual void prepare(const Imath::V3d& wo) = 0;

    /// u in [0, 1)^3 is read by closures whose eval is an estimate.
    virtual ColorD eval(const Imath::V3d& wi, const Imath::V3d& u = Imath::V3d(0.0)) const = 0;
    virtual double pdf(const Imath::V3d& wi) const = 0;
    /// u in [0, 1)^3, of which the first traits().random_numbers are read.
    virtual Sample<double> sample(const Imath::V3d& u) const = 0;
    /// Energy, whatever the transport.
    virtual Albedo<double> albedo() const = 0;
    /// Throws BadInput where compensation is not a gain. Of a gain that depends on wi, for the wi
    /// that is given; without one what it makes of the albedo.
    virtual GainAnswer gain(const std::optional<Imath::V3d>& wi = {}) const = 0;

    /// Facets that the walk behind sample(u) met; 1 for closures that do not walk.
    virtual int bounces(const Imath::V3d& u) const = 0;
};

/// tabulated_albedo: albedo() is a look-up if it can be; without it may integrate. Throws BadInput
/// where the library has no such combination, or a table is missing.
std::unique_ptr<AnyClosure> make_closure(const ClosureSpec&, bool tabulated_albedo = false);

}  // namespace regain::tools
