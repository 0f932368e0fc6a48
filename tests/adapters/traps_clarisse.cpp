// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// What adapters of one-point hosts are apt to get wrong, one test each, by the numbers of
// traps_renderman.cpp. Where a trap is one of batches, its counterpart at one point is tested.

#include "../support/allocations.h"
#include "../support/host_calls.h"
#include "../support/trap_materials.h"

#include <regain/closures/kulla_conty.h>

#include <algorithm>
#include <limits>
#include <thread>

using namespace regain::clarisse;
using namespace regain::tests;

namespace {

using regain::KullaContyForm;
using regain::OrenNayarDiffuse;
using V3 = Imath::V3f;
using Color = Imath::C3f;

// A spiral that fills the sphere evenly.
std::vector<V3> sphere(int n)
{
    std::vector<V3> all;
    for (int i = 0; i < n; ++i)
        all.push_back(direction<float>(1 - (2 * i + 1.0) / n, i * M_PI * (3 - std::sqrt(5.0))));
    return all;
}

// All entries of a point towards L, as a host adds them up.
template <class Material>
Color total(const PointCalls<Material>& p, const V3& L)
{
    Color sum(0.0f);
    for (int k = 0; k < p.list.size(); ++k) sum += p.list[k].weight * p.evaluate(L, k).value();
    return sum;
}

TEST(HostTrapsInClarisse, trap_01_weights_are_over_the_pdf_and_have_the_cosine)
{
    HalfAndHalf dull;
    dull.color = Color(0.8f);
    PointCalls<HalfAndHalf> p(dull);
    ASSERT_TRUE(p.make(direction<float>(0.6, 1)));
    // Lambert by the cosine: value over pdf is the colour, in either call.
    EXPECT_NEAR(p.evaluate(direction<float>(0.3, 2)).weight.x, 0.8, 1e-5);
    EXPECT_NEAR(p.sample(V3(0.3f, 0.6f, 0.5f)).weight.x, 0.8, 1e-5);
    EXPECT_NEAR(p.evaluate(direction<float>(0.3, 2)).pdf, 0.3 / M_PI, 1e-6);
    // A furnace by evaluate and by sample.
    const auto all = sphere(8000);
    double evaluated = 0, sampled = 0;
    Random random(1);
    for (const V3& L : all)
    {
        evaluated += double(p.evaluate(L, 1).value().x) * 4 * M_PI / double(all.size());
        const auto s = p.sample(random.cube<float>(), 1);
        if (s.pdf > 0) sampled += double(s.weight.x) / double(all.size());
    }
    EXPECT_NEAR(evaluated, 1, 0.01);
    EXPECT_NEAR(sampled, 1, 0.02);
    EXPECT_NEAR(p.albedo(1).x, 1, 1e-3);
}

TEST(HostTrapsInClarisse, trap_02_sample_says_what_evaluate_says)
{
    PointCalls<HalfAndHalf> p(HalfAndHalf{});
    Random random(2);
    int valid = 0;
    for (int i = 0; i < 300; ++i)
    {
        ASSERT_TRUE(p.make(direction<float>(0.1 + 0.9 * random.unit(), 7 * random.unit())));
        for (int k = 0; k < 2; ++k)
        {
            const auto s = p.sample(random.cube<float>(), k), e = p.evaluate(s.wo, k);
            if (!(s.pdf > 0)) continue;
            ++valid;
            EXPECT_NEAR(s.pdf / e.pdf, 1, 1e-4);
            EXPECT_NEAR(s.weight.x / e.weight.x, 1, 1e-4);
            EXPECT_NEAR(s.reverse / e.reverse, 1, 1e-4);
        }
    }
    EXPECT_GT(valid, 400);
}

TEST(HostTrapsInClarisse, trap_03_a_pdf_is_that_of_its_lobe_alone)
{
    PointCalls<HalfAndHalf> p(HalfAndHalf{});
    const V3 wi = direction<float>(0.6, 1), wo = direction<float>(0.8, 3);
    ASSERT_TRUE(p.make(wi));
    const auto metal = p.material.metal.closure(1.0f);
    EXPECT_NEAR(p.evaluate(wo, 0).pdf, wo.z / M_PI, 1e-5);
    EXPECT_NEAR(p.evaluate(wo, 1).pdf / metal.pdf(wi, wo), 1, 1e-5);
    // Entry weights are in neither.
    EXPECT_EQ(p.list[0].weight, Color(0.5f));
    EXPECT_NEAR(p.evaluate(wo, 1).value().x / metal.eval(wi, wo).x, 1, 1e-5);
}

TEST(HostTrapsInClarisse, trap_04_lobes_that_are_not_wanted_are_not_made)
{
    PointCalls<HalfAndHalf> p(HalfAndHalf{});
    const std::uint32_t cases[][2] = {
        {glossy_reflection, 1}, {diffuse_reflection, 1}, {singular_reflection, 0}, {all_lobes, 2}};
    for (const auto& [wanted, count] : cases)
    {
        p.point.wanted = wanted;
        ASSERT_TRUE(p.make(direction<float>(0.6)));
        EXPECT_EQ(p.list.size(), int(count));
        for (int k = 0; k < p.list.size(); ++k)
        {
            EXPECT_TRUE(p.lobe(k).label().category() & wanted);
            EXPECT_EQ(p.list[k].weight, Color(0.5f)) << "not shared out among the others";
        }
    }
}

TEST(HostTrapsInClarisse, trap_05_a_lobe_that_does_not_fit_is_told)
{
    constexpr int most = lobe_list<float>::capacity;
    PointCalls<Many> full({most}), more({most + 1});
    ASSERT_TRUE(full.make(direction<float>(0.6)));
    EXPECT_EQ(full.list.size(), most);
    EXPECT_NEAR(total(full, direction<float>(0.5)).x, 0.5 / M_PI, 1e-5);
    EXPECT_FALSE(more.make(direction<float>(0.6)));
    // Nor is one left out silently where memory is short.
    alignas(64) char memory[600];
    scratchpad pad(memory, sizeof memory);
    lobe_list<float> list;
    EXPECT_FALSE(
        (closure_callbacks<Many, float>().create_lobes(&full.material, full.point, pad, list)));
}

TEST(HostTrapsInClarisse, trap_06_reverse_pdf_is_the_lobe_with_its_ends_exchanged)
{
    const V3 a = direction<float>(0.95, 1), b = direction<float>(0.1, 4);
    PointCalls<HalfAndHalf> p(HalfAndHalf{});
    for (int k = 0; k < 2; ++k)
    {
        ASSERT_TRUE(p.make(a));
        const auto there = p.evaluate(b, k);
        ASSERT_TRUE(p.make(b));
        const auto back = p.evaluate(a, k);
        EXPECT_NEAR(there.reverse / back.pdf, 1, 1e-5);
        EXPECT_NEAR(there.pdf / back.reverse, 1, 1e-5);
        EXPECT_GT(std::abs(there.pdf / there.reverse - 1), 0.1);
    }
}

TEST(HostTrapsInClarisse, trap_07_gains_are_those_of_the_known_direction)
{
    const V3 a = direction<float>(0.2, 0.3), b = direction<float>(0.9, 2.5);
    PointCalls<SlopedLambert> p(SlopedLambert{});
    ASSERT_TRUE(p.make(a));
    const auto there = p.evaluate(b);
    ASSERT_TRUE(p.make(b));
    const auto back = p.evaluate(a);
    for (int c = 0; c < 3; ++c)
    {
        EXPECT_NEAR(there.weight[c], SlopedGain<float>().at(a)[c], 1e-5);
        EXPECT_NEAR(back.weight[c], SlopedGain<float>().at(b)[c], 1e-5);
    }
    EXPECT_NEAR(there.reverse, back.pdf, 1e-6) << "gains are in no pdf";
}

TEST(HostTrapsInClarisse, trap_08_radiance_is_scaled_once_and_albedo_is_energy)
{
    PointCalls<TrapGlass<true>> p(TrapGlass<true>{});
    const auto closure = p.material.closure(1.0f);
    for (const float side : {0.7f, -0.7f})
    {
        const V3 wi = direction<float>(side, 1), wo = direction<float>(-0.8f * side / 0.7f, 4);
        const float factor = side > 0 ? 1 / 2.25f : 2.25f;
        ASSERT_TRUE(p.make(wi));
        const Color f = closure.eval(wi, wo), value = p.evaluate(wo).value();
        ASSERT_GT(f.x, 0);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c] / (f[c] * factor), 1, 1e-5);
        EXPECT_NEAR(p.evaluate(wo).pdf / closure.pdf(wi, wo), 1, 1e-5);
        const auto E = closure.albedo(wi);
        EXPECT_NEAR(p.albedo().x, E.reflect.x + E.transmit.x, 1e-5);
        EXPECT_FLOAT_EQ(p.lobe().ior(), 1.5f) << "by which a host undoes the factor";
    }
}

