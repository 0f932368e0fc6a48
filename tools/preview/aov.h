// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Pictures of what is known of the first surface in view: not of light.

#pragma once

#include "integrator.h"

#include <vector>

namespace regain::tools::preview {

class BoundMaterial;

struct AovPictures
{
    int width = 0, height = 0;
    /// Means over a pixel, through the filter of the picture; 0 where nothing is in view.
    std::vector<Imath::C3f> albedo, gain;
    /// Of the middle of the pixel; 0 where nothing is in view.
    std::vector<float> lobe, method;
};

/// `materials` by the material index of the scene's placements; they report.
AovPictures aov_pictures(const World&, const std::vector<const BoundMaterial*>& materials,
                         int samples);

}  // namespace regain::tools::preview
