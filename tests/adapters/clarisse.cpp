// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The Clarisse-like adapter against the contract of its host.h.

#include "../support/hosts.h"

#include <gtest/gtest.h>

using namespace regain;
using namespace regain::clarisse;
using namespace regain::tests;

namespace {

template <class Real>
class ClarisseAdapter : public testing::Test
{
protected:
    using Metal = shaders::SchlickMetal;

    static shading_point<Real> point(const vec3<Real>& view)
    {
        shading_point<Real> p;
        p.ng = p.ns = {0, 0, 1};
        p.tangent = {1, 0, 0};
        p.view = view;
        p.front_facing = view.z > 0;
        return p;
    }

    // One lobe in a fresh scratchpad, or null.
    const bxdf_lobe<Real>* lobe(const Metal& metal, const shading_point<Real>& p)
    {
        pad.reset();
        list = {};
        const auto callbacks = closure_callbacks<Metal, Real>();
        void* data = callbacks.create_module_data(&metal);
        EXPECT_TRUE(callbacks.create_lobes(data, p, pad, list));
        callbacks.destroy_module_data(&metal, data);
        return list.size() ? list[0].lobe : nullptr;
    }

    alignas(64) char memory[4096];
    scratchpad pad{memory, sizeof memory};
    lobe_list<Real> list;
};

using Precisions = testing::Types<float, double>;
TYPED_TEST_SUITE(ClarisseAdapter, Precisions);

TYPED_TEST(ClarisseAdapter, furnace_by_sample_and_by_evaluate)
{
    using Real = TypeParam;
    const auto wi = direction<Real>(0.6);
    for (float alpha : {0.3f, 1.0f})
    {
        const auto metal = white_material(alpha);
        const auto* lobe = this->lobe(metal, this->point(wi));
        ASSERT_TRUE(lobe);
        constexpr int n = 300;
        double sampled = 0, evaluated = 0;
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
            {
                const Real u = Real((i + 0.5) / n), v = Real((j + 0.5) / n);
                vec3<Real> wo;
                color<Real> weight;
                if (lobe->sample(wi, u, v, 0, wo, weight, nullptr) > 0)
                    sampled += weight.x / (n * n);
                wo = direction<Real>(u, 2 * M_PI * v);
                const Real pdf = lobe->evaluate(wi, wo, weight, nullptr);
                evaluated += double(weight.x) * pdf * 2 * M_PI / (n * n);
            }
        EXPECT_NEAR(sampled, 1, 2e-3);
        EXPECT_NEAR(evaluated, 1, 2e-3);
        EXPECT_NEAR(lobe->albedo(wi).x, 1, 1e-3);
    }
}

// P2: the weight is already divided by the pdf, and both calls give the same two numbers.
TYPED_TEST(ClarisseAdapter, sample_and_evaluate_agree)
{
    using Real = TypeParam;
    Random random(12);
    auto metal = gold_material(0.4f);
    metal.alpha_y = 0.15f;
    for (int i = 0; i < 500; ++i)
    {
        const auto wi = direction<Real>(0.02 + 0.98 * random.unit(), 7 * random.unit());
        const auto* lobe = this->lobe(metal, this->point(wi));
        vec3<Real> wo;
        color<Real> a, b;
        Real reverse_a, reverse_b, back;
        const Real u = Real(random.unit()), v = Real(random.unit());
        const Real pdf = lobe->sample(wi, u, v, 0, wo, a, &reverse_a);
        if (pdf == 0) continue;
        EXPECT_NEAR(lobe->evaluate(wi, wo, b, &reverse_b) / pdf, 1, 1e-6);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c] / b[c], 1, 1e-5);
        EXPECT_EQ(reverse_a, reverse_b);
        // The known direction may be another than the one the lobe was made for.
        color<Real> unused;
        EXPECT_NEAR(lobe->evaluate(wo, wi, unused, &back) / reverse_a, 1, 1e-5);
        EXPECT_NEAR(back / pdf, 1, 1e-5);
    }
}

