// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The diffuse closures and the cloths: formulas, albedo, sampling, hostile inputs.

#include "../support/closures.h"
#include "../support/hostile_run.h"
#include "../support/properties.h"

#include <regain/closures/burley_diffuse.h>
#include <regain/closures/conty_kulla_sheen.h>
#include <regain/closures/oren_nayar_diffuse.h>
#include <regain/closures/translucent.h>
#include <regain/closures/transparent.h>
#include <regain/closures/zeltner_sheen.h>

#include <gtest/gtest.h>

using namespace regain;
using namespace regain::tests;

namespace {

const double pi = std::acos(-1.0);
constexpr double roughnesses[] = {0, 1e-9, 0.1, 0.3, 0.7, 1};
constexpr double cosines[] = {1e-6, 0.01, 0.1, 0.4, 0.8, 1};

const Color3<double> tint(0.9, 0.5, 0.2);

// visit(closure, name, bound of its albedo's error) for each kind at a roughness.
template <class Real, class Visit>
void each_reflecting(double roughness, const Color3<double>& color, const Visit& visit)
{
    const Color3<Real> c(color);
    const Real r = Real(roughness);
    visit(OrenNayarDiffuse<Real>(c, r), "eon", 2e-5);
    visit(OrenNayarDiffuse<Real>(c, r, false), "oren-nayar", 2e-5);
    visit(BurleyDiffuse<Real>(c, r), "burley", 2e-5);
    visit(ContyKullaSheen<Real>(c, r), "conty-kulla", 1.5e-3);
    visit(ZeltnerSheen<Real>(c, r), "zeltner", 2e-5);
}

// Over the upper hemisphere, nodes gathered at the horizon.
template <class F>
auto integrate(const F& f)
{
    constexpr int n = 200;
    auto sum = f(direction<double>(1, 0)) * 0.0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
        {
            const double x = (i + 0.5) / n, mu = x * x;
            sum += f(direction<double>(mu, 2 * pi * (j + 0.5) / n)) * (2 * x / n * 2 * pi / n);
        }
    return sum;
}

TEST(ClosureSet, albedo_is_the_integral_of_eval)
{
    for (const double r : roughnesses)
        each_reflecting<double>(r, tint, [&](const auto& closure, const char* name, double bound) {
            for (const double mu : cosines)
            {
                const auto prepared = closure.prepare(direction<double>(mu, 0.4));
                const Color3<double> exact =
                    integrate([&](const auto& wi) { return prepared.eval(wi); });
                const Color3<double> found = prepared.albedo().reflect;
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(found[c], exact[c], bound)
                        << name << ", roughness " << r << ", mu " << mu;
            }
        });
}

TEST(ClosureSet, pdf_integrates_to_1)
{
    for (const double r : roughnesses)
        each_reflecting<double>(r, tint, [&](const auto& closure, const char* name, double) {
            for (const double mu : cosines)
            {
                // Of the smoothest cloth nearly all is within a degree of the horizon.
                if (mu < 0.01 && r < 0.1) continue;
                const auto prepared = closure.prepare(direction<double>(mu, 0.4));
                EXPECT_NEAR(integrate([&](const auto& wi) { return prepared.pdf(wi); }), 1, 2e-3)
                    << name << ", roughness " << r << ", mu " << mu;
            }
        });
}

TEST(ClosureSet, samples_average_to_the_albedo_with_small_weights)
{
    for (const double r : roughnesses)
        each_reflecting<double>(r, tint, [&](const auto& closure, const char* name, double bound) {
            for (const double mu : cosines)
            {
                const auto prepared = closure.prepare(direction<double>(mu, 0.4));
                const auto s = sample_statistics(prepared, 20000);
                const Color3<double> albedo = prepared.albedo().reflect;
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(s.mean[c], albedo[c], 6e-3 + bound)
                        << name << ", roughness " << r << ", mu " << mu;
                EXPECT_EQ(s.nothing, 0);
                EXPECT_LT(s.largest, 6) << name << ", roughness " << r << ", mu " << mu;
            }
        });
}

TEST(ClosureSet, weight_is_eval_over_pdf)
{
    for (const double r : roughnesses)
    {
        each_reflecting<double>(r, tint, [](const auto& closure, const char*, double) {
            expect_weight_is_eval_over_pdf(closure, 1e-12);
        });
        each_reflecting<float>(r, tint, [](const auto& closure, const char*, double) {
            expect_weight_is_eval_over_pdf(closure, 3e-5);
        });
    }
}

TEST(ClosureSet, is_reciprocal_where_it_says_so)
{
    int reciprocal = 0;
    for (const double r : roughnesses)
        each_reflecting<double>(r, tint, [&](const auto& closure, const char* name, double) {
            const double difference = asymmetry_of_reflection(closure);
            if (closure.traits().reciprocal)
            {
                ++reciprocal;
                EXPECT_LT(difference, 1e-9) << name << ", roughness " << r;
            }
            else
                EXPECT_GT(difference, 1e-3) << name << ", roughness " << r;
        });
    EXPECT_EQ(reciprocal, 6 * 3 + 3);
}

// Its definition: no light is lost, whatever the roughness.
TEST(ClosureSet, a_white_eon_surface_disappears_in_a_furnace)
{
    for (const double r : roughnesses)
        for (const double mu : cosines)
        {
            const OrenNayarDiffuse<double> white(Color3<double>(1.0), r);
            EXPECT_TRUE(white.traits().energy_preserving);
            EXPECT_NEAR(white.albedo(direction<double>(mu)).reflect.x, 1, 1e-12) << r << " " << mu;
        }
}

// The coefficients of Oren and Nayar 1994, Eq. 30, at a standard deviation of 0.5 (28.6 degrees):
// A = 1 - 0.125 / 0.58, B = 0.1125 / 0.34; both directions at 60 degrees on one side: sin alpha tan
// beta = 3/2.
TEST(ClosureSet, the_qualitative_model_has_its_authors_coefficients)
{
    const OrenNayarDiffuse<double> closure(Color3<double>(1.0), 0.5, false);
    const auto w = direction<double>(0.5, 1.0), opposite = direction<double>(0.5, 1.0 + pi);
    const double A = 1 - 0.125 / 0.58, B = 0.1125 / 0.34;
    EXPECT_NEAR(closure.eval(w, w).x, (A + B * 1.5) / pi * 0.5, 1e-12);
    EXPECT_NEAR(closure.eval(w, opposite).x, A / pi * 0.5, 1e-12);
}

// Burley 2012, Section 5.3: along the normal f = rho / pi (1 + 0)(1 + 0); in retro-reflection at
// grazing angles F_D90 squared.
TEST(ClosureSet, burleys_diffuse_has_its_limits)
{
    const auto normal = direction<double>(1), grazing = direction<double>(1e-9, 0.3);
    const BurleyDiffuse<double> closure(Color3<double>(1.0), 0.8);
    EXPECT_NEAR(closure.eval(normal, normal).x, 1 / pi, 1e-12);
    EXPECT_NEAR(closure.eval(grazing, grazing).x / grazing.z, 2.1 * 2.1 / pi, 1e-6);
}

// D of the half-vector at 45 degrees, r = 1/2: (2 + 2) / (2 pi) / 2; wo along the normal, wi on the
// horizon: 4 (1 + 0 - 0).
TEST(ClosureSet, conty_and_kullas_cloth_is_its_formula)
{
    const ContyKullaSheen<double> closure(Color3<double>(1.0), 0.5);
    const auto wo = direction<double>(1), wi = direction<double>(1e-9);
    EXPECT_NEAR(closure.eval(wo, wi).x / wi.z, 1 / pi / 4, 1e-6);
    EXPECT_LE(ContyKullaSheen<double>(Color3<double>(1.0), 0.07)
                  .albedo(direction<double>(1e-6))
                  .reflect.x,
              1);
}

TEST(ClosureSet, the_translucent_closure_is_the_diffuse_one_on_the_other_side)
{
    const Translucent<double> closure(tint);
    const Diffuse<double> diffuse(tint);
    Random random(3);
    for (int i = 0; i < 100; ++i)
    {
        const auto wo = direction<double>(random.unit(), random.unit() * 7),
                   wi = direction<double>(random.unit(), random.unit() * 7);
        const Vec3<double> below(wi.x, wi.y, -wi.z), under(wo.x, wo.y, -wo.z);
        EXPECT_EQ(closure.eval(wo, below), diffuse.eval(wo, wi));
        EXPECT_EQ(closure.eval(under, wi), diffuse.eval(wo, wi));
        EXPECT_EQ(closure.pdf(under, wi), diffuse.pdf(wo, wi));
        EXPECT_EQ(closure.eval(wo, wi), Color3<double>(0.0));
        EXPECT_EQ(closure.eval(under, below), Color3<double>(0.0));
        const auto s =
            closure.sample(under, Vec3<double>(random.unit(), random.unit(), random.unit()));
        EXPECT_TRUE(s.valid && s.transmitted && !s.delta);
        EXPECT_GT(s.wi.z, 0);
        EXPECT_EQ(s.weight, tint);
    }
    EXPECT_EQ(closure.albedo(direction<double>(0.3)).transmit, tint);
    EXPECT_EQ(closure.albedo(direction<double>(0.3)).reflect, Color3<double>(0.0));
}

TEST(ClosureSet, the_transparent_closure_lets_light_go_straight_on)
{
    const Transparent<double> closure(tint);
    for (const double z : {0.3, -0.3})
    {
        auto wo = direction<double>(0.3, 1.0);
        wo.z = z;
        const auto s = closure.sample(wo, Vec3<double>(0.1, 0.2, 0.3));
        EXPECT_TRUE(s.valid && s.transmitted && s.delta);
        EXPECT_LT((s.wi + wo).length(), 1e-15);
        EXPECT_EQ(s.weight, tint);
        EXPECT_EQ(s.pdf, 1);
        EXPECT_EQ(closure.eval(wo, -wo), Color3<double>(0.0));
        EXPECT_EQ(closure.pdf(wo, -wo), 0);
    }
}

TEST(ClosureSet, a_vector_of_floats_answers_as_a_float_does)
{
    expect_batch_answers_as_float([](const auto& weight) {
        using Real = std::decay_t<decltype(weight)>;
        return OrenNayarDiffuse<Real>(Color3<Real>(Real(0.5f), Real(0.2f), Real(0.9f)), weight);
    });
    expect_batch_answers_as_float([](const auto& weight) {
        using Real = std::decay_t<decltype(weight)>;
        return BurleyDiffuse<Real>(Color3<Real>(Real(0.5f), Real(0.2f), Real(0.9f)), weight);
    });
    expect_batch_answers_as_float([](const auto& weight) {
        using Real = std::decay_t<decltype(weight)>;
        return ContyKullaSheen<Real>(Color3<Real>(Real(0.5f), Real(0.2f), Real(0.9f)), weight);
    });
    expect_batch_answers_as_float([](const auto& weight) {
        using Real = std::decay_t<decltype(weight)>;
        return ZeltnerSheen<Real>(Color3<Real>(Real(0.5f), Real(0.2f), Real(0.9f)), weight);
    });
    expect_batch_answers_as_float([](const auto& weight) {
        using Real = std::decay_t<decltype(weight)>;
        return Translucent<Real>(Color3<Real>(weight));
    });
}

template <class Real>
void run_hostile(long calls)
{
    expect_sane_answers<Real>(190, calls, [](auto& hostile, long) {
        return OrenNayarDiffuse<Real>(hostile.color(), hostile.parameter());
    });
    expect_sane_answers<Real>(191, calls, [](auto& hostile, long) {
        return OrenNayarDiffuse<Real>(hostile.color(), hostile.parameter(), false);
    });
    expect_sane_answers<Real>(192, calls, [](auto& hostile, long) {
        return BurleyDiffuse<Real>(hostile.color(), hostile.parameter());
    });
    expect_sane_answers<Real>(193, calls, [](auto& hostile, long) {
        return ContyKullaSheen<Real>(hostile.color(), hostile.parameter());
    });
    expect_sane_answers<Real>(194, calls, [](auto& hostile, long) {
        return ZeltnerSheen<Real>(hostile.color(), hostile.parameter());
    });
    expect_sane_answers<Real>(
        195, calls, [](auto& hostile, long) { return Translucent<Real>(hostile.color()); });
    expect_sane_answers<Real>(
        196, calls, [](auto& hostile, long) { return Transparent<Real>(hostile.color()); });
}

TEST(ClosureSet, stays_finite_whatever_comes_in)
{
    run_hostile<float>(60000);
    run_hostile<double>(30000);
}

}  // namespace
