// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "any_closure.h"

#include "closures_by_distribution.h"
#include "combined_closure.h"
#include "errors.h"

#include <fmt/format.h>

#include <stdexcept>

namespace regain::tools {

std::unique_ptr<AnyClosure> make_closure(const ClosureSpec& spec, bool tabulated_albedo)
{
    using shaders::DistributionKind;
    if (spec.combination) return make_combined_closure(spec);
    if (spec.plain)
    {
        const auto* gain = std::get_if<Method>(&spec.method);
        if (!gain || *gain != Method::none)
            throw BadInput(fmt::format(
                "the method {} does not go with {}, which has no microfacets; accepted: none",
                shaders::name(spec.method), name(spec.lobe)));
        return make_plain_closure(spec);
    }
    shaders::MicrofacetMaterial material = spec.material();
    try
    {
        material.bind_tables(tabulated_albedo);
    }
    // No such combination, or no such table.
    catch (const std::logic_error& e)
    {
        throw BadInput(e.what());
    }
    catch (const std::runtime_error& e)
    {
        throw BadInput(e.what());
    }
    switch (material.distribution)
    {
        case DistributionKind::beckmann: return make_beckmann_closure(material, spec);
        case DistributionKind::gtr: return make_gtr_closure(material, spec);
        case DistributionKind::std: return make_std_closure(material, spec);
        case DistributionKind::ggx: break;
    }
    return make_ggx_closure(material, spec);
}

}  // namespace regain::tools
