// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// What renderers in the manner of OSL's are apt to get wrong, one test each, by the numbers of
// ../adapters/traps_renderman.cpp. Where a trap is one of batches or of paths from the light, its
// counterpart at one point and in one direction is tested.

#include "../support/allocations.h"
#include "osl_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <thread>
#include <vector>

namespace regain::tools::preview { namespace {

using doubles::OslRenderer;
using Imath::C3f;
using Imath::V3f;

const float pi = static_cast<float>(M_PI);
const float last = 0.99999994f;  // below 1

V3f direction(float mu, float phi = 0)
{
    const float s = std::sqrt((1 - mu) * (1 + mu));
    return {s * std::cos(phi), s * std::sin(phi), mu};
}

// Evenly spread, the i-th of a sequence.
V3f numbers(int i)
{
    const auto u = [&](double step) {
        const double x = (i + 0.5) * step;
        return static_cast<float>(std::min(x - std::floor(x), double(last)));
    };
    return {u(0.8566748838545029), u(0.733891856627126), u(0.6287067210378087)};
}
float pick(int i)
{
    const double x = (i + 0.5) * 0.5385972572236101;
    return static_cast<float>(std::min(x - std::floor(x), double(last)));
}

// A renderer that has flattened half a white diffuse, half a white rough metal.
struct HalfAndHalf : OslRenderer
{
    using OslRenderer::OslRenderer;

