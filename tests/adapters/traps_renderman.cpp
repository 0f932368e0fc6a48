// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// What adapters of batched hosts are apt to get wrong, one test each; traps_clarisse.cpp has the
// same for one-point hosts, by the same numbers.

#include "../support/allocations.h"
#include "../support/host_calls.h"
#include "../support/trap_materials.h"

#include <regain/closures/kulla_conty.h>
#include <regain/shaders/closure_tree.h>

#include <algorithm>
#include <limits>
#include <thread>

using namespace regain;
using namespace regain::renderman;
using namespace regain::tests;

namespace {

using Vec2 = renderman::Vec2;
using Vec3 = renderman::Vec3;
using Color3 = renderman::Color3;
const LobeSet everything = LobeSet::all();
const Lobe diffuse{LobeClass::Diffuse, kDiffuseSlot, true};
const Lobe metal{LobeClass::Specular, kSpecularSlot, true};

// A spiral that fills the sphere evenly.
std::vector<Vec3> sphere(int n)
{
    std::vector<Vec3> all;
    for (int i = 0; i < n; ++i)
        all.push_back(direction<float>(1 - (2 * i + 1.0) / n, i * M_PI * (3 - std::sqrt(5.0))));
    return all;
}

Imath::V3d integral(const std::vector<Color3>& values)
{
    Imath::V3d sum(0.0);
    for (const Color3& v : values) sum += Imath::V3d(v);
    return sum * (4 * M_PI / double(values.size()));
}

bool is_finite(const Color3& c)
{
    return std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z);
}

TEST(HostTrapsInRenderMan, trap_01_weights_have_the_cosine_and_no_pdf)
{
    constexpr int n = 20000;
    GridCalls<HalfAndHalf> half({}, n);
    half.at(direction<float>(0.6, 1));
    EXPECT_NEAR(half.generate().estimate().x, 1, 0.01);
    EXPECT_NEAR(integral(half.evaluate(sphere(n)).total).x, 1, 5e-3);

    HalfAndHalf dull;
    dull.weight[0] = Imath::C3f(0.8f);
    dull.weight[1] = Imath::C3f(0.0f);
    GridCalls<HalfAndHalf> lambert(dull);
    const GridAnswers a = lambert.at(direction<float>(0.6)).evaluate(direction<float>(0.3, 2));
    EXPECT_NEAR(a.total[0].x, 0.8 * 0.3 / M_PI, 1e-6);
}

TEST(HostTrapsInRenderMan, trap_02_generate_says_what_evaluate_says)
{
    constexpr int n = 300;
    GridCalls<HalfAndHalf> half({}, n);
    Random random(2);
    for (auto& V : half.host.V) V = direction<float>(0.1 + 0.9 * random.unit(), 7 * random.unit());
    const GridAnswers g = half.generate(), e = half.evaluate(g.L);
    int valid = 0;
    for (int i = 0; i < n; ++i)
    {
        if (!g.sampled[i].valid) continue;
        ++valid;
        EXPECT_NEAR(g.fwd[i] / e.fwd[i], 1, 1e-4);
        EXPECT_NEAR(g.rev[i] / e.rev[i], 1, 1e-4);
        EXPECT_NEAR(g.total[i].x / e.total[i].x, 1, 1e-4);
    }
    EXPECT_GT(valid, n / 2);
}

TEST(HostTrapsInRenderMan, trap_03_the_pdf_is_that_of_the_mixture)
{
    const Vec3 V = direction<float>(0.6, 1), L = direction<float>(0.8, 3);
    HalfAndHalf material;
    material.weight[0] = Imath::C3f(0.25f);
    material.weight[1] = Imath::C3f(0.75f);
    GridCalls<HalfAndHalf> grid(material);
    // Both are white: a closure is picked by its weight.
    const double expected =
        0.25 * L.z / M_PI + 0.75 * double(material.metal.closure(1.0f).pdf(V, L));
    EXPECT_NEAR(grid.at(V).evaluate(L).fwd[0] / expected, 1, 2e-3);
}

