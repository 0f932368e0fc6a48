// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What both preview integrators share: path tracing with next-event estimation on the environment
/// and multiple importance sampling. They differ only in the host interface through which they know
/// their materials.

#pragma once

#include "camera.h"
#include "environment.h"
#include "film.h"
#include "sampler.h"
#include "scene.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace regain::tools::preview {

/// Everything but the materials. The references outlive the integrator.
struct World
{
    const Scene& scene;
    const Environment& environment;
    const Camera& camera;
    int width, height;  ///< of the frame, pixels
    std::uint32_t seed = 1;
    int max_bounces = 8;  ///< surface interactions per path; to go by a surface is none
};

/// Pixels [x0, x1) x [y0, y1).
struct Tile
{
    int x0, y0, x1, y1;
};

class Integrator
{
public:
    virtual ~Integrator() = default;

    /// Adds samples [first, first + count) of every pixel of the tile to the film. Any number of
    /// threads, on tiles that do not overlap.
    virtual void render(const Tile&, int first, int count, Film&) const = 0;
};

/// Dimensions of the sampler: each bounce has a block of its own.
enum class Draw : std::uint32_t { Pixel, Light, Evaluate, Scatter, Lobe, Roulette, Opacity };
inline std::uint32_t dimension(Draw draw, int bounce)
{
    return static_cast<std::uint32_t>(draw) + 64u * static_cast<std::uint32_t>(bounce);
}

/// Camera ray of one sample, through a tent filter two pixels wide.
inline Ray camera_ray(const World& world, int x, int y, const Sampler& sampler)
{
    const auto tent = [](float u) {
        return u < 0.5f ? std::sqrt(2.0f * u) - 1.0f : 1.0f - std::sqrt(2.0f - 2.0f * u);
    };
    const Imath::V2f u = sampler.get2D(dimension(Draw::Pixel, 0));
    return world.camera.ray((static_cast<float>(x) + 0.5f + tent(u.x)) / float(world.width),
                            (static_cast<float>(y) + 0.5f + tent(u.y)) / float(world.height));
}

/// Power heuristic (Veach) for one sample of each technique: the share of the one with pdf `a`.
inline float mis_weight(float a, float b)
{
    if (!(a > 0.0f)) return 0.0f;
    const float ratio = b / a;  // squaring the pdfs themselves could overflow
    return 1.0f / (1.0f + ratio * ratio);
}

inline float max_channel(const Imath::C3f& c) { return std::max({c.x, c.y, c.z}); }
inline float luminance(const Imath::C3f& c)
{
    return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z;
}

/// Where a path stands between two bounces.
struct PathState
{
    Ray ray;
    Imath::C3f throughput{1.0f};
    Imath::C3f radiance{0.0f};
    float energy = 1.0f;  ///< times the throughput: of energy, where that is of radiance
    float pdf = 0.0f;     ///< with which the closure chose `ray`, per steradian
    bool alone = true;    ///< next-event estimation could not have found this light: no weighting
};

/// Adds trace(path, sampler), along its camera ray, for samples [first, first + count) of every
/// pixel of the tile.
template <class Trace>
void add_paths(const World& world, const Tile& tile, int first, int count, Film& film,
               const Trace& trace)
{
    for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x)
            for (int s = first; s < first + count; ++s)
            {
                const Sampler sampler(x, y, s, world.seed);
                PathState path;
                path.ray = camera_ray(world, x, y, sampler);
                film.add(x, y, trace(path, sampler));
            }
}

/// For a closure's answer that is no number: the film counts the sample, whatever else it holds.
inline void mark_faulty(PathState& path)
{
    path.radiance = Imath::C3f(std::numeric_limits<float>::quiet_NaN());
}

inline bool is_finite(const Imath::V3f& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Light that the path's ray finds when it leaves the scene.
inline void add_environment(const Environment& environment, PathState& path)
{
    const Environment::Light light = environment.at(path.ray.direction);
    const float weight = path.alone ? 1.0f : mis_weight(path.pdf, light.pdf);
    path.radiance += path.throughput * light.radiance * weight;
}

/// Notes that the path has passed an interface: inside, of relative index `ior`, the radiance of
/// the same energy is ior^2 times as much. `inwards`: against the light, from outside to inside.
inline void pass_interface(PathState& path, float ior, bool inwards)
{
    path.energy *= inwards ? ior * ior : 1.0f / (ior * ior);
}

/// Whether a path goes by a surface, of which `opacity` in [0, 1] per channel is there; by chance,
/// u being uniform in [0, 1). A path that does knows as much of lights as before: what the surface
/// it left by sampled towards them has gone by this one, too.
inline bool goes_by(PathState& path, const Hit& hit, const Imath::C3f& opacity, float u)
{
    const Imath::C3f rest = Imath::C3f(1.0f) - opacity;
    const float chance = (rest.x + rest.y + rest.z) / 3.0f;
    const bool by = u < chance;
    path.throughput *= by ? rest / chance : opacity / (1.0f - chance);
    if (by) path.ray = hit.leave(path.ray.direction);
    return by;
}

/// What goes by all that a ray meets; opacity(hit) is asked where `some_let_by`.
template <class OpacityAt>
Imath::C3f visibility(const Scene& scene, Ray ray, bool some_let_by, const OpacityAt& opacity)
{
    if (!some_let_by) return Imath::C3f(scene.occluded(ray) ? 0.0f : 1.0f);
    Imath::C3f share(1.0f);
    Hit hit;
    while (share != Imath::C3f(0.0f) && scene.intersect(ray, &hit))
    {
        share *= Imath::C3f(1.0f) - opacity(hit);
        ray = hit.leave(ray.direction);
    }
    return share;
}

/// Ends dim paths by chance from the fourth bounce on, without bias. A throughput of 1, as white
/// compensated closures have, always goes on; so does one that is lower only because the path is
/// inside a denser medium.
inline bool survives(PathState& path, int bounce, const Sampler& sampler)
{
    if (bounce < 3) return true;
    const float chance = std::min(max_channel(path.throughput) * path.energy, 1.0f);
    if (sampler.get1D(dimension(Draw::Roulette, bounce)) >= chance) return false;
    path.throughput /= chance;
    return true;
}

}  // namespace regain::tools::preview
