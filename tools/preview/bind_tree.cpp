// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "bound_material.h"
#include "lobe_maker.h"
#include "osl_shader.h"
#include "surface_report.h"

#include <regain/renderman/surface_bxdf.h>
#include <regain/renderman/uniform_presence.h>

namespace regain::tools::preview {

using shaders::ClosureTree;

const LobeMaker& maker_of(const ClosureTree::Material& material)
{
    using shaders::DistributionKind;
    const auto* m = std::get_if<shaders::MicrofacetMaterial>(&material);
    if (!m) return plain_lobes;
    switch (m->distribution)
    {
        case DistributionKind::beckmann: return beckmann_lobes;
        case DistributionKind::gtr: return gtr_lobes;
        case DistributionKind::std: return std_lobes;
        case DistributionKind::ggx: break;
    }
    return ggx_lobes;
}

namespace {

// The instance data is the tree.
class TreeFactory final : public renderman::Factory
{
public:
    renderman::Bxdf* beginScatter(const renderman::ShadingContext* ctx,
                                  const renderman::LobeSet& lobesWanted, renderman::ShadeMode mode,
                                  void*, void* instanceData) override
    {
        if (mode != renderman::ShadeMode::Scatter || !instanceData) return nullptr;
        const ClosureTree& tree = *static_cast<const ClosureTree*>(instanceData);
        return renderman::SurfaceBxdf::create(
            ctx, this, lobesWanted, tree.lobes(), &tree, &weights, [&](int k) {
                const auto& material = tree.material(k);
                return maker_of(material).batch(ctx, material, tree.lobe_name(k));
            });
    }

    bool computesPresence(const void* instanceData) const override
    {
        return instanceData && static_cast<const ClosureTree*>(instanceData)->presence() < 1;
    }
    renderman::Opacity* beginOpacity(const renderman::ShadingContext* ctx, renderman::ShadeMode,
                                     void*, void* instanceData) override
    {
        if (!computesPresence(instanceData)) return nullptr;
        return renderman::UniformPresence::create(
            ctx, presence_of<float>(*static_cast<const ClosureTree*>(instanceData)));
    }

private:
    static Imath::C3f weights(const void* tree, int, const Imath::C3f* albedo, Imath::C3f* weight)
    {
        return static_cast<const ClosureTree*>(tree)->lobe_weights(albedo, weight);
    }
};

bool create_lobes(const void* data, const clarisse::shading_point<float>& point,
                  clarisse::scratchpad& pad, clarisse::lobe_list<float>& list)
{
    using Color = clarisse::color<float>;
    const ClosureTree& tree = *static_cast<const ClosureTree*>(data);
    const auto add = [&](int k, clarisse::PendingLobes<float>& pending, Color* albedo) {
        const auto& material = tree.material(k);
        return maker_of(material).add(material,
                                      {k, tree.lobe_name(k), point, pad, pending, albedo});
    };
    const auto weigh = [&](const Color* albedo, Color* weight) {
        tree.lobe_weights(albedo, weight);
    };
    return clarisse::assemble_lobes<float>(tree.lobes(), add, weigh, list);
}

class BoundTree final : public BoundMaterial
{
public:
    explicit BoundTree(const ClosureTree& tree) : _tree(tree)
    {
        _callbacks.create_module_data = [](const void* object) {
            return const_cast<void*>(object);
        };
        _callbacks.destroy_module_data = [](const void*, void*) {};
        _callbacks.create_lobes = &create_lobes;
        if (tree.presence() < 1)
            _callbacks.opacity = [](const void* data, const clarisse::shading_point<float>&) {
                return clarisse::color<float>(
                    presence_of<float>(*static_cast<const ClosureTree*>(data)));
            };
    }
    bool reports() const override { return true; }
    SurfaceReport report(const shaders::SurfacePoint&, const SeenPoint& seen) const override
    {
        return report_of(
            _tree.lobes(), seen, [&](int k) { return _tree.material(k); },
            [&](int k) { return _tree.lobe_name(k); },
            [&](const Imath::C3f* albedo, Imath::C3f* weight) {
                _tree.lobe_weights(albedo, weight);
            });
    }
    GridMaterial grid() override { return {&_factory, &_tree}; }
    PointMaterial point() override { return {&_callbacks, &_tree}; }
    OslMaterial osl() override
    {
        if (!_shader) _shader = std::make_unique<TreeShader>(_tree);
        return {_shader.get()};
    }

private:
    ClosureTree _tree;
    std::unique_ptr<TreeShader> _shader;
    TreeFactory _factory;
    clarisse::material_callbacks<float> _callbacks;
};

}  // namespace

std::unique_ptr<BoundMaterial> bind(const ClosureTree& tree)
{
    return std::make_unique<BoundTree>(tree);
}

std::unique_ptr<BoundMaterial> bind(const shaders::MicrofacetMaterial& material)
{
    return bind(ClosureTree(material));
}

}  // namespace regain::tools::preview
