// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Where a rough interface ends: flat surfaces, indices near 1, garbage, and other number types.

#include "../support/glass.h"
#include "../support/hostile.h"

#include <regain/closures/beckmann.h>
#include <regain/closures/std.h>

#include <gtest/gtest.h>

using namespace regain;
using namespace regain::tests;

namespace {

constexpr auto correlated = TransmissionShadowing::correlated, beta = TransmissionShadowing::beta;

TEST(DielectricLimits, a_flat_surface_reflects_and_refracts_in_one_direction_each)
{
    for (double mu : {-0.9, -0.3, 0.1, 0.8})
        for (double eta : {1 / 1.5, 1.5, 4.0})
        {
            const auto wo = sided(mu, 1.0);
            const double eta_o = mu > 0 ? eta : 1 / eta, side = mu > 0 ? 1 : -1;
            const auto paths = facet_paths(direction<double>(std::abs(mu), 1.0), {0, 0, 1}, eta_o);
            const double F = DielectricFresnel<double>(eta_o).reflectance(std::abs(mu));
            for (double alpha : {0.0, 1e-6, 1e-5})
            {
                const auto lobe = glass<float>(alpha, eta);
                EXPECT_TRUE(lobe.traits().delta);
                const Vec3<float> from(wo);
                const auto R = lobe.sample(from, {0.3f, 0.9f, 0.0f});
                ASSERT_TRUE(R.valid && R.delta && !R.transmitted);
                EXPECT_NEAR(R.weight.x, 1, 1e-6);
                EXPECT_NEAR(R.pdf, F, 1e-5);
                EXPECT_TRUE(R.wi.equalWithAbsError(Vec3<float>(-from.x, -from.y, from.z), 3e-7f));
                EXPECT_EQ(lobe.pdf(from, R.wi), 0);
                EXPECT_EQ(lobe.eval(from, R.wi).x, 0);
                if (F == 1) continue;
                const auto T = lobe.sample(from, {0.3f, 0.9f, 0.9999999f});
                ASSERT_TRUE(T.valid && T.delta && T.transmitted);
                EXPECT_NEAR(T.weight.x, 1, 1e-6);
                EXPECT_NEAR(T.pdf, 1 - F, 1e-5);
                const Vec3<double> wi(paths.refracted.x, paths.refracted.y,
                                      side * paths.refracted.z);
                EXPECT_LT((Vec3<double>(T.wi) - wi).length(), 2e-6);
                EXPECT_EQ(lobe.pdf(from, T.wi), 0);
                EXPECT_EQ(lobe.eval(from, T.wi).x, 0);
                // One lobe alone carries its share as weight.
                const auto alone = glass<float>(alpha, eta, correlated, ScatterMode::T);
                const auto only = alone.sample(from, {0.3f, 0.9f, 0.0f});
                EXPECT_TRUE(only.delta && only.transmitted);
                EXPECT_NEAR(only.weight.x, 1 - F, 1e-5);
                EXPECT_EQ(only.pdf, 1);
            }
        }
}

TEST(DielectricLimits, an_index_of_one_lets_everything_straight_through)
{
    Random random(41);
    for (double alpha : {0.0, 0.01, 0.5, 1.0})
        for (auto shadowing : {correlated, beta})
            for (int i = 0; i < 500; ++i)
            {
                const auto lobe = glass<float>(alpha, 1.0, shadowing);
                const Vec3<float> wo(sided(2 * random.unit() - 1, 7 * random.unit()));
                if (std::abs(wo.z) < 1e-3f) continue;
                const Vec3<float> u(random.unit<float>(), random.unit<float>(),
                                    random.unit<float>());
                const auto s = lobe.sample(wo, u);
                ASSERT_TRUE(s.valid && s.delta && s.transmitted);
                EXPECT_TRUE(s.wi.equalWithAbsError(-wo, 3e-7f));
                EXPECT_NEAR(s.pdf, 1, 1e-6);
                EXPECT_LE(s.weight.x, 1 + 1e-6);
                EXPECT_EQ(lobe.eval(wo, s.wi).x, 0);
            }
}

// The delta lobe carries the loss that the rough lobe's limit has, so that nothing jumps: neither
// the albedo nor, its gain being smooth, what compensation makes of it.
TEST(DielectricLimits, no_albedo_jumps_at_the_bound_of_transmission)
{
    struct Bound
    {
        double alpha, eta_rough, alpha_narrow, eta_narrow;
    };
    const Bound bounds[] = {{1, 1 + 1.1e-5, 1, 1 + 0.9e-5},
                            {1, 1 / (1 + 1.1e-5), 1, 1 / (1 + 0.9e-5)},
                            {0.3, 1 + 3.5e-5, 0.3, 1 + 3.1e-5},
                            {3.1e-5, 1.5, 2.9e-5, 1.5},
                            {1.4e-5, 4.0, 1.3e-5, 4.0}};
    for (const Bound& b : bounds)
        for (auto shadowing : {correlated, beta})
            for (double mu : {-1.0, -0.3, 0.05, 0.3, 1.0})
            {
                const auto rough = glass<float>(b.alpha, b.eta_rough, shadowing),
                           narrow = glass<float>(b.alpha_narrow, b.eta_narrow, shadowing);
                ASSERT_FALSE(rough.traits().delta);
                ASSERT_TRUE(narrow.traits().delta);
                const Vec3<float> wo(sided(mu));
                const auto r = sum_samples(rough.prepare(wo), 20000),
                           n = sum_samples(narrow.prepare(wo), 20000);
                EXPECT_NEAR(r.reflected, n.reflected, 1e-3) << b.alpha << " " << mu;
                EXPECT_NEAR(r.transmitted, n.transmitted, 1e-3) << b.alpha << " " << mu;
                EXPECT_EQ(n.delta_transmitted, n.transmitted);
            }
}

TEST(DielectricLimits, no_albedo_jumps_where_the_surface_becomes_flat)
{
    for (double eta : {1.05, 1.5, 4.0})
        for (double mu : {-0.9, 0.05, 0.5, 1.0})
        {
            const auto rough = glass<float>(1.001e-5, eta), flat = glass<float>(0.999e-5, eta);
            const Vec3<float> wo(sided(mu));
            const auto r = sum_samples(rough.prepare(wo), 20000),
                       f = sum_samples(flat.prepare(wo), 20000);
            EXPECT_NEAR(r.reflected, f.reflected, 1e-3);
            EXPECT_NEAR(r.transmitted, f.transmitted, 1e-3);
            EXPECT_EQ(f.delta_reflected + f.delta_transmitted, f.reflected + f.transmitted);
        }
}

// P(delta) and the pdf of what is left of the lobes make 1.
TEST(DielectricLimits, pdf_counts_what_is_not_delta)
{
    for (double mu : {-0.7, -0.1, 0.02, 0.4})
    {
        const double alpha = 0.5, eta = 1 + 1e-9;
        const auto prepared = glass<double>(alpha, eta).prepare(sided(mu));
        const auto integral = integrals(prepared, sided(mu), eta, alpha, alpha);
        const auto samples = sum_samples(prepared, 50000);
        EXPECT_EQ(integral.transmitted.x, 0);
        EXPECT_NEAR(integral.reflected.x + samples.nothing + samples.delta, 1, 5e-4);
        EXPECT_GT(samples.delta, 0.9);
    }
}

template <class Closure, class Real>
void check(const Closure& closure, Hostile<Real>& hostile, long& failures)
{
    const Vec3<Real> wo = hostile.any_direction(), wi = hostile.any_direction();
    const auto prepared = closure.prepare(wo);
    const Color3<Real> f = prepared.eval(wi);
    const Real pdf = prepared.pdf(wi);
    const Real x = hostile.random_number(), y = hostile.random_number();
    const Sample<Real> s = prepared.sample({x, y, hostile.random_number()});
    const bool good = sane(f) && sane(s.weight) && std::isfinite(pdf) && pdf >= 0 &&
                      std::isfinite(s.pdf) && s.pdf >= 0 && (!s.valid || s.pdf > 0) &&
                      std::abs(s.wi.length() - 1) < 2e-6;
    if (!good && failures++ < 5)
        ADD_FAILURE() << "wo " << wo << ", wi " << wi << ": eval " << f << ", pdf " << pdf
                      << ", sample " << s.wi << " " << s.weight << " " << s.pdf << ", eta "
                      << closure.lobe().eta();
}

// Garbage, or an index ever nearer to 1.
template <class Real>
Real hostile_index(Hostile<Real>& hostile, Random& random)
{
    if (random.bits() % 3 == 0) return hostile.number();
    const double excess = std::ldexp(random.unit(), -int(random.bits() % 40));
    return Real(random.bits() % 2 ? 1 + excess : 1 / (1 + excess));
}

template <class Real>
void run(long calls)
{
    Hostile<Real> hostile(sizeof(Real) + 1);
    Random random(44);
    long failures = 0;
    const TablesOfOne of_one(0.5, 1.5);
    const Trapped trapped;
    const ScatterMode modes[] = {ScatterMode::R, ScatterMode::T, ScatterMode::RT};
    for (long i = 0; i < calls; ++i)
    {
        const Real ax = hostile.parameter(), ay = i % 4 ? ax : hostile.parameter();
        const Real eta = i % 2 ? Real(1.5) : hostile_index(hostile, random);
        const auto mode = modes[i % 3];
        const auto shadowing = i % 5 < 3 ? correlated : beta;
        check(
            compensated(Glass<Real>(GGX<Real>(ax, ay), eta, mode, hostile.color(), hostile.color(),
                                    shadowing),
                        hostile.method(), of_one.tables(), luts::ggx_tables(), hostile.parameter()),
            hostile, failures);
        check(compensated(Dielectric<Beckmann<Real>>(Beckmann<Real>(ax, ay), eta, mode,
                                                     hostile.color(), hostile.color(), shadowing),
                          hostile.method(), DielectricTables{}),
              hostile, failures);
    }
    EXPECT_EQ(failures, 0);
}

TEST(DielectricLimits, hostile_floats_stay_finite) { run<float>(500000); }
TEST(DielectricLimits, hostile_doubles_stay_finite) { run<double>(200000); }

TEST(DielectricLimits, a_vector_of_floats_answers_as_a_float_does)
{
    static const TablesOfOne of_one(0.5, 1.5);
    for (auto shadowing : {correlated, beta})
        for (auto mode : {ScatterMode::RT, ScatterMode::R})
            for (float eta : {1.5f, 0.8f})
                expect_batch_answers_as_float(
                    [&](const auto& alpha) {
                        using Real = std::decay_t<decltype(alpha)>;
                        const Color3<Real> white(Real(1));
                        return compensated(
                            Glass<Real>(GGX<Real>(alpha), Real(eta), mode, white, white, shadowing),
                            Method::turquin, of_one.tables(), luts::ggx_tables());
                    },
                    2e-4, true);
}

// Median and 99th percentile of the relative difference of eval and pdf.
TEST(DielectricLimits, float_is_close_to_double)
{
    struct Case
    {
        double eta, median, tail;
    };
    // Directions are known to 6e-8 and the facet to that over |eta - 1|.
    for (const Case& c : {Case{1.5, 2e-6, 1e-3}, Case{1.01, 1e-4, 2e-2}, Case{0.4, 2e-6, 1e-3}})
    {
        Random random(43);
        std::vector<double> differences;
        while (differences.size() < 4000)
        {
            const double alpha = double(float(0.02 + 0.98 * random.unit()));
            const double eta = double(float(c.eta));
            const Vec3<float> wo(sided(2 * random.unit() - 1, 7 * random.unit()));
            const auto single = glass<float>(alpha, eta);
            const auto precise = glass<double>(alpha, eta);
            const Vec3<float> u(random.unit<float>(), random.unit<float>(), random.unit<float>());
            const auto s = single.sample(wo, u);
            if (!s.valid || std::abs(s.wi.z) < 1e-3f || std::abs(wo.z) < 1e-3f) continue;
            const double a = single.eval(wo, s.wi).x;
            const double b = precise.eval(Vec3<double>(wo), Vec3<double>(s.wi)).x;
            if (b > 0) differences.push_back(std::abs(a / b - 1));
        }
        std::sort(differences.begin(), differences.end());
        EXPECT_LT(differences[differences.size() / 2], c.median) << c.eta;
        EXPECT_LT(differences[differences.size() * 99 / 100], c.tail) << c.eta;
    }
}

}  // namespace
