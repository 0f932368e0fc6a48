// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Both adapters on materials of several closures.

#include "../support/hosts.h"

#include <regain/closures/ggx.h>
#include <regain/closures/layer.h>
#include <regain/closures/oren_nayar_diffuse.h>
#include <regain/closures/schlick_fresnel.h>
#include <regain/closures/translucent.h>
#include <regain/closures/transparent.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace regain;
using namespace regain::tests;

namespace {

namespace rm = regain::renderman;
namespace cl = regain::clarisse;

// Velvet: half a metal over rough diffuse, in a mix with nothing else to see through.
// Closure 0 is on closure 1; `amount` of both, the rest is closure 2, translucent.
struct Mixture
{
    float amount = 1;
    float alpha = 0.4f;
    Imath::C3f F0{0.6f, 0.3f, 0.1f};
    bool clear = false;  // the third is transparent, and not translucent

    int lobes() const { return 3; }
    template <class Real, class Visit>
    decltype(auto) with_lobe(int k, Real strength, const Visit& visit) const
    {
        using Color = Color3<Real>;
        if (k == 0) return visit(top(strength));
        if (k == 1) return visit(base<Real>());
        if (clear) return visit(Transparent<Real>(Color(Real(1))));
        return visit(Translucent<Real>(Color(Real(1))));
    }
    template <class Real>
    auto top(Real strength) const
    {
        return shaders::SchlickMetal{F0, Imath::C3f(1.0f), alpha, alpha}.closure(strength);
    }
    template <class Real>
    OrenNayarDiffuse<Real> base() const
    {
        return OrenNayarDiffuse<Real>(Color3<Real>(Real(1)), Real(0.5f));
    }
    template <class Real>
    Color3<Real> lobe_weights(const Color3<Real>* albedo, Color3<Real>* weight) const
    {
        const Real m(amount);
        weight[0] = Color3<Real>(m);
        weight[1] = (Color3<Real>(Real(1)) - albedo[0]) * m;
        weight[2] = Color3<Real>(Real(1) - m);
        return weight[0] * albedo[0] + weight[1] * albedo[1] + weight[2] * albedo[2];
    }
    const char* lobe_name(int k) const
    {
        if (k == 0) return "metal";
        if (k == 1) return "diffuse";
        return clear ? "transparent" : "translucent";
    }

