// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Documents written in place, for tests.

#pragma once

#include <regain/shaders/document.h>

#include <gtest/gtest.h>

#include <string>

namespace regain::tests {

/// A MaterialX 1.39 document of those elements.
inline std::string document(const std::string& elements,
                            const std::string& attributes = "colorspace=\"lin_ap1\"")
{
    return "<?xml version=\"1.0\"?>\n<materialx version=\"1.39\" " + attributes + ">\n" + elements +
           "\n</materialx>\n";
}

inline shaders::DocumentSettings settings()
{
    return shaders::DocumentSettings(shaders::ColorConfig::builtin());
}

/// Its first material.
inline shaders::VaryingTree surface_of(const std::string& text,
                                       std::vector<shaders::DocumentNote>* notes = nullptr,
                                       const shaders::DocumentSettings& with = settings())
{
    std::vector<shaders::DocumentNote> own;
    const auto d = shaders::MaterialDocument::parse(text, "test.mtlx", with);
    return d.surface(d.materials().at(0), notes ? *notes : own);
}

/// What reading it, and its first material, throws; empty where nothing.
inline std::string error_of(const std::string& text,
                            const shaders::DocumentSettings& with = settings())
{
    try
    {
        surface_of(text, nullptr, with);
    }
    catch (const shaders::DocumentError& e)
    {
        return e.what();
    }
    return {};
}

inline bool says(const std::string& message, const std::string& what)
{
    return message.find(what) != std::string::npos;
}

/// A material of one closure.
inline const shaders::MicrofacetMaterial& facets(const shaders::VaryingTree& surface, int k = 0)
{
    return std::get<shaders::MicrofacetMaterial>(surface.tree.material(k));
}
template <class Surface>
const Surface& plain(const shaders::VaryingTree& surface, int k = 0)
{
    return std::get<Surface>(std::get<shaders::PlainMaterial>(surface.tree.material(k)).surface);
}

inline void expect_color(const shaders::ColorD& a, double r, double g, double b,
                         double tolerance = 1e-5)
{
    EXPECT_NEAR(a.x, r, tolerance);
    EXPECT_NEAR(a.y, g, tolerance);
    EXPECT_NEAR(a.z, b, tolerance);
}

/// Weights of the closures towards a direction where each keeps that much.
inline std::vector<Imath::C3f> weights(const shaders::VaryingTree& surface,
                                       const std::vector<float>& albedo,
                                       const shaders::SurfacePoint& point = {})
{
    std::vector<Imath::C3f> a, w(static_cast<std::size_t>(surface.lobes()));
    for (const float x : albedo) a.emplace_back(x);
    Imath::V4f values[shaders::VaryingTree::most_values];
    surface.values_at(point, values);
    surface.lobe_weights(a.data(), w.data(), values);
    return w;
}

}  // namespace regain::tests
