// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The plug-in: SurfaceMaterial behind the batched adapter.

#include "surface_material.h"

#include <regain/renderman/closure_bxdf.h>
#include <regain/renderman/plugin.h>

#include <exception>
#include <string>

namespace {

using namespace surface_example;
using Factory = renderman::ClosureFactory<SurfaceMaterial>;

constexpr ParameterInfo parameters[] = {
    {"base_color", 3, {0.8f, 0.8f, 0.8f}, 0, 1, "of metal along the normal, and of the diffuse"},
    {"base_roughness", 1, {0.2f}, 0, 1, "of the diffuse"},
    {"metalness", 1, {0}, 0, 1, "how much of it is metal"},
    {"edge_color", 3, {1, 1, 1}, 0, 1, "of metal at 82 degrees"},
    {"specular_roughness", 1, {0.3f}, 0, 1, "the root of alpha"},
    {"specular_anisotropy", 1, {0}, 0, 1, "stretches highlights along the tangent"},
    {"specular_ior", 1, {1.5f}, 1, 4, "index inside over index outside"},
    {"transmission", 1, {0}, 0, 1, "how much of what is no metal is clear"},
    {"transmission_color", 3, {1, 1, 1}, 0, 1, "of what is transmitted"},
    {"coat", 1, {0}, 0, 1, "how much of it is coated"},
    {"coat_roughness", 1, {0.1f}, 0, 1, "the root of alpha"},
    {"coat_ior", 1, {1.5f}, 1, 4, "of the coat"},
    {"sheen", 1, {0}, 0, 1, "how much of it has fuzz"},
    {"sheen_color", 3, {1, 1, 1}, 0, 1, "of the fuzz"},
    {"sheen_roughness", 1, {0.3f}, 0, 1, "of the fuzz"},
    {"presence", 1, {1}, 0, 1, "where the surface is"},
    {"compensation", 1, {1}, 0, 1, "how much of the energy that is lost comes back"}};

Settings settings_of(const ParameterValue* values)
{
    Settings s;
    const auto number = [&] { return (values++)->v[0]; };
    const auto color = [&] {
        const float* v = (values++)->v;
        return Imath::C3f(v[0], v[1], v[2]);
    };
    s.base_color = color();
    s.base_roughness = number();
    s.metalness = number();
    s.edge_color = color();
    s.specular_roughness = number();
    s.specular_anisotropy = number();
    s.specular_ior = number();
    s.transmission = number();
    s.transmission_color = color();
    s.coat = number();
    s.coat_roughness = number();
    s.coat_ior = number();
    s.sheen = number();
    s.sheen_color = color();
    s.sheen_roughness = number();
    s.presence = number();
    s.compensation = number();
    return s;
}

// Tables are files, which may be missing.
void* create_instance_data(const ParameterValue* values, const char** error)
{
    static thread_local std::string why;
    try
    {
        return new SurfaceMaterial(settings_of(values));
    }
    catch (const std::exception& e)
    {
        why = e.what();
    }
    *error = why.c_str();
    return nullptr;
}

}  // namespace

extern "C" REGAIN_PLUGIN_EXPORT const regain::renderman::BxdfPlugin* regain_bxdf_plugin()
{
    static constexpr renderman::BxdfPlugin plugin{
        renderman::BxdfPlugin::current,
        REGAIN_VERSION_STRING,
        "surface",
        parameters,
        sizeof(parameters) / sizeof(*parameters),
        []() -> renderman::Factory* { return new Factory; },
        [](renderman::Factory* f) { delete f; },
        &create_instance_data,
        [](void* data) { delete static_cast<SurfaceMaterial*>(data); }};
    return &plugin;
}
