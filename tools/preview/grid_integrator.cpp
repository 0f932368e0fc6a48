// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "grid_integrator.h"

#include "arena.h"

#include <stdexcept>
#include <utility>

namespace regain::tools::preview {

using Imath::C3f;
using Imath::V2f;
using Imath::V3f;

namespace {

constexpr int kBatch = 256;  // points per call: their arrays stay in the cache

/// The host's random numbers for one batch: each point draws from its own path's sampler.
class BatchRng final : public renderman::Rng
{
public:
    void start(const Sampler* const* samplers, int n, std::uint32_t domain)
    {
        _samplers = samplers;
        _n = n;
        _domain = domain;
    }
    void draw1D(float* xi) override
    {
        for (int i = 0; i < _n; ++i) xi[i] = _samplers[i]->get1D(sobol::hash(_domain, 1));
    }
    void draw2D(V2f* xi) override
    {
        for (int i = 0; i < _n; ++i) xi[i] = _samplers[i]->get2D(sobol::hash(_domain, 2));
    }
    void newDomain(std::uint32_t scramble) override
    {
        _domain = sobol::hash(_domain, scramble + 3u);
    }

private:
    const Sampler* const* _samplers = nullptr;
    int _n = 0;
    std::uint32_t _domain = 0;
};

}  // namespace

struct GridIntegrator::Path : PathState
{
    Sampler sampler;
    Hit hit;
    int scattered = 0;
    bool went_by = false;  ///< the surface it was at last
};

/// Arrays of one batch, as the interface wants them.
struct GridIntegrator::Workspace
{
    Arena arena, query_arena;
    BatchRng rng;
    Path* present[kBatch];
    C3f opacity[kBatch];
    const Sampler* samplers[kBatch];
    V3f view[kBatch], normal[kBatch], geometric_normal[kBatch], tangent[kBatch];
    V2f st[kBatch];
    V3f in_object[kBatch];

    Environment::Light light[kBatch];
    C3f visible[kBatch];
    V3f direction[kBatch];
    renderman::LobeSet wanted[kBatch], evaluated[kBatch];
    renderman::Lobe sampled[kBatch];
    C3f weights[static_cast<std::size_t>(renderman::kMaxActive) * kBatch];
    float forward_pdf[kBatch], ior[kBatch];

    /// Of these paths where they are, on a material.
    renderman::ShadingContext context(const GridMaterial& material, Path* const* paths, int n)
    {
        for (int i = 0; i < n; ++i)
        {
            const Hit& hit = paths[i]->hit;
            samplers[i] = &paths[i]->sampler;
            view[i] = -paths[i]->ray.direction;
            normal[i] = hit.normal;
            geometric_normal[i] = hit.geometric_normal;
            tangent[i] = hit.tangent;
        }
        renderman::ShadingContext c;
        c.numPts = n;
        c.Vn = view;
        c.Nn = normal;
        c.Ngn = geometric_normal;
        c.Tn = tangent;
        c.allocFn = &Arena::allocate_from;
        c.arena = &arena;
        if (!material.textured) return c;
        for (int i = 0; i < n; ++i)
        {
            st[i] = paths[i]->hit.uv();
            in_object[i] = paths[i]->hit.in_object;
        }
        c.st = st;
        c.Po = in_object;
        return c;
    }

    /// Where `to` lies as seen from the viewer of point i, by the geometric normal.
    renderman::Domain place(int i, const V3f& to) const
    {
        const bool outside = view[i].dot(geometric_normal[i]) > 0.0f;
        const bool reflect = (to.dot(geometric_normal[i]) > 0.0f) == outside;
        if (outside) return reflect ? renderman::kOutsideReflect : renderman::kOutsideTransmit;
        return reflect ? renderman::kInsideReflect : renderman::kInsideTransmit;
    }
};

GridIntegrator::GridIntegrator(const World& world, std::vector<GridMaterial> materials)
    : _world(world), _materials(std::move(materials))
{
    for (const GridMaterial& m : _materials) _some_let_by = _some_let_by || lets_by(m);
}

void GridIntegrator::render(const Tile& tile, int first, int count, Film& film) const
{
    const int width = tile.x1 - tile.x0, height = tile.y1 - tile.y0;
    std::vector<Path> paths(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                            static_cast<std::size_t>(count));
    const auto workspace = std::make_unique<Workspace>();

    std::size_t next = 0;
    for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x)
            for (int s = first; s < first + count; ++s)
            {
                Path& path = paths[next++];
                path.sampler = Sampler(x, y, s, _world.seed);
                path.ray = camera_ray(_world, x, y, path.sampler);
            }

