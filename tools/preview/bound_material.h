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
#include <string>
#include <vector>

namespace regain::tools::preview {

/// What a material says of a point besides its light.
struct SurfaceReport
{
    Imath::C3f albedo{0.0f};  ///< energy that leaves, compensation included
    Imath::C3f gain{1.0f};    ///< that over what left without compensation
    int lobe = 0;             ///< of the closure that most of it is from: in lobe_names, from 1
    int method = 0;  ///< its compensation: in shaders::compensation_names(), from 1; 0: none
};

/// Names for SurfaceReport::lobe.
const std::vector<std::string>& lobe_names();

struct SeenPoint;

class BoundMaterial
{
public:
    virtual ~BoundMaterial() = default;
    /// False where the material does not say: that of a plug-in.
    virtual bool reports() const { return false; }
    /// At a point of a surface that is seen.
    virtual SurfaceReport report(const shaders::SurfacePoint&, const SeenPoint&) const
    {
        return {};
    }
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
