// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "aov.h"

#include "bound_material.h"
#include "lobe_maker.h"

#include <tbb/parallel_for.h>

namespace regain::tools::preview {

using Imath::C3f;

AovPictures aov_pictures(const World& world, const std::vector<const BoundMaterial*>& materials,
                         int samples)
{
    AovPictures all{world.width, world.height, {}, {}, {}, {}};
    const auto pixels =
        static_cast<std::size_t>(world.width) * static_cast<std::size_t>(world.height);
    all.albedo.assign(pixels, C3f(0.0f));
    all.gain = all.albedo;
    all.lobe.assign(pixels, 0);
    all.method = all.lobe;
    const auto report = [&](const Ray& ray, SurfaceReport& found) {
        Hit hit;
        if (!world.scene.intersect(ray, &hit)) return false;
        const BoundMaterial& material = *materials[static_cast<std::size_t>(hit.material)];
        found = material.report({hit.uv(), hit.in_object, hit.normal},
                                {-ray.direction, hit.normal, hit.geometric_normal, hit.tangent});
        return true;
    };
    tbb::parallel_for(0, world.height, [&](int y) {
        for (int x = 0; x < world.width; ++x)
        {
            const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(world.width) +
                            static_cast<std::size_t>(x);
            SurfaceReport found;
            for (int s = 0; s < samples; ++s)
                if (report(camera_ray(world, x, y, Sampler(x, y, s, world.seed)), found))
                {
                    all.albedo[at] += found.albedo / static_cast<float>(samples);
                    all.gain[at] += found.gain / static_cast<float>(samples);
                }
            const Ray middle =
                world.camera.ray((static_cast<float>(x) + 0.5f) / float(world.width),
                                 (static_cast<float>(y) + 0.5f) / float(world.height));
            if (!report(middle, found)) continue;
            all.lobe[at] = static_cast<float>(found.lobe);
            all.method[at] = static_cast<float>(found.method);
        }
    });
    return all;
}

}  // namespace regain::tools::preview