    std::vector<Path*> alive;
    alive.reserve(paths.size());
    for (Path& path : paths) alive.push_back(&path);
    std::vector<std::vector<Path*>> by_material(_materials.size());

    for (int bounce = 0; !alive.empty(); ++bounce)
    {
        for (auto& group : by_material) group.clear();
        for (Path* path : alive)
        {
            if (!_world.scene.intersect(path->ray, &path->hit))
                add_environment(_world.environment, *path);
            else if (path->scattered < _world.max_bounces)
                by_material[static_cast<std::size_t>(path->hit.material)].push_back(path);
        }
        alive.clear();
        for (std::size_t m = 0; m < by_material.size(); ++m)
        {
            std::vector<Path*>& group = by_material[m];
            for (std::size_t begin = 0; begin < group.size(); begin += kBatch)
            {
                const int n = static_cast<int>(std::min<std::size_t>(kBatch, group.size() - begin));
                shade(_materials[m], &group[begin], n, bounce, *workspace);
                for (int i = 0; i < n; ++i)
                {
                    Path* path = group[begin + static_cast<std::size_t>(i)];
                    if (path->throughput == C3f(0.0f)) continue;
                    if (path->went_by || survives(*path, bounce, path->sampler))
                        alive.push_back(path);
                }
            }
        }
    }

    next = 0;
    for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x)
            for (int s = 0; s < count; ++s) film.add(x, y, paths[next++].radiance);
}

/// One bounce of paths that are at points of one material.
void GridIntegrator::shade(const GridMaterial& material, Path* const* paths, int n, int bounce,
                           Workspace& w) const
{
    w.arena.reset();
    if (lets_by(material))
    {
        n = keep_present(material, paths, n, bounce, w);
        paths = w.present;
        if (n == 0) return;
    }
    const renderman::ShadingContext context = w.context(material, paths, n);
    renderman::Bxdf* bxdf = material.factory->beginScatter(&context, renderman::LobeSet::all(),
                                                           renderman::ShadeMode::Scatter, nullptr,
                                                           material.instance_data);
    if (!bxdf) throw std::runtime_error("a material refused to scatter, or its memory is spent");
    add_direct_light(*bxdf, paths, n, bounce, w);
    scatter(*bxdf, paths, n, bounce, w);
    material.factory->endScatter(bxdf);
}

bool GridIntegrator::lets_by(const GridMaterial& material) const
{
    return material.factory->computesPresence(material.instance_data);
}

void GridIntegrator::opacity_of(const GridMaterial& material,
                                const renderman::ShadingContext& context, C3f* result)
{
    renderman::Opacity* opacity = material.factory->beginOpacity(
        &context, renderman::ShadeMode::PresenceQuery, nullptr, material.instance_data);
    float presence[kBatch];
    const bool some = opacity && opacity->presence(presence),
               coloured = opacity && opacity->opacity(result);
    for (int i = 0; i < context.numPts; ++i)
    {
        if (!coloured) result[i] = C3f(1.0f);
        if (some) result[i] *= presence[i];
    }
    if (opacity) material.factory->endOpacity(opacity);
}

/// Where a ray to a light meets a surface.
C3f GridIntegrator::opacity_at(const Hit& hit, const V3f& view, Workspace& w) const
{
    const GridMaterial& material = _materials[static_cast<std::size_t>(hit.material)];
    if (!lets_by(material)) return C3f(1.0f);
    w.query_arena.reset();
    renderman::ShadingContext context;
    context.numPts = 1;
    context.Vn = &view;
    context.Nn = &hit.normal;
    context.Ngn = &hit.geometric_normal;
    context.Tn = &hit.tangent;
    context.allocFn = &Arena::allocate_from;
    context.arena = &w.query_arena;
    const V2f st = material.textured ? hit.uv() : V2f(0.0f);
    if (material.textured)
    {
        context.st = &st;
        context.Po = &hit.in_object;
    }
    C3f result;
    opacity_of(material, context, &result);
    return result;
}