    // The closure that all of it is.
    auto whole() const
    {
        return mix(layer(top(1.0f), base<float>()), Translucent<float>(Color3<float>(1.0f)),
                   amount);
    }
};

struct Answers
{
    explicit Answers(int n) : sampled(n), evaluated(n), L(n), total(n), fwd(n), rev(n) {}
    std::vector<rm::Lobe> sampled;
    std::vector<rm::LobeSet> evaluated;
    std::vector<rm::Vec3> L;
    std::vector<rm::Color3> total;
    std::vector<float> fwd, rev;
    int slots = 0;
};

class Grid
{
public:
    Grid(const Mixture& material, int points)
        : host(points, std::size_t(points) * 4096 + 65536), _material(material), _points(points)
    {}
    rm::Bxdf& bxdf(rm::LobeSet wanted = rm::LobeSet::all())
    {
        host.reset();
        return *_factory.beginScatter(&host.ctx, wanted, rm::ShadeMode::Scatter, nullptr,
                                      &_material);
    }
    Answers generate(const std::vector<rm::LobeSet>& wanted, bool reverse = true)
    {
        Answers a(_points);
        auto w = host.weights();
        bxdf().generateSample(rm::kAnyLighting, wanted.data(), &host.rng, a.sampled.data(),
                              a.L.data(), w, a.fwd.data(), reverse ? a.rev.data() : nullptr,
                              nullptr);
        finish(a, w);
        return a;
    }
    Answers generate(rm::LobeSet wanted = rm::LobeSet::all())
    {
        return generate(std::vector(_points, wanted));
    }
    Answers evaluate(const std::vector<rm::Vec3>& L, rm::LobeSet wanted = rm::LobeSet::all())
    {
        Answers a(_points);
        auto w = host.weights();
        bxdf().evaluateSample(rm::kAnyLighting, std::vector(_points, wanted).data(), &host.rng,
                              a.evaluated.data(), L.data(), w, a.fwd.data(), a.rev.data());
        finish(a, w);
        return a;
    }
    GridHost host;

private:
    void finish(Answers& a, rm::LobeWeights& w) const
    {
        for (int i = 0; i < _points; ++i) a.total[i] = w.total(i);
        a.slots = w.active();
    }
    Mixture _material;
    rm::ClosureFactory<Mixture> _factory;
    int _points;
};

rm::Lobe specular() { return {rm::LobeClass::Specular, rm::kSpecularSlot, true}; }
rm::Lobe diffuse() { return {rm::LobeClass::Diffuse, rm::kDiffuseSlot, true}; }
rm::Lobe translucent() { return {rm::LobeClass::Diffuse, rm::kDiffuseSlot, false}; }

TEST(MixturesInRenderMan, values_are_the_whole_closure_s)
{
    constexpr int n = 200;
    const Mixture material{0.7f};
    Grid grid(material, n);
    Random random(3);
    std::vector<rm::Vec3> L(n);
    for (int i = 0; i < n; ++i)
    {
        grid.host.V[i] = direction<float>(0.05 + 0.95 * random.unit(), 7 * random.unit());
        L[i] = direction<float>(2 * random.unit() - 1, 7 * random.unit());
    }
    const Answers e = grid.evaluate(L);
    for (int i = 0; i < n; ++i)
    {
        const auto f = material.whole().eval(grid.host.V[i], L[i]);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(e.total[i][c], f[c], 1e-5 * (1 + f[c]));
        EXPECT_TRUE(e.evaluated[i].has(L[i].z > 0 ? diffuse() : translucent()));
        EXPECT_EQ(e.evaluated[i].has(specular()), L[i].z > 0);
    }
    EXPECT_EQ(e.slots, 3);
}

// Contract C2 and C3, by both ways of asking, in each channel; where every closure is wanted, and
// where some are.
TEST(MixturesInRenderMan, furnace_of_what_is_wanted)
{
    constexpr int n = 60000;
    const Mixture material{0.7f};
    const auto V = direction<float>(0.5, 1);
    const auto E = material.top(1.0f).albedo(V).reflect;
    rm::LobeSet all = rm::LobeSet::all(), metal_alone(specular()), pair(specular());
    pair |= rm::LobeSet(translucent());
    struct Case
    {
        rm::LobeSet wanted;
        Imath::C3f albedo;
    };
    const Imath::C3f one(1.0f);
    for (const Case& c :
         {Case{all, one}, Case{metal_alone, E * 0.7f}, Case{pair, E * 0.7f + one * 0.3f}})
    {
        Grid grid(material, n);
        std::fill(grid.host.V.begin(), grid.host.V.end(), V);
        const Answers g = grid.generate(c.wanted);
        Random random(5);
        std::vector<rm::Vec3> everywhere(n);
        for (auto& L : everywhere)
            L = direction<float>(2 * random.unit() - 1, 2 * M_PI * random.unit());
        const Answers e = grid.evaluate(everywhere, c.wanted);
        Imath::C3f generated(0.0f), evaluated(0.0f);
        double pdf = 0, valid = 0;
        for (int i = 0; i < n; ++i)
        {
            valid += g.sampled[i].valid;
            if (g.sampled[i].valid) generated += g.total[i] / (g.fwd[i] * n);
            evaluated += e.total[i] * float(4 * M_PI / n);
            pdf += e.fwd[i] * 4 * M_PI / n;
        }
        for (int k = 0; k < 3; ++k)
        {
            EXPECT_NEAR(generated[k], c.albedo[k], 0.015);
            EXPECT_NEAR(evaluated[k], c.albedo[k], 0.03);
        }
        EXPECT_NEAR(pdf, valid / n, 0.03);
    }
    std::vector<rm::Color3> albedo(n);
    Grid grid(material, n);
    std::fill(grid.host.V.begin(), grid.host.V.end(), V);
    ASSERT_TRUE(grid.bxdf().albedo(albedo.data()));
    EXPECT_NEAR(albedo[5].x, 1, 1e-3);
}

TEST(MixturesInRenderMan, generate_and_evaluate_agree_and_reverse_is_forward_from_the_other_side)
{
    constexpr int n = 400;
    Grid grid(Mixture{0.7f}, n);
    Random random(7);
    for (auto& V : grid.host.V) V = direction<float>(2 * random.unit() - 1, 7 * random.unit());
    const Answers g = grid.generate(), e = grid.evaluate(g.L);
    const std::vector<rm::Vec3> V = grid.host.V;
    grid.host.V = g.L;
    grid.host.ctx.Vn = grid.host.V.data();
    const Answers back = grid.evaluate(V);
    for (int i = 0; i < n; ++i)
    {
        if (!g.sampled[i].valid) continue;
        EXPECT_TRUE(e.evaluated[i].has(g.sampled[i]));
        EXPECT_NEAR(g.fwd[i] / e.fwd[i], 1, 1e-3);
        EXPECT_NEAR(g.rev[i] / e.rev[i], 1, 1e-3);
        EXPECT_NEAR(back.fwd[i] / e.rev[i], 1, 1e-3);
        EXPECT_NEAR(back.rev[i] / e.fwd[i], 1, 1e-3);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(g.total[i][c], e.total[i][c], 1e-3 * (e.total[i][c] + 1e-3));
    }
    // Reverse pdfs cost nothing where they are not asked for, and change nothing.
    Grid again(Mixture{0.7f}, n);
    again.host.V = V;
    again.host.ctx.Vn = again.host.V.data();
    const Answers without = again.generate(std::vector(n, rm::LobeSet::all()), false);
    for (int i = 0; i < n; ++i) EXPECT_EQ(without.fwd[i], g.fwd[i]);
}

// Contract C7, with a layer: what is under it is dimmed at the eye's end.
TEST(MixturesInRenderMan, a_light_path_sees_what_an_eye_path_sees)
{
    const auto eye = direction<float>(0.15), light = direction<float>(0.9, 2.5);
    Grid from_eye(Mixture{0.7f}, 1), from_light(Mixture{0.7f}, 1);
    from_eye.host.V[0] = eye;
    from_light.host.V[0] = light;
    from_light.host.ctx.lightPath = true;
    const Answers a = from_eye.evaluate({light}), b = from_light.evaluate({eye});
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a.total[0][c] / light.z, b.total[0][c] / eye.z, 1e-5);
    EXPECT_NEAR(a.fwd[0], b.rev[0], 1e-5 * a.fwd[0]);
    EXPECT_NEAR(a.rev[0], b.fwd[0], 1e-5 * a.rev[0]);
}

