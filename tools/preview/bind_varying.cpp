// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "bound_material.h"
#include "lobe_maker.h"
#include "osl_shader.h"
#include "surface_report.h"

#include <regain/renderman/per_point.h>
#include <regain/renderman/surface_bxdf.h>

#include <cstddef>

namespace regain::tools::preview {

using Imath::V4f;
using shaders::SurfacePoint;
using shaders::VaryingTree;

namespace {

// The tree's numbers at all points of a batch, one row a point.
struct Batch
{
    const VaryingTree* tree;
    V4f* values;

    const V4f* at(int i) const { return values + i * tree->values(); }

    // Null where the arena is spent.
    static Batch* create(const renderman::ShadingContext* ctx, const VaryingTree& tree)
    {
        auto* self = ctx->alloc<Batch>();
        auto* values = ctx->alloc<V4f>(static_cast<std::size_t>(ctx->numPts) *
                                       static_cast<std::size_t>(tree.values()));
        if (!self || !values) return nullptr;
        new (self) Batch{&tree, values};
        for (int i = 0; i < ctx->numPts; ++i)
        {
            SurfacePoint point;
            point.N = ctx->Nn[i];
            if (ctx->st) point.uv = ctx->st[i];
            if (ctx->Po) point.P = ctx->Po[i];
            tree.values_at(point, values + i * tree.values());
        }
        return self;
    }
};

// The instance data is the tree.
class VaryingFactory final : public renderman::Factory
{
public:
    renderman::Bxdf* beginScatter(const renderman::ShadingContext* ctx,
                                  const renderman::LobeSet& lobesWanted, renderman::ShadeMode mode,
                                  void*, void* instanceData) override
    {
        if (mode != renderman::ShadeMode::Scatter || !instanceData) return nullptr;
        const VaryingTree& tree = *static_cast<const VaryingTree*>(instanceData);
        const Batch* batch = Batch::create(ctx, tree);
        if (!batch) return nullptr;
        return renderman::SurfaceBxdf::create(
            ctx, this, lobesWanted, tree.lobes(), batch, &weights,
            [&](int k) -> renderman::LobeBatch* {
                return renderman::PerPointBatch::create(
                    ctx, [&](const renderman::ShadingContext* one, int i) {
                        const auto material = tree.material(k, batch->at(i));
                        return maker_of(material).single(one, material, tree.lobe_name(k));
                    });
            });
    }

    bool computesPresence(const void* instanceData) const override
    {
        return instanceData && !static_cast<const VaryingTree*>(instanceData)->is_all_there();
    }
    renderman::Opacity* beginOpacity(const renderman::ShadingContext* ctx, renderman::ShadeMode,
                                     void*, void* instanceData) override
    {
        if (!computesPresence(instanceData)) return nullptr;
        const VaryingTree& tree = *static_cast<const VaryingTree*>(instanceData);
        const Batch* batch = Batch::create(ctx, tree);
        if (!batch) return nullptr;
        return renderman::PerPointPresence::create(
            ctx, [&](int i) { return static_cast<float>(tree.presence(batch->at(i))); });
    }

private:
    static Imath::C3f weights(const void* data, int at, const Imath::C3f* albedo,
                              Imath::C3f* weight)
    {
        const Batch& batch = *static_cast<const Batch*>(data);
        return batch.tree->lobe_weights(albedo, weight, batch.at(at));
    }
};

SurfacePoint surface_point(const clarisse::shading_point<float>& p)
{
    return {{p.uvw.x, p.uvw.y}, p.p_object, p.ns};
}

bool create_lobes(const void* data, const clarisse::shading_point<float>& point,
                  clarisse::scratchpad& pad, clarisse::lobe_list<float>& list)
{
    using Color = clarisse::color<float>;
    const VaryingTree& tree = *static_cast<const VaryingTree*>(data);
    V4f values[VaryingTree::most_values];
    tree.values_at(surface_point(point), values);
    const auto add = [&](int k, clarisse::PendingLobes<float>& pending, Color* albedo) {
        const auto material = tree.material(k, values);
        return maker_of(material).add(material,
                                      {k, tree.lobe_name(k), point, pad, pending, albedo});
    };
    const auto weigh = [&](const Color* albedo, Color* weight) {
        tree.lobe_weights(albedo, weight, values);
    };
    return clarisse::assemble_lobes<float>(tree.lobes(), add, weigh, list);
}

class BoundVaryingTree final : public BoundMaterial
{
public:
    explicit BoundVaryingTree(const VaryingTree& tree) : _tree(tree)
    {
        _callbacks.create_module_data = [](const void* object) {
            return const_cast<void*>(object);
        };
        _callbacks.destroy_module_data = [](const void*, void*) {};
        _callbacks.create_lobes = &create_lobes;
        if (!tree.is_all_there())
            _callbacks.opacity = [](const void* data, const clarisse::shading_point<float>& point) {
                const auto& surface = *static_cast<const VaryingTree*>(data);
                V4f values[VaryingTree::most_values];
                surface.values_at(surface_point(point), values);
                return clarisse::color<float>(static_cast<float>(surface.presence(values)));
            };
    }
    bool reports() const override { return true; }
    SurfaceReport report(const SurfacePoint& point, const SeenPoint& seen) const override
    {
        V4f values[VaryingTree::most_values];
        _tree.values_at(point, values);
        return report_of(
            _tree.lobes(), seen, [&](int k) { return _tree.material(k, values); },
            [&](int k) { return _tree.lobe_name(k); },
            [&](const Imath::C3f* albedo, Imath::C3f* weight) {
                _tree.lobe_weights(albedo, weight, values);
            });
    }
    GridMaterial grid() override { return {&_factory, &_tree, true}; }
    PointMaterial point() override { return {&_callbacks, &_tree, true}; }
    OslMaterial osl() override
    {
        if (!_shader) _shader = std::make_unique<TreeShader>(_tree);
        return {_shader.get(), true};
    }

private:
    VaryingTree _tree;
    std::unique_ptr<TreeShader> _shader;
    VaryingFactory _factory;
    clarisse::material_callbacks<float> _callbacks;
};

}  // namespace

std::unique_ptr<BoundMaterial> bind(const VaryingTree& tree)
{
    if (!tree.varies()) return bind(tree.tree);
    return std::make_unique<BoundVaryingTree>(tree);
}

}  // namespace regain::tools::preview