/// Sends on the paths that go by the material. The others are w.present, as many as returned.
int GridIntegrator::keep_present(const GridMaterial& material, Path* const* paths, int n,
                                 int bounce, Workspace& w) const
{
    opacity_of(material, w.context(material, paths, n), w.opacity);
    int present = 0;
    for (int i = 0; i < n; ++i)
    {
        Path& path = *paths[i];
        const float u = path.sampler.get1D(dimension(Draw::Opacity, bounce));
        path.went_by = goes_by(path, path.hit, w.opacity[i], u);
        if (!path.went_by) w.present[present++] = &path;
    }
    return present;
}

/// Next-event estimation: one light sample a point.
void GridIntegrator::add_direct_light(renderman::Bxdf& bxdf, Path* const* paths, int n, int bounce,
                                      Workspace& w) const
{
    // Points where evaluating cannot give anything sit the call out. Among them are those in
    // shadow: next to a ray, a closure that walks is dear, and inside of glass half of all
    // directions to a light lead through it.
    const renderman::Domain domain = bxdf.evaluateDomain();
    for (int i = 0; i < n; ++i)
    {
        const auto [direction, light] =
            _world.environment.sample(paths[i]->sampler.get2D(dimension(Draw::Light, bounce)));
        w.direction[i] = direction;
        w.light[i] = light;
        w.visible[i] = C3f(0.0f);
        if (light.pdf > 0.0f && (domain & w.place(i, direction)))
            w.visible[i] = visibility(
                _world.scene, paths[i]->hit.leave(direction), _some_let_by,
                [&, towards = direction](const Hit& hit) { return opacity_at(hit, -towards, w); });
        w.wanted[i] = w.visible[i] == C3f(0.0f) ? renderman::LobeSet() : renderman::LobeSet::all();
    }

    renderman::LobeWeights weights(w.weights, n);
    w.rng.start(w.samplers, n, dimension(Draw::Evaluate, bounce));
    // Paths start at the camera alone: nobody asks for pdfs of the way back.
    bxdf.evaluateSample(renderman::kDirect, w.wanted, &w.rng, w.evaluated, w.direction, weights,
                        w.forward_pdf, nullptr);
    for (int i = 0; i < n; ++i)
    {
        if (!w.wanted[i].any() || !w.evaluated[i].any()) continue;
        const Environment::Light& light = w.light[i];
        const float share = mis_weight(light.pdf, w.forward_pdf[i]) / light.pdf;
        paths[i]->radiance +=
            paths[i]->throughput * weights.total(i) * w.visible[i] * light.radiance * share;
    }
}

/// The next direction of each path; a throughput of 0 ends it.
void GridIntegrator::scatter(renderman::Bxdf& bxdf, Path* const* paths, int n, int bounce,
                             Workspace& w) const
{
    for (int i = 0; i < n; ++i) w.wanted[i] = renderman::LobeSet::all();
    renderman::LobeWeights weights(w.weights, n);
    w.rng.start(w.samplers, n, dimension(Draw::Scatter, bounce));
    bxdf.generateSample(renderman::kAnyLighting, w.wanted, &w.rng, w.sampled, w.direction, weights,
                        w.forward_pdf, nullptr, nullptr);
    const bool two_media = bxdf.materialIor(w.ior);
    for (int i = 0; i < n; ++i)
    {
        Path& path = *paths[i];
        const renderman::Lobe& lobe = w.sampled[i];
        const V3f& direction = w.direction[i];
        const float pdf = w.forward_pdf[i];
        const bool faulty = lobe.valid && !(is_finite(direction) && std::isfinite(pdf));
        if (faulty) mark_faulty(path);
        // A lobe that scatters to the wrong side of the true surface does so only because normals
        // are interpolated.
        const auto right_side = [&] {
            return ((w.place(i, direction) & renderman::kReflect) != 0) == lobe.reflect;
        };
        if (faulty || !lobe.valid || !(pdf > 0.0f) || !right_side())
        {
            path.throughput = C3f(0.0f);
            continue;
        }
        path.throughput *= weights.total(i) / pdf;
        if (two_media && !lobe.reflect)
            pass_interface(path, w.ior[i], w.view[i].dot(w.geometric_normal[i]) > 0.0f);
        path.ray = path.hit.leave(direction);
        ++path.scattered;
        path.pdf = pdf;
        path.alone = lobe.discrete;
    }
}

}  // namespace regain::tools::preview