TEST(HostTrapsInRenderMan, trap_04_what_is_not_wanted_has_no_weight_and_no_share)
{
    constexpr int n = 20000;
    const Vec3 V = direction<float>(0.6, 1);
    GridCalls<HalfAndHalf> grid({}, n);
    grid.at(V);
    // By the batch.
    const std::vector<LobeSet> all(n, everything), some(n, LobeSet(metal));
    const GridAnswers of_batch = grid.generate(all, nullptr, LobeSet(metal));
    EXPECT_NEAR(of_batch.estimate().x, 0.5, 0.01);
    EXPECT_FALSE(grid.begin(LobeSet(metal))->aggregateLobes().has(diffuse));
    // By each point.
    const GridAnswers of_points = grid.generate(some);
    EXPECT_NEAR(of_points.estimate().x, 0.5, 0.01);
    ASSERT_EQ(of_points.slots.size(), 1u);
    const auto closure = grid.material.metal.closure(1.0f);
    for (int i = 0; i < 100; ++i)
    {
        if (!of_points.sampled[i].valid) continue;
        EXPECT_TRUE(LobeSet(metal).has(of_points.sampled[i]));
        EXPECT_NEAR(of_points.fwd[i] / closure.pdf(V, of_points.L[i]), 1, 1e-3);
    }
    // By a point for all of its directions.
    const std::vector<Vec3> L = sphere(50);
    std::vector<Color3> storage(kMaxActive * L.size());
    LobeWeights w(storage.data(), 50);
    std::vector<LobeSet> evaluated(50);
    std::vector<float> fwd(50), rev(50);
    grid.begin()->evaluateSamplesAtIndex(kDirect, LobeSet(diffuse), &grid.host.rng, 3, 50,
                                         evaluated.data(), L.data(), w, fwd.data(), rev.data());
    for (int j = 0; j < 50; ++j)
    {
        const float cosine = std::max(L[j].z, 0.0f) / float(M_PI);
        EXPECT_NEAR(w.total(j).x, 0.5f * cosine, 1e-5f);
        EXPECT_NEAR(fwd[j], cosine, 1e-5f);
    }
}

// Those of a call, of which `left` are not taken.
LobeWeights slots_left(GridHost& host, int left)
{
    LobeWeights w = host.weights();
    for (int k = 0; k < kMaxActive - left; ++k)
        w.addActiveLobe(k < kMaxUser ? Lobe{LobeClass::User, std::uint8_t(k), true}
                                     : Lobe{LobeClass::Diffuse, std::uint8_t(k - kMaxUser), false});
    return w;
}

TEST(HostTrapsInRenderMan, trap_05_a_lobe_without_a_slot_is_not_sampled)
{
    constexpr int n = 20000;
    GridCalls<HalfAndHalf> grid({}, n);
    grid.at(direction<float>(0.6, 1));
    const std::vector<LobeSet> all(n, everything), none(n);
    // Opened only where some point wants it.
    EXPECT_TRUE(grid.generate(none).slots.empty());
    EXPECT_TRUE(grid.evaluate(sphere(n), none).slots.empty());
    EXPECT_EQ(grid.evaluate(sphere(n), LobeSet(metal)).slots.size(), 1u);
    // None left: nothing is sampled.
    {
        LobeWeights w = slots_left(grid.host, 0);
        const GridAnswers a = grid.generate(all, w);
        EXPECT_FALSE(
            std::any_of(a.sampled.begin(), a.sampled.end(), [](auto l) { return l.valid; }));
        EXPECT_EQ(a.fwd[7], 0);
    }
    // One left: that half alone, with its own pdf, by both ways.
    {
        LobeWeights w = slots_left(grid.host, 1);
        const GridAnswers a = grid.generate(all, w);
        EXPECT_NEAR(a.estimate().x, 0.5, 0.01);
        LobeWeights again = slots_left(grid.host, 1);
        const GridAnswers e = grid.evaluate(a.L, all, again);
        for (int i = 0; i < 100; ++i)
            EXPECT_TRUE(!a.sampled[i].valid || std::abs(a.fwd[i] / e.fwd[i] - 1) < 1e-4f);
        EXPECT_EQ(w.active(), kMaxActive);
    }
    // Two of one slot add up there.
    HalfAndHalf coats;
    coats.names[0] = coats.names[1] = "coat";
    GridCalls<HalfAndHalf> two(coats, n);
    two.at(direction<float>(0.6, 1));
    const GridAnswers a = two.generate();
    ASSERT_EQ(a.slots.size(), 1u);
    EXPECT_EQ(a.slots[0].id, kClearcoatSlot);
    EXPECT_NEAR(a.estimate().x, 1, 0.01);
}

