// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The integrator of the one-point host shape: each path builds the lobes of the point it is at,
/// picks one, and mixes them all itself. Knows closures only through regain/clarisse/host.h.

#pragma once

#include "integrator.h"

#include <regain/clarisse/host.h>

#include <vector>

namespace regain::tools::preview {

struct PointMaterial
{
    const clarisse::material_callbacks<float>* callbacks = nullptr;
    const void* object = nullptr;
    bool textured = false;  ///< asks for texture coordinates and positions
};

class PointIntegrator final : public Integrator
{
public:
    /// `materials` by the material index of the scene's placements. Makes their module data and
    /// throws std::runtime_error when one refuses.
    PointIntegrator(const World&, const std::vector<PointMaterial>& materials);
    ~PointIntegrator() override;
    PointIntegrator(const PointIntegrator&) = delete;
    PointIntegrator& operator=(const PointIntegrator&) = delete;

    void render(const Tile&, int first, int count, Film&) const override;

private:
    struct Bound
    {
        PointMaterial material;
        void* data;
    };
    struct Workspace;

    Imath::C3f trace(PathState, const Sampler&, Workspace&) const;
    bool bounce(PathState&, const Hit&, const Sampler&, int bounce, Workspace&) const;
    const Bound& bound_at(const Hit&) const;
    Imath::C3f opacity_at(const Hit&, const Imath::V3f& view) const;
    void release();

    World _world;
    std::vector<Bound> _materials;
    bool _some_let_by = false;
};

}  // namespace regain::tools::preview
