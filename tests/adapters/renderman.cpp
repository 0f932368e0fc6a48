// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The RenderMan-like adapter against the contract of its host.h.

#include "../support/hosts.h"

#include <gtest/gtest.h>

namespace shaders = regain::shaders;
using namespace regain::renderman;
using namespace regain::tests;

namespace {

using Metal = shaders::SchlickMetal;

class RenderManAdapter : public testing::Test
{
protected:
    // All that one call of generate or evaluate returns.
    struct Result
    {
        explicit Result(int n) : sampled(n), evaluated(n), L(n), total(n), fwd(n), rev(n) {}
        std::vector<Lobe> sampled;
        std::vector<LobeSet> evaluated;
        std::vector<Vec3> L;
        std::vector<Color3> total;
        std::vector<float> fwd, rev;
    };

    static Result generate(GridHost& host, Bxdf& bxdf, const std::vector<LobeSet>& wanted)
    {
        Result r(host.ctx.numPts);
        LobeWeights w = host.weights();
        bxdf.generateSample(kAnyLighting, wanted.data(), &host.rng, r.sampled.data(), r.L.data(), w,
                            r.fwd.data(), r.rev.data(), nullptr);
        for (int i = 0; i < host.ctx.numPts; ++i) r.total[i] = w.total(i);
        return r;
    }
    static Result evaluate(GridHost& host, Bxdf& bxdf, const std::vector<LobeSet>& wanted,
                           const std::vector<Vec3>& L)
    {
        Result r(host.ctx.numPts);
        LobeWeights w = host.weights();
        bxdf.evaluateSample(kAnyLighting, wanted.data(), &host.rng, r.evaluated.data(), L.data(), w,
                            r.fwd.data(), r.rev.data());
        for (int i = 0; i < host.ctx.numPts; ++i) r.total[i] = w.total(i);
        return r;
    }
    Bxdf* begin(GridHost& host, Metal& metal, LobeSet wanted = LobeSet::all())
    {
        return factory.beginScatter(&host.ctx, wanted, ShadeMode::Scatter, nullptr, &metal);
    }
    static std::vector<LobeSet> all(int n) { return std::vector<LobeSet>(n, LobeSet::all()); }

