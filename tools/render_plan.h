// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What `regain render` will do: its options, checked. Whatever can be wrong with them has been
/// found before the first ray.

#pragma once

#include "preview/bound_material.h"
#include "preview/environment.h"
#include "preview/row.h"
#include "render_material.h"

#include <filesystem>

namespace regain::tools {

struct RenderPlan
{
    std::filesystem::path exr, png;
    RenderMaterial material;
    std::unique_ptr<preview::BoundMaterial> plugin;  ///< shown in its place; null: none
    std::string plugin_name;
    preview::Host host;
    int width = 0, height = 0;
    shaders::ColorConfig config;
    preview::RowLayout layout;
    int bounces = 0;
    preview::LatLongImage light;

    /// One row for each method of the material; a plug-in has its own.
    int rows() const { return plugin ? 1 : static_cast<int>(material.methods().size()); }
};

/// Throws BadInput.
RenderPlan make_plan(const RenderOptions&);

}  // namespace regain::tools
