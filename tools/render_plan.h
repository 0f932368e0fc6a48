// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What `regain render` will do: its options, checked. Whatever can be wrong with them has been
/// found before the first ray.

#pragma once

#include "preview/bound_material.h"
#include "preview/environment.h"
#include "preview/row.h"
#include "render_documents.h"
#include "render_material.h"

#include <filesystem>

namespace regain::tools {

struct RenderPlan
{
    std::filesystem::path exr, png;
    RenderMaterial material;
    RenderDocuments documents;                       ///< shown in its place, unless empty
    std::unique_ptr<preview::BoundMaterial> plugin;  ///< the same; null: none
    std::string plugin_name;
    preview::Host host;
    int width = 0, height = 0;
    shaders::ColorConfig config;
    preview::RowLayout layout;
    int bounces = 0;
    preview::LatLongImage light;
    std::vector<std::string> aovs;
    Picture reference;  ///< to be compared with; empty: none

    /// One row for each method of the material; a plug-in has its own, documents as many as their
    /// materials take.
    int rows() const;
    int longest_row() const;
    /// What stands in a row. Of a plug-in this is asked once, for it has one row.
    preview::RowLayout layout_of(int row) const;
    std::vector<std::unique_ptr<preview::BoundMaterial>> bind(int row);
    /// What labels say of them.
    std::vector<std::string> names(int row) const;
};

/// Throws BadInput.
RenderPlan make_plan(const RenderOptions&);

}  // namespace regain::tools
