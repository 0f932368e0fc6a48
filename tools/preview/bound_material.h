// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A material behind both adapters, so that integrators need not be compiled with it. The adapters
/// of all the closures that a material may be are the bulk of what the preview takes to compile:
/// they are in one file per distribution.

#pragma once

#include "grid_integrator.h"
#include "point_integrator.h"

#include <regain/shaders/microfacet_material.h>

#include <memory>

namespace regain::tools::preview {

class BoundMaterial
{
public:
    virtual ~BoundMaterial() = default;
    /// The material as either host takes it; it lives as long as this object.
    virtual GridMaterial grid() = 0;
    virtual PointMaterial point() = 0;
};

/// For a material of this distribution, whose tables are bound.
std::unique_ptr<BoundMaterial> bind_ggx(const shaders::MicrofacetMaterial&);
std::unique_ptr<BoundMaterial> bind_beckmann(const shaders::MicrofacetMaterial&);
std::unique_ptr<BoundMaterial> bind_gtr(const shaders::MicrofacetMaterial&);
std::unique_ptr<BoundMaterial> bind_std(const shaders::MicrofacetMaterial&);

/// By the material's distribution.
std::unique_ptr<BoundMaterial> bind(const shaders::MicrofacetMaterial&);

}  // namespace regain::tools::preview