TEST(HostTrapsInClarisse, trap_09_the_true_normal_tells_sides_and_the_bumped_one_scatters)
{
    PointCalls<HalfAndHalf> p(HalfAndHalf{});
    p.point.ns = direction<float>(0.5, 0);
    constexpr int n = 4000;
    const auto all = sphere(n);
    ASSERT_TRUE(p.make(direction<float>(0.3, 0.1)));
    Random random(9);
    for (int k = 0; k < 2; ++k)
    {
        int lost = 0;
        double pdf = 0;
        for (int i = 0; i < n; ++i)
        {
            const auto s = p.sample(random.cube<float>(), k);
            lost += !(s.pdf > 0);
            EXPECT_TRUE(!(s.pdf > 0) || s.wo.z > 0);
            EXPECT_TRUE(s.pdf > 0 || s.weight == Color(0.0f));
            const auto e = p.evaluate(all[std::size_t(i)], k);
            EXPECT_TRUE(all[std::size_t(i)].z > 0 || e.pdf == 0);
            pdf += double(e.pdf) * 4 * M_PI / n;
        }
        EXPECT_GT(lost, n / 50);
        EXPECT_NEAR(pdf, 1 - double(lost) / n, 0.03) << "what is lost is nobody's";
    }
    // Above the surface and below the bump: black, and no NaN.
    ASSERT_TRUE(p.make(direction<float>(0.1, M_PI)));
    for (int k = 0; k < 2; ++k)
    {
        EXPECT_EQ(p.sample(V3(0.4f), k).pdf, 0);
        EXPECT_EQ(p.evaluate(direction<float>(0.9), k).pdf, 0);
        EXPECT_EQ(p.albedo(k), Color(0.0f));
    }
}