    const osl::ClosureColor* metal()
    {
        return nodes.component(osl::generalized_schlick_id, metal_params());
    }
    void see_from(const V3f& wo, const C3f& dull = C3f(0.5f), const C3f& shiny = C3f(0.5f))
    {
        globals.I = -wo;
        nodes.reset();
        const auto* Ci =
            nodes.add(nodes.multiply(dull, diffuse(C3f(1.0f))), nodes.multiply(shiny, metal()));
        EXPECT_EQ(flatten(Ci), 0u);
        ASSERT_TRUE(bsdf.prepare(wo));
    }
    void see(const osl::ClosureColor* Ci, osl::Problems expected = 0)
    {
        EXPECT_EQ(flatten(Ci), expected);
        ASSERT_TRUE(bsdf.prepare(wo()));
    }
    C3f value(const V3f& wi) const
    {
        const auto e = bsdf.eval(wo(), wi);
        return e.weight * e.pdf;
    }
    // Mean of what samples take along.
    double sampled(int count = 20000) const
    {
        double sum = 0;
        for (int i = 0; i < count; ++i)
            sum += double(bsdf.sample(wo(), numbers(i), pick(i)).weight.y);
        return sum / count;
    }
    // Of the density, by uniform cells.
    double integral_of_pdf() const
    {
        constexpr int rows = 400, columns = 200;
        double sum = 0;
        for (int i = 0; i < rows; ++i)
            for (int j = 0; j < columns; ++j)
                sum += double(bsdf.eval(wo(), direction(2 * (float(i) + 0.5f) / rows - 1,
                                                        2 * pi * (float(j) + 0.5f) / columns))
                                  .pdf);
        return sum * 4 * M_PI / (rows * columns);
    }
};

TEST(HostTrapsInOsl, trap_01_weights_are_over_the_pdf_and_have_the_cosine)
{
    HalfAndHalf r;
    r.see(r.diffuse(C3f(0.8f)));
    const auto e = r.bsdf.eval(r.wo(), direction(0.3f, 2));
    EXPECT_NEAR(e.weight.x, 0.8f, 1e-5f);
    EXPECT_NEAR(e.pdf, 0.3f / pi, 1e-6f);
    EXPECT_NEAR(r.bsdf.sample(r.wo(), V3f(0.3f, 0.6f, 0.5f), 0.5f).weight.x, 0.8f, 1e-5f);
    // A furnace by eval and by sample.
    r.see_from(direction(0.6f, 1));
    EXPECT_NEAR(r.energy().y, 1, 5e-3);
    EXPECT_NEAR(r.sampled(), 1, 5e-3);
    EXPECT_NEAR(r.bsdf.albedo(r.wo()).y, 1, 2e-3);
}

TEST(HostTrapsInOsl, trap_02_sample_says_what_eval_says)
{
    HalfAndHalf r;
    int valid = 0;
    for (int i = 0; i < 300; ++i)
    {
        r.see_from(direction(0.1f + 0.9f * pick(3 * i), 7 * pick(i)));
        const auto s = r.bsdf.sample(r.wo(), numbers(i), pick(i)), e = r.bsdf.eval(r.wo(), s.wi);
        if (!(s.pdf > 0)) continue;
        ++valid;
        EXPECT_NEAR(s.pdf / e.pdf, 1, 1e-4);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(s.weight[c] / e.weight[c], 1, 1e-4);
    }
    EXPECT_GT(valid, 250);
}

TEST(HostTrapsInOsl, trap_03_the_pdf_is_that_of_the_mixture)
{
    HalfAndHalf r;
    r.see_from(direction(0.6f, 1));
    ASSERT_EQ(r.bsdf.size(), 2);
    constexpr int samples = 20000;
    int valid = 0;
    for (int i = 0; i < samples; ++i) valid += r.bsdf.sample(r.wo(), numbers(i), pick(i)).pdf > 0;
    EXPECT_NEAR(r.integral_of_pdf(), double(valid) / samples, 3e-3);
    EXPECT_LT(valid, samples) << "the metal samples some below the surface";
    for (int i = 0; i < 20; ++i)
    {
        const V3f wi = direction(0.05f + 0.9f * pick(i), 7 * pick(2 * i));
        double mixture = 0;
        for (int k = 0; k < 2; ++k)
            mixture += double(r.bsdf.probability(k)) * double(r.bsdf.bsdf(k).eval(r.wo(), wi).pdf);
        EXPECT_NEAR(double(r.bsdf.eval(r.wo(), wi).pdf) / mixture, 1, 1e-5);
    }
}

// Nobody asks for single lobes here; what a shader turns off, it gives no weight.
TEST(HostTrapsInOsl, trap_04_what_has_no_weight_has_no_share)
{
    HalfAndHalf r;
    r.see_from(direction(0.6f), C3f(0.0f), C3f(0.5f));
    ASSERT_EQ(r.bsdf.size(), 1);
    EXPECT_EQ(r.bsdf.probability(0), 1);
    EXPECT_NEAR(r.sampled(), 0.5, 5e-3) << "the other's half is not made good";
    r.see_from(direction(0.6f), C3f(0.5f), C3f(0.0f));
    EXPECT_NEAR(r.sampled(), 0.5, 5e-3);
    // One channel is enough.
    r.see_from(direction(0.6f), C3f(0.5f, 0, 0), C3f(0, 0.5f, 0));
    EXPECT_EQ(r.bsdf.size(), 2);
    EXPECT_EQ(r.bsdf.eval(r.wo(), direction(0.5f)).weight.z, 0);
}

TEST(HostTrapsInOsl, trap_05_what_finds_no_place_is_not_sampled)
{
    HalfAndHalf r;
    const osl::ClosureColor* sum = nullptr;
    for (int i = 0; i < 20; ++i)
        sum = r.nodes.add(sum, r.nodes.multiply(C3f(0.05f), r.diffuse(C3f(1.0f))));
    r.see(sum, osl::too_many_bsdfs);
    EXPECT_EQ(r.bsdf.size(), osl::CompositeBsdf::most_bsdfs);
    float all = 0;
    for (int k = 0; k < r.bsdf.size(); ++k) all += r.bsdf.probability(k);
    EXPECT_NEAR(all, 1, 1e-5);
    EXPECT_NEAR(r.sampled(), 0.8, 5e-3);
    EXPECT_NEAR(r.energy().x, 0.8, 5e-3);
}

// There are no paths from the light; whoever wants the reverse pdf asks at the other end.
TEST(HostTrapsInOsl, trap_06_chances_are_those_of_the_end_that_is_sampled)
{
    const V3f a = direction(0.95f, 1), b = direction(0.1f, 4);
    HalfAndHalf r, without(Method::none);
    float chance[2];
    for (const bool back : {false, true})
    {
        const V3f &wo = back ? b : a, &wi = back ? a : b;
        // Of unlike weights, so that chances depend on the albedo at either end.
        r.see_from(wo, C3f(0.5f), C3f(0.5f, 0.1f, 0));
        without.see_from(wo, C3f(0.5f), C3f(0.5f, 0.1f, 0));
        double pdf = 0;
        for (int k = 0; k < 2; ++k)
            pdf += double(r.bsdf.probability(k)) *
                   double(without.bsdf.bsdf(k).eval(wo, wi).pdf);  // a gain is in no pdf
        EXPECT_NEAR(double(r.bsdf.eval(wo, wi).pdf) / pdf, 1, 1e-5);
        chance[back] = without.bsdf.probability(0);
    }
    EXPECT_GT(std::abs(chance[0] - chance[1]), 1e-3);
}

TEST(HostTrapsInOsl, trap_07_gains_are_those_of_the_known_direction)
{
    const V3f a = direction(0.2f, 0.3f), b = direction(0.9f, 2.5f);
    HalfAndHalf with, without(Method::none);
    double gain[2];
    for (const bool back : {false, true})
    {
        const V3f &wo = back ? b : a, &wi = back ? a : b;
        for (HalfAndHalf* r : {&with, &without}) r->see_from(wo, C3f(0.0f), C3f(1.0f));
        gain[back] = double(with.value(wi).x / without.value(wi).x);
        EXPECT_NEAR(gain[back] * double(without.bsdf.albedo(wo).x), 1, 2e-3);
        EXPECT_EQ(with.bsdf.eval(wo, wi).pdf, without.bsdf.eval(wo, wi).pdf);
    }
    EXPECT_GT(std::abs(gain[0] / gain[1] - 1), 0.02);
}

TEST(HostTrapsInOsl, trap_08_radiance_is_scaled_once_and_albedo_is_energy)
{
    HalfAndHalf r;
    for (const bool backfacing : {false, true})
    {
        r.globals.backfacing = backfacing;
        r.nodes.reset();
        r.see(r.nodes.component(osl::dielectric_id, r.glass_params()));
        // Back at what was known of the energy: index on the side of wi over that of wo, squared.
        const double scale = backfacing ? 1 / 2.25 : 2.25;
        double reflected = 0, transmitted = 0;
        constexpr int count = 40000;
        for (int i = 0; i < count; ++i)
        {
            const auto s = r.bsdf.sample(r.wo(), numbers(i), pick(i));
            EXPECT_EQ(s.passes, s.pdf > 0 && s.wi.z < 0);
            EXPECT_EQ(s.ior, s.pdf > 0 ? 1.5f : 1.0f) << "by which a host undoes the factor";
            (s.passes ? transmitted : reflected) += double(s.weight.x) / count;
        }
        EXPECT_NEAR(reflected + transmitted * scale, 1, 1e-2) << backfacing;
        EXPECT_GT(transmitted, 0.2);
        EXPECT_NEAR(r.bsdf.albedo(r.wo()).x, 1, 5e-3);
    }
}

TEST(HostTrapsInOsl, trap_09_the_true_normal_tells_sides_and_the_bumped_one_scatters)
{
    HalfAndHalf r;
    r.globals.N = direction(0.5f);
    r.see_from(direction(0.3f, 0.1f));
    int leaked = 0;
    for (int i = 0; i < 4000; ++i)
    {
        const V3f wi = direction(2 * pick(i) - 1, 7 * pick(5 * i));
        const auto e = r.bsdf.eval(r.wo(), wi);
        const bool there = wi.z > 0 && wi.dot(r.globals.N) > 0;
        EXPECT_EQ(e.pdf > 0, there);
        EXPECT_EQ(e.weight.y > 0, there);
        // Of diffuse, by the bumped normal's cosine.
        EXPECT_NEAR(r.bsdf.bsdf(1).eval(r.wo(), wi).pdf, there ? wi.dot(r.globals.N) / pi : 0,
                    1e-5f);
        const auto s = r.bsdf.sample(r.wo(), numbers(i), pick(i));
        EXPECT_TRUE(s.wi.z > 0 || s.pdf == 0);
        leaked += s.pdf == 0;
    }
    EXPECT_GT(leaked, 100) << "and is not drawn again";
}

TEST(HostTrapsInOsl, trap_10_normals_are_each_closure_s_own_and_indices_go_by_the_true_side)
{
    HalfAndHalf r;
    // Two normals in one tree, each flipped to the side of the true one.
    osl::OrenNayarDiffuseParams one, other;
    one.albedo = other.albedo = C3f(1.0f);
    one.N = direction(0.8f, 1);
    other.N = -direction(0.6f, 2);
    r.see(r.nodes.add(r.nodes.component(osl::oren_nayar_diffuse_id, one),
                      r.nodes.component(osl::oren_nayar_diffuse_id, other)));
    const V3f wi = direction(0.9f, 1.5f);
    EXPECT_NEAR(r.bsdf.bsdf(0).eval(r.wo(), wi).pdf, std::abs(wi.dot(other.N)) / pi, 1e-5f);
    EXPECT_NEAR(r.bsdf.bsdf(1).eval(r.wo(), wi).pdf, wi.dot(one.N) / pi, 1e-5f);
    // Whatever N a shader gives, backfacing says which side of glass is seen.
    auto p = r.glass_params();
    p.roughness_x = p.roughness_y = 0;
    for (const bool flipped : {false, true})
        for (const bool backfacing : {false, true})
        {
            p.N = flipped ? -r.globals.N : r.globals.N;
            r.globals.backfacing = backfacing;
            r.nodes.reset();
            r.see(r.nodes.component(osl::dielectric_id, p));
            const auto s = r.bsdf.sample(r.wo(), V3f(0.5f, 0.5f, last), 0.5f);
            ASSERT_TRUE(s.passes);
            EXPECT_NEAR(s.wi.x, -r.wo().x * (backfacing ? 1.5f : 1 / 1.5f), 1e-5f);
        }
}

TEST(HostTrapsInOsl, trap_11_singular_directions_are_sampled_and_never_evaluated)
{
    HalfAndHalf r, without(Method::none);
    const V3f wo = direction(0.3f, 1), mirrored(-wo.x, -wo.y, wo.z);
    for (HalfAndHalf* one : {&r, &without})
    {
        auto p = one->metal_params();
        p.roughness_x = p.roughness_y = 0;
        p.f0 = C3f(0.9f, 0.6f, 0.3f);
        one->globals.I = -wo;
        one->see(one->nodes.add(one->nodes.component(osl::generalized_schlick_id, p, C3f(0.5f)),
                                one->diffuse(C3f(1.0f), C3f(0.5f))));
        ASSERT_EQ(one->bsdf.size(), 2);
    }
    // The gain of a mirror is 1 to the last bit.
    for (const float at : {0.0f, last})
    {
        const auto s = r.bsdf.sample(wo, V3f(0.5f), at), n = without.bsdf.sample(wo, V3f(0.5f), at);
        EXPECT_EQ(s.weight, n.weight);
        EXPECT_EQ(s.pdf, n.pdf);
        if (!s.singular) continue;
        EXPECT_LT((s.wi - mirrored).length(), 1e-5f);
        const float c = 0.7f * 0.7f * 0.7f * 0.7f * 0.7f;  // Schlick
        for (int i = 0; i < 3; ++i)
        {
            const float f0 = i == 0 ? 0.9f : i == 1 ? 0.6f : 0.3f;
            EXPECT_NEAR(s.weight[i] * s.pdf, 0.5f * (f0 + (1 - f0) * c), 1e-4f);
        }
    }
    EXPECT_NE(r.bsdf.sample(wo, V3f(0.5f), 0).singular,
              r.bsdf.sample(wo, V3f(0.5f), last).singular);
    // Towards the mirrored direction there is only what has a density.
    const auto e = r.bsdf.eval(wo, mirrored);
    EXPECT_NEAR(e.weight.x * e.pdf, 0.5f * 0.3f / pi, 1e-5f);
}

TEST(HostTrapsInOsl, trap_12_black_is_a_sample_and_none_is_none)
{
    HalfAndHalf black;
    black.see(black.diffuse(C3f(0.0f)));
    const auto s = black.bsdf.sample(black.wo(), V3f(0.4f), 0.4f);
    EXPECT_GT(s.pdf, 0);
    EXPECT_EQ(s.weight, C3f(0.0f));
    HalfAndHalf r;
    r.globals.N = direction(0.5f);
    r.see_from(direction(0.3f));
    int none = 0;
    for (int i = 0; i < 500; ++i)
    {
        const auto a = r.bsdf.sample(r.wo(), numbers(i), pick(i));
        if (a.pdf > 0) continue;
        ++none;
        EXPECT_EQ(a.pdf, 0);
        EXPECT_EQ(a.weight, C3f(0.0f));
    }
    EXPECT_GT(none, 10);
}

// Points come one after the other, in the same memory.
TEST(HostTrapsInOsl, trap_13_nothing_is_left_of_the_point_before)
{
    HalfAndHalf used, fresh;
    osl::SubsurfaceParams p;
    p.N = used.globals.N;
    used.see(used.layer(used.coat(), used.nodes.component(osl::subsurface_id, p)),
             osl::subsurface_stand_in);
    used.see_from(direction(0.2f, 3), C3f(0.9f), C3f(0.0f));
    used.see_from(direction(0.7f, 2), C3f(0.3f, 0.2f, 0.1f));
    fresh.see_from(direction(0.7f, 2), C3f(0.3f, 0.2f, 0.1f));
    ASSERT_EQ(used.bsdf.size(), fresh.bsdf.size());
    for (int i = 0; i < 50; ++i)
    {
        const auto a = used.bsdf.sample(used.wo(), numbers(i), pick(i)),
                   b = fresh.bsdf.sample(fresh.wo(), numbers(i), pick(i));
        EXPECT_EQ(a.wi, b.wi);
        EXPECT_EQ(a.weight, b.weight);
        EXPECT_EQ(a.pdf, b.pdf);
    }
}

TEST(HostTrapsInOsl, trap_14_what_is_no_number_goes_no_further)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    HalfAndHalf r;
    for (const float w : {nan, -1.0f, -std::numeric_limits<float>::infinity()})
    {
        r.nodes.reset();
        r.see(r.nodes.add(r.nodes.multiply(C3f(w), r.diffuse()), r.metal()), osl::bad_weight);
        EXPECT_EQ(r.bsdf.size(), 1);
    }
    for (const float alpha : {nan, -1.0f, 0.0f, 1e-30f, 1e-8f, 1e-4f, 7.0f})
        for (const float mu : {1.0f, 0.3f, 1e-4f, 0.0f})
        {
            auto p = r.metal_params();
            p.roughness_x = alpha;
            r.globals.I = -direction(mu, 1);
            r.nodes.reset();
            r.see(r.nodes.component(osl::generalized_schlick_id, p));
            const auto check = [&](const osl::BsdfSample& s) {
                EXPECT_TRUE(std::isfinite(s.pdf) && s.pdf >= 0) << alpha << ' ' << mu;
                for (int c = 0; c < 3; ++c)
                    EXPECT_TRUE(std::isfinite(s.weight[c])) << alpha << ' ' << mu;
            };
            for (int i = 0; i < 40; ++i)
            {
                check(r.bsdf.sample(r.wo(), numbers(i), pick(i)));
                check(r.bsdf.eval(r.wo(), direction(2 * pick(i) - 1, float(i))));
            }
            check(r.bsdf.eval(r.wo(), -r.wo()));  // no half vector
            check(r.bsdf.eval(r.wo(), V3f(-r.wo().x, -r.wo().y, r.wo().z)));
            EXPECT_TRUE(std::isfinite(r.bsdf.albedo(r.wo()).x));
        }
}

TEST(HostTrapsInOsl, trap_15_what_has_a_weight_has_a_chance)
{
    HalfAndHalf r;
    // So dark that its albedo is nothing next to the other's.
    r.see(r.nodes.add(r.diffuse(C3f(1e-9f)), r.metal()));
    for (int k = 0; k < 2; ++k) EXPECT_GT(r.bsdf.probability(k), 1e-5f);
    r.see_from(direction(0.05f), C3f(0.5f), C3f(0.5f));
    // By what they give back, the gain included.
    EXPECT_NEAR(r.bsdf.probability(0), 0.5f, 5e-3f);
    for (const float end : {0.0f, last})
        for (const float at : {0.0f, last})
        {
            const auto s = r.bsdf.sample(r.wo(), V3f(end), at);
            EXPECT_TRUE(std::isfinite(s.pdf) && std::isfinite(s.weight.x));
        }
}

TEST(HostTrapsInOsl, trap_16_a_sample_is_its_four_numbers_and_nothing_else)
{
    HalfAndHalf r;
    r.see_from(direction(0.6f));
    float height[2] = {0, 0};
    int count[2] = {0, 0};
    for (int i = 0; i < 4000; ++i)
    {
        const auto a = r.bsdf.sample(r.wo(), numbers(i), pick(i)),
                   b = r.bsdf.sample(r.wo(), numbers(i), pick(i));
        EXPECT_EQ(a.wi, b.wi);
        // The fourth picks, and the first three are not used up by it.
        const bool first = pick(i) < r.bsdf.probability(0);
        const auto alone = r.bsdf.bsdf(first ? 0 : 1).sample(r.wo(), numbers(i));
        EXPECT_EQ(a.wi, a.pdf > 0 ? alone.wi : V3f(0.0f));
        height[first] += a.wi.z;
        count[first] += a.pdf > 0;
    }
    EXPECT_NEAR(double(height[0]) / count[0], 2.0 / 3, 0.02) << "diffuse, by the cosine";
    EXPECT_GT(count[1], 1000);
}

TEST(HostTrapsInOsl, trap_17_nothing_is_allocated_and_threads_share_a_library)
{
    HalfAndHalf r;
    const V3f wi = direction(0.5f, 3);
    const long before = tests::allocations();
    r.see_from(direction(0.6f, 1));
    const auto e = r.bsdf.eval(r.wo(), wi);
    const auto s = r.bsdf.sample(r.wo(), V3f(0.5f), 0.5f);
    EXPECT_EQ(tests::allocations(), before);
    EXPECT_TRUE(s.pdf > 0 && e.pdf > 0);
    const auto* Ci =
        r.nodes.add(r.diffuse(C3f(1.0f), C3f(0.5f)), r.nodes.multiply(C3f(0.5f), r.metal()));
    std::vector<std::thread> threads;
    std::vector<float> pdf(4);
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&, t] {
            const auto own = std::make_unique<osl::CompositeBsdf>();
            for (int round = 0; round < 50; ++round)
            {
                own->clear();
                r.shader.flatten(Ci, r.globals, *own);
                own->prepare(r.wo());
                pdf[std::size_t(t)] = own->eval(r.wo(), wi).pdf;
            }
        });
    for (auto& t : threads) t.join();
    for (const float x : pdf) EXPECT_EQ(x, e.pdf);
}

