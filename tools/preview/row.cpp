// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "row.h"

#include "../errors.h"
#include "grid_integrator.h"
#include "point_integrator.h"
#include "widget.h"

#include <regain/clarisse/closure_lobe.h>
#include <regain/renderman/closure_bxdf.h>

#include <fmt/format.h>

#include <utility>

namespace regain::tools::preview {

using Imath::C3f;
using Imath::V3f;
using shaders::SchlickMetal;

namespace {

constexpr float kSpacing = 2.4f;

}  // namespace

Host host_named(const std::string& wanted)
{
    for (const Host host : {Host::renderman, Host::clarisse})
        if (wanted == name(host)) return host;
    throw BadInput(
        fmt::format("--host {}: no such host; there are renderman and clarisse", wanted));
}

const char* name(Host host) { return host == Host::renderman ? "renderman" : "clarisse"; }

RowScene::RowScene(int widgets) : _widgets(widgets)
{
    const int floor = _scene.add_mesh(make_floor(400.0f));
    const int widget = _scene.add_mesh(make_widget());
    _scene.place(floor, V3f(0.0f), 0);
    for (int i = 0; i < widgets; ++i)
    {
        const float x = (static_cast<float>(i) - 0.5f * static_cast<float>(widgets - 1)) * kSpacing;
        _scene.place(widget, V3f(x, 0.0f, 0.0f), i + 1);
    }
    _scene.commit();
}

Camera RowScene::camera(float aspect) const
{
    return frame_row(_widgets, kSpacing, kWidgetHeight, aspect);
}

SchlickMetal floor_material()
{
    return SchlickMetal{C3f(0.3f), C3f(1.0f), 1.0f, 1.0f, Method::turquin};
}

struct RowIntegrator::Binding
{
    std::vector<SchlickMetal> materials;
    renderman::ClosureFactory<SchlickMetal> factory;
    clarisse::material_callbacks<float> callbacks =
        clarisse::closure_callbacks<SchlickMetal, float>();
};

RowIntegrator::RowIntegrator(Host host, const World& world, std::vector<SchlickMetal> materials)
    : _binding(std::make_unique<Binding>())
{
    _binding->materials = std::move(materials);
    if (host == Host::renderman)
    {
        std::vector<GridMaterial> bound;
        for (SchlickMetal& m : _binding->materials) bound.push_back({&_binding->factory, &m});
        _integrator = std::make_unique<GridIntegrator>(world, std::move(bound));
    }
    else
    {
        std::vector<PointMaterial> bound;
        for (const SchlickMetal& m : _binding->materials)
            bound.push_back({&_binding->callbacks, &m});
        _integrator = std::make_unique<PointIntegrator>(world, bound);
    }
}

RowIntegrator::~RowIntegrator() = default;

}  // namespace regain::tools::preview
