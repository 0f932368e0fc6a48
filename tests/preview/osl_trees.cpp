// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Trees of closures as OSL leaves them, made by hand: what they are flattened to, with gains as
// closure weights, layers, and every way in which a tree can be wrong.

#include "../support/allocations.h"
#include "doubles.h"
#include "osl_renderer.h"

#include <regain/osl/registration.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>

namespace regain::tools::preview { namespace {

using Imath::C3f;
using Imath::V3f;
using osl::ClosureColor;
using Renderer = doubles::OslRenderer;
using shaders::ColorD;

const float nan = std::numeric_limits<float>::quiet_NaN();

void expect_color(const C3f& a, const C3f& b, float tolerance)
{
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance);
}

TEST(OslTrees, weights_of_products_and_of_components_both_count)
{
    Renderer r;
    const auto* a = r.nodes.multiply({0.5f, 1, 0}, r.diffuse(C3f(1), {1, 0.25f, 1}));
    const auto* b = r.nodes.multiply(C3f(0.5f), r.nodes.multiply({1, 0.5f, 1}, r.diffuse(C3f(1))));
    EXPECT_EQ(r.flatten(r.nodes.multiply(C3f(2), r.nodes.add(a, b))), 0u);
    ASSERT_EQ(r.bsdf.size(), 2);
    // Sums go on at their first part, so the second is flattened before it.
    expect_color(r.bsdf.weight(0), {1, 0.5f, 1}, 1e-6f);
    expect_color(r.bsdf.weight(1), {1, 0.5f, 0}, 1e-6f);
}

TEST(OslTrees, black_is_null)
{
    Renderer r;
    EXPECT_EQ(r.nodes.multiply(C3f(0.0f), r.diffuse()), nullptr);
    const auto* one = r.diffuse();
    EXPECT_EQ(r.nodes.multiply(C3f(1.0f), one), one);
    EXPECT_EQ(r.nodes.add(nullptr, one), one);
    EXPECT_EQ(r.flatten(nullptr), 0u);
    EXPECT_EQ(r.bsdf.size(), 0);
    EXPECT_EQ(r.flatten(r.layer(nullptr, nullptr)), 0u);
    EXPECT_TRUE(r.bsdf.prepare(r.wo()));
    EXPECT_EQ(r.bsdf.sample(r.wo(), V3f(0.5f), 0.5f).pdf, 0);
    // A weight of 0 that a shader left in a component.
    EXPECT_EQ(r.flatten(r.diffuse(C3f(1), C3f(0))), 0u);
    EXPECT_EQ(r.bsdf.size(), 0);
}

// The walk's weights are those of the same tree in the library's own terms, whose layers are tested
// with closures of all kinds.
TEST(OslTrees, layers_let_through_what_the_compensated_top_does_not_keep)
{
    Renderer r;
    const C3f w(0.8f, 0.5f, 0.25f), half(0.5f);
    const auto* top = r.nodes.add(r.nodes.multiply(half, r.coat()),
                                  r.nodes.multiply(C3f(0.25f), r.diffuse(C3f(1.0f))));
    EXPECT_EQ(r.flatten(r.layer(top, r.layer(r.coat(), r.diffuse(C3f(1.0f))), w)), 0u);
    ASSERT_EQ(r.bsdf.size(), 4);
    const C3f coat = r.bsdf.bsdf(1).albedo(r.wo());
    EXPECT_GT(coat.x, 0.03f);
    const C3f rest = C3f(1.0f) - (half * coat + C3f(0.25f));
    expect_color(r.bsdf.weight(0), w * C3f(0.25f), 1e-6f);
    expect_color(r.bsdf.weight(1), w * half, 1e-6f);
    expect_color(r.bsdf.weight(2), w * rest, 1e-5f);
    expect_color(r.bsdf.weight(3), w * rest * (C3f(1.0f) - coat), 1e-5f);
}

// White on white, a rough coat and rough metal in it: nothing is lost, by eval and by sample.
TEST(OslTrees, white_layers_lose_nothing)
{
    Renderer r;
    const auto* metal = r.nodes.component(osl::generalized_schlick_id, r.metal_params());
    const auto* base = r.nodes.add(r.nodes.multiply(C3f(0.4f), metal),
                                   r.nodes.multiply(C3f(0.6f), r.diffuse(C3f(1.0f))));
    EXPECT_EQ(r.flatten(r.layer(r.coat(), base)), 0u);
    ASSERT_TRUE(r.bsdf.prepare(r.wo()));
    EXPECT_NEAR(r.energy().y, 1, 5e-3f);
    expect_color(r.bsdf.albedo(r.wo()), C3f(1.0f), 5e-3f);

    constexpr int samples = 40000;
    double sum = 0;
    for (int i = 0; i < samples; ++i)
    {
        // Kronecker sequences of four irrational steps.
        const auto u = [&](double step) {
            const double x = (i + 0.5) * step;
            return float(std::min(x - std::floor(x), 0.99999));
        };
        const auto s = r.bsdf.sample(
            r.wo(), {u(0.8566748838545029), u(0.733891856627126), u(0.6287067210378087)},
            u(0.5385972572236101));
        sum += double(s.weight.y);
        if (!(s.pdf > 0) || i % 1000) continue;
        const auto e = r.bsdf.eval(r.wo(), s.wi);
        EXPECT_NEAR(e.pdf, s.pdf, 1e-4f * s.pdf);
        EXPECT_NEAR(e.weight.y, s.weight.y, 1e-4f * s.weight.y);
    }
    EXPECT_NEAR(sum / samples, 1, 5e-3);
}

// A gain is a weight: what is sampled, and its density, are those without it.
TEST(OslTrees, gains_change_neither_directions_nor_densities)
{
    Renderer with, without(Method::none);
    with.flatten(with.nodes.component(osl::generalized_schlick_id, with.metal_params()));
    without.flatten(without.nodes.component(osl::generalized_schlick_id, without.metal_params()));
    with.bsdf.prepare(with.wo());
    without.bsdf.prepare(without.wo());
    for (float u : {0.1f, 0.4f, 0.7f})
    {
        const auto a = with.bsdf.sample(with.wo(), {u, 0.3f, 0.5f}, 0.5f),
                   b = without.bsdf.sample(with.wo(), {u, 0.3f, 0.5f}, 0.5f);
        EXPECT_EQ(a.wi, b.wi);
        EXPECT_EQ(a.pdf, b.pdf);
        EXPECT_GT(a.weight.x, b.weight.x * 1.01f);
    }
    EXPECT_NEAR(with.energy().x, 1, 2e-3f);
}

TEST(OslTrees, weights_that_are_no_weights_leave_a_closure_out)
{
    Renderer r;
    for (const C3f& w : {C3f(nan), C3f(-1.0f), C3f(nan, -1, 0)})
    {
        r.nodes.reset();
        const auto* Ci = r.nodes.add(r.nodes.multiply(w, r.diffuse()), r.diffuse());
        EXPECT_EQ(r.flatten(Ci), osl::Problems(osl::bad_weight));
        EXPECT_EQ(r.bsdf.size(), 1);
        EXPECT_EQ(r.flatten(r.diffuse(C3f(1), w)), osl::Problems(osl::bad_weight));
        EXPECT_EQ(r.bsdf.size(), 0);
    }
    // One channel alone, and more than any surface has.
    EXPECT_EQ(r.flatten(r.diffuse(C3f(1), {1, nan, 1e30f})), osl::Problems(osl::bad_weight));
    expect_color(r.bsdf.weight(0), {1, 0, 1e6f}, 0);
}

// However many there are, their product is a number.
TEST(OslTrees, products_of_large_weights_stay_finite)
{
    Renderer r;
    const ClosureColor* Ci = r.diffuse(C3f(1), C3f(1e6f));
    for (int i = 0; i < 20; ++i) Ci = r.nodes.multiply({1e6f, 1e6f, 0}, Ci);
    EXPECT_EQ(r.flatten(r.layer(Ci, Ci, C3f(1e6f))), 0u);
    ASSERT_EQ(r.bsdf.size(), 1);
    expect_color(r.bsdf.weight(0), {1e6f, 1e6f, 0}, 0);
    ASSERT_TRUE(r.bsdf.prepare(r.wo()));
    EXPECT_TRUE(std::isfinite(r.bsdf.sample(r.wo(), V3f(0.5f), 0.5f).weight.x));
}

// Of what a host hands over with them, too.
TEST(OslTrees, hostile_parameters_and_globals_leave_no_nan)
{
    const float inf = std::numeric_limits<float>::infinity();
    for (const float bad : {nan, inf, -inf, 0.0f, -1.0f, 1e30f})
    {
        Renderer r;
        auto metal = r.metal_params();
        auto glass = r.glass_params();
        metal.roughness_x = glass.roughness_y = metal.exponent = glass.ior = bad;
        metal.f0 = metal.color82 = glass.reflection_tint = C3f(bad);
        metal.U = glass.N = V3f(bad);
        metal.gamma = glass.thinfilm_ior = bad;
        for (const V3f& N : {V3f(0, 0, 1), V3f(bad)})
        {
            r.nodes.reset();
            r.globals.N = r.globals.dPdu = N;
            r.flatten(r.layer(r.nodes.component(osl::dielectric_id, glass),
                              r.nodes.component(osl::generalized_schlick_id, metal)));
            if (!r.bsdf.prepare(r.wo())) FAIL() << bad;
            for (const float u : {0.0f, 0.5f, 0.999f})
            {
                const auto s = r.bsdf.sample(r.wo(), V3f(u), u);
                const auto e = r.bsdf.eval(r.wo(), V3f(-0.6f, 0, 0.8f));
                for (const float x : {s.pdf, s.weight.x, s.wi.z, e.pdf, e.weight.x})
                    EXPECT_TRUE(std::isfinite(x)) << bad;
            }
        }
    }
}

// What the defaults of a library can be asked for, without shading: sheets, too.
TEST(OslTrees, a_default_library_knows_every_kind)
{
    const Renderer r;
    const osl::ClosureLibrary library;
    alignas(16) unsigned char memory[8192];
    osl::NodePool nodes(memory, sizeof memory);
    for (const bool thin : {false, true})
        for (const int tints : {1, 2, 3})
        {
            auto p = r.glass_params();
            p.thin_walled = thin;
            p.reflection_tint = C3f(float(tints & 1));
            p.transmission_tint = C3f(float(tints >> 1));
            osl::ReadComponent read;
            osl::Problems problems = 0;
            const auto* c = nodes.component(osl::dielectric_id, p);
            EXPECT_TRUE(
                library.read(*static_cast<const osl::ClosureComponent*>(c), read, problems));
            EXPECT_EQ(problems, 0u) << thin << tints;
        }
}

TEST(OslTrees, more_than_fits_is_left_out_and_said)
{
    Renderer r;
    const ClosureColor* sum = nullptr;
    for (int i = 0; i < 20; ++i) sum = r.nodes.add(sum, r.diffuse());
    EXPECT_EQ(r.flatten(sum), osl::Problems(osl::too_many_bsdfs));
    EXPECT_EQ(r.bsdf.size(), osl::CompositeBsdf::most_bsdfs);

    // Chains as shaders build them take no depth; layers do.
    r.nodes.reset();
    sum = r.diffuse();
    for (int i = 0; i < 500; ++i) sum = r.nodes.add(sum, r.diffuse(C3f(1), C3f(0)));
    EXPECT_EQ(r.flatten(sum), 0u);
    EXPECT_EQ(r.bsdf.size(), 1);
    r.nodes.reset();
    const ClosureColor* deep = r.diffuse();
    for (int i = 0; i < 100; ++i) deep = r.layer(nullptr, deep);
    EXPECT_EQ(r.flatten(deep), osl::Problems(osl::too_deep));

    // No tree at all: it ends, too.
    osl::ClosureMul loop;
    loop.id = ClosureColor::mul;
    loop.weight = C3f(1.0f);
    loop.closure = &loop;
    EXPECT_EQ(r.flatten(&loop), osl::Problems(osl::too_many_nodes));

    alignas(16) unsigned char little[64];
    osl::NodePool small(little, sizeof little);
    EXPECT_EQ(small.component(osl::dielectric_id, osl::DielectricParams{}), nullptr);
    EXPECT_TRUE(small.full());
}

TEST(OslTrees, what_is_not_rendered_as_asked_is_said)
{
    Renderer r;
    const auto schlick = [&](const auto& change) {
        auto p = r.metal_params();
        change(p);
        return r.flatten(r.nodes.component(osl::generalized_schlick_id, p));
    };
    EXPECT_EQ(schlick([](auto&) {}), 0u);
    EXPECT_EQ(schlick([](auto& p) { p.distribution.text = "phong"; }), osl::unknown_distribution);
    EXPECT_EQ(schlick([](auto& p) { p.distribution.text = ""; }), 0u);
    EXPECT_EQ(schlick([](auto& p) { p.compensation.text = "magic"; }), osl::unknown_compensation);
    EXPECT_EQ(schlick([](auto& p) { p.compensation.text = "turquin"; }), 0u);
    EXPECT_EQ(schlick([](auto& p) { p.thinfilm_thickness = 300; }), osl::thin_film);
    EXPECT_EQ(schlick([](auto& p) { p.transmission_tint = C3f(1.0f); }), osl::schlick_transmission);
    EXPECT_EQ(schlick([](auto& p) { p.N = V3f(nan); }), osl::bad_normal);
    EXPECT_EQ(r.bsdf.size(), 1);

    // No tables were bound for conductors.
    EXPECT_EQ(r.flatten(r.nodes.component(osl::conductor_id, osl::ConductorParams{})),
              osl::no_tables);
    osl::SubsurfaceParams p;
    p.N = r.globals.N;
    EXPECT_EQ(r.flatten(r.nodes.component(osl::subsurface_id, p)), osl::subsurface_stand_in);
    EXPECT_EQ(r.flatten(r.nodes.component(77, p)), osl::unknown_closure);
    ClosureColor wrong{-7};
    EXPECT_EQ(r.flatten(&wrong), osl::unknown_closure);
    for (int k = 0; k < osl::problem_kinds; ++k)
        EXPECT_GT(std::strlen(osl::message(static_cast<osl::Problem>(1u << k))), 20u);
}

// A host's own components, such as emission, reach it with their weights.
// What adds any closure, asked about those without microfacets, which compile fast.
TEST(OslTrees, closures_can_be_made_without_the_preview)
{
    Renderer r;
    r.bsdf.clear();
    C3f albedo(0.0f);
    osl::Problems problems = 0;
    osl::ComponentFrame frame;
    frame.N = r.globals.N;
    osl::MakeAny{}(std::variant<shaders::PlainMaterial>(
                       shaders::PlainMaterial{shaders::TranslucentSurface{ColorD(0.7)}}),
                   1.0f, frame, r.globals, C3f(0.5f), true, r.bsdf, albedo, problems);
    EXPECT_EQ(problems, 0u);
    EXPECT_NEAR(albedo.x, 0.7f, 1e-5f);
    ASSERT_TRUE(r.bsdf.prepare(r.wo()));
    EXPECT_NEAR(r.energy().x, 0.35f, 2e-3f);
}

TEST(OslTrees, a_host_is_told_of_its_own_components)
{
    Renderer r;
    osl::ClosureLibrary library{osl::ClosureLibrary::Empty{}};
    C3f emitted(0.0f);
    const auto* Ci = r.nodes.multiply(C3f(0.5f), r.nodes.component(1000, 0, {1, 2, 3}));
    const auto found = library.flatten(
        Ci, r.globals, r.bsdf, [](auto&&...) { FAIL(); },
        [&](const osl::ClosureComponent& c, const C3f& weight) {
            emitted += weight;
            return c.id == 1000;
        });
    EXPECT_EQ(found, 0u);
    expect_color(emitted, {0.5f, 1, 1.5f}, 1e-6f);
}

TEST(OslTrees, normals_are_turned_to_the_side_that_is_seen)
{
    Renderer r;
    const auto energy_of = [&](const V3f& N) {
        osl::OrenNayarDiffuseParams p;
        p.N = N;
        p.albedo = C3f(0.5f);
        r.flatten(r.nodes.component(osl::oren_nayar_diffuse_id, p));
        r.bsdf.prepare(r.wo());
        return r.energy().x;
    };
    EXPECT_NEAR(energy_of({0, 0, 1}), 0.5f, 2e-3f);
    EXPECT_NEAR(energy_of({0, 0, -1}), 0.5f, 2e-3f);
    EXPECT_NEAR(energy_of({0, 0, 5}), 0.5f, 2e-3f);
    // The one bumped away from wo is black, and the one that only bends it loses what leaks.
    EXPECT_EQ(energy_of({-0.9f, 0, 0.1f}), 0);
    EXPECT_LT(energy_of({0.3f, 0, 0.9f}), 0.5f);
}

// Seen from inside, the index is the other way round.
TEST(OslTrees, back_faces_are_the_inside_of_glass)
{
    Renderer r;
    auto p = r.glass_params();
    p.roughness_x = p.roughness_y = 0;
    for (const bool backfacing : {false, true})
    {
        r.globals.backfacing = backfacing;
        ASSERT_EQ(r.flatten(r.nodes.component(osl::dielectric_id, p)), 0u);
        ASSERT_TRUE(r.bsdf.prepare(r.wo()));
        const float eta = backfacing ? 1 / 1.5f : 1.5f;
        int passed = 0;
        for (float u : {0.05f, 0.3f, 0.6f, 0.95f})
        {
            const auto s = r.bsdf.sample(r.wo(), {0.5f, 0.5f, u}, u);
            ASSERT_GT(s.pdf, 0);
            EXPECT_TRUE(s.singular);
            EXPECT_EQ(s.passes, s.wi.z < 0);
            EXPECT_NEAR(s.wi.x, s.passes ? -0.6f / eta : -0.6f, 1e-5f);
            EXPECT_NEAR(s.weight.x, s.passes ? 1 / (eta * eta) : 1, 1e-4f);
            passed += s.passes;
        }
        EXPECT_GT(passed, 0);
        EXPECT_EQ(r.bsdf.eval(r.wo(), V3f(-0.6f, 0, 0.8f)).pdf, 0);
    }
}

TEST(OslTrees, shading_allocates_nothing)
{
    Renderer r;
    const auto* Ci =
        r.layer(r.coat(),
                r.nodes.add(r.diffuse(), r.nodes.component(osl::dielectric_id, r.glass_params())));
    const long before = tests::allocations();
    r.flatten(Ci);
    r.bsdf.prepare(r.wo());
    for (float u : {0.1f, 0.5f, 0.9f}) r.bsdf.sample(r.wo(), V3f(u), u);
    EXPECT_EQ(tests::allocations(), before);
    EXPECT_EQ(r.bsdf.size(), 3);
}

// The order of stdosl.h, in the words of its declarations.
TEST(OslTrees, closures_are_registered_as_stdosl_declares_them)
{
    OSL::ShadingSystem system;
    osl::register_closures(system);
    const auto declared = [](const OSL::ShadingSystem::Closure& c) {
        std::string text = c.name;
        for (std::size_t k = 0; k + 1 < c.params.size(); ++k)
        {
            const auto& p = c.params[k];
            text += (k ? " " : ": ") + std::string(p.type.c_str()) + (p.key ? "=" : "") +
                    (p.key ? p.key : "");
        }
        return text;
    };
    const char* expected[] = {
        "oren_nayar_diffuse_bsdf: vector color float string=label int=energy_compensation",
        "burley_diffuse_bsdf: vector color float string=label",
        "dielectric_bsdf: vector vector color color float float float string "
        "float=thinfilm_thickness float=thinfilm_ior string=label float=gamma "
        "string=compensation string=transmission_shadowing int=thin_walled",
        "conductor_bsdf: vector vector float float color color string float=thinfilm_thickness "
        "float=thinfilm_ior string=label float=gamma string=compensation",
        "generalized_schlick_bsdf: vector vector color color float float color color float string "
        "float=thinfilm_thickness float=thinfilm_ior string=label float=gamma "
        "string=compensation color=color82",
        "translucent_bsdf: vector color string=label",
        "transparent_bsdf: string=label",
        "subsurface_bssrdf: vector color color float string=label",
        "sheen_bsdf: vector color float string=label int=mode",
        "layer: pointer pointer"};
    ASSERT_EQ(system.closures.size(), std::size(expected));
    for (std::size_t k = 0; k < std::size(expected); ++k)
    {
        const auto& c = system.closures[k];
        EXPECT_EQ(declared(c), expected[k]);
        EXPECT_EQ(c.id, int(k));
        int end = 0;
        bool keyed = false;
        for (std::size_t i = 0; i + 1 < c.params.size(); ++i)
        {
            const auto& p = c.params[i];
            EXPECT_GE(p.offset, end);
            EXPECT_EQ(std::size_t(p.field_size), p.type.size());
            end = p.offset + p.field_size;
            EXPECT_TRUE(p.key || !keyed) << "a positional parameter after a key";
            keyed = p.key;
        }
        EXPECT_LE(end, c.params.back().offset);
        EXPECT_LE(c.params.back().field_size, 16);
    }
}

}}  // namespace regain::tools::preview