TEST(HostTrapsInOsl, trap_18_many_closures_are_all_there_or_it_is_said)
{
    HalfAndHalf r;
    for (int count = 1; count <= osl::CompositeBsdf::most_bsdfs + 4; ++count)
    {
        r.nodes.reset();
        const osl::ClosureColor* sum = nullptr;
        for (int i = 0; i < count; ++i)
            sum = r.nodes.add(r.diffuse(C3f(1.0f), C3f(1 / float(count))), sum);
        const bool fits = count <= osl::CompositeBsdf::most_bsdfs;
        r.see(sum, fits ? 0u : osl::too_many_bsdfs);
        EXPECT_EQ(r.bsdf.size(), std::min(count, osl::CompositeBsdf::most_bsdfs));
        const float rest = fits ? 1 : float(osl::CompositeBsdf::most_bsdfs) / float(count);
        EXPECT_NEAR(r.value(direction(0.5f)).x, rest * 0.5f / pi, 1e-5f);
    }
}

TEST(HostTrapsInOsl, trap_19_I_is_the_direction_that_is_known_and_points_at_the_surface)
{
    HalfAndHalf r;
    const V3f wo = direction(0.3f, 1), wi = direction(0.9f, 3);
    r.see_from(wo, C3f(1.0f), C3f(0.0f));
    EXPECT_EQ(r.wo(), wo);
    EXPECT_NEAR(r.bsdf.eval(wo, wi).pdf, wi.z / pi, 1e-5f) << "of the one that is asked about";
    r.see_from(wo, C3f(0.0f), C3f(1.0f));
    HalfAndHalf other;
    other.see_from(wi, C3f(0.0f), C3f(1.0f));
    // Of visible normals: more of them are seen from up there.
    EXPECT_GT(std::abs(r.bsdf.eval(wo, wi).pdf / other.bsdf.eval(wi, wo).pdf - 1), 0.1f);
}

