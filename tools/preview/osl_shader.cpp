// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "osl_shader.h"

#include "lobe_maker.h"

namespace regain::tools::preview {

using Imath::C3f;
using osl::ClosureColor;
using shaders::ClosureTree;
using shaders::MicrofacetMaterial;
using shaders::PlainMaterial;
using shaders::VaryingTree;

namespace {

// The names are literals, and end with a zero.
osl::StringParam string(std::string_view literal) { return {literal.data()}; }

template <class Params>
void describe_microfacets(const MicrofacetMaterial& m, const osl::ShaderGlobals& globals, Params& p)
{
    p.N = globals.N;
    p.U = globals.dPdu;
    p.roughness_x = float(m.alpha_x);
    p.roughness_y = float(m.alpha_y);
    p.distribution = string(name(m.distribution));
    p.gamma = float(m.gamma);
    p.compensation = string(name(m.method));
}

const ClosureColor* component(const MicrofacetMaterial& m, const osl::ShaderGlobals& globals,
                              osl::NodePool& pool)
{
    if (const auto* s = std::get_if<shaders::ConductorSurface>(&m.surface))
    {
        osl::ConductorParams p;
        describe_microfacets(m, globals, p);
        p.ior = C3f(s->n);
        p.extinction = C3f(s->k);
        return pool.component(osl::conductor_id, p);
    }
    if (const auto* s = std::get_if<shaders::SchlickSurface>(&m.surface))
    {
        osl::GeneralizedSchlickParams p;
        describe_microfacets(m, globals, p);
        p.f0 = C3f(s->F0);
        p.f90 = C3f(s->F90);
        p.exponent = float(s->exponent);
        // Of 0 alone the parameter means none.
        p.color82 = s->F82 == shaders::ColorD(0.0) ? C3f(1e-6f) : C3f(s->F82);
        return pool.component(osl::generalized_schlick_id, p);
    }
    if (const auto* s = std::get_if<shaders::InterfaceSurface>(&m.surface))
    {
        osl::DielectricParams p;
        describe_microfacets(m, globals, p);
        const C3f black(0.0f);
        p.reflection_tint = s->mode == ScatterMode::T ? black : C3f(s->reflection_tint);
        p.transmission_tint = s->mode == ScatterMode::R ? black : C3f(s->transmission_tint);
        p.ior = float(s->eta);
        p.transmission_shadowing =
            string(s->shadowing == TransmissionShadowing::beta ? "beta" : "correlated");
        p.thin_walled = s->thin_walled;
        return pool.component(osl::dielectric_id, p);
    }
    const auto& s = std::get<shaders::SheenSurface>(m.surface);
    osl::SheenParams p;
    p.N = globals.N;
    p.albedo = C3f(s.color);
    p.mode = 2;
    return pool.multiply(C3f(float(s.weight)), pool.component(osl::sheen_id, p));
}

const ClosureColor* component(const PlainMaterial& m, const osl::ShaderGlobals& globals,
                              osl::NodePool& pool)
{
    if (const auto* s = std::get_if<shaders::OrenNayarSurface>(&m.surface))
    {
        osl::OrenNayarDiffuseParams p;
        p.N = globals.N;
        p.albedo = C3f(s->color);
        p.roughness = float(s->roughness);
        p.energy_compensation = s->energy_compensation;
        return pool.component(osl::oren_nayar_diffuse_id, p);
    }
    if (const auto* s = std::get_if<shaders::BurleyDiffuseSurface>(&m.surface))
    {
        osl::BurleyDiffuseParams p;
        p.N = globals.N;
        p.albedo = C3f(s->color);
        p.roughness = float(s->roughness);
        return pool.component(osl::burley_diffuse_id, p);
    }
    if (const auto* s = std::get_if<shaders::SubsurfaceSurface>(&m.surface))
    {
        osl::SubsurfaceParams p;
        p.N = globals.N;
        p.albedo = C3f(s->color);
        return pool.component(osl::subsurface_id, p);
    }
    if (const auto* s = std::get_if<shaders::TranslucentSurface>(&m.surface))
    {
        osl::TranslucentParams p;
        p.N = globals.N;
        p.albedo = C3f(s->color);
        return pool.component(osl::translucent_id, p);
    }
    if (const auto* s = std::get_if<shaders::TransparentSurface>(&m.surface))
        return pool.component(osl::transparent_id, osl::TransparentParams{}, C3f(s->color));
    const auto& s = std::get<shaders::ClothSurface>(m.surface);
    osl::SheenParams p;
    p.N = globals.N;
    p.albedo = C3f(s.color);
    p.roughness = float(s.roughness);
    p.mode = s.mode == shaders::ClothMode::zeltner;
    return pool.component(osl::sheen_id, p);
}

// `values` are null where nothing varies.
const ClosureColor* closure_of(const VaryingTree& surface, const Imath::V4f* values,
                               ClosureTree::Node node, const osl::ShaderGlobals& globals,
                               osl::NodePool& pool)
{
    using Kind = ClosureTree::Kind;
    const ClosureTree& tree = surface.tree;
    const ClosureTree::Made& made = tree.made(node);
    const auto part = [&](ClosureTree::Node n) {
        return closure_of(surface, values, n, globals, pool);
    };
    const C3f weight =
        made.parameter < 0 ? C3f(made.weight) : surface.weight(made.parameter, values);
    switch (made.kind)
    {
        case Kind::lobe: {
            const auto here = [&](const auto& m) { return component(m, globals, pool); };
            if (!values) return std::visit(here, tree.material_of(node));
            return std::visit(here, surface.material_of(node, values));
        }
        case Kind::layer:
            return pool.component(osl::layer_id,
                                  osl::LayerParams{part(made.first), part(made.second)});
        case Kind::mix: {
            return pool.add(pool.multiply(weight, part(made.first)),
                            pool.multiply(C3f(1.0f) - weight, part(made.second)));
        }
        case Kind::add: return pool.add(part(made.first), part(made.second));
        case Kind::multiply: return pool.multiply(weight, part(made.first));
    }
    return nullptr;
}

}  // namespace

namespace {

// The kinds of closures of the tree, with their tables.
osl::ClosureLibrary library_of(const VaryingTree& surface)
{
    osl::ClosureLibrary library{osl::ClosureLibrary::Empty{}};
    const bool several = surface.lobes() > 1 || surface.tree.presence() < 1;
    std::vector<const ClosureTree*> trees{&surface.tree};
    for (const ClosureTree& of_tiles : surface.trees_of_tiles()) trees.push_back(&of_tiles);
    // A kind is looked for by what it is, which says nothing of its widths: first those that have
    // the tables of two.
    for (const bool anisotropic : {true, false})
        for (const ClosureTree* tree : trees)
            for (int k = 0; k < tree->lobes(); ++k)
            {
                const auto* m = std::get_if<MicrofacetMaterial>(&tree->material(k));
                if (!m || std::holds_alternative<shaders::SheenSurface>(m->surface)) continue;
                if ((m->alpha_x != m->alpha_y) == anisotropic) library.add(*m, several);
            }
    return library;
}

}  // namespace

TreeShader::TreeShader(const VaryingTree& surface) : OslShader(library_of(surface)), _tree(surface)
{
    const ClosureTree& tree = surface.tree;
    _lets_by = !surface.is_all_there();
    for (int k = 0; k < tree.lobes(); ++k)
        if (const auto* m = std::get_if<PlainMaterial>(&tree.material(k)))
            _lets_by |= std::holds_alternative<shaders::TransparentSurface>(m->surface);
}

const ClosureColor* TreeShader::shade(const osl::ShaderGlobals& globals, osl::NodePool& pool) const
{
    Imath::V4f all[VaryingTree::most_values];
    const Imath::V4f* values = _tree.varies() ? all : nullptr;
    if (values) _tree.values_at({{globals.u, globals.v}, globals.P, globals.N}, all);
    const ClosureColor* Ci = closure_of(_tree, values, _tree.tree.root(), globals, pool);
    // OSL has no presence but light that goes by.
    const auto presence = static_cast<float>(_tree.presence(values));
    if (presence == 1) return Ci;
    return pool.add(pool.multiply(C3f(presence), Ci),
                    pool.multiply(C3f(1 - presence),
                                  pool.component(osl::transparent_id, osl::TransparentParams{})));
}

osl::Problems OslShader::flatten(const ClosureColor* Ci, const osl::ShaderGlobals& globals,
                                 osl::CompositeBsdf& composite) const
{
    return _library.flatten(
        Ci, globals, composite,
        [](const ClosureTree::Material& material, float strength, const osl::ComponentFrame& frame,
           const osl::ShaderGlobals& at, const C3f& weight, bool asked, osl::CompositeBsdf& into,
           C3f& albedo, osl::Problems& problems) {
            maker_of(material).add_bsdf(
                material, {strength, frame, at, weight, asked, into, albedo, problems});
        },
        [](const osl::ClosureComponent&, const C3f&) { return false; });
}

}  // namespace regain::tools::preview
