// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The report of a material of several closures.

#pragma once

#include "bound_material.h"
#include "lobe_maker.h"

#include <functional>

namespace regain::tools::preview {

/// weigh(albedo, weight) is the material's lobe_weights there.
SurfaceReport report_of(int lobes, const SeenPoint&,
                        const std::function<shaders::ClosureTree::Material(int)>& material,
                        const std::function<const char*(int)>& name,
                        const std::function<void(const Imath::C3f*, Imath::C3f*)>& weigh);

}  // namespace regain::tools::preview
