// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The module: CarPaint behind the one-point adapter.

#include "car_paint_material.h"

#include <regain/clarisse/closure_lobe.h>
#include <regain/clarisse/plugin.h>

#include <exception>
#include <string>

namespace {

using namespace car_paint_example;

constexpr ParameterInfo attributes[] = {
    {"pigment", 3, {0.35f, 0.02f, 0.02f}, 0, 1, "colour of the paint"},
    {"pigment_roughness", 1, {0.3f}, 0, 1, "of the paint"},
    {"flakes", 1, {0.4f}, 0, 1, "how much of it is flakes"},
    {"flake_color", 3, {0.9f, 0.4f, 0.35f}, 0, 1, "of their metal along its normal"},
    {"flake_roughness", 1, {0.5f}, 0, 1, "the root of alpha"},
    {"flake_tail", 1, {1.3f}, 0.1f, 10, "gamma of GTR: the less, the longer"},
    {"coat", 1, {1}, 0, 1, "how much of it is coated"},
    {"coat_roughness", 1, {0.05f}, 0, 1, "the root of alpha"},
    {"coat_ior", 1, {1.5f}, 1, 4, "of the coat"},
    {"opacity", 1, {1}, 0, 1, "where the surface is"}};

Settings settings_of(const ParameterValue* values)
{
    Settings s;
    const auto number = [&] { return (values++)->v[0]; };
    const auto color = [&] {
        const float* v = (values++)->v;
        return Imath::C3f(v[0], v[1], v[2]);
    };
    s.pigment = color();
    s.pigment_roughness = number();
    s.flakes = number();
    s.flake_color = color();
    s.flake_roughness = number();
    s.flake_tail = number();
    s.coat = number();
    s.coat_roughness = number();
    s.coat_ior = number();
    s.opacity = number();
    return s;
}

// Tables are files, which may be missing.
void* create_object(const ParameterValue* values, const char** error)
{
    static thread_local std::string why;
    try
    {
        return new CarPaint(settings_of(values));
    }
    catch (const std::exception& e)
    {
        why = e.what();
    }
    *error = why.c_str();
    return nullptr;
}

}  // namespace

extern "C" REGAIN_PLUGIN_EXPORT const regain::clarisse::MaterialModule* regain_material_module()
{
    static const clarisse::MaterialModule module{
        clarisse::MaterialModule::current,
        REGAIN_VERSION_STRING,
        "car_paint",
        attributes,
        sizeof(attributes) / sizeof(*attributes),
        &create_object,
        [](void* object) { delete static_cast<CarPaint*>(object); },
        clarisse::closure_callbacks<CarPaint, float>()};
    return &module;
}