TYPED_TEST(ClarisseAdapter, strength_goes_from_single_scattering_to_all)
{
    using Real = TypeParam;
    const auto wi = direction<Real>(1);
    auto p = this->point(wi);
    const auto metal = white_material(1);
    const double E = 1 - std::log(2.0);
    for (double s : {0.0, 0.5, 1.0})
    {
        p.multiple_scattering_strength = Real(s);
        EXPECT_NEAR(this->lobe(metal, p)->albedo(wi).x, E + s * (1 - E), 1e-3);
    }
}

TYPED_TEST(ClarisseAdapter, singular_lobes_sample_and_do_not_evaluate)
{
    using Real = TypeParam;
    const auto wi = direction<Real>(0.6);
    const auto metal = gold_material(0);
    const auto* lobe = this->lobe(metal, this->point(wi));
    EXPECT_EQ(lobe->label().sc, scatter::singular);
    EXPECT_EQ(lobe->label().category(), singular_reflection);
    EXPECT_EQ(lobe->roughness(), 0);
    vec3<Real> wo;
    color<Real> weight;
    Real reverse;
    EXPECT_EQ(lobe->sample(wi, Real(0.3), Real(0.3), 0, wo, weight, &reverse), 1);
    EXPECT_EQ(reverse, 1);
    EXPECT_TRUE(wo.equalWithAbsError({-wi.x, -wi.y, wi.z}, Real(1e-6)));
    EXPECT_NEAR(weight.x, 0.94, 0.01);
    EXPECT_EQ(lobe->evaluate(wi, wo, weight, &reverse), 0);
    EXPECT_EQ(weight, color<Real>(Real(0)));
}

TYPED_TEST(ClarisseAdapter, labels_decide_whether_a_lobe_is_made)
{
    using Real = TypeParam;
    auto p = this->point(direction<Real>(0.6));
    const auto rough = gold_material(0.3f);
    const auto* lobe = this->lobe(rough, p);
    EXPECT_STREQ(lobe->label().name, "metal");
    EXPECT_EQ(lobe->label().category(), glossy_reflection);
    EXPECT_NEAR(lobe->roughness(), 0.3, 1e-6);
    p.wanted = diffuse_reflection | singular_reflection;
    EXPECT_FALSE(this->lobe(rough, p));
    p.wanted = glossy_reflection;
    EXPECT_TRUE(this->lobe(rough, p));
}

TYPED_TEST(ClarisseAdapter, sides)
{
    using Real = TypeParam;
    const auto metal = gold_material(0.3f);
    auto front = this->point(direction<Real>(0.6)), back = this->point(direction<Real>(-0.6));
    for (auto* p : {&front, &back})
    {
        const bool is_front = p == &front;
        p->sides = sidedness::single_sided;
        EXPECT_EQ(this->lobe(metal, *p) != nullptr, is_front);
        p->sides = sidedness::inverted;
        EXPECT_EQ(this->lobe(metal, *p) != nullptr, !is_front);
        p->sides = sidedness::double_sided;
        ASSERT_TRUE(this->lobe(metal, *p));
        const auto& e = this->list[0];
        EXPECT_GT(e.z.dot(p->view), 0) << "the lobe faces the viewer";
        EXPECT_NEAR(e.x.cross(e.y).dot(e.z), 1, 1e-6) << "right-handed";
    }
}

// The lobe's frame is orthonormal whatever the tangent.
TYPED_TEST(ClarisseAdapter, frames_survive_bad_tangents)
{
    using Real = TypeParam;
    auto p = this->point(direction<Real>(0.6));
    const auto metal = gold_material(0.3f);
    for (const vec3<Real>& t : {vec3<Real>(0, 0, 1), vec3<Real>(0, 0, 0), vec3<Real>(3, 1, 9)})
    {
        p.tangent = t;
        ASSERT_TRUE(this->lobe(metal, p));
        const auto& e = this->list[0];
        EXPECT_NEAR(e.x.length(), 1, 1e-6);
        EXPECT_NEAR(e.x.dot(e.z), 0, 1e-6);
    }
}

