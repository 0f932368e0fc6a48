// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Cloth: Burley's sheen over a dull base, as in Figure 3 of Turquin 2019. The base has to be dark
/// for the sheen to show, which adds 0.09 at most.

#pragma once

#include "bound_material.h"

#include <regain/closures/diffuse.h>
#include <regain/closures/sheen.h>

namespace regain::tools::preview {

struct Cloth
{
    static constexpr double dark = 0.05;  ///< the base of the figure

    shaders::SheenSurface sheen;
    double base = dark;  ///< Lambertian albedo in [0, 1]

    template <class Real>
    auto closure(Real strength) const
    {
        return burley_sheen(Diffuse<Real>(Color3<Real>(Real(base))), Real(sheen.weight) * strength,
                            Color3<Real>(sheen.color));
    }
    const char* lobe_name() const { return "cloth"; }
};

std::unique_ptr<BoundMaterial> bind(const Cloth&);

}  // namespace regain::tools::preview
