// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Conductors by reflectivity and edge tint.

#include "../support/closures.h"
#include "../support/hostile.h"

#include <regain/closures/artist_fresnel.h>
#include <regain/closures/xsimd.h>

#include <gtest/gtest.h>

using namespace regain;
using namespace regain::tests;

namespace {

template <class Real>
ArtistFresnel<Real> grey(double r, double g)
{
    return {Color3<Real>(Real(r)), Color3<Real>(Real(g))};
}

TEST(ArtistFresnel, reflects_its_reflectivity_at_normal_incidence)
{
    for (double r : {0.0, 0.01, 0.2, 0.5, 0.9, 0.99, 0.999})
        for (double g : {0.0, 0.3, 0.7, 1.0})
        {
            EXPECT_NEAR(grey<double>(r, g).at(1).x, r, 1e-12) << r << " " << g;
            EXPECT_NEAR(grey<float>(r, g).at(1).x, r, 2e-6) << r << " " << g;
            EXPECT_EQ(grey<double>(r, g).normal_incidence().x, r);
        }
}

// Gulbrandsen's formulas as printed.
TEST(ArtistFresnel, n_and_k_are_gulbrandsens)
{
    for (double r : {0.05, 0.3, 0.8, 0.98})
        for (double g : {0.0, 0.25, 0.5, 1.0})
        {
            const double root = std::sqrt(r);
            const double n = g * (1 - r) / (1 + r) + (1 - g) * (1 + root) / (1 - root);
            const double k2 = ((n + 1) * (n + 1) * r - (n - 1) * (n - 1)) / (1 - r);
            const auto conductor = grey<double>(r, g).conductor();
            EXPECT_NEAR(conductor.n().x, n, 1e-10 * n);
            EXPECT_NEAR(conductor.k().x, std::sqrt(std::max(0.0, k2)), 1e-6);
        }
}

// Gold at 650 nm, Johnson and Christy 1972: its r, and the g that gives its n.
TEST(ArtistFresnel, every_conductor_has_its_two_colours)
{
    const double n = 0.16, k = 3.46;
    const double r = ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k);
    const double largest = (1 + std::sqrt(r)) / (1 - std::sqrt(r)), smallest = (1 - r) / (1 + r);
    const auto artist = grey<double>(r, (largest - n) / (largest - smallest));
    EXPECT_NEAR(artist.conductor().n().x, n, 1e-10);
    EXPECT_NEAR(artist.conductor().k().x, k, 1e-10);
    const ConductorFresnel<double> metal{Color3<double>(n), Color3<double>(k)};
    for (double mu : {0.01, 0.2, 0.7}) EXPECT_NEAR(artist.at(mu).x, metal.at(mu).x, 1e-10);
}

// The more g, the more the edge stays white; r alone decides the middle.
TEST(ArtistFresnel, edge_tint_brightens_the_edge)
{
    for (double r : {0.3, 0.9})
        for (double g = 0; g < 0.95; g += 0.1)
            EXPECT_LT(grey<double>(r, g).at(0.2).x, grey<double>(r, g + 0.1).at(0.2).x)
                << r << " " << g;
}

TEST(ArtistFresnel, stays_within_zero_and_one_whatever_comes_in)
{
    Hostile<float> hostile(77);
    const Trapped trapped;
    for (int i = 0; i < 200000; ++i)
    {
        const ArtistFresnel<float> F(hostile.color(), hostile.color());
        const auto at = F.at(float(i) / 200000), average = F.average();
        ASSERT_TRUE(sane(at) && sane(average));
        for (int c = 0; c < 3; ++c) ASSERT_LE(std::max(at[c], average[c]), 1.0001f);
    }
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(ArtistFresnel<float>(Color3<float>(nan), Color3<float>(nan)).reflectivity().x, 0);
    EXPECT_EQ(ArtistFresnel<float>(Color3<float>(2), Color3<float>(7)).edge_tint().x, 1);
}

TEST(ArtistFresnel, a_vector_of_floats_answers_as_a_float_does)
{
    using Batch = xsimd::batch<float>;
    for (float r : {0.0f, 0.4f, 0.95f, 1.0f})
        for (float g : {0.0f, 0.5f, 1.0f})
        {
            alignas(64) float lane[Batch::size];
            const ArtistFresnel<Batch> wide{Color3<Batch>(Batch(r)), Color3<Batch>(Batch(g))};
            const ArtistFresnel<float> narrow{Color3<float>(r), Color3<float>(g)};
            wide.at(Batch(0.3f)).x.store_aligned(lane);
            EXPECT_NEAR(lane[0], narrow.at(0.3f).x, 1e-6);
            wide.exact_average().x.store_aligned(lane);
            EXPECT_NEAR(lane[0], narrow.exact_average().x, 1e-5);
        }
}

}  // namespace
