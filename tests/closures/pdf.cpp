// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The pdf is the density of sample: it integrates to 1 less the share of samples that come to
// nothing, and samples fall where it says.

#include "../support/closures.h"
#include "../support/reflection_integral.h"

#include <gtest/gtest.h>

#include <vector>

using namespace regain;
using namespace regain::tests;

namespace {

// Share of random numbers for which nothing is sampled, over a Kronecker sequence: a grid would be
// no better than its spacing where the boundary runs along it.
template <class Prepared>
double nothing_sampled(const Prepared& prepared)
{
    constexpr int n = 400000;
    int nothing = 0;
    double u = 0.5, v = 0.5;
    for (int i = 0; i < n; ++i)
    {
        u += 0.7548776662466927;
        v += 0.5698402909980532;
        u -= std::floor(u);
        v -= std::floor(v);
        if (!prepared.sample({u, v}).valid) ++nothing;
    }
    return nothing / double(n);
}

TEST(Pdf, integrates_to_one_less_what_comes_to_nothing)
{
    for (NormalSampling sampling : {NormalSampling::bounded, NormalSampling::full})
        for (double alpha_x : {1e-3, 0.04, 0.25, 1.0})
            for (double ratio : {1.0, 4.0})
                for (double mu : {1e-3, 0.02, 0.3, 0.7, 1.0})
                {
                    const double alpha_y = alpha_x / ratio;
                    const auto closure = white<double>(alpha_x, alpha_y, sampling);
                    const Vec3<double> wo = direction<double>(mu, 0.6);
                    const auto prepared = closure.prepare(wo);
                    const double integral = integrate_reflections(
                        wo, alpha_x, alpha_y, 40,
                        [&](const Vec3<double>& wi) { return prepared.pdf(wi); });
                    EXPECT_NEAR(integral + nothing_sampled(prepared), 1, 5e-4)
                        << "alpha " << alpha_x << " " << alpha_y << ", mu " << mu << ", "
                        << (sampling == NormalSampling::full ? "full" : "bounded");
                }
}

// Bounding must pay: fewer samples come to nothing.
TEST(Pdf, bounded_sampling_wastes_less)
{
    const Vec3<double> wo = direction<double>(0.3);
    const double full = nothing_sampled(white<double>(1, 1, NormalSampling::full).prepare(wo));
    const double bounded = nothing_sampled(white<double>(1, 1).prepare(wo));
    EXPECT_GT(full, 0.2);
    EXPECT_LT(bounded, 0.5 * full);
}

// Pearson's test over 16 x 32 cells of equal solid angle, expected counts from 16 x 16 midpoints of
// the pdf in each. The 1e-4 quantile of chi-squared is approximated by Wilson and Hilferty (1931).
TEST(Pdf, samples_fall_where_it_says)
{
    constexpr int rows = 16, columns = 32, samples = 400000;
    const double pi = std::acos(-1.0);
    for (NormalSampling sampling : {NormalSampling::bounded, NormalSampling::full})
        for (double alpha_y : {0.9, 0.3})
            for (double mu : {0.15, 0.8})
            {
                const auto prepared =
                    white<double>(0.9, alpha_y, sampling).prepare(direction<double>(mu, 1.0));
                std::vector<double> expected(rows * columns), observed(rows * columns);
                constexpr int fine = 16;
                for (int i = 0; i < rows * fine; ++i)
                    for (int j = 0; j < columns * fine; ++j)
                        expected[i / fine * columns + j / fine] +=
                            prepared.pdf(direction<double>((i + 0.5) / (rows * fine),
                                                           2 * pi * (j + 0.5) / (columns * fine))) *
                            2 * pi / (rows * columns * fine * fine) * samples;
                Random random(11);
                for (int s = 0; s < samples; ++s)
                {
                    const auto sample = prepared.sample(random.square<double>());
                    if (!sample.valid) continue;
                    double phi = std::atan2(sample.wi.y, sample.wi.x) / (2 * pi);
                    if (phi < 0) phi += 1;
                    const int i = std::min(rows - 1, int(sample.wi.z * rows));
                    const int j = std::min(columns - 1, int(phi * columns));
                    observed[i * columns + j] += 1;
                }
                double chi2 = 0, pooled_expected = 0, pooled_observed = 0;
                int cells = 0;
                for (int c = 0; c < rows * columns; ++c)
                {
                    if (expected[c] < 5)
                    {
                        pooled_expected += expected[c];
                        pooled_observed += observed[c];
                        continue;
                    }
                    chi2 += (observed[c] - expected[c]) * (observed[c] - expected[c]) / expected[c];
                    ++cells;
                }
                if (pooled_expected >= 5)
                {
                    const double d = pooled_observed - pooled_expected;
                    chi2 += d * d / pooled_expected;
                    ++cells;
                }
                const double k = cells, z = 3.719, v = 2 / (9 * k);
                const double limit = k * std::pow(1 - v + z * std::sqrt(v), 3);
                EXPECT_LT(chi2, limit)
                    << "alpha_y " << alpha_y << ", mu " << mu << ", cells " << cells;
            }
}

}  // namespace
