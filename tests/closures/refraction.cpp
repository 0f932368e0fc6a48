// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Directions through a facet: Snell's law, its inverse, and the rule for which pairs it joins.

#include "../support/closures.h"

#include <regain/closures/refraction.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace regain;
using namespace regain::tests;

namespace {

constexpr double indices[] = {1e-2,  0.25, 1 / 1.5, 1 / 1.001, 1 / 1.00001, 1.00001,
                              1.001, 1.05, 1.5,     2.4,       4,           1e2};

// A facet's normal seen from wo.
template <class Real>
Vec3<Real> facet(Random& random, const Vec3<Real>& wo)
{
    Vec3<Real> m = direction<Real>(random.unit(), 7 * random.unit());
    return m.dot(wo) < 0 ? Vec3<Real>(-m) : m;
}

// Snell's law in its plainest form, in double: sines and the plane of incidence.
Vec3<double> snell(const Vec3<double>& wo, const Vec3<double>& m, double eta)
{
    const double c = wo.dot(m), sine2 = (1 - c * c) / (eta * eta);
    return (m * c - wo) / eta - m * std::sqrt(1 - sine2);
}

TEST(Refraction, follows_snells_law)
{
    Random random(5);
    for (double eta : indices)
        for (int i = 0; i < 2000; ++i)
        {
            const auto wo = direction<double>(random.unit(), 7 * random.unit());
            const auto m = facet(random, wo);
            const auto r = refract(wo, m, eta);
            const double c = wo.dot(m), sine2 = (1 - c * c) / (eta * eta);
            if (std::abs(sine2 - 1) < 1e-9) continue;
            ASSERT_EQ(r.valid, sine2 < 1);
            EXPECT_NEAR(r.wi.length(), 1, 1e-14);
            if (!r.valid) continue;
            EXPECT_LT((r.wi - snell(wo, m, eta)).length(), 1e-12 + 1e-15 / std::abs(1 - sine2));
            EXPECT_NEAR(r.cosine, -r.wi.dot(m), 1e-12);

            const float f = float(eta);
            const Vec3<float> wof(wo), mf(m);
            const auto s = refract(wof, mf, f);
            if (!s.valid || sine2 > 0.999) continue;
            EXPECT_LT((Vec3<double>(s.wi) - snell(wo, m, double(f))).length(),
                      5e-6 * std::max(1.0, 1 / eta));
        }
}

// What is bent by an index near 1 is small, and known to a fraction of itself.
TEST(Refraction, keeps_the_digits_of_a_small_deflection)
{
    Random random(6);
    for (double excess : {1e-6, 1e-8, 1e-10})
        for (int i = 0; i < 500; ++i)
        {
            const auto wo = direction<double>(0.2 + 0.8 * random.unit(), 7 * random.unit());
            auto m = facet(random, wo);
            const double c = wo.dot(m);
            if (c < 0.1) continue;
            const auto r = refract(wo, m, RelativeIndex<double>{1 + excess, excess});
            // To first order wo turns by excess tan theta.
            const double turned = (r.wi + wo).length(),
                         expected = excess * std::sqrt(1 - c * c) / c;
            EXPECT_NEAR(turned, expected, 1e-4 * expected + 1e-15);
        }
}

TEST(Refraction, goes_back_the_way_it_came)
{
    Random random(7);
    for (double eta : indices)
        for (int i = 0; i < 1000; ++i)
        {
            const auto wo = direction<double>(random.unit(), 7 * random.unit());
            const auto m = facet(random, wo);
            const auto index = RelativeIndex<double>::of(eta);
            const auto there = refract(wo, m, index);
            if (!there.valid || there.cosine < 1e-3) continue;
            const auto back = refract(there.wi, Vec3<double>(-m), index.inverse());
            ASSERT_TRUE(back.valid);
            EXPECT_LT((back.wi - wo).length(), 1e-8);
        }
}

// The facet is known from the directions: as well as they are in the number type, over |eta - 1|.
TEST(Refraction, half_vector_is_the_facet)
{
    Random random(8);
    for (double eta : {0.25, 1 / 1.5, 1 / 1.001, 1.001, 1.05, 1.5, 4.0})
        for (int i = 0; i < 2000; ++i)
        {
            const auto wo = direction<double>(random.unit(), 7 * random.unit());
            const auto m = facet(random, wo);
            const auto index = RelativeIndex<double>::of(eta);
            const auto r = refract(wo, m, index);
            if (!r.valid) continue;
            const auto h = detail::refraction_half_vector(wo, r.wi, index);
            EXPECT_LT((h.normalized() - m).length(), 1e-14 / std::abs(eta - 1) + 1e-13);

            const auto index_f = RelativeIndex<float>::of(float(eta));
            const Vec3<float> wof(wo);
            const auto s = refract(wof, Vec3<float>(m), index_f);
            if (!s.valid) continue;
            const auto hf = detail::refraction_half_vector(wof, s.wi, index_f);
            EXPECT_LT((Vec3<double>(hf).normalized() - m).length(),
                      6e-7 / std::abs(eta - 1) + 5e-6);
        }
}

TEST(Refraction, a_facet_joins_the_pairs_it_scatters_and_no_others)
{
    Random random(9);
    int reflections = 0, transmissions = 0;
    for (int i = 0; i < 20000; ++i)
    {
        const double eta = indices[random.bits() % 12];
        auto wo = direction<double>(random.unit(), 7 * random.unit());
        auto m = direction<double>(random.unit(), 7 * random.unit());
        if (i % 2)
        {
            wo.z = -wo.z;
            m.z = -m.z;
        }
        const auto mirrored = reflect(wo, m);
        const bool faces = wo.dot(m) > 0;
        const double side = wo.z > 0 ? 1 : -1;
        EXPECT_EQ(is_reflection(wo, mirrored, m), faces && mirrored.z * side > 1e-12);
        EXPECT_FALSE(is_transmission(wo, mirrored, m));
        reflections += is_reflection(wo, mirrored, m);

        const auto r = refract(wo, m, eta);
        if (!r.valid) continue;
        EXPECT_EQ(is_transmission(wo, r.wi, m), r.wi.z * side < -1e-12);
        EXPECT_FALSE(is_reflection(wo, r.wi, m));
        transmissions += is_transmission(wo, r.wi, m);
        // A facet seen from the other side of the surface is no facet.
        EXPECT_FALSE(is_transmission(wo, r.wi, Vec3<double>(-m)));
    }
    EXPECT_GT(reflections, 4000);
    EXPECT_GT(transmissions, 2000);
}

TEST(Refraction, hostile_directions_join_nothing)
{
    const Vec3<double> up(0, 0, 1), along(1, 0, 0), grazing(1, 0, 1e-13);
    for (const auto& wi : {along, grazing, Vec3<double>(0.0)})
    {
        EXPECT_FALSE(is_reflection(up, wi, up));
        EXPECT_FALSE(is_transmission(up, Vec3<double>(-wi), up));
    }
    EXPECT_EQ(RelativeIndex<float>::of(NAN).eta, 1.5f);
    EXPECT_EQ(RelativeIndex<float>::of(-1.0f).eta, 0.01f);
    EXPECT_EQ(RelativeIndex<float>::of(INFINITY).eta, 100.0f);
}

}  // namespace
