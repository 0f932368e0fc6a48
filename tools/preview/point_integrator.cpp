// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "point_integrator.h"

#include <memory>
#include <stdexcept>

namespace regain::tools::preview {

using Imath::C3f;
using Imath::V2f;
using Imath::V3f;
using Entry = clarisse::lobe_entry<float>;
using LobeList = clarisse::lobe_list<float>;

namespace {

constexpr std::size_t kPadBytes = 64 * 1024;

V3f to_local(const Entry& e, const V3f& v) { return {v.dot(e.x), v.dot(e.y), v.dot(e.z)}; }
V3f to_world(const Entry& e, const V3f& v) { return e.x * v.x + e.y * v.y + e.z * v.z; }

clarisse::shading_point<float> shading_point_at(const Hit& hit, const V3f& view, bool textured)
{
    clarisse::shading_point<float> point;
    if (textured)
    {
        const Imath::V2f uv = hit.uv();
        point.uvw = V3f(uv.x, uv.y, 0.0f);
        point.p_object = hit.in_object;
    }
    point.p = hit.position;
    point.ng = hit.geometric_normal;
    point.ns = hit.normal;
    point.tangent = hit.tangent;
    point.view = view;
    point.front_facing = hit.geometric_normal.dot(view) > 0.0f;
    return point;
}

/// The lobes of one point as the host mixes them.
struct Mixture
{
    LobeList lobes;
    V3f view[LobeList::capacity];           // in each lobe's frame
    float probability[LobeList::capacity];  // of picking it

    /// False when an albedo is no number.
    bool choose_probabilities(const V3f& world_view)
    {
        float total = 0.0f;
        for (int k = 0; k < lobes.size(); ++k)
        {
            const Entry& e = lobes[k];
            view[k] = to_local(e, world_view);
            // A lobe that can contribute is never picked with probability 0. An albedo may cost
            // more than all else, and there is nothing to ask it for where there is one lobe.
            const float share =
                lobes.size() > 1 ? luminance(e.weight * e.lobe->albedo(view[k])) : 0.0f;
            const float least = max_channel(e.weight) > 0.0f ? 1e-4f : 0.0f;
            probability[k] = std::max(share, least);
            total += probability[k];
        }
        for (int k = 0; k < lobes.size(); ++k)
            probability[k] = total > 0.0f ? probability[k] / total : 0.0f;
        return std::isfinite(total);
    }

