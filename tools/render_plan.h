// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What `regain render` will do: its options, checked. Whatever can be wrong with them has been
/// found before the first ray.

#pragma once

#include "preview/environment.h"
#include "preview/row.h"
#include "render_material.h"

#include <filesystem>

namespace regain::tools {

struct RenderPlan
{
    std::filesystem::path exr, png;
    RenderMaterial material;
    preview::Host host;
    int width = 0, height = 0;
    shaders::ColorConfig config;
    preview::RowLayout layout;
    int bounces = 0;
    preview::LatLongImage light;
};

/// Throws BadInput.
RenderPlan make_plan(const RenderOptions&);

}  // namespace regain::tools
