// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The integrator of the OSL-shaped host: at each point it runs the shader, flattens the tree of
/// closures that it left, and samples and evaluates that as one. Knows closures only through
/// regain/osl.

#pragma once

#include "integrator.h"

#include <regain/osl/problems.h>

#include <atomic>
#include <vector>

namespace regain::tools::preview {

class OslShader;

struct OslMaterial
{
    const OslShader* shader = nullptr;
    bool textured = false;  ///< asks for texture coordinates and positions
};

class OslIntegrator final : public Integrator
{
public:
    /// `materials` by the material index of the scene's placements.
    OslIntegrator(const World&, std::vector<OslMaterial> materials);

    /// What of a material is not rendered as asked is said on standard error, once.
    void render(const Tile&, int first, int count, Film&) const override;

private:
    struct Workspace;

    Imath::C3f trace(PathState, const Sampler&, Workspace&) const;
    enum class Next { ends, scattered, straight };
    Next bounce(PathState&, const Hit&, const Sampler&, int bounce, Workspace&) const;
    struct Surface;
    bool shade(const Hit&, const Imath::V3f& wo, Surface&) const;
    void say(osl::Problems) const;

    World _world;
    std::vector<OslMaterial> _materials;
    bool _some_let_by = false;
    mutable std::atomic<osl::Problems> _said{0};
};

}  // namespace regain::tools::preview
