// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A BoundMaterial of one type of material that is not made of trees.

#pragma once

#include "bound_material.h"

#include <regain/clarisse/closure_lobe.h>
#include <regain/renderman/closure_bxdf.h>

#include <stdexcept>

namespace regain::tools::preview {

/// Any material that the adapters take.
template <class Material>
class BoundAs : public BoundMaterial
{
public:
    explicit BoundAs(const Material& material) : _material(material) {}
    GridMaterial grid() override { return {&_factory, &_material}; }
    PointMaterial point() override { return {&_callbacks, &_material}; }
    /// Throws std::invalid_argument: that host knows closures by their names.
    OslMaterial osl() override
    {
        throw std::invalid_argument(
            "this material is no tree of closures with MaterialX's names, "
            "which is what the OSL-shaped host takes");
    }

private:
    Material _material;
    renderman::ClosureFactory<Material> _factory;
    clarisse::material_callbacks<float> _callbacks = clarisse::closure_callbacks<Material, float>();
};

}  // namespace regain::tools::preview