TEST(HostTrapsInClarisse, trap_10_sidedness_turns_both_normals_and_indices_go_by_the_true_one)
{
    const V3 V = direction<float>(0.7, 1), N = direction<float>(0.8, 0);
    PointCalls<TrapGlass<false>> glass(TrapGlass<false>{});
    glass.point.ns = N;
    const auto closure = glass.material.closure(1.0f);
    const auto reflected = [&](const V3& view) {
        EXPECT_TRUE(glass.make(view));
        return glass.evaluate(N * (2 * N.dot(view)) - view).value().x;
    };
    const auto expected = [&](float side) {
        const V3 wo = direction<float>(side, 2);
        return closure.eval(wo, V3(-wo.x, -wo.y, wo.z)).x;
    };
    EXPECT_NEAR(reflected(V) / expected(V.dot(N)), 1, 1e-3);
    EXPECT_NEAR(reflected(-V) / expected(-V.dot(N)), 1, 1e-3);
    // From above the surface and below the bump it is neither outside nor inside.
    EXPECT_EQ(reflected(direction<float>(0.1, M_PI)), 0);
    EXPECT_EQ(glass.evaluate(direction<float>(-0.9)).pdf, 0);
    EXPECT_EQ(glass.albedo(), Color(0.0f));
    glass.point.sides = sidedness::inverted;
    EXPECT_NEAR(reflected(-V) / expected(V.dot(N)), 1, 1e-3);
    // What only reflects is there from one side, the other, or both.
    PointCalls<HalfAndHalf> half(HalfAndHalf{});
    half.point.ns = N;
    for (const auto sides : {sidedness::single_sided, sidedness::double_sided, sidedness::inverted})
        for (const bool front : {true, false})
        {
            half.point.sides = sides;
            ASSERT_TRUE(half.make(front ? V : -V));
            const bool there =
                sides == sidedness::double_sided || front == (sides == sidedness::single_sided);
            EXPECT_EQ(half.list.size(), there ? 2 : 0);
            EXPECT_TRUE(!there || half.list[1].z == (front ? N : -N));
        }
}

