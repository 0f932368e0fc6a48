// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "environment.h"

#include <algorithm>
#include <cmath>

namespace regain::tools::preview {

using Imath::C3f;
using Imath::V3f;

namespace {

/// A soft box: a rectangle seen from the origin, with edges that fade so that a polished surface
/// does not show the image's pixels.
struct SoftBox
{
    V3f direction;         ///< to its centre
    float half_x, half_y;  ///< extents as tangents of angles: along the horizon, upwards
    float fade;            ///< width of the edge, in the same measure
    C3f radiance;
};

float smooth_step(float x)
{
    const float t = std::clamp(x, 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

float coverage(const SoftBox& box, const V3f& d)
{
    const V3f z = box.direction.normalized();
    const V3f x = V3f(0, 1, 0).cross(z).normalized();
    const V3f y = z.cross(x);
    const float depth = d.dot(z);
    if (depth <= 0.0f) return 0.0f;
    const float outside_x = std::abs(d.dot(x) / depth) - box.half_x;
    const float outside_y = std::abs(d.dot(y) / depth) - box.half_y;
    return smooth_step(-outside_x / box.fade) * smooth_step(-outside_y / box.fade);
}

}  // namespace

LatLongImage make_studio()
{
    // Contrast is what makes metal look like metal: a few bright, large shapes on a dim room. The
    // camera looks from +z.
    const SoftBox boxes[] = {
        {{-0.75f, 0.75f, 0.65f}, 0.55f, 0.42f, 0.06f, C3f(6.2f, 6.05f, 5.8f)},  // key
        {{1.0f, 0.35f, 0.45f}, 0.22f, 0.75f, 0.05f, C3f(2.0f, 2.1f, 2.3f)},     // fill
        {{0.1f, 1.0f, -0.45f}, 0.90f, 0.35f, 0.06f, C3f(2.4f, 2.4f, 2.4f)},     // top
        {{0.75f, 0.50f, -0.9f}, 0.18f, 0.60f, 0.04f, C3f(4.6f, 4.7f, 4.9f)},    // rim
        {{-1.0f, 0.22f, -0.35f}, 0.14f, 0.55f, 0.04f, C3f(2.4f, 2.4f, 2.4f)},   // edge
    };

    LatLongImage image;
    image.width = 512;
    image.height = 256;
    image.pixels.reserve(512 * 256);
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column)
        {
            const V3f d = latlong_direction((static_cast<float>(column) + 0.5f) / 512.0f,
                                            (static_cast<float>(row) + 0.5f) / 256.0f);
            const float up = std::max(d.y, 0.0f);
            C3f c = C3f(0.10f, 0.105f, 0.115f) + C3f(0.12f, 0.12f, 0.125f) * (up * up);
            // The floor hides what is below the horizon: light there would only cost samples.
            c *= smooth_step(1.0f + 10.0f * d.y);
            for (const SoftBox& box : boxes)
            {
                const float k = coverage(box, d);
                c = c * (1.0f - k) + box.radiance * k;
            }
            image.pixels.push_back(c);
        }
    return image;
}

}  // namespace regain::tools::preview
