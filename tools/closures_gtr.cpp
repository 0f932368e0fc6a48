// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "closure_model.h"
#include "closures_by_distribution.h"

namespace regain::tools {

std::unique_ptr<AnyClosure> make_gtr_closure(const shaders::MicrofacetMaterial& material,
                                             const ClosureSpec& spec)
{
    return make_closure_of<GTR>(material, spec);
}

}  // namespace regain::tools