TEST(HostTrapsInRenderMan, trap_06_reverse_pdf_is_the_sampler_with_its_ends_exchanged)
{
    HalfAndHalf material;
    material.metal = shaders::SchlickMetal{Imath::C3f(0.04f), Imath::C3f(1.0f), 0.3f, 0.6f};
    material.weight[0] = Imath::C3f(0.1f);
    GridCalls<HalfAndHalf> grid(material);
    const Vec3 V = direction<float>(0.95, 1), L = direction<float>(0.05, 4);
    const GridAnswers there = grid.at(V).evaluate(L), back = grid.at(L).evaluate(V);
    EXPECT_NEAR(there.rev[0] / back.fwd[0], 1, 1e-5);
    EXPECT_NEAR(there.fwd[0] / back.rev[0], 1, 1e-5);
    EXPECT_GT(std::abs(there.fwd[0] / there.rev[0] - 1), 0.1);
    // Not by the chances that closures have at V.
    const auto closure = material.metal.closure(1.0f);
    const float E = closure.albedo(V).reflect.x, q = 0.5f * E / (0.1f + 0.5f * E);
    const float by_V = (1 - q) * V.z / float(M_PI) + q * closure.pdf(L, V);
    EXPECT_GT(std::abs(there.rev[0] / by_V - 1), 0.05);
}

TEST(HostTrapsInRenderMan, trap_07_gains_are_the_eye_s_whichever_way_light_is_followed)
{
    const Vec3 eye = direction<float>(0.2, 0.3), light = direction<float>(0.9, 2.5);
    GridCalls<SlopedLambert> grid(SlopedLambert{});
    const GridAnswers a = grid.at(eye).evaluate(light), exchanged = grid.at(light).evaluate(eye);
    grid.host.ctx.lightPath = true;
    const GridAnswers b = grid.at(light).evaluate(eye);
    for (int c = 0; c < 3; ++c)
    {
        EXPECT_NEAR(a.total[0][c] / light.z, b.total[0][c] / eye.z, 1e-5);
        EXPECT_GT(std::abs(exchanged.total[0][c] / eye.z / (a.total[0][c] / light.z) - 1), 0.01);
    }
    EXPECT_NEAR(a.fwd[0], b.rev[0], 1e-6);
    EXPECT_NEAR(a.rev[0], b.fwd[0], 1e-6);
}

TEST(HostTrapsInRenderMan, trap_08_radiance_is_scaled_once_and_gains_know_energy)
{
    const double eta2 = 1.5 * 1.5;
    GridCalls<TrapGlass<true>> grid(TrapGlass<true>{});
    const auto closure = grid.material.closure(1.0f);
    for (const float side : {0.7f, -0.7f})
    {
        const Vec3 V = direction<float>(side, 1), L = direction<float>(-0.8f * side / 0.7f, 4);
        const double factor = side > 0 ? 1 / eta2 : eta2;
        const Imath::C3f f = closure.eval(V, L);
        ASSERT_GT(f.x, 0);
        grid.host.ctx.lightPath = false;
        const GridAnswers a = grid.at(V).evaluate(L);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(a.total[0][c] / (f[c] * factor), 1, 1e-5);
        EXPECT_NEAR(a.fwd[0] / closure.pdf(V, L), 1, 1e-5);
        float ior = 0;
        EXPECT_TRUE(grid.begin()->materialIor(&ior));
        EXPECT_FLOAT_EQ(ior, 1.5f);
        EXPECT_NEAR(grid.albedo().x, closure.albedo(V).reflect.x + closure.albedo(V).transmit.x,
                    1e-5);
        // Importance is not scaled; the gain is the eye's.
        grid.host.ctx.lightPath = true;
        const Imath::C3f back = closure.lobe().eval(V, L) * SlopedGain<float>().at(L);
        EXPECT_NEAR(grid.at(V).evaluate(L).total[0].y / back.y, 1, 1e-5);
    }
}

TEST(HostTrapsInRenderMan, trap_09_the_true_normal_tells_sides_and_the_bumped_one_scatters)
{
    constexpr int n = 4000;
    const Vec3 N = direction<float>(0.5, 0), V = direction<float>(0.3, 0.1);
    GridCalls<HalfAndHalf> grid({}, n);
    const GridAnswers g = grid.at(V, N).generate();
    int lost = 0;
    for (int i = 0; i < n; ++i)
    {
        lost += !g.sampled[i].valid;
        EXPECT_TRUE(!g.sampled[i].valid || g.L[i].z > 0);
        EXPECT_TRUE(g.sampled[i].valid || (g.fwd[i] == 0 && g.total[i] == Color3(0.0f)));
    }
    EXPECT_GT(lost, n / 20);
    // What is lost is nobody's: the pdf falls short of 1 by it, in evaluate as in generate.
    const GridAnswers e = grid.evaluate(sphere(n));
    double pdf = 0;
    for (const float p : e.fwd) pdf += double(p) * 4 * M_PI / n;
    EXPECT_NEAR(pdf, 1 - double(lost) / n, 0.03);
    // Above the surface and below the bump: black, and no NaN.
    const Vec3 between = direction<float>(0.1, M_PI);
    EXPECT_FALSE(grid.at(between, N).generate().sampled[0].valid);
    EXPECT_EQ(grid.evaluate(direction<float>(0.9)).total[0], Color3(0.0f));
    EXPECT_EQ(grid.albedo(), Color3(0.0f));
}

