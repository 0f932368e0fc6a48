// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The same light by paths from the eye and by paths from the light. Two rough surfaces hand it on
// to each other; what is measured is
//
//   I = int int int W(w2) cos2 f_B(w2, w1) cos1 f_A(w1, w0) cos0 L(w0) dw0 dw1 dw2
//
// W and L being uneven over the hemisphere, and f(wo, wi) what a path from the eye sees. That is an
// estimate from the eye: w2 at random, w1 by B's sampler, w0 by A's. From the light w0 comes first,
// then w1 by A's sampler and w2 by B's, with the values f*(wo, wi) = f(wi, wo). A gain of one
// direction that forgets to change ends gets I wrong.

#include "../support/closures.h"
#include "../support/properties.h"

#include <regain/closures/balanced_gain.h>
#include <regain/closures/directional_gain.h>
#include <regain/closures/fitted_tail.h>
#include <regain/closures/ggx.h>
#include <regain/closures/host_queries.h>
#include <regain/closures/kulla_conty.h>
#include <regain/closures/layer.h>
#include <regain/closures/microfacet_reflection.h>
#include <regain/closures/oren_nayar_diffuse.h>
#include <regain/closures/schlick_fresnel.h>
#include <regain/luts/library.h>

#include <gtest/gtest.h>

using namespace regain;
using namespace regain::tests;

namespace {

struct Estimate
{
    double mean = 0, error = 0;
};

double emitted(const Vec3<double>& w) { return 0.05 + std::pow(1 - w.z, 4); }
double wanted(const Vec3<double>& w) { return std::pow(w.z, 6); }

// Of first(w) second(w'') over two samples, w by the cosine.
template <class Near, class Far, class First, class Second>
Estimate traced(const Near& near, const Far& far, const First& first, const Second& second)
{
    constexpr int sets = 32, samples = 4096;
    const double pi = std::acos(-1.0);
    double sum = 0, squares = 0;
    Random random(71);
    for (int set = 0; set < sets; ++set)
    {
        double mean = 0;
        for (int i = 0; i < samples; ++i)
        {
            const auto start =
                direction<double>(std::sqrt(1 - random.unit()), 2 * pi * random.unit());
            const auto numbers = [&] {
                const double x = random.unit(), y = random.unit();
                return Vec3<double>(x, y, random.unit());
            };
            const auto a = near.sample(start, numbers());
            if (!a.valid) continue;
            const auto b = far.sample(a.wi, numbers());
            if (!b.valid) continue;
            mean += pi * first(start) * a.weight.y * b.weight.y * second(b.wi) / samples;
        }
        sum += mean / sets;
        squares += mean * mean / sets;
    }
    return {sum, std::sqrt((squares - sum * sum) / (sets - 1))};
}

template <class A, class B>
Estimate from_eye(const A& a, const B& b)
{
    return traced(b, a, wanted, emitted);
}
template <class A, class B>
Estimate from_light(const A& a, const B& b)
{
    return traced(a, b, emitted, wanted);
}

double difference(const Estimate& a, const Estimate& b)
{
    return std::abs(a.mean - b.mean) / std::sqrt(a.error * a.error + b.error * b.error);
}

MicrofacetReflection<GGX<double>, SchlickFresnel<double>> lobe(double alpha)
{
    return {GGX<double>(alpha, alpha), SchlickFresnel<double>(Color3<double>(0.9))};
}

const MicrofacetTables& tables()
{
    static const MicrofacetTables all = [] {
        MicrofacetTables t = luts::microfacet_tables("ggx");
        luts::add_later_bounces(t, "ggx");
        luts::add_balance(t, "ggx");
        luts::add_later_shape(t, "ggx");
        return t;
    }();
    return all;
}

// With the gain at the eye's end both agree; at the other one they are far apart.
template <class A, class B>
void expect_right_end_matters(const A& a, const B& b, double least)
{
    const Estimate eye = from_eye(a, b), right = from_light(for_light_path(a), for_light_path(b)),
                   wrong = from_light(a, b);
    EXPECT_LT(eye.error, 0.01 * eye.mean);
    EXPECT_LT(difference(eye, right), 3.5) << eye.mean << " and " << right.mean;
    EXPECT_GT(std::abs(wrong.mean / eye.mean - 1), least) << wrong.mean << " for " << eye.mean;
}

TEST(LightTracing, a_gain_of_one_direction_belongs_to_the_eye_s_end)
{
    expect_right_end_matters(compensated(lobe(0.9), Method::turquin, tables()),
                             compensated(lobe(0.6), Method::turquin, tables()), 0.1);
    expect_right_end_matters(directional(lobe(0.9), tables()), directional(lobe(0.6), tables()),
                             0.1);
}

TEST(LightTracing, so_does_what_a_layer_leaves)
{
    const OrenNayarDiffuse<double> base(Color3<double>(0.8), 0.5);
    const auto top =
        compensated(MicrofacetReflection<GGX<double>, SchlickFresnel<double>>(
                        GGX<double>(0.3, 0.3), SchlickFresnel<double>(Color3<double>(0.04))),
                    Method::turquin, tables());
    expect_right_end_matters(layer(top, base), layer(top, base), 0.03);
}

// Nothing has to be turned where the closure is reciprocal.
template <class A, class B>
void expect_either_end(const A& a, const B& b)
{
    ASSERT_TRUE(a.traits().reciprocal && b.traits().reciprocal);
    const Estimate eye = from_eye(a, b), light = from_light(a, b);
    EXPECT_LT(eye.error, 0.02 * eye.mean);
    EXPECT_LT(difference(eye, light), 3.5) << eye.mean << " and " << light.mean;
}

TEST(LightTracing, reciprocal_methods_need_no_care)
{
    expect_either_end(lobe(0.9), lobe(0.6));
    expect_either_end(balanced(lobe(0.9), tables()), balanced(lobe(0.6), tables()));
    expect_either_end(kulla_conty(lobe(0.9), KullaContyForm::series, tables()),
                      kulla_conty(lobe(0.6), KullaContyForm::series, tables()));
    expect_either_end(fitted_tail(lobe(0.9), tables()), fitted_tail(lobe(0.6), tables()));
}

}  // namespace
