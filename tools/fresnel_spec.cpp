// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "fresnel_spec.h"

#include "errors.h"

namespace regain::tools {
namespace {

// What the closures accept without clamping.
constexpr Range index_range{0, 1e4}, exponent_range{0, 100}, eta_range{1e-2, 1e2};

}  // namespace

FresnelSpec read_fresnel(const Json& object)
{
    Fields fields(object, "'fresnel'");
    const auto F0 = fields.color("F0", unit_range), F82 = fields.color("F82", unit_range);
    const auto n = fields.color("n", index_range), k = fields.color("k", index_range);
    const auto constant = fields.color("constant", unit_range);
    const auto eta = fields.number("eta", eta_range);
    fields.finish();

    if ((F0 || F82) + (n || k) + constant.has_value() + eta.has_value() != 1)
        throw BadInput("'fresnel' holds one of: F0 (and F82), n and k, constant, eta");
    if (eta) return DielectricParameters{*eta};
    if (constant) return ConstantParameters{*constant};
    if (n || k)
    {
        if (!n) fields.missing("'n'");
        if (!k) fields.missing("'k'");
        return ConductorParameters{*n, *k};
    }
    if (!F0) fields.missing("'F0'");
    SchlickParameters schlick;
    schlick.F0 = *F0;
    if (F82) schlick.F82 = *F82;
    return schlick;
}

ConductorParameters read_conductor_parameters(Fields& fields)
{
    ConductorParameters p;
    p.n = fields.color("ior", index_range).value_or(p.n);
    p.k = fields.color("extinction", index_range).value_or(p.k);
    return p;
}

DielectricParameters read_dielectric_parameters(Fields& fields)
{
    DielectricParameters p;
    p.eta = fields.number("ior", eta_range).value_or(p.eta);
    return p;
}

SchlickParameters read_schlick_parameters(Fields& fields)
{
    SchlickParameters p;
    p.F0 = fields.color("color0", unit_range).value_or(p.F0);
    p.F82 = fields.color("color82", unit_range).value_or(p.F82);
    p.F90 = fields.color("color90", unit_range).value_or(p.F90);
    p.exponent = fields.number("exponent", exponent_range).value_or(p.exponent);
    return p;
}

}  // namespace regain::tools