TEST(HostTrapsInRenderMan, trap_10_indices_are_exchanged_by_the_side_of_the_true_surface)
{
    const Vec3 N = direction<float>(0.8, 0), up(0, 0, 1);
    GridCalls<TrapGlass<false>> glass(TrapGlass<false>{});
    const auto closure = glass.material.closure(1.0f);
    const auto reflected = [&](const Vec3& V, const Vec3& n, const Vec3& ng) {
        const Vec3 L = n * (2 * n.dot(V)) - V;
        return glass.at(V, n, ng).evaluate(L).total[0].x;
    };
    const Vec3 V = direction<float>(0.7, 1);
    const float mu = V.dot(N), outside = reflected(V, N, up), inside = reflected(-V, N, up);
    const auto expected = [&](float side) {
        const Vec3 wo = direction<float>(side, 2), wi(-wo.x, -wo.y, wo.z);
        return closure.eval(wo, wi).x;
    };
    EXPECT_NEAR(outside / expected(mu), 1, 1e-3);
    EXPECT_NEAR(inside / expected(-mu), 1, 1e-3);
    EXPECT_GT(std::abs(inside / outside - 1), 0.1);
    // From above the surface and below the bump it is neither outside nor inside.
    const Vec3 between = direction<float>(0.1, M_PI);
    EXPECT_EQ(reflected(between, N, up), 0);
    EXPECT_EQ(glass.evaluate(direction<float>(-0.9)).fwd[0], 0);
    EXPECT_EQ(glass.albedo(), Color3(0.0f));
    // A surface that only reflects is turned, bump and all.
    GridCalls<HalfAndHalf> half(HalfAndHalf{});
    const Vec3 L = direction<float>(0.6, 3);
    const float front = half.at(V, N, up).evaluate(L).total[0].x;
    EXPECT_GT(front, 0);
    EXPECT_NEAR(half.at(V, -N, -up).evaluate(L).total[0].x, front, 1e-6f);
}

TEST(HostTrapsInRenderMan, trap_11_delta_lobes_are_sampled_and_never_evaluated)
{
    GridCalls<HalfAndHalf> grid({}, 200);
    grid.material.metal = gold_material(0);
    const Vec3 V = direction<float>(0.3, 1), mirrored(-V.x, -V.y, V.z);
    const GridAnswers g = grid.at(V).generate(), e = grid.evaluate(mirrored);
    Lobe discrete = metal;
    discrete.discrete = true;
    // The gain is 1: what comes out is Fresnel's term, picked as often as it reflects.
    const Imath::C3f F =
        grid.material.metal.closure(0.0f).prepare(V).sample(Vec2(0.5f, 0.5f)).weight;
    const float share = F.x + F.y + F.z;
    int mirrors = 0;
    for (int i = 0; i < 200; ++i)
    {
        ASSERT_TRUE(g.sampled[i].valid);
        EXPECT_FALSE(e.evaluated[i].has(discrete));
        EXPECT_NEAR(e.total[i].x, 0.5 * V.z / M_PI, 1e-6) << "the Lambert half alone";
        if (!g.sampled[i].discrete) continue;
        ++mirrors;
        EXPECT_NEAR(g.fwd[i], share / (share + 3), 1e-4);
        EXPECT_EQ(g.rev[i] > 0, true);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(g.total[i][c], 0.5f * F[c], 1e-6f);
    }
    EXPECT_GT(mirrors, 20);
}

TEST(HostTrapsInRenderMan, trap_12_black_is_a_sample_and_none_is_none)
{
    constexpr int n = 500;
    GridCalls<HalfAndHalf> black({}, n);
    black.material.metal = shaders::SchlickMetal{Imath::C3f(0.0f), Imath::C3f(0.0f), 0.2f, 0.2f};
    black.material.color = Imath::C3f(0.0f);
    black.material.weight[1] = Imath::C3f(0.0f);
    const GridAnswers a = black.at(direction<float>(0.6)).generate();
    for (int i = 0; i < n; ++i)
    {
        EXPECT_TRUE(a.sampled[i].valid);
        EXPECT_GT(a.fwd[i], 0);
        EXPECT_EQ(a.total[i], Color3(0.0f));
    }
    // Some of a bumped metal's samples go into the surface.
    GridCalls<shaders::SchlickMetal> bumped(gold_material(1.0f), n);
    const GridAnswers b = bumped.at(direction<float>(0.3), direction<float>(0.5)).generate();
    int none = 0;
    for (int i = 0; i < n; ++i)
    {
        none += !b.sampled[i].valid;
        EXPECT_EQ(b.fwd[i] > 0, b.sampled[i].valid);
        EXPECT_TRUE(b.sampled[i].valid || (b.total[i] == Color3(0.0f) && b.rev[i] == 0));
    }
    EXPECT_GT(none, 10);
}

