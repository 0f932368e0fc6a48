// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// A thin sheet: what is reflected between its interfaces, and that nothing is lost.

#include "../support/glass.h"
#include "../support/hostile.h"
#include "../support/reflection_integral.h"

#include <regain/closures/std.h>
#include <regain/closures/thin_dielectric.h>

#include <gtest/gtest.h>

using namespace regain;
using namespace regain::tests;

namespace {

template <class Real>
using Sheet = ThinDielectric<GGX<Real>>;

template <class Real>
Sheet<Real> sheet(double alpha, double eta, ScatterMode mode = ScatterMode::RT)
{
    return {GGX<Real>(Real(alpha)), Real(eta), mode};
}

struct Both
{
    double reflected, transmitted;
};

// Integrals of f(wi) over the hemisphere of wo and the other one.
template <class F>
Both integrate_sheet(const Vec3<double>& wo, double alpha_x, double alpha_y, const F& f)
{
    const double side = wo.z < 0 ? -1 : 1;
    const auto over = [&](double sign) {
        return integrate_reflections(
            Vec3<double>(wo.x, wo.y, std::abs(wo.z)), alpha_x, alpha_y, 48,
            [&](const Vec3<double>& w) { return f(Vec3<double>(w.x, w.y, sign * w.z)); });
    };
    return {over(side), over(-side)};
}

// Light followed through a hundred reflections between two smooth interfaces; the closure has
// their closed sum.
TEST(ThinDielectric, a_smooth_sheet_sums_all_inner_reflections)
{
    for (double eta : {1.05, 1.5, 4.0})
        for (double mu : {0.05, 0.4, 1.0})
        {
            const double F = DielectricFresnel<double>(eta).reflectance(mu);
            double R = F, T = 0, inside = 1 - F;
            for (int bounce = 0; bounce < 100; ++bounce)
            {
                (bounce % 2 ? R : T) += inside * (1 - F);
                inside *= F;
            }
            for (double side : {1.0, -1.0})
            {
                const auto closure = sheet<double>(0, eta);
                const auto wo = sided(side * mu, 1.0);
                const auto r = closure.sample(wo, {0.5, 0.5, 0.0}),
                           t = closure.sample(wo, {0.5, 0.5, 1 - 1e-12});
                ASSERT_TRUE(r.valid && r.delta && !r.transmitted);
                ASSERT_TRUE(t.valid && t.delta && t.transmitted);
                // The sum is short of what is still inside after the last bounce.
                EXPECT_NEAR(r.pdf * r.weight.x, R, 1e-12 + inside);
                EXPECT_NEAR(t.pdf * t.weight.x, T, 1e-12 + inside);
                EXPECT_LT((r.wi - Vec3<double>(-wo.x, -wo.y, wo.z)).length(), 1e-14);
                EXPECT_LT((t.wi + wo).length(), 1e-14);
                EXPECT_EQ(closure.pdf(wo, t.wi), 0);
                EXPECT_EQ(closure.eval(wo, r.wi).x, 0);
            }
        }
}

TEST(ThinDielectric, weight_is_eval_over_pdf)
{
    for (double alpha : {1e-3, 0.1, 1.0})
        for (double eta : {0.7, 1.01, 1.5})
            for (auto mode : {ScatterMode::R, ScatterMode::T, ScatterMode::RT})
            {
                expect_weight_is_eval_over_pdf(sheet<float>(alpha, eta, mode), 2e-6, true);
                expect_weight_is_eval_over_pdf(sheet<double>(alpha, eta, mode), 1e-14, true);
            }
}

TEST(ThinDielectric, eval_sample_and_pdf_tell_one_story)
{
    for (double eta : {0.8, 1.05, 1.5, 2.4})
        for (double alpha : {0.01, 0.3, 1.0})
            for (double mu : {-0.9, -0.1, 0.05, 0.5})
            {
                const Sheet<double> closure(GGX<double>(alpha, 0.5 * alpha), eta);
                const auto wo = sided(mu, 0.4);
                const auto prepared = closure.prepare(wo);
                const auto density = integrate_sheet(
                    wo, alpha, 0.5 * alpha, [&](const auto& wi) { return prepared.pdf(wi); });
                const auto value = integrate_sheet(
                    wo, alpha, 0.5 * alpha, [&](const auto& wi) { return prepared.eval(wi).x; });
                const auto samples = sum_samples(prepared, 32768);
                EXPECT_NEAR(density.reflected + density.transmitted + samples.nothing, 1, 5e-4);
                EXPECT_NEAR(value.reflected, samples.reflected, 2e-3) << eta << " " << alpha;
                EXPECT_NEAR(value.transmitted, samples.transmitted, 2e-3) << eta << " " << alpha;
            }
}

// Single scattering: together the lobes are a mirror's of the same width. Compensated, they are
// everything.
TEST(ThinDielectric, furnace_loses_nothing)
{
    for (double eta : {0.7, 1.05, 1.5, 4.0})
        for (double alpha : {1e-3, 0.1, 0.5, 1.0})
            for (double mu : {-0.7, -0.02, 1e-3, 0.1, 1.0})
            {
                const auto wo = sided(mu);
                const auto lobe = sheet<double>(alpha, eta);
                const auto closure = compensated(lobe, Method::turquin, luts::ggx_tables());
                EXPECT_TRUE(closure.traits().energy_preserving);
                const auto E = integrate_sheet(wo, alpha, alpha,
                                               [&](const auto& wi) { return lobe.eval(wo, wi).x; });
                const Vec3<double> above(wo.x, wo.y, std::abs(wo.z));
                const auto mirror = white<double>(alpha, alpha);
                EXPECT_NEAR(
                    E.reflected + E.transmitted,
                    integrate_reflections(above, alpha, alpha, 48,
                                          [&](const auto& wi) { return mirror.eval(above, wi).x; }),
                    1e-9);

                const auto all = integrate_sheet(
                    wo, alpha, alpha, [&](const auto& wi) { return closure.eval(wo, wi).x; });
                EXPECT_NEAR(all.reflected + all.transmitted, 1, 2e-3) << eta << " " << alpha;
                const auto albedo = closure.albedo(wo);
                EXPECT_NEAR(albedo.reflect.x + albedo.transmit.x, 1, 1e-6);
                // The step of total reflection is coarse to a grid of facets.
                EXPECT_NEAR(albedo.reflect.x, all.reflected, eta < 1 ? 4e-2 : 8e-3)
                    << eta << " " << alpha << " " << mu;
            }
}

TEST(ThinDielectric, is_reciprocal_on_both_sides)
{
    Random random(51);
    for (double eta : {0.8, 1.05, 1.5})
        for (double alpha : {0.05, 0.5, 1.0})
        {
            const Sheet<double> closure(GGX<double>(alpha, 0.4 * alpha), eta);
            EXPECT_TRUE(closure.traits().reciprocal);
            for (int i = 0; i < 1000; ++i)
            {
                const auto wo = sided(2 * random.unit() - 1, 7 * random.unit());
                const auto wi = sided(2 * random.unit() - 1, 7 * random.unit());
                if (std::abs(wo.z) < 1e-4 || std::abs(wi.z) < 1e-4) continue;
                const double there = closure.eval(wo, wi).x / std::abs(wi.z);
                const double back = closure.eval(wi, wo).x / std::abs(wo.z);
                EXPECT_NEAR(there, back, 1e-9 * (there + back));
            }
        }
}

TEST(ThinDielectric, tints_and_modes_take_their_part)
{
    const Color3<double> red(0.9, 0.2, 0.1), blue(0.1, 0.3, 0.8);
    const Sheet<double> both(GGX<double>(0.4), 1.5, ScatterMode::RT, red, blue),
        R(GGX<double>(0.4), 1.5, ScatterMode::R, red, blue),
        T(GGX<double>(0.4), 1.5, ScatterMode::T, red, blue);
    const auto plain = sheet<double>(0.4, 1.5);
    Random random(52);
    for (int i = 0; i < 500; ++i)
    {
        const auto wo = sided(2 * random.unit() - 1), wi = sided(2 * random.unit() - 1);
        const bool same = wo.z * wi.z > 0;
        const Color3<double> expected = (same ? red : blue) * plain.eval(wo, wi).x;
        EXPECT_TRUE(both.eval(wo, wi).equalWithRelError(expected, 1e-12));
        EXPECT_TRUE((same ? R : T).eval(wo, wi).equalWithRelError(expected, 1e-12));
        EXPECT_EQ((same ? T : R).eval(wo, wi), Color3<double>(0.0));
        EXPECT_EQ((same ? T : R).pdf(wo, wi), 0);
    }
}

TEST(ThinDielectric, no_sheet_lets_everything_straight_through)
{
    for (double alpha : {0.0, 0.3, 1.0})
    {
        const auto wo = Vec3<float>(sided(-0.6, 1.0));
        const auto s = sheet<float>(alpha, 1.0).sample(wo, {0.2f, 0.3f, 0.4f});
        ASSERT_TRUE(s.valid && s.delta && s.transmitted);
        EXPECT_TRUE(s.wi.equalWithAbsError(-wo, 3e-7f));
        EXPECT_EQ(s.pdf, 1);
    }
}

// On either side of each bound the compensated albedo is nearly the same.
TEST(ThinDielectric, no_albedo_jumps_at_the_bounds)
{
    struct Bound
    {
        double alpha, eta, alpha_beyond, eta_beyond;
    };
    for (const Bound& b : {Bound{1.001e-5, 1.5, 0.999e-5, 1.5}, Bound{1, 1 + 1.1e-5, 1, 1 + 9e-6},
                           Bound{0.3, 1 - 3.5e-5, 0.3, 1 - 3.1e-5}})
        for (double mu : {-0.9, 0.05, 0.5})
        {
            const Vec3<float> wo(sided(mu));
            const auto tables = luts::ggx_tables();
            const auto rough = compensated(sheet<float>(b.alpha, b.eta), Method::turquin, tables);
            const auto beyond =
                compensated(sheet<float>(b.alpha_beyond, b.eta_beyond), Method::turquin, tables);
            ASSERT_TRUE(beyond.traits().delta);
            const auto r = sum_samples(rough.prepare(wo), 16384),
                       n = sum_samples(beyond.prepare(wo), 16384);
            EXPECT_NEAR(r.reflected, n.reflected, 1e-3);
            EXPECT_NEAR(r.transmitted, n.transmitted, 1e-3);
        }
}

template <class Real>
void run_hostile(long calls)
{
    Hostile<Real> hostile(sizeof(Real) + 2);
    long failures = 0;
    const Trapped trapped;
    const ScatterMode modes[] = {ScatterMode::R, ScatterMode::T, ScatterMode::RT};
    for (long i = 0; i < calls; ++i)
    {
        const auto closure =
            compensated(Sheet<Real>(GGX<Real>(hostile.parameter(), hostile.parameter()),
                                    i % 2 ? hostile.number() : Real(1.5), modes[i % 3],
                                    hostile.color(), hostile.color()),
                        hostile.method(), luts::ggx_tables(), hostile.parameter());
        const Vec3<Real> wo = hostile.any_direction(), wi = hostile.any_direction();
        const auto prepared = closure.prepare(wo);
        const Color3<Real> f = prepared.eval(wi);
        const Real pdf = prepared.pdf(wi), x = hostile.random_number(), y = hostile.random_number();
        const Sample<Real> s = prepared.sample({x, y, hostile.random_number()});
        const bool good = sane(f) && sane(s.weight) && std::isfinite(pdf) && pdf >= 0 &&
                          std::isfinite(s.pdf) && s.pdf >= 0 && (!s.valid || s.pdf > 0) &&
                          std::abs(s.wi.length() - 1) < 2e-6;
        if (!good && failures++ < 5)
            ADD_FAILURE() << "wo " << wo << ", wi " << wi << ": eval " << f << ", pdf " << pdf
                          << ", sample " << s.wi << " " << s.weight << " " << s.pdf;
    }
    EXPECT_EQ(failures, 0);
}

TEST(ThinDielectric, hostile_inputs_stay_finite)
{
    run_hostile<float>(500000);
    run_hostile<double>(100000);
}

TEST(ThinDielectric, a_vector_of_floats_answers_as_a_float_does)
{
    for (auto mode : {ScatterMode::RT, ScatterMode::T})
        expect_batch_answers_as_float(
            [&](const auto& alpha) {
                using Real = std::decay_t<decltype(alpha)>;
                return compensated(Sheet<Real>(GGX<Real>(alpha), Real(1.4f), mode), Method::turquin,
                                   luts::ggx_tables());
            },
            2e-4, true);
}

TEST(ThinDielectric, takes_any_distribution)
{
    const ThinDielectric<STD<double>> closure(STD<double>(0.4, 3.0), 1.5);
    const auto wo = sided(-0.5);
    const auto prepared = closure.prepare(wo);
    const auto value =
        integrate_sheet(wo, 0.4, 0.4, [&](const auto& wi) { return prepared.eval(wi).x; });
    // 4.5 sigma of 60,000 samples, 0.5 each.
    const auto samples = sum_samples(prepared, 60000);
    EXPECT_NEAR(value.reflected, samples.reflected, 9e-3);
    EXPECT_NEAR(value.transmitted, samples.transmitted, 9e-3);
}

}  // namespace