TEST(HostTrapsInClarisse, trap_11_singular_lobes_are_sampled_and_never_evaluated)
{
    PointCalls<HalfAndHalf> p(HalfAndHalf{});
    p.material.metal = gold_material(0);
    const V3 wi = direction<float>(0.3, 1), mirrored(-wi.x, -wi.y, wi.z);
    ASSERT_TRUE(p.make(wi));
    EXPECT_EQ(p.lobe(1).label().sc, scatter::singular);
    const auto s = p.sample(V3(0.5f), 1);
    EXPECT_EQ(s.pdf, 1);
    EXPECT_EQ(s.reverse, 1);
    // The gain is 1.
    const Color F = p.material.metal.closure(0.0f).prepare(wi).sample(V3(0.5f)).weight;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(s.weight[c], F[c], 1e-6f);
    EXPECT_EQ(p.evaluate(mirrored, 1).pdf, 0);
    EXPECT_EQ(p.evaluate(mirrored, 1).weight, Color(0.0f));
}

TEST(HostTrapsInClarisse, trap_12_black_is_a_sample_and_none_is_none)
{
    PointCalls<HalfAndHalf> black(HalfAndHalf{});
    black.material.color = Color(0.0f);
    ASSERT_TRUE(black.make(direction<float>(0.6)));
    EXPECT_GT(black.sample(V3(0.4f)).pdf, 0);
    EXPECT_EQ(black.sample(V3(0.4f)).weight, Color(0.0f));
    PointCalls<HalfAndHalf> p(HalfAndHalf{});
    p.point.ns = direction<float>(0.5);
    ASSERT_TRUE(p.make(direction<float>(0.3)));
    Random random(12);
    int none = 0;
    for (int i = 0; i < 500; ++i)
    {
        const auto s = p.sample(random.cube<float>(), 1);
        if (s.pdf > 0) continue;
        ++none;
        EXPECT_EQ(s.pdf, 0);
        EXPECT_EQ(s.reverse, 0);
        EXPECT_EQ(s.weight, Color(0.0f));
    }
    EXPECT_GT(none, 10);
}

TEST(HostTrapsInClarisse, trap_13_a_lobe_answers_for_other_directions_than_its_own)
{
    const V3 a = direction<float>(0.6, 1), b = direction<float>(0.2, 5), wo = direction<float>(0.5);
    PointCalls<HalfAndHalf> made_for_a(HalfAndHalf{}), made_for_b(HalfAndHalf{});
    ASSERT_TRUE(made_for_a.make(a));
    ASSERT_TRUE(made_for_b.make(b));
    for (int k = 0; k < 2; ++k)
    {
        Color x, y;
        float pdf_x, pdf_y, reverse;
        pdf_x = made_for_a.lobe(k).evaluate(b, wo, x, &reverse);
        pdf_y = made_for_b.lobe(k).evaluate(b, wo, y, nullptr);
        EXPECT_NEAR(pdf_x, pdf_y, 1e-6);
        EXPECT_NEAR(x.x, y.x, 1e-6);
        EXPECT_EQ(made_for_a.lobe(k).albedo(b), made_for_b.lobe(k).albedo(b));
    }
}

TEST(HostTrapsInClarisse, trap_14_what_is_no_number_goes_no_further)
{
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = 1 / 0.0f;
    for (const float w : {nan, -1.0f, -inf})
    {
        PointCalls<HalfAndHalf> p(HalfAndHalf{});
        p.material.weight[0] = Color(w);
        ASSERT_TRUE(p.make(direction<float>(0.6)));
        EXPECT_EQ(p.list[0].weight, Color(0.0f));
        EXPECT_EQ(p.list[1].weight, Color(0.5f));
    }
    const float values[] = {nan, inf, -inf, -1, 0, 1e-30f, 1e-8f, 7, 1e30f};
    const auto all = sphere(30);
    for (const float x : values)
        for (int input = 0; input < 6; ++input)
        {
            PointCalls<HalfAndHalf> p(HalfAndHalf{});
            V3 view = direction<float>(0.3, 1);
            if (input == 0) p.material.metal.alpha_x = x;
            if (input == 1) p.material.metal.F0.y = x;
            if (input == 2) p.material.color.x = x;
            if (input == 3) view.y = x;
            if (input == 4) p.point.ns.y = x;
            if (input == 5) p.point.tangent = V3(x);
            ASSERT_TRUE(p.make(view));
            for (int k = 0; k < p.list.size(); ++k)
            {
                const auto check = [&](const PointAnswer<float>& a) {
                    EXPECT_TRUE(std::isfinite(a.pdf) && a.pdf >= 0) << input << ' ' << x;
                    EXPECT_TRUE(std::isfinite(a.reverse) && a.reverse >= 0) << input << ' ' << x;
                    for (int c = 0; c < 3; ++c)
                        EXPECT_TRUE(std::isfinite(a.weight[c])) << input << ' ' << x;
                };
                for (const V3& L : all) check(p.evaluate(L, k));
                check(p.evaluate(-view, k));  // no half vector
                check(p.sample(V3(0.3f, 0.7f, 0.2f), k));
                for (int c = 0; c < 3; ++c)
                {
                    EXPECT_TRUE(std::isfinite(p.albedo(k)[c])) << input << ' ' << x;
                    EXPECT_TRUE(std::isfinite(p.list[k].weight[c]));
                }
            }
        }
}

