// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Two closures added answer as one.

#include "../support/closures.h"
#include "../support/properties.h"
#include "../support/reflection_integral.h"

#include <regain/closures/diffuse.h>
#include <regain/closures/sum.h>

#include <gtest/gtest.h>

using namespace regain;
using namespace regain::tests;

namespace {

template <class Real>
auto metal_and_paint(double alpha)
{
    auto metal = artists_gold<Real>(alpha, alpha);
    metal.set_tables(luts::ggx_tables());
    return sum(metal, Diffuse<Real>(Color3<Real>(Real(0.1), Real(0.3), Real(0.5))));
}

TEST(Sum, answers_the_sum)
{
    Random random(31);
    const auto closure = metal_and_paint<double>(0.4);
    for (int i = 0; i < 200; ++i)
    {
        const auto wo = direction<double>(random.unit(), 7 * random.unit());
        const auto wi = direction<double>(random.unit(), 7 * random.unit());
        EXPECT_EQ(closure.eval(wo, wi),
                  closure.first().eval(wo, wi) + closure.second().eval(wo, wi));
        EXPECT_EQ(closure.albedo(wo).reflect,
                  closure.first().albedo(wo).reflect + closure.second().albedo(wo).reflect);
    }
}

TEST(Sum, weight_is_eval_over_pdf)
{
    for (double alpha : {0.01, 0.2, 1.0})
    {
        expect_weight_is_eval_over_pdf(metal_and_paint<float>(alpha), 1e-6);
        expect_weight_is_eval_over_pdf(metal_and_paint<double>(alpha), 1e-14);
    }
}

TEST(Sum, samples_on_average_the_albedo_and_integrates_to_one)
{
    for (double alpha : {0.1, 0.5, 1.0})
        for (double mu : {0.1, 0.6, 1.0})
        {
            const auto wo = direction<double>(mu);
            const auto prepared = metal_and_paint<double>(alpha).prepare(wo);
            const auto s = sample_statistics(prepared, 100000);
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(s.mean[c], prepared.albedo().reflect[c], 3e-3);
            const double pdf = integrate_reflections(
                wo, alpha, alpha, 96, [&](const auto& wi) { return prepared.pdf(wi); });
            EXPECT_NEAR(pdf + s.nothing, 1, 2e-3) << "alpha " << alpha << ", mu " << mu;
        }
}

// The mirror keeps its delta samples, the paint its share of the rest.
TEST(Sum, a_delta_lobe_keeps_its_samples_to_itself)
{
    const auto closure = metal_and_paint<double>(0);
    EXPECT_TRUE(closure.traits().delta);
    const auto prepared = closure.prepare(direction<double>(0.5));
    const double p = prepared.first_probability();
    EvenCube cube;
    Color3<double> delta(0.0), rest(0.0);
    constexpr int n = 20000;
    for (int i = 0; i < n; ++i)
    {
        const auto s = prepared.sample(cube.next());
        ASSERT_TRUE(s.valid);
        (s.delta ? delta : rest) += s.weight * (1.0 / n);
        EXPECT_NEAR(s.pdf, s.delta ? p : prepared.pdf(s.wi), 1e-15);
    }
    for (int c = 0; c < 3; ++c)
    {
        EXPECT_NEAR(delta[c], prepared.first().albedo().reflect[c], 2e-3);
        EXPECT_NEAR(rest[c], prepared.second().albedo().reflect[c], 2e-3);
    }
}

TEST(Sum, promises_what_both_promise)
{
    const auto rough = metal_and_paint<double>(0.3).traits();
    EXPECT_TRUE(rough.reciprocal && rough.exact_pdf);
    EXPECT_FALSE(rough.delta || rough.energy_preserving || rough.transmissive);
    const auto turquin = sum(compensated(white<double>(1, 1), Method::turquin, luts::ggx_tables()),
                             Diffuse<double>(Color3<double>(0.1)));
    EXPECT_FALSE(turquin.traits().reciprocal);
    EXPECT_EQ(rough.random_numbers, 3);
}

// A number that chooses must not come back to the lobe in part: u.z is stretched.
TEST(Sum, sums_can_be_nested)
{
    const auto inner = metal_and_paint<double>(0.3);
    const auto nested = sum(inner, Diffuse<double>(Color3<double>(0.2)));
    const auto prepared = nested.prepare(direction<double>(0.4));
    const auto s = sample_statistics(prepared, 100000);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(s.mean[c], prepared.albedo().reflect[c], 3e-3);
    expect_weight_is_eval_over_pdf(nested, 1e-14);
}

TEST(Sum, a_vector_of_floats_answers_as_a_float_does)
{
    expect_batch_answers_as_float([](const auto& alpha) {
        using Real = std::decay_t<decltype(alpha)>;
        GeneralizedSchlick<Real> metal{
            GGX<Real>(alpha),
            SchlickFresnel<Real>(Color3<Real>(Real(0.94f), Real(0.77f), Real(0.37f)))};
        metal.set_tables(luts::ggx_tables());
        return sum(metal, Diffuse<Real>(Color3<Real>(Real(0.1f), Real(0.3f), Real(0.5f))));
    });
}

}  // namespace
