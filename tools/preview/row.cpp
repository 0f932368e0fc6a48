// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "row.h"

#include "../errors.h"
#include "bound_material.h"
#include "widget.h"

#include <fmt/format.h>

#include <utility>

namespace regain::tools::preview {

using Imath::C3f;
using Imath::V3f;
using shaders::MicrofacetMaterial;

namespace {

constexpr float kSpacing = 2.4f;

float height_of(Object object) { return object == Object::widget ? kWidgetHeight : kSphereHeight; }

}  // namespace

Host host_named(const std::string& wanted)
{
    for (const Host host : all_hosts)
        if (wanted == name(host)) return host;
    throw BadInput(
        fmt::format("--host {}: no such host; there are renderman, clarisse and osl", wanted));
}

const char* name(Host host)
{
    switch (host)
    {
        case Host::renderman: return "renderman";
        case Host::clarisse: return "clarisse";
        case Host::osl: return "osl";
    }
    return "";
}

Object object_named(const std::string& wanted)
{
    for (const Object object : {Object::widget, Object::sphere, Object::nested})
        if (wanted == name(object)) return object;
    throw BadInput(
        fmt::format("--object {}: no such object; there are widget, sphere, nested", wanted));
}

const char* name(Object object)
{
    switch (object)
    {
        case Object::widget: return "widget";
        case Object::sphere: return "sphere";
        case Object::nested: return "nested";
    }
    return "";
}

RowScene::RowScene(const RowLayout& layout) : _layout(layout)
{
    if (layout.floor) _scene.place(_scene.add_mesh(make_floor(400.0f)), V3f(0.0f), 0);
    std::vector<int> meshes;
    if (layout.object == Object::widget)
        meshes.push_back(_scene.add_mesh(make_widget(layout.transparent)));
    else
        meshes.push_back(_scene.add_mesh(make_standing_sphere()));
    if (layout.object == Object::nested) meshes.push_back(_scene.add_mesh(make_inner_sphere()));

    const float lift = layout.transparent && layout.floor ? 2e-3f : 0.0f;
    for (int i = 0; i < layout.objects; ++i)
        for (const int mesh : meshes)
            _scene.place(mesh, V3f(place(i), lift, 0.0f), i + 1, layout.turn);
    _scene.commit();
}

float RowScene::place(int i) const
{
    return kSpacing * (static_cast<float>(i) - 0.5f * static_cast<float>(_layout.objects - 1));
}

float RowScene::across(int i, float aspect) const
{
    return 0.5f +
           0.5f * place(i) /
               half_width_of_row(_layout.objects, kSpacing, height_of(_layout.object), aspect);
}

Camera RowScene::camera(float aspect) const
{
    return frame_row(_layout.objects, kSpacing, height_of(_layout.object), aspect);
}

MicrofacetMaterial floor_material()
{
    return shaders::SchlickMetal{C3f(0.3f), C3f(1.0f), 1.0f, 1.0f, Method::turquin};
}

namespace {

std::vector<std::unique_ptr<BoundMaterial>> with_tables(
    const std::vector<MicrofacetMaterial>& materials)
{
    std::vector<std::unique_ptr<BoundMaterial>> bound;
    for (MicrofacetMaterial material : materials)
    {
        material.bind_tables();
        bound.push_back(bind(material));
    }
    return bound;
}

}  // namespace

RowIntegrator::RowIntegrator(Host host, const World& world,
                             const std::vector<MicrofacetMaterial>& materials)
    : RowIntegrator(host, world, with_tables(materials))
{}

RowIntegrator::RowIntegrator(Host host, const World& world,
                             std::vector<std::unique_ptr<BoundMaterial>> materials)
    : _materials(std::move(materials))
{
    if (host == Host::renderman)
    {
        std::vector<GridMaterial> bound;
        for (const auto& m : _materials) bound.push_back(m->grid());
        _integrator = std::make_unique<GridIntegrator>(world, std::move(bound));
    }
    else if (host == Host::osl)
    {
        std::vector<OslMaterial> bound;
        for (const auto& m : _materials) bound.push_back(m->osl());
        _integrator = std::make_unique<OslIntegrator>(world, std::move(bound));
    }
    else
    {
        std::vector<PointMaterial> bound;
        for (const auto& m : _materials) bound.push_back(m->point());
        _integrator = std::make_unique<PointIntegrator>(world, bound);
    }
}

std::vector<const BoundMaterial*> RowIntegrator::materials() const
{
    std::vector<const BoundMaterial*> all;
    for (const auto& m : _materials) all.push_back(m.get());
    return all;
}

RowIntegrator::~RowIntegrator() = default;

}  // namespace regain::tools::preview