TEST(HostTrapsInClarisse, trap_15_albedos_to_pick_by_are_above_0_and_have_the_gain)
{
    PointCalls<HalfAndHalf> p(HalfAndHalf{});
    const float E = p.material.metal.closure(0.0f).albedo(direction<float>(0.05)).reflect.x;
    for (const float mu : {1.0f, 0.05f, 1e-3f})
        for (const float strength : {0.0f, 1.0f})
        {
            p.point.multiple_scattering_strength = strength;
            ASSERT_TRUE(p.make(direction<float>(mu)));
            for (int k = 0; k < 2; ++k) EXPECT_GT(p.albedo(k).x, 0);
            EXPECT_TRUE(strength == 0 || std::abs(p.albedo(1).x - 1) < 2e-3f);
            EXPECT_TRUE(strength == 1 || mu != 0.05f || std::abs(p.albedo(1).x - E) < 2e-3f);
        }
    // The ends of the range of numbers.
    for (const float u : {0.0f, 0.99999994f})
        for (int k = 0; k < 2; ++k)
        {
            const auto s = p.sample(V3(u), k);
            EXPECT_TRUE(std::isfinite(s.pdf) && std::isfinite(s.weight.x));
        }
}

TEST(HostTrapsInClarisse, trap_16_a_sample_is_its_three_numbers_and_nothing_else)
{
    const ClosureMaterial<LambertInterface<float>> interface {
        {
            1.5f, 0.5f
        }
    };
    PointCalls<ClosureMaterial<LambertInterface<float>>> p(interface);
    ASSERT_TRUE(p.make(direction<float>(0.6)));
    Random random(16);
    double height[2] = {0, 0}, count[2] = {0, 0};
    for (int i = 0; i < 20000; ++i)
    {
        const V3 u = random.cube<float>();
        const auto a = p.sample(u), b = p.sample(u);
        EXPECT_EQ(a.wo, b.wo);
        EXPECT_EQ(a.wo.z < 0, u.z < 0.5f) << "the third is the event's";
        height[a.wo.z > 0] += std::abs(double(a.wo.z));
        ++count[a.wo.z > 0];
    }
    for (const int side : {0, 1}) EXPECT_NEAR(height[side] / count[side], 2.0 / 3, 0.01);
}

TEST(HostTrapsInClarisse, trap_17_nothing_is_allocated_and_threads_share_a_material)
{
    PointCalls<HalfAndHalf> p(HalfAndHalf{});
    const V3 wi = direction<float>(0.6, 1), wo = direction<float>(0.5, 3);
    const long before = allocations();
    const bool made = p.make(wi);
    const auto a = p.evaluate(wo, 1);
    const auto s = p.sample(V3(0.5f), 1);
    const Color E = p.albedo(1);
    EXPECT_EQ(allocations(), before) << "all is in the scratchpad";
    EXPECT_TRUE(made && s.pdf > 0 && E.x > 0);
    std::vector<std::thread> threads;
    std::vector<float> pdf(4);
    const auto callbacks = closure_callbacks<HalfAndHalf, float>();
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&, t] {
            alignas(64) char memory[8192];
            for (int round = 0; round < 50; ++round)
            {
                scratchpad pad(memory, sizeof memory);
                lobe_list<float> list;
                callbacks.create_lobes(&p.material, p.point, pad, list);
                Color weight;
                pdf[std::size_t(t)] = list[1].lobe->evaluate(wi, wo, weight, nullptr);
            }
        });
    for (auto& t : threads) t.join();
    for (const float x : pdf) EXPECT_EQ(x, a.pdf);
}