    ClosureFactory<Metal> factory;
};

// Contract C2, by both ways of asking: the same albedo, and 1 for white.
TEST_F(RenderManAdapter, furnace_by_generate_and_by_evaluate)
{
    constexpr int n = 20000;
    for (float alpha : {0.3f, 1.0f})
    {
        GridHost host(n);
        host.ctx.arena = &host;
        GridHost big(n, std::size_t(n) * 1024);
        std::fill(big.V.begin(), big.V.end(), direction<float>(0.7));
        Metal metal = white_material(alpha);
        Bxdf* bxdf = begin(big, metal);
        ASSERT_TRUE(bxdf);
        const Result g = generate(big, *bxdf, all(n));
        std::vector<Vec3> uniform(n);
        Random random(2);
        for (Vec3& L : uniform) L = direction<float>(random.unit(), 2 * M_PI * random.unit());
        const Result e = evaluate(big, *bxdf, all(n), uniform);
        double generated = 0, evaluated = 0;
        for (int i = 0; i < n; ++i)
        {
            if (g.sampled[i].valid) generated += g.total[i].x / g.fwd[i] / n;
            evaluated += e.total[i].x * 2 * M_PI / n;
        }
        EXPECT_NEAR(generated, 1, 0.02) << alpha;
        EXPECT_NEAR(evaluated, 1, 0.05) << alpha;
        std::vector<Color3> albedo(n);
        ASSERT_TRUE(bxdf->albedo(albedo.data()));
        EXPECT_NEAR(albedo[7].x, 1, 1e-3);
    }
}

TEST_F(RenderManAdapter, generate_and_evaluate_agree)
{
    constexpr int n = 512;
    GridHost host(n);
    Random random(6);
    for (int i = 0; i < n; ++i)
    {
        host.V[i] = direction<float>(random.unit(), 7 * random.unit());
        host.T[i] = direction<float>(0.2, 7 * random.unit());
    }
    Metal metal = gold_material(0.4f);
    metal.alpha_y = 0.2f;
    Bxdf* bxdf = begin(host, metal);
    const Result g = generate(host, *bxdf, all(n)), e = evaluate(host, *bxdf, all(n), g.L);
    for (int i = 0; i < n; ++i)
    {
        if (!g.sampled[i].valid) continue;
        EXPECT_TRUE(e.evaluated[i].has(g.sampled[i]));
        EXPECT_NEAR(g.fwd[i] / e.fwd[i], 1, 1e-3);
        EXPECT_NEAR(g.rev[i] / e.rev[i], 1, 1e-3);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(g.total[i][c] / e.total[i][c], 1, 1e-3);
        EXPECT_NEAR(g.L[i].length(), 1, 1e-5);
    }
}

// The reverse pdf is what the sampler would give with V and L changed over.
TEST_F(RenderManAdapter, reverse_is_forward_from_the_other_side)
{
    GridHost host(2);
    host.V[0] = direction<float>(0.3, 0.4);
    host.V[1] = direction<float>(0.8, 2.0);
    Metal metal = gold_material(0.5f);
    Bxdf* bxdf = begin(host, metal);
    const Result r = evaluate(host, *bxdf, all(2), {host.V[1], host.V[0]});
    EXPECT_NEAR(r.rev[0], r.fwd[1], 1e-6 * r.fwd[1]);
    EXPECT_NEAR(r.rev[1], r.fwd[0], 1e-6 * r.fwd[0]);
    EXPECT_NE(r.fwd[0], r.fwd[1]);
}

TEST_F(RenderManAdapter, at_index_is_evaluate_at_that_point)
{
    constexpr int n = 4, lights = 9;
    GridHost host(n);
    for (int i = 0; i < n; ++i) host.V[i] = direction<float>(0.2 + 0.2 * i, i);
    Metal metal = gold_material(0.5f);
    Bxdf* bxdf = begin(host, metal);
    std::vector<Vec3> L;
    for (int j = 0; j < lights; ++j) L.push_back(direction<float>(0.1 + 0.09 * j, 0.5 * j));
    for (int i = 0; i < n; ++i)
    {
        std::vector<Color3> storage(kMaxActive * lights);
        LobeWeights w(storage.data(), lights);
        std::vector<LobeSet> evaluated(lights);
        std::vector<float> fwd(lights), rev(lights);
        bxdf->evaluateSamplesAtIndex(kDirect, LobeSet::all(), &host.rng, i, lights,
                                     evaluated.data(), L.data(), w, fwd.data(), rev.data());
        for (int j = 0; j < lights; ++j)
        {
            const Result one = evaluate(host, *bxdf, all(n), std::vector<Vec3>(n, L[j]));
            EXPECT_EQ(w.total(j), one.total[i]);
            EXPECT_EQ(fwd[j], one.fwd[i]);
            EXPECT_EQ(rev[j], one.rev[i]);
        }
    }
}

// Points that want nothing, see the back or have no frame decline alone; what belongs to a declined
// point is 0, and the others are as they would be without it.
TEST_F(RenderManAdapter, points_decline_alone)
{
    constexpr int n = 6;
    GridHost host(n);
    std::fill(host.V.begin(), host.V.end(), direction<float>(0.7));
    host.V[3] = Vec3(0, 0, 0);
    std::vector<LobeSet> wanted = all(n);
    wanted[1].clear();
    Lobe diffuse;
    wanted[4] = LobeSet(diffuse);
    Metal metal = gold_material(0.2f);
    Bxdf* bxdf = begin(host, metal);
    std::vector<Vec3> L(n, direction<float>(0.7, 3.1));
    L[1] = Vec3(NAN, NAN, NAN);  // not to be read
    const Result g = generate(host, *bxdf, wanted), e = evaluate(host, *bxdf, wanted, L);
    for (int i : {1, 3, 4})
    {
        EXPECT_FALSE(g.sampled[i].valid) << i;
        EXPECT_FALSE(e.evaluated[i].any()) << i;
        for (const Result* r : {&g, &e})
        {
            EXPECT_EQ(r->fwd[i], 0);
            EXPECT_EQ(r->rev[i], 0);
            EXPECT_EQ(r->total[i], Color3(0.0f));
        }
    }
    for (int i : {0, 2, 5})
    {
        EXPECT_TRUE(g.sampled[i].valid) << i;
        EXPECT_EQ(e.total[i], e.total[0]);
    }
}

TEST_F(RenderManAdapter, empty_and_single_batches)
{
    GridHost none(0), one(1);
    one.V[0] = direction<float>(0.9);
    Metal metal = gold_material(0.2f);
    Bxdf* bxdf = begin(none, metal);
    ASSERT_TRUE(bxdf);
    generate(none, *bxdf, all(0));
    EXPECT_TRUE(generate(one, *begin(one, metal), all(1)).sampled[0].valid);
}

TEST_F(RenderManAdapter, lobes_wanted_by_the_batch_are_the_most_there_is)
{
    GridHost host(1);
    host.V[0] = direction<float>(0.9);
    Metal metal = gold_material(0.2f);
    Lobe diffuse;
    Bxdf* bxdf = begin(host, metal, LobeSet(diffuse));
    EXPECT_FALSE(bxdf->aggregateLobes().any());
    EXPECT_FALSE(generate(host, *bxdf, all(1)).sampled[0].valid);
    EXPECT_TRUE(begin(host, metal)->aggregateLobes().any());
}

// Contract C4.
TEST_F(RenderManAdapter, a_mirror_is_a_discrete_lobe)
{
    GridHost host(1);
    host.V[0] = direction<float>(0.6);
    Metal metal = gold_material(0);
    Bxdf* bxdf = begin(host, metal);
    EXPECT_EQ(bxdf->evaluateDomain(), kEmptyDomain);
    const Result g = generate(host, *bxdf, all(1));
    ASSERT_TRUE(g.sampled[0].valid);
    EXPECT_TRUE(g.sampled[0].discrete);
    EXPECT_EQ(g.fwd[0], 1);
    EXPECT_NEAR(g.total[0].x, 0.94, 0.01);
    const Result e = evaluate(host, *bxdf, all(1), g.L);
    EXPECT_FALSE(e.evaluated[0].any());
    EXPECT_EQ(e.fwd[0], 0);
    // Whoever wants smooth lobes only gets nothing.
    LobeSet smooth = LobeSet::all();
    smooth.bits &= ~LobeSet::kDiscrete;
    EXPECT_FALSE(generate(host, *bxdf, {smooth}).sampled[0].valid);
}

// Contract C7: both ends of a path give one value.
TEST_F(RenderManAdapter, a_light_path_sees_what_an_eye_path_sees)
{
    const Vec3 eye = direction<float>(0.15), light = direction<float>(0.9, 2.5);
    Metal metal = gold_material(0.9f);
    GridHost from_eye(1), from_light(1);
    from_eye.V[0] = eye;
    from_light.V[0] = light;
    from_light.ctx.lightPath = true;
    const Result a = evaluate(from_eye, *begin(from_eye, metal), all(1), {light});
    const Result b = evaluate(from_light, *begin(from_light, metal), all(1), {eye});
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a.total[0][c] / light.z, b.total[0][c] / eye.z, 1e-5);
    EXPECT_NEAR(a.fwd[0], b.rev[0], 1e-6);
    EXPECT_NEAR(a.rev[0], b.fwd[0], 1e-6);
}

