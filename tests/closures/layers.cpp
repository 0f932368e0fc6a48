// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The combinators: layer, mix, multiply, and what is under what in a furnace.

#include "../support/closures.h"
#include "../support/hostile_run.h"
#include "../support/properties.h"

#include <regain/closures/dielectric_gain.h>
#include <regain/closures/dielectric_tail.h>
#include <regain/closures/ggx.h>
#include <regain/closures/host_queries.h>
#include <regain/closures/layer.h>
#include <regain/closures/method_gain.h>
#include <regain/closures/microfacet_reflection.h>
#include <regain/closures/oren_nayar_diffuse.h>
#include <regain/closures/schlick_fresnel.h>
#include <regain/closures/translucent.h>
#include <regain/closures/zeltner_sheen.h>
#include <regain/luts/library.h>

#include <gtest/gtest.h>

using namespace regain;
using namespace regain::tests;

namespace {

const double pi = std::acos(-1.0);
constexpr double alphas[] = {0.01, 0.1, 0.3, 0.6, 1};
constexpr double cosines[] = {0.02, 0.1, 0.3, 0.6, 1};

const Color3<double> white(1.0);

OrenNayarDiffuse<double> chalk(double roughness = 0.5)
{
    return OrenNayarDiffuse<double>(white, roughness);
}

// MaterialX's coat: the reflection of an interface alone, compensated.
auto coat(double alpha, double eta = 1.5)
{
    static const MicrofacetTables mirror = luts::microfacet_tables("ggx");
    static const DielectricTables tables =
        luts::dielectric_tables("ggx", TransmissionShadowing::correlated);
    const Dielectric<GGX<double>> lobe(GGX<double>(alpha, alpha), eta, ScatterMode::R);
    return compensated(lobe, Method::turquin, tables, mirror);
}

auto metal(double alpha, const Color3<double>& F0)
{
    static const MicrofacetTables tables = luts::microfacet_tables("ggx");
    const MicrofacetReflection<GGX<double>, SchlickFresnel<double>> lobe(
        GGX<double>(alpha, alpha), SchlickFresnel<double>(F0));
    return compensated(lobe, Method::turquin, tables);
}

// Mean weight of n samples: nothing of it comes from albedo() but how often lobes are picked.
template <class Closure>
Color3<double> by_samples(const Closure& closure, double mu, int n = 40000)
{
    return sample_statistics(closure.prepare(direction<double>(mu, 0.3)), n).mean;
}

TEST(Layers, a_white_base_under_a_coat_disappears_in_a_furnace)
{
    for (const double alpha : alphas)
        for (const double mu : cosines)
        {
            const auto plastic = layer(coat(alpha), chalk());
            EXPECT_NEAR(by_samples(plastic, mu).x, 1, 5e-3) << alpha << " " << mu;
            EXPECT_NEAR(plastic.albedo(direction<double>(mu)).reflect.x, 1, 3e-3);
        }
}

TEST(Layers, a_coat_that_is_not_compensated_gives_its_loss_to_the_base)
{
    const Dielectric<GGX<double>> bare(GGX<double>(0.8, 0.8), 1.5, ScatterMode::R);
    for (const double mu : cosines)
        EXPECT_NEAR(by_samples(layer(bare, chalk()), mu).x, 1, 5e-3) << mu;
}

TEST(Layers, cloth_over_chalk_disappears_too)
{
    for (const double roughness : {0.1, 0.4, 1.0})
        for (const double mu : cosines)
        {
            const auto velvet = layer(ZeltnerSheen<double>(white, roughness), chalk());
            EXPECT_NEAR(by_samples(velvet, mu).x, 1, 5e-3) << roughness << " " << mu;
        }
}

TEST(Layers, three_layers_disappear_as_well)
{
    for (const double mu : cosines)
    {
        const auto top = coat(0.3, 1.6);
        const auto all = layer(top, layer(metal(0.5, Color3<double>(0.4, 0.4, 0.4)), chalk()));
        EXPECT_NEAR(by_samples(all, mu).x, 1, 5e-3) << mu;
    }
}

TEST(Layers, each_channel_passes_what_its_own_top_leaves)
{
    const Color3<double> F0(0.9, 0.4, 0.1);
    const auto top = metal(0.4, F0);
    const auto both = layer(top, chalk());
    const auto wo = direction<double>(0.5), wi = direction<double>(0.8, 2.0);
    const auto E = top.albedo(wo).reflect;
    const auto value = both.eval(wo, wi), of_top = top.eval(wo, wi), of_base = chalk().eval(wo, wi);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c], of_top[c] + (1 - E[c]) * of_base[c], 1e-12);
    EXPECT_GT(E.x, E.z + 0.3);
}

