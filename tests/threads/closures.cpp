// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Closures and what they prepare are values that any number of threads may read.

#include "together.h"

#include <regain/closures/constant_fresnel.h>
#include <regain/closures/dielectric_tail.h>
#include <regain/closures/directional_gain.h>
#include <regain/closures/gtr.h>
#include <regain/closures/method_gain.h>
#include <regain/closures/microfacet_reflection.h>
#include <regain/closures/random_stream.h>
#include <regain/closures/schlick_fresnel.h>
#include <regain/closures/walk.h>
#include <regain/luts/library.h>

#include <gtest/gtest.h>

using namespace regain;
using regain::tests::together;

namespace {

constexpr int threads = 4;

// Every thread asks the same closure the same questions: all hear the same, bit for bit.
template <class Closure>
void expect_same_answers(const Closure& closure)
{
    const Vec3<float> wo(0.6f, 0, 0.8f);
    const auto prepared = closure.prepare(wo);
    float sum[threads] = {};
    together(threads, [&](int i) {
        const auto mine = closure.prepare(wo);
        RandomStream<float> random(wo);
        for (int k = 0; k < 200; ++k)
        {
            const auto u = random.next3();
            for (const auto* p : {&prepared, &mine})
            {
                const auto s = p->sample(u);
                sum[i] += s.weight.x + s.pdf + p->pdf(s.wi);
            }
        }
        const auto a = mine.albedo();
        sum[i] += a.reflect.x + a.transmit.x;
    });
    for (int i = 1; i < threads; ++i) EXPECT_EQ(sum[i], sum[0]);
    EXPECT_GT(sum[0], 1);
}

TEST(Threads, closures_are_shared)
{
    MicrofacetTables ggx = luts::microfacet_tables("ggx"), gtr = luts::microfacet_tables("gtr");
    luts::add_later_bounces(ggx, "ggx");
    const SchlickFresnel<float> gold(Color3<float>(0.9f, 0.7f, 0.3f), Color3<float>(1.0f),
                                     Color3<float>(1.0f), 5.0f);
    expect_same_answers(directional(MicrofacetReflection(GGX<float>(0.5f), gold, ggx), ggx, 1.0f));
    expect_same_answers(compensated(MicrofacetReflection(GTR<float>(0.5f, 0.5f, 1.3f), gold, gtr),
                                    Method::series, gtr, 1.0f));
    expect_same_answers(Walk(GGX<float>(0.7f), ConstantFresnel<float>(), 1, ggx));

    DielectricTables glass = luts::dielectric_tables("ggx", TransmissionShadowing::beta);
    luts::add_later_split(glass, "ggx");
    const Color3<float> white(1.0f);
    expect_same_answers(fitted_tail(Dielectric(GGX<float>(0.4f), 1.5f, ScatterMode::RT, white,
                                               white, TransmissionShadowing::beta, glass),
                                    glass, 1.0f));
}

}  // namespace