// A bumped normal may reflect through the surface: neither call returns such light.
TEST_F(RenderManAdapter, light_does_not_leak_through_the_surface)
{
    constexpr int n = 2000;
    GridHost host(n);
    const Vec3 bumped = direction<float>(0.5, 0.0);
    std::fill(host.V.begin(), host.V.end(), direction<float>(0.3, 0.1));
    std::fill(host.N.begin(), host.N.end(), bumped);
    Metal metal = gold_material(0.7f);
    Bxdf* bxdf = begin(host, metal);
    const Result g = generate(host, *bxdf, all(n));
    int declined = 0;
    for (int i = 0; i < n; ++i)
    {
        if (!g.sampled[i].valid)
            ++declined;
        else
            EXPECT_GT(g.L[i].z, 0);
    }
    EXPECT_GT(declined, 50);
    const Result e =
        evaluate(host, *bxdf, all(n), std::vector<Vec3>(n, direction<float>(-0.2, 0.0)));
    EXPECT_EQ(e.fwd[0], 0);
    EXPECT_EQ(e.total[0], Color3(0.0f));
}

TEST_F(RenderManAdapter, surfaces_have_two_sides)
{
    GridHost front(1), back(1);
    front.V[0] = direction<float>(0.7, 0.3);
    back.V[0] = front.V[0];
    back.N[0] = back.Ng[0] = Vec3(0, 0, -1);
    Metal metal = gold_material(0.5f);
    const Vec3 L = direction<float>(0.4, 2);
    EXPECT_EQ(evaluate(front, *begin(front, metal), all(1), {L}).fwd[0],
              evaluate(back, *begin(back, metal), all(1), {L}).fwd[0]);
}

TEST_F(RenderManAdapter, a_spent_arena_is_an_answer)
{
    GridHost host(8, 256);
    Metal metal = gold_material(0.5f);
    EXPECT_EQ(begin(host, metal), nullptr);
}

TEST_F(RenderManAdapter, lobe_sets_tell_lobes_apart)
{
    std::vector<Lobe> lobes;
    for (int id = 0; id < kMaxDiffuse; ++id)
        for (bool reflect : {true, false})
            lobes.push_back({LobeClass::Diffuse, std::uint8_t(id), reflect});
    for (int id = 0; id < kMaxSpecular; ++id)
        for (bool reflect : {true, false})
            lobes.push_back({LobeClass::Specular, std::uint8_t(id), reflect});
    for (int id = 0; id < kMaxUser; ++id)
        lobes.push_back({LobeClass::User, std::uint8_t(id), true});
    for (std::size_t i = 0; i < lobes.size(); ++i)
        for (std::size_t j = 0; j < lobes.size(); ++j)
            EXPECT_EQ(LobeSet(lobes[i]).has(lobes[j]), i == j);
}

TEST_F(RenderManAdapter, weights_have_a_last_slot)
{
    std::vector<Color3> storage(kMaxActive * 2);
    LobeWeights w(storage.data(), 2);
    for (int k = 0; k < kMaxSpecular; ++k)
        EXPECT_TRUE(w.addActiveLobe({LobeClass::Specular, std::uint8_t(k), true}));
    for (int k = 0; k < kMaxSpecular; ++k)
        EXPECT_TRUE(w.addActiveLobe({LobeClass::User, std::uint8_t(k), true}));
    EXPECT_FALSE(w.addActiveLobe({LobeClass::User, 9, true}));
    EXPECT_TRUE(w.addActiveLobe({LobeClass::User, 3, true})) << "open already";
}

}  // namespace
