// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The integrator of the batched host shape: whole tiles advance bounce by bounce, and the points
/// that share a material are shaded in one call. Knows closures only through
/// regain/renderman/host.h.

#pragma once

#include "integrator.h"

#include <regain/renderman/host.h>

#include <vector>

namespace regain::tools::preview {

struct GridMaterial
{
    renderman::Factory* factory = nullptr;
    void* instance_data = nullptr;
    bool textured = false;  ///< asks for texture coordinates and positions
};

class GridIntegrator final : public Integrator
{
public:
    /// `materials` by the material index of the scene's placements.
    GridIntegrator(const World&, std::vector<GridMaterial> materials);

    void render(const Tile&, int first, int count, Film&) const override;

private:
    struct Workspace;
    struct Path;

    void shade(const GridMaterial&, Path* const* paths, int n, int bounce, Workspace&) const;
    bool lets_by(const GridMaterial&) const;
    static void opacity_of(const GridMaterial&, const renderman::ShadingContext&,
                           Imath::C3f* result);
    Imath::C3f opacity_at(const Hit&, const Imath::V3f& view, Workspace&) const;
    int keep_present(const GridMaterial&, Path* const* paths, int n, int bounce, Workspace&) const;
    void add_direct_light(renderman::Bxdf&, Path* const* paths, int n, int bounce,
                          Workspace&) const;
    void scatter(renderman::Bxdf&, Path* const* paths, int n, int bounce, Workspace&) const;

    World _world;
    std::vector<GridMaterial> _materials;
    bool _some_let_by = false;
};

}  // namespace regain::tools::preview