TEST(HostTrapsInRenderMan, trap_13_points_are_told_by_their_own_index)
{
    constexpr int n = 5;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    GridCalls<HalfAndHalf> grid({}, n);
    for (int i = 0; i < n; ++i) grid.host.V[i] = direction<float>(0.3 + 0.15 * i, i);
    grid.host.V[2] = -grid.host.V[2];  // from behind
    grid.host.V[3] = Vec3(0.0f);       // from nowhere
    std::vector<LobeSet> wanted(n, everything);
    wanted[1].clear();
    wanted[4] = LobeSet(metal);
    std::vector<Vec3> L(n, direction<float>(0.7, 3));
    L[1] = Vec3(nan);  // not to be read
    L[2] = -L[2];
    const GridAnswers g = grid.generate(wanted), e = grid.evaluate(L, wanted);
    for (int i = 0; i < n; ++i)
    {
        const bool there = i != 1 && i != 3;
        EXPECT_EQ(e.evaluated[i].any(), there);
        for (const GridAnswers* a : {&g, &e})
        {
            EXPECT_GE(a->fwd[i], 0) << "written at every point";
            EXPECT_GE(a->rev[i], 0);
            EXPECT_TRUE(is_finite(a->total[i]));
            EXPECT_TRUE(there || (a->fwd[i] == 0 && a->rev[i] == 0 && a->total[i] == Color3(0.0f)));
        }
        if (!there) continue;
        GridCalls<HalfAndHalf> alone(HalfAndHalf{});
        const GridAnswers one = alone.at(grid.host.V[i]).evaluate(L[i], wanted[i]);
        EXPECT_EQ(e.total[i], one.total[0]);
        EXPECT_EQ(e.fwd[i], one.fwd[0]);
        EXPECT_EQ(e.rev[i], one.rev[0]);
    }
    // Many directions of one point are its own, whatever their index.
    const std::vector<Vec3> many = sphere(40);
    std::vector<Color3> storage(kMaxActive * many.size());
    LobeWeights w(storage.data(), 40);
    std::vector<LobeSet> evaluated(40);
    std::vector<float> fwd(40), rev(40);
    grid.begin()->evaluateSamplesAtIndex(kDirect, everything, &grid.host.rng, 4, 40,
                                         evaluated.data(), many.data(), w, fwd.data(), rev.data());
    for (int j = 0; j < 40; ++j)
    {
        const GridAnswers one = grid.evaluate(many[j]);
        EXPECT_EQ(w.total(j), one.total[4]);
        EXPECT_EQ(fwd[j], one.fwd[4]);
    }
    GridCalls<HalfAndHalf> none({}, 0);
    EXPECT_TRUE(none.begin());
    EXPECT_EQ(none.generate().total.size(), 0u);
}