TEST(MixturesInRenderMan, at_index_is_evaluate_at_that_point)
{
    constexpr int n = 3, lights = 70;  // more than are asked for at a time
    Grid grid(Mixture{0.6f}, n);
    for (int i = 0; i < n; ++i) grid.host.V[i] = direction<float>(0.2 + 0.3 * i, i);
    Random random(2);
    std::vector<rm::Vec3> L(lights);
    for (auto& w : L) w = direction<float>(2 * random.unit() - 1, 7 * random.unit());
    std::vector<rm::Color3> storage(rm::kMaxActive * lights);
    for (int i = 0; i < n; ++i)
    {
        rm::LobeWeights w(storage.data(), lights);
        std::vector<rm::LobeSet> evaluated(lights);
        std::vector<float> fwd(lights), rev(lights);
        grid.bxdf().evaluateSamplesAtIndex(rm::kDirect, rm::LobeSet::all(), &grid.host.rng, i,
                                           lights, evaluated.data(), L.data(), w, fwd.data(),
                                           rev.data());
        for (int j = 0; j < lights; ++j)
        {
            const Answers one = grid.evaluate(std::vector<rm::Vec3>(n, L[j]));
            EXPECT_EQ(w.total(j), one.total[i]);
            EXPECT_EQ(fwd[j], one.fwd[i]);
            EXPECT_EQ(rev[j], one.rev[i]);
            EXPECT_EQ(evaluated[j].bits, one.evaluated[i].bits);
        }
    }
}

// Of the slots that the host has left, one: the closures without are neither weighed nor sampled.
TEST(MixturesInRenderMan, a_closure_without_a_slot_is_not_sampled)
{
    constexpr int n = 2000;
    Grid grid(Mixture{0.7f}, n);
    std::fill(grid.host.V.begin(), grid.host.V.end(), direction<float>(0.6));
    rm::LobeWeights w = grid.host.weights();
    for (int k = 0; k < rm::kMaxActive - 1; ++k)
        ASSERT_TRUE(w.addActiveLobe(
            k < rm::kMaxUser
                ? rm::Lobe{rm::LobeClass::User, std::uint8_t(k), true}
                : rm::Lobe{rm::LobeClass::Specular, std::uint8_t(k - rm::kMaxUser + 2), true}));
    Answers a(n);
    const std::vector<rm::LobeSet> wanted(n, rm::LobeSet::all());
    grid.bxdf().generateSample(rm::kAnyLighting, wanted.data(), &grid.host.rng, a.sampled.data(),
                               a.L.data(), w, a.fwd.data(), nullptr, nullptr);
    int valid = 0;
    for (int i = 0; i < n; ++i)
    {
        if (!a.sampled[i].valid) continue;
        ++valid;
        EXPECT_EQ(a.sampled[i].slot(), a.sampled[0].slot());
    }
    EXPECT_GT(valid, n / 2);
}