TYPED_TEST(ClarisseAdapter, a_full_scratchpad_is_an_answer)
{
    using Real = TypeParam;
    char small[64];
    scratchpad tight(small, sizeof small);
    lobe_list<Real> none;
    const auto metal = gold_material(0.3f);
    const auto callbacks = closure_callbacks<shaders::SchlickMetal, Real>();
    EXPECT_FALSE(callbacks.create_lobes(&metal, this->point(direction<Real>(0.6)), tight, none));
    EXPECT_EQ(none.size(), 0);
}

TYPED_TEST(ClarisseAdapter, light_does_not_leak_through_the_surface)
{
    using Real = TypeParam;
    auto p = this->point(direction<Real>(0.3, 0.1));
    p.ns = direction<Real>(0.5, 0.0);
    const auto metal = gold_material(0.7f);
    const auto* lobe = this->lobe(metal, p);
    const auto& e = this->list[0];
    const vec3<Real> wi(p.view.dot(e.x), p.view.dot(e.y), p.view.dot(e.z));
    Random random(3);
    int declined = 0;
    for (int i = 0; i < 2000; ++i)
    {
        vec3<Real> wo;
        color<Real> weight;
        const Real u = Real(random.unit()), v = Real(random.unit());
        if (lobe->sample(wi, u, v, 0, wo, weight, nullptr) == 0)
        {
            ++declined;
            continue;
        }
        EXPECT_GT((e.x * wo.x + e.y * wo.y + e.z * wo.z).z, 0);
    }
    EXPECT_GT(declined, 50);
}

// Both hosts are told the same about one material, each in its own terms.
TEST(Adapters, say_the_same)
{
    Random random(31);
    shaders::SchlickMetal metal = gold_material(0.6f);
    metal.alpha_y = 0.3f;
    renderman::ClosureFactory<shaders::SchlickMetal> factory;
    alignas(64) char memory[4096];
    for (int i = 0; i < 300; ++i)
    {
        GridHost host(1);
        host.V[0] = direction<float>(random.unit(), 7 * random.unit());
        host.T[0] = direction<float>(0.3, 7 * random.unit());
        const auto L = direction<float>(random.unit(), 7 * random.unit());
        renderman::Bxdf* bxdf = factory.beginScatter(
            &host.ctx, renderman::LobeSet::all(), renderman::ShadeMode::Scatter, nullptr, &metal);
        renderman::LobeWeights w = host.weights();
        const renderman::LobeSet wanted = renderman::LobeSet::all();
        renderman::LobeSet evaluated;
        float fwd, rev;
        bxdf->evaluateSample(renderman::kDirect, &wanted, &host.rng, &evaluated, &L, w, &fwd, &rev);

        shading_point<float> p;
        p.ng = p.ns = {0, 0, 1};
        p.tangent = host.T[0];
        p.view = host.V[0];
        scratchpad pad(memory, sizeof memory);
        lobe_list<float> list;
        ASSERT_TRUE(
            (closure_callbacks<shaders::SchlickMetal, float>().create_lobes(&metal, p, pad, list)));
        const auto& e = list[0];
        const auto local = [&](const Imath::V3f& d) {
            return Imath::V3f(d.dot(e.x), d.dot(e.y), d.dot(e.z));
        };
        color<float> weight;
        float reverse;
        const float pdf = e.lobe->evaluate(local(p.view), local(L), weight, &reverse);
        EXPECT_NEAR(pdf, fwd, 1e-4f * (1 + fwd));
        EXPECT_NEAR(reverse, rev, 1e-4f * (1 + rev));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(weight[c] * pdf, w.total(0)[c], 1e-4f);
    }
}

}  // namespace