TEST(HostTrapsInRenderMan, trap_14_what_is_no_number_goes_no_further)
{
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = 1 / 0.0f;
    constexpr int n = 40;
    // Weights that are none, or negative: the closure is left out, and the other is as ever.
    for (const float w : {nan, -1.0f, -inf})
    {
        GridCalls<HalfAndHalf> grid({}, n);
        grid.material.weight[0] = Imath::C3f(w);
        const Vec3 V = direction<float>(0.6, 1);
        const GridAnswers g = grid.at(V).generate(), e = grid.evaluate(sphere(n));
        const auto closure = grid.material.metal.closure(1.0f);
        for (int i = 0; i < n; ++i)
        {
            EXPECT_NEAR(e.fwd[i], closure.pdf(V, sphere(n)[i]), 1e-4);
            EXPECT_NEAR(e.total[i].x, 0.5f * closure.eval(V, sphere(n)[i]).x, 1e-4);
            EXPECT_TRUE(is_finite(g.total[i]) && std::isfinite(g.fwd[i]));
        }
        EXPECT_NEAR(grid.albedo().x, 0.5, 1e-3);
    }
    // Inputs, one at a time.
    const float values[] = {nan, inf, -inf, -1, 0, 1e-30f, 1e-8f, 7, 1e30f};
    for (const float x : values)
        for (int input = 0; input < 6; ++input)
        {
            GridCalls<HalfAndHalf> grid({}, n);
            for (int i = 0; i < n; ++i) grid.host.V[i] = direction<float>(0.01 + 0.024 * i, i);
            if (input == 0) grid.material.metal.alpha_x = x;
            if (input == 1) grid.material.metal.F0.y = x;
            if (input == 2) grid.material.color.x = x;
            if (input == 3) grid.host.V[5].y = x;
            if (input == 4) grid.host.N[5].y = x;
            if (input == 5) grid.host.T[5] = Vec3(x);
            std::vector<Vec3> L = sphere(n);
            for (int i = 0; i < n; i += 3) L[i] = -grid.host.V[i];  // no half vector
            const GridAnswers g = grid.generate(), e = grid.evaluate(L);
            for (int i = 0; i < n; ++i)
                for (const GridAnswers* a : {&g, &e})
                {
                    EXPECT_TRUE(is_finite(a->total[i])) << input << ' ' << x;
                    EXPECT_TRUE(std::isfinite(a->fwd[i]) && a->fwd[i] >= 0) << input << ' ' << x;
                    EXPECT_TRUE(std::isfinite(a->rev[i]) && a->rev[i] >= 0) << input << ' ' << x;
                }
        }
}

// Lambert that expects to be black.
struct Shy : OrenNayarDiffuse<float>
{
    struct Prepared : OrenNayarDiffuse<float>::Prepared
    {
        using Base = OrenNayarDiffuse<float>::Prepared;
        explicit Prepared(const Base& base) : Base(base) {}
        Albedo<float> expected_albedo() const { return {Imath::C3f(0.0f), Imath::C3f(0.0f)}; }
    };
    Shy() : OrenNayarDiffuse<float>(Imath::C3f(1.0f), 0.0f) {}
    Prepared prepare(const Vec3& wo) const
    {
        return Prepared(OrenNayarDiffuse<float>::prepare(wo));
    }
};
struct HalfShy : HalfAndHalf
{
    template <class Real, class Visit>
    decltype(auto) with_lobe(int k, Real strength, const Visit& visit) const
    {
        return k == 0 ? visit(Shy()) : visit(metal.closure(strength));
    }
};

// Numbers by domain and point alone: what is drawn twice is the same, and one number is the first
// of two.
struct StrictRng final : Rng
{
    explicit StrictRng(int n, float constant = -1) : points(n), fixed(constant) {}
    void draw1D(float* xi) override
    {
        for (int i = 0; i < points; ++i) xi[i] = pair(i).x;
    }
    void draw2D(Vec2* xi) override
    {
        for (int i = 0; i < points; ++i) xi[i] = pair(i);
    }
    void newDomain(std::uint32_t scramble) override { domain = domain * 31 + scramble; }
    Vec2 pair(int i) const
    {
        if (fixed >= 0) return Vec2(fixed);
        return Random((std::uint64_t(domain) << 32) + std::uint64_t(i)).square<float>();
    }
    int points;
    float fixed;
    std::uint32_t domain = 1;
};

// Two panes of which each lets half of its light through.
struct TwoPanes : HalfAndHalf
{
    template <class Real, class Visit>
    decltype(auto) with_lobe(int, Real, const Visit& visit) const
    {
        return visit(LambertInterface<Real>(Real(1.5), Real(0.5)));
    }
    const char* lobe_name(int k) const { return k == 0 ? "glass" : "coat"; }
};

TEST(HostTrapsInRenderMan, trap_15_what_has_a_weight_has_a_chance)
{
    constexpr int n = 40000;
    GridCalls<HalfShy> grid({}, n);
    const GridAnswers a = grid.at(direction<float>(0.6)).generate();
    int picked = 0;
    for (const Lobe& l : a.sampled) picked += l.valid && l.cls == LobeClass::Diffuse;
    EXPECT_GT(picked, 20);
    EXPECT_NEAR(a.estimate().x, 1, 0.05);
    // The ends of the range of numbers.
    GridCalls<HalfAndHalf> half({}, 8);
    half.at(direction<float>(0.6));
    for (const float u : {0.0f, 0.99999994f})
    {
        StrictRng rng(8, u);
        for (const LobeSet wanted : {everything, LobeSet(metal), LobeSet(diffuse)})
        {
            const GridAnswers b = half.generate(wanted, &rng);
            EXPECT_TRUE(std::isfinite(b.fwd[0]) && is_finite(b.total[0]));
            EXPECT_TRUE(!b.sampled[0].valid || wanted.has(b.sampled[0]));
        }
    }
}

