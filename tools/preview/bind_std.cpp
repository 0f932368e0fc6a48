// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "bind_distribution.h"

#include <regain/closures/std.h>

namespace regain::tools::preview {

std::unique_ptr<BoundMaterial> bind_std(const shaders::MicrofacetMaterial& material)
{
    return std::make_unique<BoundAs<MaterialOf<STD>>>(MaterialOf<STD>{material});
}

}  // namespace regain::tools::preview
