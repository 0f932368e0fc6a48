// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A BoundMaterial of one distribution: for the files that compile one each.

#pragma once

#include "bound_material.h"

#include <regain/clarisse/closure_lobe.h>
#include <regain/renderman/closure_bxdf.h>

namespace regain::tools::preview {

template <template <class> class Distribution>
class BoundTo final : public BoundMaterial
{
public:
    explicit BoundTo(const shaders::MicrofacetMaterial& material) : _material{material} {}
    GridMaterial grid() override { return {&_factory, &_material}; }
    PointMaterial point() override { return {&_callbacks, &_material}; }

private:
    struct Material
    {
        shaders::MicrofacetMaterial value;

        template <class Real, class Visit>
        decltype(auto) with_closure(Real strength, const Visit& visit) const
        {
            return value.with_closure_of<Distribution>(strength, visit);
        }
        const char* lobe_name() const { return value.lobe_name(); }
    };

    Material _material;
    renderman::ClosureFactory<Material> _factory;
    clarisse::material_callbacks<float> _callbacks = clarisse::closure_callbacks<Material, float>();
};

}  // namespace regain::tools::preview