TEST(HostTrapsInRenderMan, trap_16_numbers_are_drawn_from_domains_of_their_own)
{
    constexpr int n = 40000;
    StrictRng rng(n);
    // The choice of a closure has nothing to do with what that makes of its numbers.
    GridCalls<TwoPanes> panes({}, n);
    const GridAnswers a = panes.at(direction<float>(0.6)).generate(everything, &rng);
    double picked[2] = {0, 0}, transmitted[2] = {0, 0}, height[2] = {0, 0};
    for (int i = 0; i < n; ++i)
    {
        const int k = a.sampled[i].id == kClearcoatSlot;
        ++picked[k];
        transmitted[k] += a.L[i].z < 0;
        height[k] += double(std::abs(a.L[i].z));
    }
    for (const int k : {0, 1})
    {
        EXPECT_NEAR(picked[k] / n, 0.5, 0.02);
        EXPECT_NEAR(transmitted[k] / picked[k], 0.5, 0.02);
        EXPECT_NEAR(height[k] / picked[k], 2.0 / 3, 0.01);
    }
    // The third number of a closure: the event has nothing to do with the direction.
    const ClosureMaterial interface {
        LambertInterface<float>(1.5f, 0.5f)
    };
    GridCalls<ClosureMaterial<LambertInterface<float>>> glass(interface, n);
    const GridAnswers b = glass.at(direction<float>(0.6)).generate(everything, &rng);
    double heights[2] = {0, 0}, counts[2] = {0, 0};
    for (const Vec3& L : b.L)
    {
        heights[L.z > 0] += double(std::abs(L.z));
        ++counts[L.z > 0];
    }
    for (const int side : {0, 1}) EXPECT_NEAR(heights[side] / counts[side], 2.0 / 3, 0.01);
    EXPECT_NEAR(counts[1] / n, 0.5, 0.02);
}

TEST(HostTrapsInRenderMan, trap_17_nothing_is_allocated_and_threads_share_a_factory)
{
    constexpr int n = 64;
    GridCalls<HalfAndHalf> grid({}, n);
    grid.at(direction<float>(0.6, 1));
    const std::vector<Vec3> L = sphere(n);
    const std::vector<LobeSet> wanted(n, everything);
    GridAnswers a(n), b(n);
    const long before = allocations();
    Bxdf* bxdf = grid.begin();
    LobeWeights w = grid.host.weights();
    bxdf->generateSample(kAnyLighting, wanted.data(), &grid.host.rng, a.sampled.data(), a.L.data(),
                         w, a.fwd.data(), a.rev.data(), a.compTrans.data());
    LobeWeights again = grid.host.weights();
    bxdf->evaluateSample(kAnyLighting, wanted.data(), &grid.host.rng, b.evaluated.data(), L.data(),
                         again, b.fwd.data(), b.rev.data());
    bxdf->albedo(a.total.data());
    grid.factory.endScatter(bxdf);
    EXPECT_EQ(allocations(), before) << "all is in the host's arena";
    // Outputs that are optional.
    LobeWeights third = grid.host.weights();
    grid.begin()->generateSample(kAnyLighting, wanted.data(), &grid.host.rng, a.sampled.data(),
                                 a.L.data(), third, a.fwd.data(), nullptr, nullptr);

    std::vector<std::thread> threads;
    std::vector<float> pdf(4);
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&, t] {
            GridHost own(1);
            own.V[0] = direction<float>(0.6, 1);
            for (int round = 0; round < 50; ++round)
            {
                own.reset();
                LobeWeights weights = own.weights();
                LobeSet evaluated;
                float rev;
                grid.factory
                    .beginScatter(&own.ctx, everything, ShadeMode::Scatter, nullptr, &grid.material)
                    ->evaluateSample(kDirect, &everything, &own.rng, &evaluated, &L[3], weights,
                                     &pdf[std::size_t(t)], &rev);
            }
        });
    for (auto& t : threads) t.join();
    for (const float p : pdf) EXPECT_EQ(p, b.fwd[3]);
}

