// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Pinhole camera. World units, y up.

#pragma once

#include "scene.h"

#include <Imath/ImathVec.h>

#include <algorithm>
#include <cmath>

namespace regain::tools::preview {

class Camera
{
public:
    /// `half_width` and `half_height` are what the frame shows at the distance of `target`.
    Camera(const Imath::V3f& eye, const Imath::V3f& target, float half_width, float half_height)
        : _eye(eye)
    {
        const Imath::V3f forward = (target - eye).normalized();
        const Imath::V3f right = forward.cross(Imath::V3f(0, 1, 0)).normalized();
        _forward = target - eye;
        _right = right * half_width;
        _up = right.cross(forward) * half_height;
    }

    /// Ray through the frame at (x, y), each in [0, 1], (0, 0) at the top left.
    Ray ray(float x, float y) const
    {
        const Imath::V3f d = _forward + _right * (2.0f * x - 1.0f) + _up * (1.0f - 2.0f * y);
        return {_eye, d.normalized()};
    }

private:
    Imath::V3f _eye, _forward, _right, _up;
};

/// What frame_row shows to either side of the middle, at the distance of the row.
inline float half_width_of_row(int count, float spacing, float widget_height, float aspect)
{
    return std::max(0.5f * spacing * static_cast<float>(count) * 1.02f,
                    0.72f * widget_height * aspect);
}

/// Looks at a row of `count` widgets, `spacing` apart along x about the origin, slightly from
/// above, so that the floor fills the frame. The row fits whatever the frame's shape.
inline Camera frame_row(int count, float spacing, float widget_height, float aspect)
{
    const float half_width = half_width_of_row(count, spacing, widget_height, aspect);
    const float half_height = half_width / aspect;
    const float elevation = 0.30f;                     // radians above the horizon
    const float distance = half_width / 0.21f + 8.0f;  // a long lens: the ends are not distorted
    const Imath::V3f target(0.0f, 0.48f * widget_height, 0.0f);
    const Imath::V3f away(0.0f, std::sin(elevation), std::cos(elevation));
    return {target + away * distance, target, half_width, half_height};
}

}  // namespace regain::tools::preview
