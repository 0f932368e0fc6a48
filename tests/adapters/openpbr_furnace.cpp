// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The configurations that OpenPBR's specification lists under "White furnace testing": whatever a
// surface is put together of, where all its colours are white it gives back all light. Here they
// are settings of the example surface, whose layers are OpenPBR's: coat over fuzz over metal,
// translucent glass, or specular over diffuse or subsurface, which is the diffuse here.

#include "../../adapters/renderman/example/surface_material.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace regain;
using surface_example::Settings;
using surface_example::SurfaceMaterial;

namespace {

// Share of the light from wo that samples of a closure take along; alike spread random numbers.
double kept(const SurfaceMaterial& material, int k, const Vec3<double>& wo)
{
    return material.with_lobe(k, 1.0, [&](const auto& closure) {
        constexpr int samples = 8192;
        const auto prepared = closure.prepare(wo);
        double sum = 0;
        for (int i = 0; i < samples; ++i)
        {
            const auto u = [&](double step) {
                const double x = (i + 0.5) * step;
                return x - std::floor(x);
            };
            const auto s = prepared.sample(
                Vec3<double>(u(0.8191725133961645), u(0.6710436067037893), u(0.5497004779019703)));
            if (s.valid) sum += s.weight.y;
        }
        return sum / samples;
    });
}

double energy(const SurfaceMaterial& material, const Vec3<double>& wo)
{
    constexpr int most = SurfaceMaterial::parts;
    Color3<double> albedo[most], weight[most];
    for (int k = 0; k < material.lobes(); ++k)
        albedo[k] = material.with_lobe(k, 1.0, [&](const auto& closure) {
            const auto a = closure.prepare(wo).albedo();
            return a.reflect + a.transmit;
        });
    material.lobe_weights(albedo, weight);
    double sum = 0;
    for (int k = 0; k < material.lobes(); ++k) sum += weight[k].y * kept(material, k, wo);
    return sum;
}

struct Configuration
{
    const char* name;
    void (*set)(Settings&);
};

const Configuration configurations[] = {
    {"metal", [](Settings& s) { s.metalness = 1; }},
    {"dielectric over diffuse", [](Settings&) {}},
    {"dielectric over subsurface", [](Settings& s) { s.base_roughness = 0; }},
    {"translucent", [](Settings& s) { s.transmission = 1; }},
    {"diffuse and translucent", [](Settings& s) { s.transmission = 0.5f; }},
    {"metal and all of that", [](Settings& s) { s.metalness = s.transmission = 0.5f; }},
    {"coat over all of that",
     [](Settings& s) {
         s.metalness = s.transmission = 0.5f;
         s.coat = 1;
     }},
    {"half a coat over metal",
     [](Settings& s) {
         s.metalness = 1;
         s.coat = 0.5f;
     }},
    {"fuzz over all of that", [](Settings& s) {
         s.metalness = s.transmission = 0.5f;
         s.coat = 0.5f;
         s.sheen = 1;
     }}};

void expect_white(float anisotropy)
{
    for (const Configuration& c : configurations)
        for (const float roughness : {0.0f, 0.3f, 0.6f, 0.85f, 1.0f})
        {
            Settings s;
            s.base_color = Imath::C3f(1.0f);
            s.specular_roughness = roughness;
            s.coat_roughness = s.sheen_roughness = 0.2f + 0.8f * roughness;
            s.specular_anisotropy = anisotropy;
            c.set(s);
            const SurfaceMaterial material(s);
            for (const double mu : {0.1, 0.3, 0.6, 0.9, 1.0})
            {
                const double sine = std::sqrt((1 - mu) * (1 + mu));
                EXPECT_NEAR(energy(material, {sine * 0.8, sine * 0.6, mu}), 1, 5e-3)
                    << c.name << ", roughness " << roughness << ", mu " << mu;
            }
        }
}

TEST(OpenPBR, white_surfaces_disappear_in_a_furnace) { expect_white(0); }

TEST(OpenPBR, so_do_anisotropic_ones) { expect_white(0.5f); }

}  // namespace
