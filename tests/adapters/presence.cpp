// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Where a surface is, told by both adapters: it changes nothing of what scatters, and closures that
// let light straight on are no part of it.

#include "../support/hosts.h"

#include <regain/closures/oren_nayar_diffuse.h>
#include <regain/closures/transparent.h>
#include <regain/shaders/closure_tree.h>

#include <gtest/gtest.h>

#include <limits>

using namespace regain;
using namespace regain::tests;

namespace {

namespace rm = regain::renderman;
namespace cl = regain::clarisse;

// A pane in dull paint: two fifths of it let light straight on, and `there` of all of it is there.
struct Painted
{
    double there = 1;

    int lobes() const { return 2; }
    template <class Real, class Visit>
    decltype(auto) with_lobe(int k, Real, const Visit& visit) const
    {
        using Color = Color3<Real>;
        return k == 0 ? visit(OrenNayarDiffuse<Real>(Color(Real(0.8)), Real(0.3)))
                      : visit(Transparent<Real>(Color(Real(1), Real(0.5), Real(0.25))));
    }
    template <class Real>
    Color3<Real> lobe_weights(const Color3<Real>* albedo, Color3<Real>* weight) const
    {
        weight[0] = Color3<Real>(Real(0.6));
        weight[1] = Color3<Real>(Real(0.4));
        return weight[0] * albedo[0] + weight[1] * albedo[1];
    }
    const char* lobe_name(int k) const { return k == 0 ? "diffuse" : "transparent"; }
};
struct PartlyPainted : Painted
{
    double presence() const { return there; }
};

TEST(Presence, is_clamped_and_1_of_what_says_nothing)
{
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = 1 / 0.0;
    const double cases[][2] = {{0, 0}, {0.25, 0.25}, {1, 1},   {-3, 0},
                               {7, 1}, {nan, 1},     {inf, 1}, {-inf, 0}};
    for (const auto& [said, heard] : cases)
    {
        EXPECT_EQ(presence_of<float>(PartlyPainted{{said}}), float(heard));
        EXPECT_EQ(presence_of<double>(PartlyPainted{{said}}), heard);
        shaders::ClosureTree tree;
        tree.set_presence(said);
        EXPECT_EQ(tree.presence(), heard);
        EXPECT_EQ(presence_of<float>(tree), float(heard));
    }
    EXPECT_EQ(presence_of<float>(Painted{0.5}), 1);
    EXPECT_EQ(shaders::ClosureTree().presence(), 1);
}

TEST(PresenceInRenderMan, is_told_where_it_is_below_1)
{
    GridHost host(3);
    rm::ClosureFactory<Painted> whole;
    rm::ClosureFactory<PartlyPainted> partly;
    Painted all;
    PartlyPainted some{{0.3}}, full{{1}};
    const auto ask = [&](rm::Factory& factory, void* data) {
        auto* o = factory.beginOpacity(&host.ctx, rm::ShadeMode::PresenceQuery, nullptr, data);
        EXPECT_EQ(o != nullptr, factory.computesPresence(data));
        return o;
    };
    EXPECT_FALSE(ask(whole, &all));
    EXPECT_FALSE(ask(partly, &full));
    EXPECT_FALSE(ask(partly, nullptr));
    rm::Opacity* o = ask(partly, &some);
    ASSERT_TRUE(o);
    float presence[3] = {9, 9, 9};
    rm::Color3 opacity[3];
    EXPECT_TRUE(o->presence(presence));
    for (const float p : presence) EXPECT_FLOAT_EQ(p, 0.3f);
    EXPECT_FALSE(o->opacity(opacity)) << "the transparent closure is a lobe, and no opacity";
    GridHost spent(3, 8);
    EXPECT_FALSE(partly.beginOpacity(&spent.ctx, rm::ShadeMode::PresenceQuery, nullptr, &some));
}

struct Answers
{
    std::vector<rm::Lobe> sampled;
    std::vector<rm::Vec3> L;
    std::vector<rm::Color3> total, compTrans, value;
    std::vector<float> fwd, rev, pdf;
};

template <class Material>
Answers ask_all(Material material, int n)
{
    GridHost host(n, std::size_t(n) * 2048 + 8192);
    std::fill(host.V.begin(), host.V.end(), direction<float>(0.6, 1));
    rm::ClosureFactory<Material> factory;
    rm::Bxdf* bxdf = factory.beginScatter(&host.ctx, rm::LobeSet::all(), rm::ShadeMode::Scatter,
                                          nullptr, &material);
    const std::vector<rm::LobeSet> wanted(n, rm::LobeSet::all());
    const auto size = std::size_t(n);
    const std::vector<rm::Color3> black(size, rm::Color3(0.0f)), nothing(size, rm::Color3(7.0f));
    const std::vector<float> none(size);
    Answers a{std::vector<rm::Lobe>(size),
              std::vector<rm::Vec3>(size, rm::Vec3(0.0f)),
              black,
              nothing,
              black,
              none,
              none,
              none};
    auto w = host.weights();
    bxdf->generateSample(rm::kAnyLighting, wanted.data(), &host.rng, a.sampled.data(), a.L.data(),
                         w, a.fwd.data(), a.rev.data(), a.compTrans.data());
    for (int i = 0; i < n; ++i) a.total[i] = w.total(i);
    std::vector<rm::LobeSet> evaluated(size);
    std::vector<float> rev(size);
    auto again = host.weights();
    bxdf->evaluateSample(rm::kAnyLighting, wanted.data(), &host.rng, evaluated.data(), a.L.data(),
                         again, a.pdf.data(), rev.data());
    for (int i = 0; i < n; ++i) a.value[i] = again.total(i);
    return a;
}

TEST(PresenceInRenderMan, changes_nothing_of_what_scatters)
{
    constexpr int n = 500;
    const Answers whole = ask_all(Painted{}, n);
    int straight = 0;
    for (const double p : {1.0, 0.3, 0.0})
    {
        const Answers some = ask_all(PartlyPainted{{p}}, n);
        for (int i = 0; i < n; ++i)
        {
            EXPECT_EQ(some.sampled[i].slot(), whole.sampled[i].slot());
            EXPECT_EQ(some.sampled[i].continuation, whole.sampled[i].continuation);
            EXPECT_EQ(some.L[i], whole.L[i]);
            EXPECT_EQ(some.total[i], whole.total[i]);
            EXPECT_EQ(some.value[i], whole.value[i]);
            EXPECT_EQ(some.fwd[i], whole.fwd[i]);
            EXPECT_EQ(some.rev[i], whole.rev[i]);
            EXPECT_EQ(some.pdf[i], whole.pdf[i]);
            EXPECT_EQ(some.compTrans[i], rm::Color3(0.0f)) << "told once, as a lobe";
            straight += some.sampled[i].valid && some.sampled[i].continuation;
        }
    }
    EXPECT_GT(straight, n / 2);
}

// The other half of the rule: light that goes straight on is the continuation lobe's, all of it.
TEST(PresenceInRenderMan, is_not_what_a_transparent_closure_lets_through)
{
    constexpr int n = 20000;
    const Answers a = ask_all(PartlyPainted{{0.5}}, n);
    Imath::V3d straight(0.0);
    for (int i = 0; i < n; ++i)
        if (a.sampled[i].valid && a.sampled[i].continuation)
            straight += Imath::V3d(a.total[i]) / (double(a.fwd[i]) * n);
    const double expected[] = {0.4, 0.2, 0.1};
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(straight[c], expected[c], 0.02 * expected[c] / 0.4);
}

template <class Real>
class PresenceInClarisse : public testing::Test
{};
using Precisions = testing::Types<float, double>;
TYPED_TEST_SUITE(PresenceInClarisse, Precisions);

TYPED_TEST(PresenceInClarisse, is_told_beside_the_lobes_and_changes_none)
{
    using Real = TypeParam;
    const auto whole = cl::closure_callbacks<Painted, Real>();
    const auto partly = cl::closure_callbacks<PartlyPainted, Real>();
    EXPECT_EQ(whole.opacity, nullptr) << "the transparent closure is a lobe, and no opacity";
    ASSERT_NE(partly.opacity, nullptr);

    cl::shading_point<Real> point;
    point.ng = point.ns = cl::vec3<Real>(0, 0, 1);
    point.tangent = cl::vec3<Real>(1, 0, 0);
    point.view = direction<Real>(0.6, 1);
    alignas(64) char memory[2][8192];
    const Painted painted;
    for (const double p : {1.0, 0.3, 0.0})
    {
        const PartlyPainted some{{p}};
        EXPECT_EQ(partly.opacity(&some, point), cl::color<Real>(Real(p)));
        cl::scratchpad pads[] = {{memory[0], sizeof memory[0]}, {memory[1], sizeof memory[1]}};
        cl::lobe_list<Real> a, b;
        ASSERT_TRUE(whole.create_lobes(&painted, point, pads[0], a));
        ASSERT_TRUE(partly.create_lobes(&some, point, pads[1], b));
        ASSERT_EQ(a.size(), 2);
        ASSERT_EQ(b.size(), 2);
        EXPECT_EQ(b[1].lobe->label().sc, cl::scatter::straight);
        for (int k = 0; k < 2; ++k)
        {
            EXPECT_EQ(a[k].weight, b[k].weight);
            EXPECT_EQ(a[k].lobe->albedo(point.view), b[k].lobe->albedo(point.view));
            cl::vec3<Real> wo_a, wo_b;
            cl::color<Real> w_a, w_b;
            EXPECT_EQ(a[k].lobe->sample(point.view, Real(0.2), Real(0.7), Real(0.5), wo_a, w_a, 0),
                      b[k].lobe->sample(point.view, Real(0.2), Real(0.7), Real(0.5), wo_b, w_b, 0));
            EXPECT_EQ(wo_a, wo_b);
            EXPECT_EQ(w_a, w_b);
        }
        EXPECT_NEAR(b[1].weight.y * b[1].lobe->albedo(point.view).y, 0.2, 1e-6);
    }
}

}  // namespace
