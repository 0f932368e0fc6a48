// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Which Fresnel term a closure has, as it is written in JSON:
///
///   {"F0": [r,g,b], "F82": [r,g,b]}    Schlick's curve, F82 optional
///   {"n": [r,g,b], "k": [r,g,b]}       exact, of a conductor
///   {"constant": [r,g,b]}
///   {"eta": x}                         exact, of a dielectric: index inside over index outside
///
/// or, beside it, by MaterialX's names: `ior` and `extinction` of conductor_bsdf, `ior` of
/// dielectric_bsdf, `color0`, `color82`, `color90` and `exponent` of generalized_schlick_bsdf.

#pragma once

#include "json_fields.h"

#include <regain/closures/dielectric_fresnel.h>
#include <regain/shaders/microfacet_material.h>

#include <variant>

namespace regain::tools {

using SchlickParameters = shaders::SchlickSurface;
using ConductorParameters = shaders::ConductorSurface;

struct ConstantParameters
{
    ColorD value{1.0};
};

struct DielectricParameters
{
    double eta = 1.5;
};

using FresnelSpec =
    std::variant<SchlickParameters, ConductorParameters, ConstantParameters, DielectricParameters>;

/// Reads an object of these forms. Throws BadInput.
FresnelSpec read_fresnel(const Json& object);

/// Reads the MaterialX parameters of the lobe, whichever are there.
ConductorParameters read_conductor_parameters(Fields& fields);
DielectricParameters read_dielectric_parameters(Fields& fields);
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
    if (const auto* d = std::get_if<DielectricParameters>(&spec))
        return visit(DielectricFresnel<Real>(Real(d->eta)));
    const Color value(std::get<ConstantParameters>(spec).value);
    return visit(SchlickFresnel<Real>(value, Color(Real(1)), value));
}

}  // namespace regain::tools
