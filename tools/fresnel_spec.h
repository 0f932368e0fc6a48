// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Which Fresnel term a closure has, as it is written in JSON:
///
///   {"F0": [r,g,b], "F82": [r,g,b]}    Schlick's curve, F82 optional
///   {"n": [r,g,b], "k": [r,g,b]}       exact, of a conductor
///   {"constant": [r,g,b]}
///
/// or, beside it, by MaterialX's names: `ior` and `extinction` of conductor_bsdf, `color0`,
/// `color82`, `color90` and `exponent` of generalized_schlick_bsdf.

#pragma once

#include "json_fields.h"

#include <regain/closures/conductor_fresnel.h>
#include <regain/closures/constant_fresnel.h>
#include <regain/closures/schlick_fresnel.h>

#include <variant>

namespace regain::tools {

struct SchlickParameters
{
    ColorD F0{1.0}, F82{1.0}, F90{1.0};
    double exponent = 5;
};

/// The default is MaterialX's, gold.
struct ConductorParameters
{
    ColorD n{0.183, 0.421, 1.373}, k{3.424, 2.346, 1.770};
};

struct ConstantParameters
{
    ColorD value{1.0};
};

using FresnelSpec = std::variant<SchlickParameters, ConductorParameters, ConstantParameters>;

/// Reads an object of the first three forms. Throws BadInput.
FresnelSpec read_fresnel(const Json& object);

/// Reads the MaterialX parameters of the lobe, whichever are there.
ConductorParameters read_conductor_parameters(Fields& fields);
SchlickParameters read_schlick_parameters(Fields& fields);

/// Calls `visit` with the Fresnel term at the precision of Real.
template <class Real, class Visit>
decltype(auto) with_fresnel(const FresnelSpec& spec, const Visit& visit)
{
    using Color = Color3<Real>;
    if (const auto* s = std::get_if<SchlickParameters>(&spec))
        return visit(
            SchlickFresnel<Real>(Color(s->F0), Color(s->F82), Color(s->F90), Real(s->exponent)));
    if (const auto* c = std::get_if<ConductorParameters>(&spec))
        return visit(ConductorFresnel<Real>(Color(c->n), Color(c->k)));
    return visit(ConstantFresnel<Real>(Color(std::get<ConstantParameters>(spec).value)));
}

}  // namespace regain::tools
