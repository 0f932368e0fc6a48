// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "cloth.h"

#include "bind_as.h"

namespace regain::tools::preview {

std::unique_ptr<BoundMaterial> bind(const Cloth& cloth)
{
    return std::make_unique<BoundAs<Cloth>>(cloth);
}

}  // namespace regain::tools::preview