    /// Value f |cos| and pdf of the whole mixture towards `direction`. Lobe `known`, if any, has
    /// them already.
    void evaluate(const V3f& direction, int known, C3f* value, float* pdf) const
    {
        for (int k = 0; k < lobes.size(); ++k)
        {
            if (k == known) continue;
            const Entry& e = lobes[k];
            C3f weight(0.0f);
            const float p = e.lobe->evaluate(view[k], to_local(e, direction), weight, nullptr);
            if (!(p > 0.0f)) continue;
            *value += e.weight * weight * p;
            *pdf += probability[k] * p;
        }
    }
};

}  // namespace

struct PointIntegrator::Workspace
{
    alignas(64) unsigned char memory[kPadBytes];
    clarisse::scratchpad pad{memory, kPadBytes};
};

PointIntegrator::PointIntegrator(const World& world, const std::vector<PointMaterial>& materials)
    : _world(world)
{
    _materials.reserve(materials.size());
    for (const PointMaterial& m : materials)
    {
        void* data = m.callbacks->create_module_data(m.object);
        if (!data)
        {
            release();
            throw std::runtime_error("a material refused to be prepared for the one-point host");
        }
        _materials.push_back({m, data});
        _some_let_by = _some_let_by || m.callbacks->opacity;
    }
}

PointIntegrator::~PointIntegrator() { release(); }

void PointIntegrator::release()
{
    for (const Bound& b : _materials)
        b.material.callbacks->destroy_module_data(b.material.object, b.data);
    _materials.clear();
}

void PointIntegrator::render(const Tile& tile, int first, int count, Film& film) const
{
    const auto workspace = std::make_unique<Workspace>();
    add_paths(_world, tile, first, count, film, [&](const PathState& path, const Sampler& sampler) {
        return trace(path, sampler, *workspace);
    });
}

C3f PointIntegrator::trace(PathState path, const Sampler& sampler, Workspace& workspace) const
{
    for (int b = 0, scattered = 0;; ++b)
    {
        Hit hit;
        if (!_world.scene.intersect(path.ray, &hit))
        {
            add_environment(_world.environment, path);
            break;
        }
        if (scattered == _world.max_bounces) break;
        if (bound_at(hit).material.callbacks->opacity)
        {
            const float u = sampler.get1D(dimension(Draw::Opacity, b));
            if (goes_by(path, hit, opacity_at(hit, -path.ray.direction), u)) continue;
        }
        if (!bounce(path, hit, sampler, b, workspace)) break;
        if (!survives(path, b, sampler)) break;
        ++scattered;
    }
    return path.radiance;
}

const PointIntegrator::Bound& PointIntegrator::bound_at(const Hit& hit) const
{
    return _materials[static_cast<std::size_t>(hit.material)];
}

C3f PointIntegrator::opacity_at(const Hit& hit, const V3f& view) const
{
    const Bound& bound = bound_at(hit);
    const auto opacity = bound.material.callbacks->opacity;
    return opacity ? opacity(bound.data, shading_point_at(hit, view, bound.material.textured))
                   : C3f(1.0f);
}

/// Adds direct light and gives the path its next ray; false when the path ends here.
bool PointIntegrator::bounce(PathState& path, const Hit& hit, const Sampler& sampler, int bounce,
                             Workspace& workspace) const
{
    const Bound& bound = bound_at(hit);
    const V3f view = -path.ray.direction;
    const clarisse::shading_point<float> point =
        shading_point_at(hit, view, bound.material.textured);

    workspace.pad.reset();
    Mixture mixture;
    if (!bound.material.callbacks->create_lobes(bound.data, point, workspace.pad, mixture.lobes))
        throw std::runtime_error("a material's lobes do not fit into the scratchpad");
    if (!mixture.choose_probabilities(view))
    {
        mark_faulty(path);
        return false;
    }

    const auto on_viewers_side = [&](const V3f& direction) {
        return direction.dot(hit.geometric_normal) * view.dot(hit.geometric_normal) > 0.0f;
    };

    // A lobe's event says on which side of the true surface it may scatter. Reflection to behind
    // the surface exists only because normals are interpolated.
    const auto possible = [&](const V3f& direction, clarisse::event event) {
        if (event == clarisse::event::either) return true;
        return on_viewers_side(direction) == (event == clarisse::event::reflection);
    };
    const auto any_possible = [&](const V3f& direction) {
        for (int k = 0; k < mixture.lobes.size(); ++k)
            if (possible(direction, mixture.lobes[k].lobe->label().ev)) return true;
        return false;
    };

    const auto [to_light, light] =
        _world.environment.sample(sampler.get2D(dimension(Draw::Light, bounce)));
    if (light.pdf > 0.0f && any_possible(to_light))
    {
        C3f value(0.0f);
        float pdf = 0.0f;
        mixture.evaluate(to_light, -1, &value, &pdf);
        const C3f visible = value == C3f(0.0f)
                                ? C3f(0.0f)
                                : visibility(_world.scene, hit.leave(to_light), _some_let_by,
                                             [&, towards = to_light](const Hit& other) {
                                                 return opacity_at(other, -towards);
                                             });
        if (visible != C3f(0.0f))
            path.radiance += path.throughput * value * visible * light.radiance *
                             (mis_weight(light.pdf, pdf) / light.pdf);
    }

    const float pick = sampler.get1D(dimension(Draw::Lobe, bounce));
    int chosen = -1;
    float sum = 0.0f;
    for (int k = 0; k < mixture.lobes.size(); ++k)
    {
        if (!(mixture.probability[k] > 0.0f)) continue;
        chosen = k;
        sum += mixture.probability[k];
        if (pick < sum) break;
    }
    if (chosen < 0) return false;

    const Entry& entry = mixture.lobes[chosen];
    const float q = mixture.probability[chosen];
    const V2f uv = sampler.get2D(dimension(Draw::Scatter, bounce));
    const float w = sampler.get1D(dimension(Draw::Evaluate, bounce));
    V3f local(0.0f);
    C3f weight(0.0f);
    const float lobe_pdf =
        entry.lobe->sample(mixture.view[chosen], uv.x, uv.y, w, local, weight, nullptr);
    if (!std::isfinite(lobe_pdf) || (lobe_pdf > 0.0f && !is_finite(local)))
    {
        mark_faulty(path);
        return false;
    }
    if (!(lobe_pdf > 0.0f)) return false;
    const V3f direction = to_world(entry, local);
    if (!possible(direction, entry.lobe->label().ev)) return false;

    if (entry.lobe->label().is_singular())
    {
        path.throughput *= entry.weight * weight / q;
        path.alone = true;
    }
    else
    {
        C3f value = entry.weight * weight * lobe_pdf;
        float pdf = q * lobe_pdf;
        mixture.evaluate(direction, chosen, &value, &pdf);
        path.throughput *= value / pdf;
        path.pdf = pdf;
        path.alone = false;
    }
    const float ior = entry.lobe->ior();
    if (ior != 1.0f && !on_viewers_side(direction)) pass_interface(path, ior, point.front_facing);
    path.ray = hit.leave(direction);
    return path.throughput != C3f(0.0f);
}

}  // namespace regain::tools::preview
