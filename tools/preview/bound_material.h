// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A material behind all adapters, so that integrators need not be compiled with it.

#pragma once

#include "grid_integrator.h"
#include "osl_integrator.h"
#include "point_integrator.h"

#include <regain/shaders/varying_tree.h>

#include <memory>

namespace regain::tools::preview {

class BoundMaterial
{
public:
    virtual ~BoundMaterial() = default;
    /// The material as each host takes it; it lives as long as this object.
    virtual GridMaterial grid() = 0;
    virtual PointMaterial point() = 0;
    virtual OslMaterial osl() = 0;
};

/// Its tables are bound.
std::unique_ptr<BoundMaterial> bind(const shaders::ClosureTree&);
std::unique_ptr<BoundMaterial> bind(const shaders::MicrofacetMaterial&);
/// As a tree where nothing varies.
std::unique_ptr<BoundMaterial> bind(const shaders::VaryingTree&);

}  // namespace regain::tools::preview