TEST(HostTrapsInRenderMan, trap_18_too_many_closures_are_refused_and_none_is_lost)
{
    constexpr int n = 2000;
    GridCalls<Many> most({SurfaceBxdf::most_lobes}, n);
    most.host.V.assign(n, direction<float>(0.6));
    EXPECT_NEAR(most.generate().estimate().x, 1, 1e-3);
    GridCalls<Many> more({SurfaceBxdf::most_lobes + 1});
    EXPECT_FALSE(more.begin());
    // Trees say so earlier.
    using shaders::ClosureTree;
    EXPECT_EQ(ClosureTree::most_lobes, SurfaceBxdf::most_lobes);
    ClosureTree tree;
    const auto leaf = tree.lobe(shaders::PlainMaterial{shaders::OrenNayarSurface{}});
    auto node = leaf;
    for (int k = 0; k < ClosureTree::most_lobes; ++k) node = tree.add(node, leaf);
    EXPECT_THROW(tree.set_root(node), std::invalid_argument);
}

TEST(HostTrapsInRenderMan, trap_19_V_is_the_direction_that_is_known)
{
    const Vec3 V = direction<float>(0.3, 1), L = direction<float>(0.9, 3);
    GridCalls<SlopedLambert> grid(SlopedLambert{});
    const Color3 value = grid.at(V).evaluate(L).total[0], gain = SlopedGain<float>().at(V);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c], gain[c] * L.z / M_PI, 1e-5);
}

// Paint on a clear pane, of which half is there.
struct Pane : HalfAndHalf
{
    template <class Real, class Visit>
    decltype(auto) with_lobe(int k, Real, const Visit& visit) const
    {
        return k == 0 ? visit(diffuse<Real>())
                      : visit(Transparent<Real>(regain::Color3<Real>(Real(1))));
    }
    double presence() const { return 0.5; }
};

TEST(HostTrapsInRenderMan, trap_20_transparency_is_a_lobe_and_presence_none)
{
    constexpr int n = 4000;
    GridCalls<Pane> grid({}, n);
    const GridAnswers a = grid.at(direction<float>(0.6)).generate();
    double straight = 0;
    for (int i = 0; i < n; ++i)
    {
        EXPECT_EQ(a.compTrans[i], Color3(0.0f));
        if (a.sampled[i].continuation) straight += double(a.total[i].x / a.fwd[i]) / n;
    }
    EXPECT_NEAR(straight, 0.5, 0.05);
    EXPECT_NEAR(a.estimate().x, 1, 1e-3) << "not halved by the presence";
    grid.host.reset();
    Opacity* o = grid.factory.beginOpacity(&grid.host.ctx, ShadeMode::PresenceQuery, nullptr,
                                           &grid.material);
    ASSERT_TRUE(o);
    std::vector<float> presence(n);
    std::vector<Color3> opacity(n);
    EXPECT_TRUE(o->presence(presence.data()));
    EXPECT_EQ(presence[n - 1], 0.5f) << "not less by the transparent half";
    EXPECT_FALSE(o->opacity(opacity.data()));
}

TEST(HostTrapsInRenderMan, trap_21_value_over_pdf_may_exceed_1_in_a_channel)
{
    constexpr int n = 100;
    GridCalls<SlopedLambert> grid(SlopedLambert{}, n);
    const Vec3 V = direction<float>(0.5, 0.6);
    const GridAnswers a = grid.at(V).generate();
    const Color3 gain = SlopedGain<float>().at(V);
    ASSERT_GT(gain.y, 1.2f);
    for (int i = 0; i < n; ++i)
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(a.total[i][c] / a.fwd[i], gain[c], 1e-4);
}

// A lobe that is added for what is scattered several times, and not a gain.
struct AddedMetal
{
    template <class Real>
    auto closure(Real) const
    {
        return kulla_conty(white<Real>(0.5, 0.5), KullaContyForm::printed, luts::ggx_tables());
    }
    const char* lobe_name() const { return "metal"; }
};

TEST(HostTrapsInRenderMan, trap_22_compensation_stays_in_the_slot_of_its_lobe)
{
    const Vec3 V = direction<float>(0.6), L = direction<float>(0.4, 3);
    GridCalls<HalfAndHalf> half(HalfAndHalf{});
    const GridAnswers a = half.at(V).evaluate(L);
    ASSERT_EQ(a.slots.size(), 2u);
    EXPECT_TRUE(LobeSet(a.slots[0]).has(diffuse));
    EXPECT_TRUE(LobeSet(a.slots[1]).has(metal));
    GridCalls<AddedMetal> added(AddedMetal{});
    const GridAnswers b = added.at(V).evaluate(L);
    ASSERT_EQ(b.slots.size(), 1u);
    EXPECT_TRUE(LobeSet(b.slots[0]).has(metal));
    EXPECT_GT(b.total[0].x, white<float>(0.5, 0.5).eval(V, L).x);
}

}  // namespace