TEST(HostTrapsInOsl, trap_20_transparency_is_a_closure_and_dims_no_other)
{
    HalfAndHalf r;
    r.see(r.nodes.add(r.diffuse(C3f(1.0f), C3f(0.5f)),
                      r.nodes.component(osl::transparent_id, osl::TransparentParams{}, C3f(0.5f))));
    ASSERT_EQ(r.bsdf.size(), 2);
    for (int k = 0; k < 2; ++k) EXPECT_EQ(r.bsdf.weight(k), C3f(0.5f));
    EXPECT_EQ(r.bsdf.transparency(r.wo()), C3f(0.5f)) << "of that much shadow rays are not stopped";
    const int pane = r.bsdf.bsdf(0).passes_straight() ? 0 : 1;
    const auto s = r.bsdf.sample(r.wo(), V3f(0.5f), pane == 0 ? 0 : last);
    EXPECT_TRUE(s.straight && s.singular && !s.passes);
    EXPECT_LT((s.wi + r.wo()).length(), 1e-5f);
    EXPECT_NEAR(s.weight.x * s.pdf, 0.5f, 1e-5f);
    EXPECT_NEAR(r.sampled(), 1, 1e-3);
    HalfAndHalf opaque;
    opaque.see_from(direction(0.6f));
    EXPECT_EQ(opaque.bsdf.transparency(opaque.wo()), C3f(0.0f));
}