TEST(HostTrapsInClarisse, trap_18_many_closures_are_all_there_or_refused)
{
    for (int count = 1; count <= lobe_list<float>::capacity + 4; ++count)
    {
        PointCalls<Many> p({count});
        const bool fits = count <= lobe_list<float>::capacity;
        EXPECT_EQ(p.make(direction<float>(0.6)), fits) << count;
        if (!fits) continue;
        EXPECT_EQ(p.list.size(), count);
        EXPECT_NEAR(total(p, direction<float>(0.5)).x, 0.5 / M_PI, 1e-5);
    }
}

TEST(HostTrapsInClarisse, trap_19_wi_is_the_direction_that_is_known)
{
    const V3 wi = direction<float>(0.3, 1), wo = direction<float>(0.9, 3);
    PointCalls<SlopedLambert> p(SlopedLambert{});
    ASSERT_TRUE(p.make(wi));
    const auto a = p.evaluate(wo);
    EXPECT_NEAR(a.pdf, wo.z / M_PI, 1e-5) << "of the direction that is asked about";
    EXPECT_NEAR(a.reverse, wi.z / M_PI, 1e-5);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a.weight[c], SlopedGain<float>().at(wi)[c], 1e-5);
}

// Paint on a clear pane, of which half is there.
struct Pane : HalfAndHalf
{
    template <class Real, class Visit>
    decltype(auto) with_lobe(int k, Real, const Visit& visit) const
    {
        return k == 0 ? visit(diffuse<Real>())
                      : visit(regain::Transparent<Real>(regain::Color3<Real>(Real(1))));
    }
    double presence() const { return 0.5; }
};

TEST(HostTrapsInClarisse, trap_20_transparency_is_a_lobe_and_opacity_none)
{
    PointCalls<Pane> p(Pane{});
    const V3 view = direction<float>(0.6);
    ASSERT_TRUE(p.make(view));
    ASSERT_EQ(p.list.size(), 2);
    EXPECT_EQ(p.lobe(1).label().sc, scatter::straight);
    for (int k = 0; k < 2; ++k) EXPECT_EQ(p.list[k].weight, Color(0.5f));
    const auto s = p.sample(V3(0.5f), 1);
    EXPECT_EQ(s.weight, Color(1.0f)) << "not halved by the opacity";
    EXPECT_LT((s.wo + view).length(), 1e-5f);
    const auto callbacks = closure_callbacks<Pane, float>();
    ASSERT_TRUE(callbacks.opacity);
    EXPECT_EQ(callbacks.opacity(&p.material, p.point), Color(0.5f))
        << "not less by the transparent half";
    EXPECT_FALSE((closure_callbacks<HalfAndHalf, float>().opacity));
}

TEST(HostTrapsInClarisse, trap_21_value_over_pdf_may_exceed_1_in_a_channel)
{
    const V3 wi = direction<float>(0.5, 0.6);
    PointCalls<SlopedLambert> p(SlopedLambert{});
    ASSERT_TRUE(p.make(wi));
    const Color gain = SlopedGain<float>().at(wi);
    ASSERT_GT(gain.y, 1.2f);
    Random random(21);
    for (int i = 0; i < 100; ++i)
    {
        const auto s = p.sample(random.cube<float>());
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(s.weight[c], gain[c], 1e-4);
    }
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(p.albedo()[c], gain[c], 1e-4);
}

// A lobe that is added for what is scattered several times, and not a gain.
struct AddedMetal
{
    template <class Real>
    auto closure(Real) const
    {
        return kulla_conty(white<Real>(0.5, 0.5), KullaContyForm::printed,
                           regain::luts::ggx_tables());
    }
    const char* lobe_name() const { return "metal"; }
};

TEST(HostTrapsInClarisse, trap_22_compensation_has_the_label_of_its_lobe)
{
    const V3 wi = direction<float>(0.6), wo = direction<float>(0.4, 3);
    PointCalls<AddedMetal> added(AddedMetal{});
    ASSERT_TRUE(added.make(wi));
    ASSERT_EQ(added.list.size(), 1);
    EXPECT_STREQ(added.lobe().label().name, "metal");
    EXPECT_EQ(added.lobe().label().category(), glossy_reflection);
    EXPECT_GT(added.evaluate(wo).value().x, white<float>(0.5, 0.5).eval(wi, wo).x);
    PointCalls<HalfAndHalf> half(HalfAndHalf{});
    ASSERT_TRUE(half.make(wi));
    EXPECT_EQ(half.lobe(0).label().category(), diffuse_reflection);
    EXPECT_EQ(half.lobe(1).label().category(), glossy_reflection);
    EXPECT_EQ(half.list.size(), 2);
}

}  // namespace
