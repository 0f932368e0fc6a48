// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The preview's subject: a widget with curved, flat and bevelled parts, as shading people use to
/// judge a material. A rounded octagonal foot, a ring, and a spherical shell with a window and two
/// grooves around an inner ball. y up, standing on y = 0, about 2 units high and wide, the window
/// towards +z.

#pragma once

#include "mesh.h"

namespace regain::tools::preview {

constexpr float kWidgetHeight = 2.05f;
constexpr float kWidgetRadius = 1.08f;

/// Without a bottom, which no one sees through metal. `closed` adds it: light that goes through has
/// to find every surface twice.
Mesh make_widget(bool closed = false);

/// A sphere of radius 1 that stands on y = 0.
constexpr float kSphereHeight = 2.0f;
Mesh make_standing_sphere();

/// One half as large about the same centre.
Mesh make_inner_sphere();

/// A square in the plane y = 0, `half_size` to each side of the origin.
Mesh make_floor(float half_size);

}  // namespace regain::tools::preview
