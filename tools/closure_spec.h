// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A closure as the commands name it, and the closure itself from that. What the design knows but
/// the library does not have yet is refused by name.

#pragma once

#include "fresnel_spec.h"

#include <regain/closures/compensated.h>
#include <regain/closures/ggx.h>
#include <regain/closures/microfacet_reflection.h>
#include <regain/luts/builtin.h>

namespace regain::tools {

enum class Lobe { conductor, generalized_schlick };
enum class Precision { single, twice };

/// The lobe's and the method's name on command lines; the distribution is GGX.
struct ClosureSpec
{
    Lobe lobe = Lobe::conductor;
    double alpha_x = 0.05, alpha_y = 0.05;  ///< MaterialX's default
    FresnelSpec fresnel = ConductorParameters{};
    Method method = Method::none;
    double strength = 1;
    Precision precision = Precision::single;
};

std::string_view name(Lobe lobe);

/// Reads the fields that describe a closure: closure, distribution, alpha, fresnel (or the lobe's
/// parameters by MaterialX's names), scatter_mode, method, strength, precision, transport. Does
/// not finish the fields. Throws BadInput; also where `closure` is missing, if it is needed.
ClosureSpec read_closure_spec(Fields& fields, bool closure_needed);

/// Calls `visit` with the closure, a Compensated at the precision of Real.
template <class Real, class Visit>
decltype(auto) with_closure_of(const ClosureSpec& spec, const Visit& visit)
{
    return with_fresnel<Real>(spec.fresnel, [&](const auto& fresnel) -> decltype(auto) {
        const MicrofacetTables tables = luts::ggx_tables();
        const MicrofacetReflection lobe(GGX<Real>(Real(spec.alpha_x), Real(spec.alpha_y)), fresnel,
                                        tables);
        return visit(compensated(lobe, spec.method, tables, Real(spec.strength)));
    });
}

/// The same at the precision that the specification asks for.
template <class Visit>
decltype(auto) with_closure(const ClosureSpec& spec, const Visit& visit)
{
    if (spec.precision == Precision::twice) return with_closure_of<double>(spec, visit);
    return with_closure_of<float>(spec, visit);
}

}  // namespace regain::tools
