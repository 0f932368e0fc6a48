// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Fresnel terms against textbook forms in double precision.

#include "../support/closures.h"

#include <gtest/gtest.h>

#include <complex>

using namespace regain;
using namespace regain::tests;

namespace {

// Fresnel's equations with a complex index, as printed in any textbook.
double textbook(double n, double k, double mu)
{
    using C = std::complex<double>;
    const C eta(n, k);
    const C cos_t = std::sqrt(1.0 - (1 - mu * mu) / (eta * eta));
    const C s = (mu - eta * cos_t) / (mu + eta * cos_t),
            p = (eta * mu - cos_t) / (eta * mu + cos_t);
    return 0.5 * (std::norm(s) + std::norm(p));
}

TEST(ConductorFresnel, matches_the_textbook)
{
    for (double n : {0.04, 0.2, 0.9, 1.0, 1.5, 5.0})
        for (double k : {0.01, 0.5, 2.0, 9.0})
            for (double mu : {1e-4, 0.05, 0.4, 0.9, 1.0})
            {
                const ConductorFresnel<double> F{Color3<double>(n), Color3<double>(k)};
                EXPECT_NEAR(F.at(mu).x, textbook(n, k, mu), 1e-12) << n << " " << k << " " << mu;
            }
}

// What a metal absorbs is small, and 1 - F has to be right in float all the same.
TEST(ConductorFresnel, absorptance_is_exact_in_float)
{
    for (double n : {0.05, 0.5, 2.0})
        for (double k : {3.0, 10.0})
            for (double mu : {0.01, 0.3, 1.0})
            {
                const ConductorFresnel<float> F{Color3<float>(float(n)), Color3<float>(float(k))};
                const double exact =
                    1 - textbook(double(float(n)), double(float(k)), double(float(mu)));
                EXPECT_NEAR(1 - double(F.at(float(mu)).x), exact, 1e-7 + 2e-6 * exact);
            }
}

TEST(ConductorFresnel, without_absorption_is_a_dielectric)
{
    // Fresnel's equations of a dielectric of index 1.5, real arithmetic.
    const ConductorFresnel<double> F{Color3<double>(1.5), Color3<double>(0.0)};
    for (double mu : {0.02, 0.3, 0.8, 1.0})
    {
        const double t = std::sqrt(1 - (1 - mu * mu) / 2.25);
        const double s = (mu - 1.5 * t) / (mu + 1.5 * t), p = (1.5 * mu - t) / (1.5 * mu + t);
        EXPECT_NEAR(F.at(mu).x, 0.5 * (s * s + p * p), 1e-12);
    }
    EXPECT_NEAR(F.at(1.0).x, 0.04, 1e-15);
}

TEST(ConductorFresnel, average_is_the_integral)
{
    for (double n : {0.04, 0.2, 1.0, 2.5, 5.0})
        for (double k : {0.5, 2.0, 5.0, 10.0})
        {
            const ConductorFresnel<double> F{Color3<double>(n), Color3<double>(k)};
            double integral = 0;
            for (int i = 0; i < 4000; ++i)
            {
                const double mu = (i + 0.5) / 4000;
                integral += 2 * mu * textbook(n, k, mu) / 4000;
            }
            EXPECT_NEAR(F.average().x, integral, 3e-4) << n << " " << k;
        }
}

// OpenPBR Surface 1.1: at cos 1/7 the reflectance is Schlick's times the tint.
TEST(SchlickFresnel, f82_tints_at_82_degrees)
{
    const Color3<double> F0(0.9, 0.6, 0.3), F82(1.0, 0.8, 0.5);
    const SchlickFresnel<double> F{F0, F82};
    const double mu = 1.0 / 7, falloff = std::pow(6.0 / 7, 5);
    for (int c = 0; c < 3; ++c)
    {
        EXPECT_NEAR(F.at(mu)[c], F82[c] * (F0[c] + (1 - F0[c]) * falloff), 1e-12);
        EXPECT_NEAR(F.at(1.0)[c], F0[c], 1e-15);
        EXPECT_NEAR(F.at(0.0)[c], 1, 1e-15);
    }
}

TEST(SchlickFresnel, average_is_the_integral)
{
    for (double F0 : {0.0, 0.04, 0.3, 0.95})
        for (double F82 : {0.0, 0.5, 1.0})
            for (double exponent : {2.0, 5.0, 7.5})
            {
                const SchlickFresnel<double> F(Color3<double>(F0), Color3<double>(F82),
                                               Color3<double>(0.9), exponent);
                double integral = 0;
                for (int i = 0; i < 20000; ++i)
                {
                    const double mu = (i + 0.5) / 20000;
                    integral += 2 * mu * F.at(mu).x / 20000;
                }
                // Exact where the curve is not clamped; by a short quadrature where it is.
                EXPECT_NEAR(F.average().x, integral, F82 == 1 ? 1e-6 : 1e-3)
                    << F0 << " " << F82 << " " << exponent;
            }
}

TEST(SchlickFresnel, stays_within_zero_and_one)
{
    const SchlickFresnel<double> dark(Color3<double>(0.0), Color3<double>(0.0));
    for (int i = 0; i <= 1000; ++i)
    {
        EXPECT_GE(dark.at(i / 1000.0).x, 0);
        EXPECT_LE(dark.at(i / 1000.0).x, 1);
    }
}

}  // namespace
