// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Burley's sheen, and the Lambertian base under it.

#include "../support/closures.h"
#include "../support/hostile_run.h"
#include "../support/properties.h"

#include <regain/closures/diffuse.h>
#include <regain/closures/sheen.h>

#include <gtest/gtest.h>

using namespace regain;
using namespace regain::tests;

namespace {

const double pi = std::acos(-1.0);

// Over cosines and azimuths, nodes gathered at the horizon in front of wo.
template <class F>
double integrate(const F& f)
{
    constexpr int n = 300;
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
        {
            const double x = (i + 0.5) / n, y = (j + 0.5) / n, mu = x * x;
            const double azimuth = pi * (1 - y * y);
            sum += f(direction<double>(mu, azimuth)) * 2 * x / n * 2 * pi * 2 * y / n;
        }
    return sum;
}

// The published code of the model: FH = SchlickWeight(LdotH), sheen * Csheen * FH, L the light and
// H the half-vector.
TEST(Sheen, is_burleys_profile)
{
    Random random(12);
    const Color3<double> color(1.0, 0.5, 0.25);
    for (int i = 0; i < 1000; ++i)
    {
        const auto wo = direction<double>(random.unit(), 7 * random.unit());
        const auto wi = direction<double>(random.unit(), 7 * random.unit());
        const auto h = (wo + wi).normalized();
        const double F_H = std::pow(1 - wi.dot(h), 5);
        const auto f = Sheen<double>(0.4, color).eval(wo, wi);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(f[c], 0.4 * color[c] * F_H * wi.z, 1e-14);
    }
}

TEST(Sheen, albedo_is_the_integral)
{
    double average = 0;
    for (int i = 0; i <= 20; ++i)
    {
        const double mu = std::max(1e-4, i / 20.0);
        const auto prepared = Sheen<double>(1).prepare(direction<double>(mu));
        const double exact = integrate([&](const auto& wi) { return prepared.eval(wi).x; });
        EXPECT_NEAR(prepared.albedo().reflect.x, exact, 4e-6) << mu;
        average += 2 * mu * exact * (i % 20 ? 1 : 0.5) / 20;
    }
    // What the header says.
    EXPECT_NEAR(Sheen<double>(1).albedo(direction<double>(1e-6)).reflect.x, 0.0885, 1e-4);
    EXPECT_NEAR(average, 0.0116, 1e-4);
}

TEST(Sheen, is_reciprocal)
{
    EXPECT_LT(asymmetry_of_reflection(Sheen<double>(0.7)), 1e-9);
    EXPECT_LT(asymmetry_of_reflection(Diffuse<double>(Color3<double>(0.7))), 1e-12);
    EXPECT_TRUE(Sheen<double>(0.7).traits().reciprocal);
}

TEST(Sheen, weight_is_eval_over_pdf)
{
    expect_weight_is_eval_over_pdf(Sheen<float>(0.7f), 1e-6);
    expect_weight_is_eval_over_pdf(Sheen<double>(1), 1e-14);
    expect_weight_is_eval_over_pdf(Diffuse<double>(Color3<double>(0.3)), 1e-14);
    const Diffuse<float> grey(Color3<float>(0.5f));
    expect_weight_is_eval_over_pdf(burley_sheen(grey, 0.6f), 1e-6);
}

TEST(Sheen, is_sampled_by_its_pdf_with_small_weights)
{
    for (double mu : {1e-3, 0.1, 0.3, 0.6, 0.85, 1.0})
    {
        const auto prepared = Sheen<double>(1).prepare(direction<double>(mu));
        EXPECT_NEAR(integrate([&](const auto& wi) { return prepared.pdf(wi); }), 1, 1e-4);
        const auto s = sample_statistics(prepared, 40000);
        const double albedo = prepared.albedo().reflect.x;
        EXPECT_NEAR(s.mean.x / albedo, 1, 0.02);
        EXPECT_EQ(s.nothing, 0);
        EXPECT_LT(s.largest / albedo, mu > 0.6 ? 9 : 3) << mu;
        EXPECT_LT(s.variance, mu > 0.6 ? 4 : 0.8) << mu;
    }
}

// Pearson's test over cosine and azimuth; 1 - 1e-6 quantile of chi-squared with 255 degrees.
TEST(Sheen, samples_fall_where_the_pdf_says)
{
    for (double mu : {0.05, 0.4, 0.9})
    {
        const auto prepared = Sheen<double>(1).prepare(direction<double>(mu));
        constexpr int k = 16, n = 200000, fine = 40;
        std::vector<double> expected(k * k), observed(k * k);
        for (int i = 0; i < k * fine; ++i)
            for (int j = 0; j < k * fine; ++j)
                expected[std::size_t(i / fine * k + j / fine)] +=
                    prepared.pdf(direction<double>((i + 0.5) / (k * fine),
                                                   2 * pi * (j + 0.5) / (k * fine))) *
                    2 * pi / (k * k * fine * fine) * n;
        Random random(9);
        for (int i = 0; i < n; ++i)
        {
            const double x = random.unit(), y = random.unit();
            const auto s = prepared.sample(Vec3<double>(x, y, random.unit()));
            double phi = std::atan2(s.wi.y, s.wi.x) / (2 * pi);
            if (phi < 0) phi += 1;
            ++observed[std::size_t(std::min(k - 1, int(s.wi.z * k)) * k +
                                   std::min(k - 1, int(phi * k)))];
        }
        double chi2 = 0;
        for (std::size_t c = 0; c < expected.size(); ++c)
            chi2 += (observed[c] - expected[c]) * (observed[c] - expected[c]) / expected[c];
        EXPECT_LT(chi2, 377.0) << mu;
    }
}

// Figure 3: sheen from 0 to 1 over a Lambertian base brightens the edge and leaves the rest.
TEST(Sheen, adds_a_grazing_glow_to_a_base)
{
    const Diffuse<double> base(Color3<double>(0.5));
    const auto edge = direction<double>(0.05), front = direction<double>(1);
    EXPECT_EQ(burley_sheen(base, 0.0).albedo(edge).reflect, Color3<double>(0.5));
    EXPECT_GT(burley_sheen(base, 1.0).albedo(edge).reflect.x, 0.57);
    EXPECT_LT(burley_sheen(base, 1.0).albedo(front).reflect.x, 0.5004);
    const double half = burley_sheen(base, 0.5).albedo(edge).reflect.x,
                 full = burley_sheen(base, 1.0).albedo(edge).reflect.x;
    EXPECT_NEAR(half - 0.5, 0.5 * (full - 0.5), 1e-12);
}

TEST(Sheen, tint_takes_the_hue_of_the_base)
{
    const Color3<double> base(0.2, 0.1, 0.05);
    EXPECT_EQ(sheen_color(base, 0.1, 0.0), Color3<double>(1.0));
    EXPECT_TRUE(
        sheen_color(base, 0.1, 1.0).equalWithAbsError(Color3<double>(2.0, 1.0, 0.5), 1e-12));
    EXPECT_EQ(sheen_color(Color3<double>(0.0), 0.0, 1.0), Color3<double>(1.0));
}

TEST(Sheen, a_vector_of_floats_answers_as_a_float_does)
{
    expect_batch_answers_as_float([](const auto& weight) {
        using Real = std::decay_t<decltype(weight)>;
        const Diffuse<Real> base(Color3<Real>(Real(0.5f), Real(0.2f), Real(0.9f)));
        return burley_sheen(base, Real(1) - weight);
    });
}

template <class Real>
void run_hostile(long calls)
{
    expect_sane_answers<Real>(90, calls, [](auto& hostile, [[maybe_unused]] long i) {
        const Diffuse<Real> base(hostile.color());
        const Real weight = hostile.parameter();
        const Color3<Real> color = hostile.color();
        return burley_sheen(base, weight,
                            sheen_color(color, hostile.number(), hostile.parameter()));
    });
}

TEST(Sheen, stays_finite_whatever_comes_in)
{
    run_hostile<float>(300000);
    run_hostile<double>(100000);
}

}  // namespace