TEST(Layers, a_base_under_whole_glass_is_not_seen)
{
    const DielectricTables tables =
        luts::dielectric_tables("ggx", TransmissionShadowing::correlated);
    const Dielectric<GGX<double>> lobe(GGX<double>(0.3, 0.3), 1.5);
    const auto glass = compensated(lobe, Method::turquin, tables);
    const auto wo = direction<double>(0.5), wi = direction<double>(0.7, 2.0);
    EXPECT_LT((layer(glass, chalk()).eval(wo, wi) - glass.eval(wo, wi)).x, 5e-3);
}

TEST(Layers, a_mix_is_between_its_parts)
{
    const auto a = chalk(0.2);
    const auto b = metal(0.5, Color3<double>(0.9, 0.6, 0.3));
    const auto wo = direction<double>(0.6), wi = direction<double>(0.7, 2.5);
    for (const double m : {0.0, 0.25, 1.0})
    {
        const auto mixed = mix(a, b, m);
        const auto value = mixed.eval(wo, wi), of_a = a.eval(wo, wi), of_b = b.eval(wo, wi);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c], m * of_a[c] + (1 - m) * of_b[c], 1e-12);
    }
    // What has no weight is not asked for samples.
    EXPECT_EQ(mix(a, b, 0.0).prepare(wo).first_probability(), 0);
    EXPECT_EQ(mix(a, b, 1.0).prepare(wo).first_probability(), 1);
    EXPECT_EQ(mix(a, b, std::nan("")).prepare(wo).first_probability(), 0);
}

TEST(Layers, weight_is_eval_over_pdf_and_pdfs_are_of_the_samples)
{
    expect_weight_is_eval_over_pdf(layer(coat(0.3), chalk()), 1e-9);
    expect_weight_is_eval_over_pdf(mix(chalk(), metal(0.5, white), 0.3), 1e-9);
    expect_weight_is_eval_over_pdf(multiply(chalk(), Color3<double>(0.5, 2.0, 0.1)), 1e-12);
}

TEST(Layers, a_weight_is_a_gain)
{
    const auto half = multiply(chalk(), 0.5);
    const auto wo = direction<double>(0.6), wi = direction<double>(0.7, 2.5);
    EXPECT_EQ(half.pdf(wo, wi), chalk().pdf(wo, wi));
    EXPECT_EQ(half.eval(wo, wi), chalk().eval(wo, wi) * 0.5);
    EXPECT_TRUE(half.traits().reciprocal);
    EXPECT_FALSE(layer(coat(0.3), chalk()).traits().reciprocal);
    EXPECT_EQ(multiply(chalk(), -1.0).eval(wo, wi), Color3<double>(0.0));
}

// Of a path from the light f*(wo, wi) has to be what the eye's path has for f(wi, wo): gains and
// layers, whatever is inside what.
TEST(Layers, a_path_from_the_light_sees_what_the_eye_sees)
{
    const auto closure =
        mix(layer(coat(0.4), multiply(layer(metal(0.5, Color3<double>(0.5)), chalk()), 0.7)),
            chalk(0.9), 0.6);
    const auto turned = for_light_path(closure);
    Random random(5);
    double largest = 0;
    for (int i = 0; i < 50; ++i)
    {
        const auto wo = direction<double>(0.05 + 0.95 * random.unit(), 7 * random.unit()),
                   wi = direction<double>(0.05 + 0.95 * random.unit(), 7 * random.unit());
        const auto seen = closure.eval(wi, wo) * (1 / wo.z),
                   told = turned.eval(wo, wi) * (1 / wi.z);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(told[c], seen[c], 1e-9 * seen[c]);
        largest = std::max(largest, std::abs(closure.eval(wo, wi).x / wi.z / seen.x - 1));
    }
    // Without turning it, it would have been wrong by this much.
    EXPECT_GT(largest, 0.1);
}

TEST(Layers, paper_lets_light_through_on_either_side)
{
    const auto paper = mix(Translucent<double>(white), chalk(), 0.3);
    const auto a = paper.albedo(direction<double>(0.5));
    EXPECT_NEAR(a.reflect.x, 0.7, 1e-12);
    EXPECT_NEAR(a.transmit.x, 0.3, 1e-12);
    EXPECT_TRUE(paper.traits().transmissive);
    EXPECT_EQ(relative_index(paper), 1);
}

template <class Real>
void run_hostile(long calls)
{
    expect_sane_answers<Real>(290, calls, [](auto& hostile, [[maybe_unused]] long i) {
        const OrenNayarDiffuse<Real> base(hostile.color(), hostile.parameter());
        const ZeltnerSheen<Real> top(hostile.color(), hostile.parameter());
        return mix(layer(top, multiply(base, hostile.color())), base, hostile.parameter());
    });
}

TEST(Layers, stay_finite_whatever_comes_in)
{
    run_hostile<float>(60000);
    run_hostile<double>(30000);
}

}  // namespace
