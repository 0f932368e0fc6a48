// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// A gain is a closure weight: it scales what is returned and touches neither directions nor pdfs.

#include "../support/closures.h"

#include <gtest/gtest.h>

#include <cstring>

using namespace regain;
using namespace regain::tests;

namespace {

template <class T>
bool same_bits(const T& a, const T& b)
{
    return std::memcmp(&a, &b, sizeof(T)) == 0;
}

// A hook as a renderer would write it.
struct Halve
{
    Color3<float> at(const Vec3<float>&) const { return Color3<float>(0.5f); }
};

// One that depends on both directions.
struct Symmetric
{
    static constexpr bool depends_on_wi = true;
    static constexpr bool reciprocal = true;
    Color3<float> at(const Vec3<float>& wo) const { return Color3<float>(1 + wo.z); }
    Color3<float> pair(const Vec3<float>&, const Vec3<float>& wi) const
    {
        return Color3<float>(1 + wi.z);
    }
};

class GainHook : public testing::Test
{
protected:
    template <class Check>
    void for_many_calls(const Check& check)
    {
        Random random(5);
        for (double alpha : {0.0, 1e-3, 0.2, 1.0})
            for (int i = 0; i < 2000; ++i)
            {
                const auto lobe = artists_gold<float>(alpha, 0.7 * alpha);
                const auto wo = direction<float>(random.unit(), 6 * random.unit());
                const auto wi = direction<float>(random.unit(), 6 * random.unit());
                check(lobe, wo, wi, random.square<float>());
            }
    }
};

TEST_F(GainHook, identity_is_bit_equal_to_none)
{
    for_many_calls([](const auto& lobe, const auto& wo, const auto& wi, const auto& u) {
        const auto none = compensated(lobe, Method::none, luts::ggx_tables()).prepare(wo);
        const auto identity = compensated(lobe, IdentityGain<float>()).prepare(wo);
        const auto bare = lobe.prepare(wo);
        EXPECT_TRUE(same_bits(identity.eval(wi), none.eval(wi)));
        EXPECT_TRUE(same_bits(identity.eval(wi), bare.eval(wi)));
        EXPECT_TRUE(same_bits(identity.pdf(wi), none.pdf(wi)));
        const auto a = identity.sample(u), b = none.sample(u), c = bare.sample(u);
        EXPECT_TRUE(same_bits(a.wi, b.wi) && same_bits(a.wi, c.wi));
        EXPECT_TRUE(same_bits(a.weight, b.weight) && same_bits(a.weight, c.weight));
        EXPECT_TRUE(same_bits(a.pdf, b.pdf) && same_bits(a.pdf, c.pdf));
    });
}

TEST_F(GainHook, no_method_changes_a_direction_or_a_pdf)
{
    for_many_calls([](const auto& lobe, const auto& wo, const auto& wi, const auto& u) {
        const auto bare = lobe.prepare(wo);
        const auto expected = bare.sample(u);
        for (Method method : all_methods)
        {
            const auto closure = compensated(lobe, method, luts::ggx_tables()).prepare(wo);
            const auto s = closure.sample(u);
            EXPECT_TRUE(same_bits(s.wi, expected.wi));
            EXPECT_TRUE(same_bits(s.pdf, expected.pdf));
            EXPECT_EQ(s.valid, expected.valid);
            EXPECT_TRUE(same_bits(closure.pdf(wi), bare.pdf(wi)));
        }
    });
}

TEST_F(GainHook, a_users_gain_scales_everything_but_directions_and_pdfs)
{
    for_many_calls([](const auto& lobe, const auto& wo, const auto& wi, const auto& u) {
        const auto bare = lobe.prepare(wo), half = bare;
        const auto closure = compensated(lobe, Halve()).prepare(wo);
        EXPECT_EQ(closure.eval(wi), bare.eval(wi) * 0.5f);
        const auto a = closure.sample(u), b = half.sample(u);
        EXPECT_EQ(a.weight, b.weight * 0.5f);
        EXPECT_TRUE(same_bits(a.wi, b.wi) && same_bits(a.pdf, b.pdf));
    });
}

TEST_F(GainHook, a_gain_of_both_directions_enters_eval_sample_and_albedo)
{
    const auto lobe = artists_gold<float>(0.5, 0.5);
    const auto closure = compensated(lobe, Symmetric());
    EXPECT_TRUE(closure.traits().reciprocal);
    const auto wo = direction<float>(0.6), wi = direction<float>(0.3, 1.0);
    EXPECT_NEAR(closure.eval(wo, wi).x, lobe.eval(wo, wi).x * 1.6f * 1.3f, 1e-5f);
    EXPECT_EQ(closure.pdf(wo, wi), lobe.pdf(wo, wi));
    const auto s = closure.sample(wo, {0.2f, 0.7f}), t = lobe.sample(wo, {0.2f, 0.7f});
    EXPECT_NEAR(s.weight.x, t.weight.x * 1.6f * (1 + t.wi.z), 1e-5f);
    Color3<double> sum(0.0);
    constexpr int n = 200;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
            sum += Color3<double>(closure.sample(wo, {(i + 0.5f) / n, (j + 0.5f) / n}).weight) /
                   (n * n);
    EXPECT_NEAR(closure.albedo(wo).reflect.x, sum.x, 5e-3);
}

// Turned round, the pair of directions is what the eye's path would see.
TEST_F(GainHook, reversed_closures_swap_the_ends)
{
    for_many_calls([](const auto& lobe, const auto& wo, const auto& wi, const auto& u) {
        const auto closure = compensated(lobe, Method::turquin, luts::ggx_tables());
        const auto turned = reversed(closure);
        const auto there = turned.eval(wo, wi) * wo.z, back = closure.eval(wi, wo) * wi.z;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(there[c], back[c], 2e-4f * (1 + back[c]));
        EXPECT_TRUE(same_bits(turned.sample(wo, u).wi, closure.sample(wo, u).wi));
        EXPECT_TRUE(same_bits(turned.pdf(wo, wi), closure.pdf(wo, wi)));
    });
}

// Without the tables that a method needs the gain is 1, and the closure does not claim otherwise.
TEST_F(GainHook, without_tables_the_gain_is_one_and_the_traits_say_so)
{
    const auto wo = direction<float>(0.5), wi = direction<float>(0.4, 2.0);
    for (Method method : all_methods)
    {
        const auto lobe = artists_gold<float>(0.8, 0.8);
        const auto closure = compensated(lobe, method, MicrofacetTables());
        EXPECT_FALSE(closure.traits().energy_preserving);
        EXPECT_EQ(closure.eval(wo, wi), lobe.eval(wo, wi)) << name(method);
        EXPECT_EQ(closure.gain().at(wo), Color3<float>(1.0f));
    }
    MicrofacetTables no_average = luts::ggx_tables();
    no_average.E_avg = TableView();
    const auto lobe = artists_gold<float>(0.8, 0.8);
    EXPECT_FALSE(compensated(lobe, Method::series, no_average).traits().energy_preserving);
    EXPECT_TRUE(compensated(lobe, Method::turquin, no_average).traits().energy_preserving);
}

// F_ms by its definition, for gold at alpha 1: E_avg = 0.40914 and E_ss(mu = 1) = 1 - ln 2.
TEST_F(GainHook, methods_follow_their_equations)
{
    const auto lobe = artists_gold<double>(1, 1);
    const double E = 1 - std::log(2.0), E_avg = 0.40914, k = (1 - E) / E;
    const Color3<double> F0 = lobe.fresnel().normal_incidence(), F = lobe.fresnel().average();
    const auto gain = [&](Method m) {
        return compensated(lobe, m, luts::ggx_tables()).gain().at(direction<double>(1));
    };
    for (int c = 0; c < 3; ++c)
    {
        const double tolerance = 7e-4 / E * 1.2;
        EXPECT_EQ(gain(Method::none)[c], 1);
        EXPECT_NEAR(gain(Method::normalise)[c], 1 + k, tolerance);
        EXPECT_NEAR(gain(Method::turquin)[c], 1 + F0[c] * k, tolerance);
        EXPECT_NEAR(gain(Method::turquin_eq12)[c], 1 + E_avg / (1 - F[c] * (1 - E_avg)) * k,
                    tolerance);
        EXPECT_NEAR(gain(Method::turquin_eq13)[c], 1 + F[c] * k, tolerance) << "alpha is 1";
        EXPECT_NEAR(gain(Method::turquin_eq14)[c], 1 + F[c] * k, tolerance);
        EXPECT_NEAR(gain(Method::series)[c], 1 + F[c] * E_avg / (1 - F[c] * (1 - E_avg)) * k,
                    tolerance);
    }
    const auto half = artists_gold<double>(0.5, 0.5);
    const double E_half = luts::builtin_table("ggx_E_ss").at(1.0, std::sqrt(0.5));
    EXPECT_NEAR(compensated(half, Method::turquin_eq13, luts::ggx_tables()).gain().at({0, 0, 1}).z,
                1 + std::pow(F.z, std::pow(0.5, 1.5)) * (1 - E_half) / E_half, 1e-12);
}

TEST_F(GainHook, names_and_methods_match)
{
    for (Method method : all_methods) EXPECT_EQ(method_named(name(method)), method);
    EXPECT_FALSE(method_named("turkin"));
}

}  // namespace