TEST(HostTrapsInOsl, trap_21_value_over_pdf_may_exceed_1_in_a_channel)
{
    HalfAndHalf r;
    r.see_from(direction(0.5f, 0.6f), C3f(0.0f), C3f(1.0f));
    float most = 0;
    for (int i = 0; i < 2000; ++i)
        most = std::max(most, r.bsdf.sample(r.wo(), numbers(i), pick(i)).weight.x);
    EXPECT_GT(most, 1.1f);
    EXPECT_NEAR(r.sampled(), 1, 5e-3);
}

TEST(HostTrapsInOsl, trap_22_compensation_is_part_of_its_closure)
{
    // By a gain, and by a lobe that is added for what is scattered several times.
    HalfAndHalf none(Method::none);
    none.see_from(direction(0.6f), C3f(0.0f), C3f(1.0f));
    const V3f wi = direction(0.4f, 3);
    for (const shaders::Compensation& method :
         {shaders::Compensation(Method::turquin), shaders::Compensation(KullaContyForm::printed)})
    {
        HalfAndHalf r(method);
        r.see_from(direction(0.6f), C3f(0.0f), C3f(1.0f));
        ASSERT_EQ(r.bsdf.size(), 1);
        EXPECT_GT(r.value(wi).x, none.value(wi).x);
        EXPECT_FLOAT_EQ(r.bsdf.eval(r.wo(), wi).roughness, 0.6f);
        EXPECT_NEAR(r.bsdf.albedo(r.wo()).x, 1, 2e-3);
    }
}

}}  // namespace regain::tools::preview
