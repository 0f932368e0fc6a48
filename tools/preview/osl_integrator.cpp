// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "osl_integrator.h"

#include "osl_shader.h"

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <stdexcept>

namespace regain::tools::preview {

using Imath::C3f;
using Imath::V2f;
using Imath::V3f;

namespace {

constexpr std::size_t kNodeBytes = 64 * 1024;

osl::ShaderGlobals globals_at(const Hit& hit, const V3f& wo, bool textured)
{
    osl::ShaderGlobals sg;
    if (textured)
    {
        const Imath::V2f uv = hit.uv();
        sg.u = uv.x;
        sg.v = uv.y;
        sg.P = hit.in_object;
    }
    sg.I = -wo;
    sg.backfacing = hit.geometric_normal.dot(wo) < 0.0f;
    sg.N = sg.backfacing ? -hit.normal : hit.normal;
    sg.Ng = sg.backfacing ? -hit.geometric_normal : hit.geometric_normal;
    sg.dPdu = hit.tangent;
    return sg;
}

}  // namespace

/// What the shader left at a point, ready to be sampled.
struct OslIntegrator::Surface
{
    alignas(64) unsigned char memory[kNodeBytes];
    osl::NodePool nodes{memory, kNodeBytes};
    osl::ShaderGlobals globals;
    osl::CompositeBsdf bsdf;
};

struct OslIntegrator::Workspace
{
    Surface at, in_between;
};

OslIntegrator::OslIntegrator(const World& world, std::vector<OslMaterial> materials)
    : _world(world), _materials(std::move(materials))
{
    for (const OslMaterial& m : _materials) _some_let_by = _some_let_by || m.shader->lets_by();
}

void OslIntegrator::render(const Tile& tile, int first, int count, Film& film) const
{
    const auto workspace = std::make_unique<Workspace>();
    add_paths(_world, tile, first, count, film, [&](const PathState& path, const Sampler& sampler) {
        return trace(path, sampler, *workspace);
    });
}

C3f OslIntegrator::trace(PathState path, const Sampler& sampler, Workspace& workspace) const
{
    for (int b = 0, scattered = 0;; ++b)
    {
        Hit hit;
        if (!_world.scene.intersect(path.ray, &hit))
        {
            add_environment(_world.environment, path);
            break;
        }
        // At the last surface light may still go straight on.
        if (scattered == _world.max_bounces && !_some_let_by) break;
        const Next next = bounce(path, hit, sampler, b, workspace);
        if (next == Next::ends) break;
        if (next == Next::straight) continue;
        if (scattered == _world.max_bounces) break;
        ++scattered;
        if (!survives(path, b, sampler)) break;
    }
    return path.radiance;
}

/// Each problem once, by whichever thread meets it first.
void OslIntegrator::say(osl::Problems problems) const
{
    if ((problems & ~_said.load(std::memory_order_relaxed)) == 0) return;
    const osl::Problems fresh = problems & ~_said.fetch_or(problems);
    for (int k = 0; k < osl::problem_kinds; ++k)
        if (fresh & (1u << k))
            fmt::print(stderr, "regain: {}\n", osl::message(static_cast<osl::Problem>(1u << k)));
}

/// False where an albedo is no number.
bool OslIntegrator::shade(const Hit& hit, const V3f& wo, Surface& surface) const
{
    const OslMaterial& material = _materials[static_cast<std::size_t>(hit.material)];
    const OslShader& shader = *material.shader;
    surface.globals = globals_at(hit, wo, material.textured);
    surface.nodes.reset();
    surface.bsdf.clear();
    const osl::ClosureColor* Ci = shader.shade(surface.globals, surface.nodes);
    if (surface.nodes.full())
        throw std::runtime_error("a material's closures do not fit into the pool of nodes");
    say(shader.flatten(Ci, surface.globals, surface.bsdf));
    return surface.bsdf.prepare(wo);
}

/// Adds direct light and gives the path its next ray.
OslIntegrator::Next OslIntegrator::bounce(PathState& path, const Hit& hit, const Sampler& sampler,
                                          int bounce, Workspace& workspace) const
{
    const V3f wo = -path.ray.direction;
    const osl::CompositeBsdf& bsdf = workspace.at.bsdf;
    if (!shade(hit, wo, workspace.at))
    {
        mark_faulty(path);
        return Next::ends;
    }
    const auto opacity = [&](const Hit& other, const V3f& from) {
        shade(other, from, workspace.in_between);
        return C3f(1.0f) - workspace.in_between.bsdf.transparency(from);
    };

    const auto [to_light, light] =
        _world.environment.sample(sampler.get2D(dimension(Draw::Light, bounce)));
    if (light.pdf > 0.0f)
    {
        const osl::BsdfSample value = bsdf.eval(wo, to_light);
        if (value.pdf > 0.0f && value.weight != C3f(0.0f))
            path.radiance +=
                path.throughput * value.weight * value.pdf * light.radiance *
                visibility(_world.scene, hit.leave(to_light), _some_let_by,
                           [&, towards = to_light](const Hit& h) { return opacity(h, -towards); }) *
                (mis_weight(light.pdf, value.pdf) / light.pdf);
    }

    const V2f uv = sampler.get2D(dimension(Draw::Scatter, bounce));
    const float w = sampler.get1D(dimension(Draw::Evaluate, bounce));
    const osl::BsdfSample s =
        bsdf.sample(wo, V3f(uv.x, uv.y, w), sampler.get1D(dimension(Draw::Lobe, bounce)));
    if (!std::isfinite(s.pdf) || (s.pdf > 0.0f && !is_finite(s.wi)))
    {
        mark_faulty(path);
        return Next::ends;
    }
    if (!(s.pdf > 0.0f)) return Next::ends;
    path.throughput *= s.weight;
    path.ray = hit.leave(s.wi);
    if (path.throughput == C3f(0.0f)) return Next::ends;
    // What goes straight on knows as much of lights as before: shadow rays do the same.
    if (s.straight) return Next::straight;
    path.pdf = s.pdf;
    path.alone = s.singular;
    if (s.passes) pass_interface(path, s.ior, !workspace.at.globals.backfacing);
    return Next::scattered;
}

}  // namespace regain::tools::preview