TEST(MixturesInRenderMan, what_lets_light_straight_on_is_a_continuation)
{
    constexpr int n = 4000;
    Mixture material{0.6f};
    material.clear = true;
    Grid grid(material, n);
    const auto V = direction<float>(0.5, 2);
    std::fill(grid.host.V.begin(), grid.host.V.end(), V);
    const Answers g = grid.generate();
    double straight = 0;
    for (int i = 0; i < n; ++i)
    {
        if (!g.sampled[i].valid || !g.sampled[i].continuation) continue;
        EXPECT_TRUE(g.sampled[i].discrete);
        EXPECT_LT((g.L[i] + V).length(), 1e-5f);
        straight += g.total[i].x / g.fwd[i] / n;
        EXPECT_LE(g.fwd[i], 1);
    }
    EXPECT_NEAR(straight, 0.4, 0.04);
    const Answers e = grid.evaluate(std::vector<rm::Vec3>(n, -V));
    EXPECT_FALSE(e.evaluated[0].any());
}

template <class Real>
class MixturesInClarisse : public testing::Test
{};
using Numbers = testing::Types<float, double>;
TYPED_TEST_SUITE(MixturesInClarisse, Numbers);

TYPED_TEST(MixturesInClarisse, entries_add_up_to_the_whole_closure)
{
    using Real = TypeParam;
    const Mixture material{0.7f};
    const auto callbacks = cl::closure_callbacks<Mixture, Real>();
    std::vector<char> memory(1 << 16);
    Random random(4);
    for (int i = 0; i < 50; ++i)
    {
        cl::scratchpad pad(memory.data(), memory.size());
        cl::lobe_list<Real> lobes;
        cl::shading_point<Real> point;
        point.ng = point.ns = cl::vec3<Real>(0, 0, 1);
        point.tangent = cl::vec3<Real>(1, 0, 0);
        point.view = direction<Real>(0.05 + 0.95 * random.unit(), 7 * random.unit());
        ASSERT_TRUE(callbacks.create_lobes(&material, point, pad, lobes));
        ASSERT_EQ(lobes.size(), 3);
        EXPECT_EQ(lobes[0].lobe->label().sc, cl::scatter::glossy);
        EXPECT_EQ(lobes[1].lobe->label().sc, cl::scatter::diffuse);
        const auto wo = direction<Real>(2 * random.unit() - 1, 7 * random.unit());
        cl::color<Real> sum(Real(0)), albedo(Real(0));
        for (int k = 0; k < 3; ++k)
        {
            const auto& e = lobes[k];
            const auto local = [&](const cl::vec3<Real>& w) {
                return cl::vec3<Real>(w.dot(e.x), w.dot(e.y), w.dot(e.z));
            };
            cl::color<Real> weight(Real(0));
            const Real pdf = e.lobe->evaluate(local(point.view), local(wo), weight, nullptr);
            sum += e.weight * weight * pdf;
            albedo += e.weight * e.lobe->albedo(local(point.view));
        }
        const auto f = material.whole().eval(Vec3<float>(point.view), Vec3<float>(wo));
        for (int c = 0; c < 3; ++c)
        {
            EXPECT_NEAR(sum[c], f[c], 1e-5 * (1 + f[c]));
            EXPECT_NEAR(albedo[c], 1, 1e-3);
        }
    }
}

// A filter that leaves the top out does not brighten what is under it.
TYPED_TEST(MixturesInClarisse, what_is_not_wanted_still_casts_its_shadow)
{
    using Real = TypeParam;
    const Mixture material{1.0f};
    const auto callbacks = cl::closure_callbacks<Mixture, Real>();
    std::vector<char> memory(1 << 16);
    cl::shading_point<Real> point;
    point.ng = point.ns = cl::vec3<Real>(0, 0, 1);
    point.tangent = cl::vec3<Real>(1, 0, 0);
    point.view = direction<Real>(0.5, 1);
    Real weight[2];
    for (const bool all : {true, false})
    {
        cl::scratchpad pad(memory.data(), memory.size());
        cl::lobe_list<Real> lobes;
        point.wanted = all ? std::uint32_t(cl::all_lobes) : std::uint32_t(cl::diffuse_reflection);
        ASSERT_TRUE(callbacks.create_lobes(&material, point, pad, lobes));
        for (int k = 0; k < lobes.size(); ++k)
            if (lobes[k].lobe->label().ev == cl::event::reflection &&
                lobes[k].lobe->label().sc == cl::scatter::diffuse)
                weight[all] = lobes[k].weight.x;
    }
    EXPECT_EQ(weight[0], weight[1]);
    EXPECT_LT(weight[0], 0.6);
}

}  // namespace
