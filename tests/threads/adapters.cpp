// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Factories, module data and libraries of closures are made once and shared; bxdfs, scratchpads and
// composites are a thread's own.

#include "../../adapters/renderman/example/surface_material.h"
#include "../support/hosts.h"
#include "together.h"

#include <regain/osl/closure_library.h>

#include <gtest/gtest.h>

#include <memory>

using namespace regain;
using regain::tests::together;

namespace {

constexpr int threads = 4;

surface_example::SurfaceMaterial coated_metal()
{
    surface_example::Settings s;
    s.metalness = 0.5f;
    s.coat = 0.5f;
    return surface_example::SurfaceMaterial(s);
}

TEST(Threads, a_batched_factory_is_shared)
{
    const auto material = coated_metal();
    renderman::ClosureFactory<surface_example::SurfaceMaterial> factory;
    double sum[threads] = {};
    together(threads, [&](int t) {
        constexpr int n = 16;
        tests::GridHost host(n);
        std::fill(host.V.begin(), host.V.end(), renderman::Vec3(0.6f, 0, 0.8f));
        const auto all = renderman::LobeSet::all();
        renderman::Bxdf* bxdf =
            factory.beginScatter(&host.ctx, all, renderman::ShadeMode::Scatter, nullptr,
                                 const_cast<surface_example::SurfaceMaterial*>(&material));
        ASSERT_TRUE(bxdf);
        const std::vector<renderman::LobeSet> wanted(n, all);
        std::vector<renderman::Lobe> sampled(n);
        std::vector<renderman::Vec3> L(n);
        std::vector<float> fwd(n), rev(n);
        auto weights = host.weights();
        bxdf->generateSample(renderman::kAnyLighting, wanted.data(), &host.rng, sampled.data(),
                             L.data(), weights, fwd.data(), rev.data(), nullptr);
        for (int i = 0; i < n; ++i) sum[t] += double(weights.total(i).x) + double(fwd[i]);
        factory.endScatter(bxdf);
    });
    for (int t = 1; t < threads; ++t) EXPECT_EQ(sum[t], sum[0]);
    EXPECT_GT(sum[0], 0);
}

TEST(Threads, module_data_is_shared)
{
    const auto material = coated_metal();
    const auto callbacks = clarisse::closure_callbacks<surface_example::SurfaceMaterial, float>();
    void* data = callbacks.create_module_data(&material);
    float sum[threads] = {};
    together(threads, [&](int t) {
        auto memory = std::make_unique<std::max_align_t[]>(4096);
        clarisse::scratchpad pad(memory.get(), 4096 * sizeof(std::max_align_t));
        clarisse::shading_point<float> point;
        point.ng = point.ns = {0, 0, 1};
        point.tangent = {1, 0, 0};
        point.view = {0.6f, 0, 0.8f};
        clarisse::lobe_list<float> lobes;
        ASSERT_TRUE(callbacks.create_lobes(data, point, pad, lobes));
        for (int k = 0; k < lobes.size(); ++k)
            sum[t] += (lobes[k].weight * lobes[k].lobe->albedo({0.6f, 0, 0.8f})).x;
    });
    callbacks.destroy_module_data(&material, data);
    for (int t = 1; t < threads; ++t) EXPECT_EQ(sum[t], sum[0]);
    EXPECT_GT(sum[0], 0.5f);
}

// Makes the few closures that this test has.
struct MakeFew
{
    template <class Material>
    void operator()(const Material& material, float strength, const osl::ComponentFrame& frame,
                    const osl::ShaderGlobals& globals, const Imath::C3f& weight, bool asked,
                    osl::CompositeBsdf& composite, Imath::C3f& albedo,
                    osl::Problems& problems) const
    {
        if (const auto* plain = std::get_if<shaders::PlainMaterial>(&material))
            plain->with_closure(strength, [&](const auto& closure) {
                osl::add_closure(closure, frame, globals, weight, asked, composite, albedo,
                                 problems);
            });
    }
};

TEST(Threads, a_library_of_closures_is_shared)
{
    const osl::ClosureLibrary library;
    float sum[threads] = {};
    together(threads, [&](int t) {
        alignas(16) unsigned char memory[2048];
        osl::NodePool nodes(memory, sizeof memory);
        const osl::ShaderGlobals globals;
        osl::OrenNayarDiffuseParams chalk;
        osl::SheenParams fuzz;
        osl::ConductorParams metal;
        chalk.N = fuzz.N = metal.N = globals.N;
        const auto* base = nodes.add(nodes.component(osl::oren_nayar_diffuse_id, chalk),
                                     nodes.component(osl::conductor_id, metal));
        const auto* Ci = nodes.component(
            osl::layer_id, osl::LayerParams{nodes.component(osl::sheen_id, fuzz), base});
        const auto bsdf = std::make_unique<osl::CompositeBsdf>();
        EXPECT_EQ(library.flatten(Ci, globals, *bsdf, MakeFew{}), 0u);
        EXPECT_TRUE(bsdf->prepare(-globals.I));
        sum[t] = bsdf->sample(-globals.I, {0.3f, 0.4f, 0.5f}, 0.6f).weight.x +
                 bsdf->albedo(-globals.I).x;
    });
    for (int t = 1; t < threads; ++t) EXPECT_EQ(sum[t], sum[0]);
    EXPECT_GT(sum[0], 0);
}

}  // namespace
