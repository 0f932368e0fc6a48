// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Albedos of rough dielectrics against known numbers, reciprocity and the closures' own rule of
// which directions a facet joins.

#include "../support/closures.h"
#include "../support/glass.h"

#include <regain/closures/beckmann.h>
#include <regain/closures/dielectric.h>
#include <regain/closures/gtr.h>
#include <regain/closures/std.h>
#include <regain/luts/albedo_integral.h>
#include <regain/luts/dielectric_integral.h>
#include <regain/luts/quadrature.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace regain;
using namespace regain::luts;

namespace {

// By the random walk's first bounce and by quadrature of the closed forms over outgoing
// directions, to three digits: GGX, alpha 1, eta 1.5, mu 0.1; E^T of Beckmann there.
TEST(DielectricIntegral, matches_known_values)
{
    const DielectricAlbedo ggx = dielectric_albedo(SlopeLaw::ggx(1), 0.1, 1.5);
    EXPECT_NEAR(ggx.reflected + ggx.transmitted_beta, 0.164, 6e-4);
    EXPECT_NEAR(ggx.reflected + ggx.transmitted_correlated, 0.741, 6e-4);
    const DielectricAlbedo beckmann = dielectric_albedo(SlopeLaw::beckmann(1), 0.1, 1.5);
    EXPECT_NEAR(beckmann.transmitted_beta, 0.517, 6e-4);
    EXPECT_NEAR(beckmann.transmitted_correlated, 0.810, 6e-4);
}

TEST(DielectricIntegral, an_opaque_index_is_the_mirror)
{
    for (double alpha : {1e-3, 0.3, 1.0})
        for (double mu : {0.01, 0.2, 0.9})
            EXPECT_NEAR(dielectric_albedo(SlopeLaw::ggx(alpha), mu, 1e9).reflected,
                        ggx_albedo(mu, alpha), 1e-6);
}

// What gets through from one side gets through from the other, per unit of etendue:
// Tavg(eta) = eta^2 Tavg(1 / eta), in both forms of shadowing.
TEST(DielectricIntegral, average_transmission_is_reciprocal)
{
    const QuadratureRule rule = gauss_legendre(48);
    const auto averages = [&](double alpha, double eta) {
        double correlated = 0, beta = 0;
        for (std::size_t i = 0; i < rule.x.size(); ++i)
        {
            const double t = rule.x[i], mu = t * t * t * (10 - 15 * t + 6 * t * t);
            const double weight = rule.weight[i] * 30 * t * t * (1 - t) * (1 - t) * 2 * mu;
            const DielectricAlbedo a = dielectric_albedo(SlopeLaw::ggx(alpha), mu, eta, 20);
            correlated += weight * a.transmitted_correlated;
            beta += weight * a.transmitted_beta;
        }
        return std::make_pair(correlated, beta);
    };
    for (double alpha : {0.5, 1.0})
        for (double eta : {1.01, 1.5, 4.0})
        {
            const auto [in, in_beta] = averages(alpha, eta);
            const auto [out, out_beta] = averages(alpha, 1 / eta);
            EXPECT_NEAR(in, eta * eta * out, 1e-4) << alpha << " " << eta;
            EXPECT_NEAR(in_beta, eta * eta * out_beta, 1e-4) << alpha << " " << eta;
        }
}

// Light from all sides, reciprocal and without loss, keeps 1 - 1 / eta^2 of what is inside; single
// scattering keeps so much less that what scales it to that has no bound: docs/methods.md.
TEST(DielectricIntegral, no_bounded_gain_balances_glass)
{
    const auto least_gain = [](double alpha, double eta) {
        const QuadratureRule rule = gauss_legendre(24);
        double reflected = 0;
        for (std::size_t i = 0; i < rule.x.size(); ++i)
        {
            const double x = rule.x[i], mu = x * x;
            reflected += rule.weight[i] * 2 * x * 2 * mu *
                         dielectric_albedo(SlopeLaw::ggx(alpha), mu, 1 / eta, 14).reflected;
        }
        return (1 - 1 / (eta * eta)) / reflected;
    };
    EXPECT_NEAR(least_gain(0.1, 1.5), 0.991, 0.01);
    EXPECT_NEAR(least_gain(1, 1.5), 4.11, 0.05);
    EXPECT_NEAR(least_gain(1, 1.1), 12.1, 0.2);
    EXPECT_GT(least_gain(1, 1.01), 80);
    EXPECT_GT(least_gain(1, 1.001), 600);
}

TEST(DielectricIntegral, has_converged)
{
    for (double alpha : {1e-3, 0.05, 1.0})
        for (double mu : {0.02, 0.3, 0.745356, 1.0})
            for (double eta : {1.0001, 1 / 1.0001, 1.5, 1 / 1.5, 4.0, 0.25})
            {
                const SlopeLaw law = SlopeLaw::ggx(alpha);
                const DielectricAlbedo coarse = dielectric_albedo(law, mu, eta, 24),
                                       fine = dielectric_albedo(law, mu, eta, 40);
                EXPECT_NEAR(coarse.reflected, fine.reflected, 2e-6);
                EXPECT_NEAR(coarse.transmitted_correlated, fine.transmitted_correlated, 2e-6);
                EXPECT_NEAR(coarse.transmitted_beta, fine.transmitted_beta, 2e-6);
            }
}

// Heavy tails, too: of STD at gamma 1.51 half of what is seen are facets steeper than 1e12, and all
// that is refracted by them has to be there.
TEST(DielectricIntegral, has_converged_for_every_law)
{
    const auto expect_converged = [](const SlopeLaw& law, double tolerance) {
        for (double mu : {0.02, 0.3, 1.0})
            for (double eta : {1.0001, 1 / 1.0001, 1.5, 1 / 1.5, 4.0, 0.25})
            {
                const DielectricAlbedo coarse = dielectric_albedo(law, mu, eta, 24),
                                       fine = dielectric_albedo(law, mu, eta, 60);
                const double E = fine.reflected + fine.transmitted_correlated;
                EXPECT_NEAR(coarse.reflected + coarse.transmitted_correlated, E, tolerance * E)
                    << mu << " " << eta;
                EXPECT_NEAR(coarse.transmitted_beta, fine.transmitted_beta, tolerance)
                    << mu << " " << eta;
            }
    };
    for (double alpha : {1e-3, 0.1, 1.0})
    {
        for (double gamma : {0.01, 1.0, 10.0}) expect_converged(SlopeLaw::gtr(alpha, gamma), 2e-6);
        for (double gamma : {2.5, 100.0}) expect_converged(SlopeLaw::std(alpha, gamma), 2e-6);
        expect_converged(SlopeLaw::beckmann(alpha), 2e-6);
        for (double gamma : {1.51, 1.6}) expect_converged(SlopeLaw::std(alpha, gamma), 1e-4);
    }
}

// The closure's samples are another way to the same numbers, and go by the closures' rule of which
// directions a facet joins.
template <class Distribution>
void expect_samples_agree(const Distribution& distribution, const SlopeLaw& law)
{
    constexpr int n = 1 << 16;
    // Four standard errors of the mean of what lies in [0, 1].
    const auto bound = [](double mean) { return 4 * std::sqrt(mean * (1 - mean) / n) + 1e-5; };
    for (double mu : {0.02, 0.3, -0.02, -0.3, -1.0})
    {
        const double eta = 1.5;
        const Dielectric<Distribution> lobe(distribution, eta);
        const tests::SampleSums sampled = tests::sum_samples(lobe.prepare(tests::sided(mu)), n);
        const DielectricAlbedo a = dielectric_albedo(law, std::abs(mu), mu > 0 ? eta : 1 / eta);
        EXPECT_NEAR(sampled.reflected, a.reflected, bound(a.reflected)) << mu;
        EXPECT_NEAR(sampled.transmitted, a.transmitted_correlated, bound(a.transmitted_correlated))
            << mu;
    }
}

TEST(DielectricIntegral, agrees_with_samples_of_closures_with_a_tail)
{
    for (double alpha : {0.1, 1.0})
    {
        for (double gamma : {1.51, 1.6, 3.0})
            expect_samples_agree(STD<double>(alpha, gamma), SlopeLaw::std(alpha, gamma));
        for (double gamma : {0.5, 1.3, 10.0})
            expect_samples_agree(GTR<double>(alpha, gamma), SlopeLaw::gtr(alpha, gamma));
    }
}

TEST(DielectricIntegral, agrees_with_samples_of_the_closure)
{
    for (double alpha : {0.2, 1.0})
        for (double mu : {0.1, 0.8, -0.4, -0.8})
            for (const TransmissionShadowing shadowing :
                 {TransmissionShadowing::correlated, TransmissionShadowing::beta})
            {
                const double eta = 1.5;
                const Color3<double> white(1);
                const Dielectric<GGX<double>> lobe(GGX<double>(alpha), eta, ScatterMode::RT, white,
                                                   white, shadowing);
                Vec3<double> wo = tests::direction<double>(std::abs(mu));
                wo.z = mu;
                const Albedo<double> sampled = lobe.prepare(wo).albedo();
                const DielectricAlbedo a =
                    dielectric_albedo(SlopeLaw::ggx(alpha), std::abs(mu), mu > 0 ? eta : 1 / eta);
                EXPECT_NEAR(sampled.reflect.x, a.reflected, 8e-3) << alpha << " " << mu;
                EXPECT_NEAR(sampled.transmit.x,
                            shadowing == TransmissionShadowing::beta ? a.transmitted_beta
                                                                     : a.transmitted_correlated,
                            8e-3)
                    << alpha << " " << mu;
            }
}

}  // namespace
