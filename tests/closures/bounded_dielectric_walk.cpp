// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The walk of bounded cost through an interface: it is the plain walk but for what lies beyond its
// bound, R + T = 1, and its pdf is near its density.

#include "../support/walk_cells.h"

#include <regain/closures/bounded_dielectric_walk.h>
#include <regain/closures/dielectric_walk.h>
#include <regain/closures/walk_orders.h>
#include <regain/luts/library.h>

#include <gtest/gtest.h>

#include <string>

using namespace regain;
using namespace regain::tests;

namespace {

const double pi = std::acos(-1.0);
const Color3<double> white_color(1.0);

template <class Distribution>
DielectricWalk<Distribution> plain_glass(const Distribution& distribution, double eta)
{
    return {distribution, eta};
}
template <class Distribution>
BoundedDielectricWalk<Distribution> glass(const Distribution& distribution, double eta,
                                          int bounces = default_bounces, int eval_samples = 1,
                                          const DielectricTables& tables = {},
                                          const MicrofacetTables& shape = {})
{
    return {distribution, eta, white_color, white_color, eval_samples, tables, shape, bounces};
}

TEST(BoundedDielectricWalk, loses_nothing_within_its_bound)
{
    for_each_distribution<double>([](const auto& distribution, const char* name) {
        Random random(1);
        for (double eta : {1.0, 1.0001, 1.5, 4.0, 1 / 1.5, 0.25})
            for (double mu : {1e-6, 0.2, 1.0, -0.02, -0.7})
                for (int bounces : {2, 16})
                {
                    const auto prepared =
                        glass(distribution, eta, bounces).prepare(direction<double>(mu, 2.1));
                    for (int i = 0; i < 150; ++i)
                    {
                        const auto u = random.cube<double>();
                        const auto s = prepared.sample(u);
                        ASSERT_TRUE(s.valid) << name << ", eta " << eta << ", mu " << mu;
                        ASSERT_EQ(s.weight.y, 1.0);
                        ASSERT_GT(s.pdf, 0.0);
                        ASSERT_EQ(s.transmitted, s.wi.z * mu < 0);
                        ASSERT_LE(prepared.path(u).bounces, bounces);
                    }
                }
    });
}

// Until it ends it is the plain walk, number by number.
TEST(BoundedDielectricWalk, walks_as_the_plain_walk)
{
    for_each_distribution<double>([](const auto& distribution, const char* name) {
        Random random = random_of_test(name);
        for (double mu : {0.3, -0.8})
        {
            const auto wo = direction<double>(mu, 0.7);
            const auto plain = plain_glass(distribution, 1.5).prepare(wo);
            const auto bounded = glass(distribution, 1.5, 8).prepare(wo);
            for (int i = 0; i < 1500; ++i)
            {
                const auto u = random.cube<double>();
                const auto p = plain.path(u), q = bounded.path(u);
                if (p.bounces > 8) continue;
                ASSERT_EQ(p.bounces, q.bounces);
                ASSERT_EQ(p.transmitted, q.transmitted);
                ASSERT_NEAR((p.wi - q.wi).length(), 0, 1e-9);
            }
        }
    });
}

// The mean of eval is where samples of the plain walk fall, on either side.
TEST(BoundedDielectricWalk, mean_of_eval_is_the_plain_walk)
{
    const DirectionCells cells{12, 10, -1};
    for_each_distribution<double>([&](const auto& distribution, const char* name) {
        // The core of this one is too narrow for such cells.
        if (std::string(name) == "STD, anisotropic") return;
        for (double mu : {0.6, -0.5})
        {
            const auto wo = direction<double>(mu, 0.4);
            expect_samples_where_eval_says(cells, plain_glass(distribution, 1.6).prepare(wo),
                                           glass(distribution, 1.6, 32).prepare(wo), 40000, 512,
                                           std::string(name) + (mu > 0 ? " entering" : " leaving"),
                                           0.02);
        }
    });
}

// Of its own, too, where much goes on beyond the bound.
TEST(BoundedDielectricWalk, samples_fall_where_eval_says)
{
    const DirectionCells cells{12, 10, -1};
    for (double mu : {0.2, -0.9})
    {
        const auto prepared =
            glass(GGX<double>(0.9, 0.6), 1.5, 5).prepare(direction<double>(mu, 0.4));
        expect_samples_where_eval_says(cells, prepared, prepared, 200000, 2048,
                                       "mu " + std::to_string(mu), 0.02);
    }
}

TEST(BoundedDielectricWalk, bound_moves_little)
{
    const GGX<double> ggx(1);
    for (double mu : {0.5, -0.5})
    {
        const auto wo = direction<double>(mu);
        const double plain =
            walk_orders(plain_glass(ggx, 1.5).prepare(wo), 200000).total().reflect.x;
        // Standard errors are 1.1e-3; the numbers are the same.
        EXPECT_NEAR(walk_orders(glass(ggx, 1.5, 8).prepare(wo), 200000).total().reflect.x, plain,
                    2e-3);
        EXPECT_NEAR(walk_orders(glass(ggx, 1.5, 16).prepare(wo), 200000).total().reflect.x, plain,
                    1e-4);
    }
}

// f(wo, wi) = eta_o^2 f(wi, wo), eta_o seen from wo; 1 on the same side.
TEST(BoundedDielectricWalk, mean_eval_is_reciprocal_with_eta_squared)
{
    for_each_distribution<double>([](const auto& distribution, const char* name) {
        const double eta = 1.5;
        const auto walk = glass(distribution, eta, 32);
        EXPECT_TRUE(walk.traits().reciprocal);
        Random random = random_of_test(name);
        for (int pair = 0; pair < 4; ++pair)
        {
            const double side_a = pair % 2 ? -1 : 1, side_b = pair < 2 ? -side_a : side_a;
            const auto a = direction<double>(side_a * (0.2 + 0.8 * random.unit()), 1.0);
            const auto b = direction<double>(side_b * (0.2 + 0.8 * random.unit()), 3.5);
            const double factor = side_a == side_b ? 1 : side_a > 0 ? eta * eta : 1 / (eta * eta);
            Mean there, back;
            const auto from_a = walk.prepare(a), from_b = walk.prepare(b);
            for (int i = 0; i < 4000; ++i)
            {
                there.add(from_a.eval(b, random.cube<double>()).x / std::abs(b.z));
                back.add(factor * from_b.eval(a, random.cube<double>()).x / std::abs(a.z));
            }
            // A few joined paths weigh so much that the error cannot be told from those there are.
            EXPECT_NEAR(there.value(), back.value(),
                        4.5 * std::hypot(there.error(), back.error()) + 0.02 * back.value())
                << name << ", " << a << ", " << b;
        }
    });
}

// With tables as well as these know the sum of the beta form; without, exactly.
TEST(BoundedDielectricWalk, pdf_integrates_to_one)
{
    for (double mu : {0.3, 0.9, -0.4, -1.0})
        EXPECT_NEAR(
            integral_of_pdf(glass(GGX<double>(0.7, 0.5), 1.5).prepare(direction<double>(mu, 0.3)),
                            200000),
            1, 1e-3)
            << mu;
    const auto tables = luts::dielectric_tables("ggx", TransmissionShadowing::beta);
    MicrofacetTables shape = luts::microfacet_tables("ggx");
    luts::add_later_shape(shape, "ggx");
    for (double eta : {1.1, 1.5, 2.4})
        for (double mu : {0.3, 0.9, -0.4, -1.0})
            EXPECT_NEAR(integral_of_pdf(glass(GGX<double>(0.6), eta, 16, 1, tables, shape)
                                            .prepare(direction<double>(mu, 0.3)),
                                        200000),
                        1, 3e-3)
                << "eta " << eta << ", mu " << mu;
}

// What is fitted, whatever it is asked for: it integrates to 1 by its form.
TEST(BoundedDielectricWalk, density_of_later_bounces_integrates_to_one)
{
    constexpr int rows = 120, columns = 240;
    for (double alpha : {0.02, 0.4, 1.0})
        for (double forward : {0.0, 0.5, 1.0})
            for (double eta : {0.2, 1 / 1.5, 0.999, 1.0, 1.1, 4.0})
                for (double mu : {0.0, 0.5, 1.0})
                {
                    const detail::LaterDielectricDensity<double> later(alpha, forward, eta, mu);
                    const auto wo = direction<double>(mu, 0.3);
                    double sum = 0, least = 1;
                    for (int i = 0; i < rows * columns; ++i)
                    {
                        // More of them along the horizon and the normal.
                        const double x = (i / columns + 0.5) / rows;
                        const double z = x * x * (3 - 2 * x);
                        const auto wi =
                            direction<double>(z, 0.3 + pi * (1 + (i % columns + 0.5) / columns));
                        const double reflected = later.at(wo, wi, false),
                                     transmitted = later.at(wo, wi, true);
                        sum += (reflected + transmitted) * 6 * x * (1 - x);
                        least = std::min(least, std::min(reflected, transmitted) / z);
                    }
                    EXPECT_NEAR(sum * 2 * pi / (rows * columns), 1, 1e-3)
                        << alpha << ' ' << forward << ' ' << eta << ' ' << mu;
                    EXPECT_GE(least, 0.03 / (2 * pi));
                }
}

// With the tables of its distribution.
template <class Distribution>
BoundedDielectricWalk<Distribution> known_glass(const Distribution& distribution, const char* name,
                                                double eta)
{
    MicrofacetTables shape = luts::microfacet_tables(name);
    luts::add_later_shape(shape, name);
    return glass(distribution, eta, 16, 1,
                 luts::dielectric_tables(name, TransmissionShadowing::beta), shape);
}

// L1 distance of the pdf to the density of samples, in the mean over wo that are cosine-weighted;
// the light of later facets alone, for what is not that is exact.
template <class Distribution>
double mean_distance(const Distribution& distribution, const char* name, double eta, double side)
{
    const auto walk = known_glass(distribution, name, eta);
    const Dielectric<Distribution> single(distribution, eta, ScatterMode::RT, white_color,
                                          white_color, TransmissionShadowing::beta);
    double sum = 0;
    for (int i = 0; i < 4; ++i)
    {
        const auto wo = direction<double>(side * std::sqrt((i + 0.5) / 4), 0.3);
        const auto prepared = walk.prepare(wo);
        const auto once = single.prepare(wo);
        sum += distance_to_samples(
                   {20, 16, -1}, prepared, 40000, [](const auto& p) { return p.bounces > 1; },
                   [&](const auto& wi) { return prepared.pdf(wi) - once.eval(wi).x; }) /
               4;
    }
    return sum;
}

// From either side, near index 1 and far from it. The samples add up to 0.03.
TEST(BoundedDielectricWalk, pdf_is_near_the_density)
{
    const auto check = [](const auto& distribution, const char* name, double alpha) {
        for (double eta : {1.1, 1.33, 3.0})
        {
            const double outside = mean_distance(distribution, name, eta, 1),
                         inside = mean_distance(distribution, name, eta, -1);
            EXPECT_LT(outside, 0.02 + 0.05 * alpha) << name << ' ' << alpha << ", eta " << eta;
            EXPECT_LT(inside, 0.03 + 0.07 * alpha) << name << ' ' << alpha << ", eta " << eta;
        }
    };
    for (double alpha : {0.25, 1.0})
    {
        check(GGX<double>(alpha), "ggx", alpha);
        check(Beckmann<double>(alpha), "beckmann", alpha);
    }
}

// The second moment of the weights that a host has which divides by the pdf, over the square of the
// mean, in cells: what is not seen by the mean of deviations.
TEST(BoundedDielectricWalk, pdf_keeps_weights_bounded)
{
    const DirectionCells cells{24, 20, -1};
    for (double eta : {1.1, 1.5, 2.5})
        for (double mu : {0.1, 0.7, -0.1, -0.3, -0.95})
        {
            const auto prepared =
                known_glass(GGX<double>(0.7), "ggx", eta).prepare(direction<double>(mu, 0.3));
            const int samples = 40000;
            std::vector<double> share(std::size_t(cells.size()));
            Random random = random_of_test();
            for (int i = 0; i < samples; ++i)
                share[cells.of(prepared.sample(random.cube<double>()).wi)] += 1.0 / samples;
            double square = 0, largest = 0;
            for (int cell = 0; cell < cells.size(); ++cell)
            {
                double density = 0;
                for (int i = 0; i < 64; ++i)
                    density += prepared.pdf(
                                   cells.direction_in(cell, (i / 8 + 0.5) / 8, (i % 8 + 0.5) / 8)) *
                               cells.area() / 64;
                const double found = share[std::size_t(cell)];
                square += found * found / density;
                if (found > 1e-3) largest = std::max(largest, found / density);
            }
            EXPECT_LT(square, 1.3) << "eta " << eta << ", mu " << mu;
            EXPECT_LT(largest, 5) << "eta " << eta << ", mu " << mu;
        }
}

TEST(BoundedDielectricWalk, multiple_importance_sampling_is_unbiased)
{
    const auto tables = luts::dielectric_tables("ggx", TransmissionShadowing::beta);
    const auto prepared =
        glass(GGX<double>(0.8), 1.5, 16, 1, tables).prepare(direction<double>(-0.5));
    const auto light = [](const Vec3<double>& w) { return std::pow(std::max(0.0, w.x), 3); };
    const double light_pdf = 1 / (4 * pi);
    Random random(10);
    Mean by_samples, combined;
    for (int i = 0; i < 60000; ++i)
    {
        const auto s = prepared.sample(random.cube<double>());
        by_samples.add(s.weight.x * light(s.wi));
        double sum = s.weight.x * light(s.wi) * s.pdf / (s.pdf + light_pdf);
        const auto wi = direction<double>(2 * random.unit() - 1, 2 * pi * random.unit());
        sum +=
            prepared.eval(wi, random.cube<double>()).x * light(wi) / (prepared.pdf(wi) + light_pdf);
        combined.add(sum);
    }
    EXPECT_NEAR(combined.value(), by_samples.value(),
                4.5 * std::hypot(combined.error(), by_samples.error()));
}

// A tint multiplies all that leaves on its side, whatever it met before.
TEST(BoundedDielectricWalk, tints_multiply_the_sides)
{
    const Color3<double> red(0.9, 0.1, 0.2), blue(0.1, 0.3, 0.8);
    const BoundedDielectricWalk<GGX<double>> tinted(GGX<double>(0.8), 1.5, red, blue);
    const auto wo = direction<double>(-0.4);
    const auto prepared = tinted.prepare(wo), white = glass(GGX<double>(0.8), 1.5).prepare(wo);
    Random random(11);
    for (int i = 0; i < 1000; ++i)
    {
        const auto u = random.cube<double>();
        const auto s = prepared.sample(u);
        EXPECT_EQ(s.weight, s.transmitted ? blue : red);
        EXPECT_EQ(s.wi, white.sample(u).wi);
        const auto wi = direction<double>(2 * random.unit() - 1, 7 * random.unit());
        EXPECT_NEAR(prepared.eval(wi, u).x,
                    (wi.z * wo.z > 0 ? red.x : blue.x) * white.eval(wi, u).x, 1e-12);
    }
}

// At eta 1 there is no surface; a flat one is smooth glass.
TEST(BoundedDielectricWalk, delta_limits)
{
    const auto wo = direction<double>(-0.9);
    const auto flat = glass(GGX<double>(0), 1.5).prepare(wo);
    Random random(12);
    for (int i = 0; i < 1000; ++i)
    {
        const auto s = flat.sample(random.cube<double>());
        ASSERT_TRUE(s.valid && s.delta);
    }
    EXPECT_EQ(flat.eval(direction<double>(0.9), {0.1, 0.2, 0.3}).x, 0);
    for (double mu : {0.9, 1e-3})
    {
        const auto from = direction<double>(-mu);
        const auto nothing = glass(GGX<double>(0.8), 1).prepare(from);
        for (int i = 0; i < 1000; ++i)
        {
            const auto s = nothing.sample(random.cube<double>());
            ASSERT_TRUE(s.valid && s.delta && s.transmitted);
            EXPECT_NEAR((s.wi + from).length(), 0, 1e-9);
        }
    }
}

}  // namespace
