// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "cloth.h"

#include "bind_as.h"
#include "osl_shader.h"

namespace regain::tools::preview {

namespace {

class BoundCloth final : public BoundAs<Cloth>
{
public:
    explicit BoundCloth(const Cloth& cloth) : BoundAs(cloth), _shader(tree_of(cloth)) {}
    OslMaterial osl() override { return {&_shader}; }

private:
    static shaders::ClosureTree tree_of(const Cloth& cloth)
    {
        shaders::MicrofacetMaterial sheen;
        sheen.surface = cloth.sheen;
        sheen.method = Method::none;
        shaders::OrenNayarSurface base;
        base.color = shaders::ColorD(cloth.base);
        shaders::ClosureTree tree;
        tree.set_root(tree.add(tree.lobe(shaders::PlainMaterial{base}), tree.lobe(sheen)));
        return tree;
    }

    TreeShader _shader;
};

}  // namespace

std::unique_ptr<BoundMaterial> bind(const Cloth& cloth)
{
    return std::make_unique<BoundCloth>(cloth);
}

}  // namespace regain::tools::preview
