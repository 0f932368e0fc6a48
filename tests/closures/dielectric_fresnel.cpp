// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Fresnel's equations between dielectrics, against their textbook form in extended precision.

#include <regain/closures/dielectric_fresnel.h>
#include <regain/closures/xsimd.h>
#include <regain/luts/quadrature.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace regain;

namespace {

constexpr double indices[] = {0.01, 0.25, 1 / 1.5, 1 / 1.01, 0.9999, 1.000001, 1.001,
                              1.05, 1.33, 1.5,     2,        2.4,    4,        100};

struct Textbook
{
    long double R, T;
};

// Amplitudes of both polarisations by the angles (Born and Wolf, 1.5.2).
Textbook textbook(long double c, long double eta)
{
    const long double sine2 = (1 - c) * (1 + c) / (eta * eta);
    if (sine2 >= 1) return {1, 0};
    const long double t = std::sqrt(1 - sine2);
    const long double s = (c - eta * t) / (c + eta * t), p = (eta * c - t) / (eta * c + t);
    const long double ts = 2 * c / (c + eta * t), tp = 2 * c / (eta * c + t);
    return {(s * s + p * p) / 2, eta * t / c * (ts * ts + tp * tp) / 2};
}

TEST(DielectricFresnel, agrees_with_the_textbook_in_both_parts)
{
    for (double eta : indices)
        for (double mu = 1e-6; mu <= 1; mu *= 1.03)
        {
            const auto expected = textbook(mu, eta);
            const DielectricFresnel<double> F(eta);
            // What is near the critical angle is as uncertain as the angle.
            const double critical = 1 - (1 - mu) * (1 + mu) / (eta * eta);
            if (std::abs(critical) < 1e-3) continue;
            EXPECT_NEAR(F.reflectance(mu) / double(expected.R), 1, 1e-11) << eta << ", " << mu;
            EXPECT_NEAR(F.transmittance(mu), double(expected.T), 1e-11 * double(expected.T));
            EXPECT_NEAR(F.reflectance(mu) + F.transmittance(mu), 1, 1e-14);

            const float m = float(mu), e = float(eta);
            const auto single = textbook(m, e);
            const DielectricFresnel<float> f(e);
            EXPECT_NEAR(double(f.transmittance(m)), double(single.T),
                        1e-6 * double(single.T) / std::abs(critical));
            EXPECT_NEAR(double(f.reflectance(m)), double(single.R),
                        1e-6 * double(single.R) / std::abs(critical) + 1e-20);
        }
}

// From both cosines the transmittance is as good at the critical angle as anywhere.
TEST(DielectricFresnel, transmittance_of_a_pair_has_no_critical_angle)
{
    for (double eta : indices)
        for (double t = 1e-6; t <= 1; t *= 1.1)
        {
            const long double q = t, c2 = 1 - (1 - q) * (1 + q) * eta * eta;
            if (c2 <= 0) continue;
            const double c = double(std::sqrt(c2));
            const long double s = 1 / (c + eta * q), p = 1 / (eta * c + q);
            const double expected = double(2 * eta * c * q * (s * s + p * p));
            EXPECT_NEAR(
                DielectricFresnel<float>(float(eta)).transmittance(float(c), float(t)) / expected,
                1, 3e-6);
            // One cosine says what it can: c is rounded, and g^2 = c^2 - (1 - eta^2).
            EXPECT_NEAR(DielectricFresnel<double>(eta).transmittance(c) / expected, 1,
                        1e-12 + 5e-15 * c * c / (eta * eta * t * t));
        }
}

TEST(DielectricFresnel, an_index_of_one_reflects_nothing)
{
    for (float mu : {0.0f, 1e-30f, 1e-6f, 0.5f, 1.0f})
    {
        EXPECT_EQ(DielectricFresnel<float>(1.0f).reflectance(mu), 0);
        EXPECT_NEAR(DielectricFresnel<float>(1.0f).transmittance(mu), 1, 1e-6);
    }
    EXPECT_EQ(DielectricFresnel<float>(1.0f).average_reflectance(), 0);
}

TEST(DielectricFresnel, all_is_reflected_beyond_the_critical_angle)
{
    for (double eta : {0.25, 1 / 1.5, 0.999})
    {
        const DielectricFresnel<double> F(eta);
        const double critical = std::sqrt(1 - eta * eta);
        for (double share : {0.0, 0.3, 0.999})
        {
            EXPECT_EQ(F.reflectance(share * critical), 1);
            EXPECT_EQ(F.transmittance(share * critical), 0);
        }
        EXPECT_LT(F.reflectance(1.001 * critical), 1);
    }
}

TEST(DielectricFresnel, average_is_the_integral)
{
    const auto rule = luts::gauss_legendre(64);
    for (double eta : {0.01, 0.25, 1 / 2.0, 1 / 1.5, 1 / 1.01, 0.99999, 1.00001, 1.01, 1.2, 1.5,
                       1.9999, 2.0, 2.5, 4.0, 20.0, 100.0})
    {
        // Nodes gather at grazing, and where total reflection ends.
        const double start = eta < 1 ? std::sqrt(1 - eta * eta) : 0;
        long double sum = 0;
        for (std::size_t i = 0; i < rule.x.size(); ++i)
        {
            const double x = rule.x[i], x3 = x * x * x, mu = start + (1 - start) * x3 * x3;
            sum += (long double)rule.weight[i] * 2 * mu * 6 * x3 * x * x * (1 - start) *
                   textbook(mu, eta).T;
        }
        const DielectricFresnel<double> F(eta);
        EXPECT_NEAR(F.average_transmittance() / double(sum), 1, 1e-9) << eta;
        EXPECT_NEAR(F.average_reflectance(), double(1 - sum), 1e-9) << eta;
        const float e = float(eta);
        const DielectricFresnel<double> same(static_cast<double>(e));
        EXPECT_NEAR(DielectricFresnel<float>(e).average_reflectance(), same.average_reflectance(),
                    1e-6);
        EXPECT_NEAR(
            DielectricFresnel<float>(e).average_transmittance() / same.average_transmittance(), 1,
            2e-6);
    }
}

// 1 - F_ss(eta) = eta^2 (1 - F_ss(1 / eta)), by reciprocity; F_ss(1.5) by the closed form of Egan
// and Hilgeman 1973.
TEST(DielectricFresnel, average_has_its_known_values)
{
    EXPECT_NEAR(DielectricFresnel<double>(1.5).average_reflectance(), 0.0917780, 1e-6);
    for (double eta : {1.0001, 1.3, 1.99, 2.01, 10.0})
        EXPECT_NEAR(DielectricFresnel<double>(eta).average_transmittance(),
                    eta * eta * DielectricFresnel<double>(1 / eta).average_transmittance(), 1e-12);
    // Both forms meet.
    EXPECT_NEAR(DielectricFresnel<double>(std::nextafter(2.0, 1.0)).average_reflectance(),
                DielectricFresnel<double>(2.0).average_reflectance(), 1e-10);
}

TEST(DielectricFresnel, a_vector_answers_as_a_float_does)
{
    using Batch = xsimd::batch<float>;
    alignas(64) float R[Batch::size], average[Batch::size];
    for (double eta : indices)
        for (float mu : {0.0f, 0.01f, 0.3f, 0.8f, 1.0f})
        {
            const DielectricFresnel<Batch> F{Batch(float(eta))};
            F.reflectance(Batch(mu)).store_aligned(R);
            F.average_reflectance().store_aligned(average);
            const DielectricFresnel<float> scalar{float(eta)};
            EXPECT_NEAR(R[0], scalar.reflectance(mu), 1e-6);
            EXPECT_NEAR(average[0], scalar.average_reflectance(), 1e-6);
        }
}

}  // namespace
