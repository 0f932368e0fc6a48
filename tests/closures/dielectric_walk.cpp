// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The random walk through a rough dielectric: it loses nothing on either side, begins as single
// scattering with the beta form does, and its estimates agree with each other.

#include "../support/cells.h"
#include "../support/dielectric_integral.h"
#include "../support/walks.h"

#include <regain/closures/dielectric_walk.h>
#include <regain/closures/walk_orders.h>

#include <gtest/gtest.h>

#include <vector>

using namespace regain;
using namespace regain::tests;

namespace {

const double pi = std::acos(-1.0);
const Color3<double> white_color(1.0);

template <class Distribution>
DielectricWalk<Distribution> glass(const Distribution& distribution, double eta, int samples = 1)
{
    using Real = typename Distribution::Real;
    const Color3<Real> one(Real(1));
    return {distribution, Real(eta), one, one, samples};
}

// R + T = 1: every weight is 1, so what could be missing is walks.
TEST(DielectricWalk, loses_nothing)
{
    for_each_distribution<double>([](const auto& distribution, const char* name) {
        Random random(1);
        for (double eta : {1.0, 1.0001, 1.5, 4.0, 1 / 1.5, 0.25})
            for (double mu : {1e-6, 0.2, 1.0, -0.02, -0.7})
            {
                const auto prepared = glass(distribution, eta).prepare(direction<double>(mu, 2.1));
                for (int i = 0; i < 300; ++i)
                {
                    const auto s = prepared.sample(random.cube<double>());
                    ASSERT_TRUE(s.valid) << name << ", eta " << eta << ", mu " << mu;
                    ASSERT_EQ(s.weight.y, 1.0);
                    ASSERT_GT(s.pdf, 0.0);
                    ASSERT_EQ(s.transmitted, s.wi.z * mu < 0);
                }
            }
    });
}

// What leaves at the first bounce is what single scattering reflects and transmits, the latter in
// its beta form; of facets tilted either way.
TEST(DielectricWalk, first_bounce_is_single_scattering)
{
    Cells cells;
    for_each_kind<double>([&](const char* kind, const auto& distributions) {
        Random random = random_of_test(kind);
        double eta = 1.2;
        for (const auto& distribution : distributions)
        {
            eta += 0.2;
            for (double mu : {0.3, 0.9, -0.45, -0.95})
            {
                using Distribution = std::decay_t<decltype(distribution)>;
                const auto wo = direction<double>(mu, 0.8 + 5 * mu);
                const Dielectric<Distribution> single(distribution, eta, ScatterMode::RT,
                                                      white_color, white_color,
                                                      TransmissionShadowing::beta);
                const auto once = single.prepare(wo);
                // The facet that joins them, on the side of wo.
                const auto towards = [&](const Vec3<double>& wi) {
                    const double side = mu < 0 ? -1 : 1, eta_o = mu < 0 ? 1 / eta : eta;
                    const Vec3<double> m = wo + wi * (wi.z * mu < 0 ? eta_o : 1.0);
                    return is_tilted_towards(wo, m * (m.z * side < 0 ? -1.0 : 1.0));
                };
                const auto E = integrate_dielectric(
                    wo, eta, distribution.alpha_x(), distribution.alpha_y(), 1e-6,
                    [&](const Vec3<double>& wi) {
                        const double f = once.eval(wi).x;
                        return towards(wi) ? Vec2<double>(f, 0) : Vec2<double>(0, f);
                    });

                constexpr int n = 160000;
                const auto prepared = glass(distribution, eta).prepare(wo);
                std::vector<double> counts(4);
                for (int i = 0; i < n; ++i)
                {
                    const auto p = prepared.path(random.cube<double>());
                    if (p.bounces == 1) ++counts[(p.transmitted ? 2 : 0) + (towards(p.wi) ? 0 : 1)];
                }
                cells.add(kind, place(distribution, mu), n, counts, {E[0], E[1], E[2], E[3]});
            }
        }
    });
    cells.check();
}

// By a walk in heights, in double precision and by another author: GGX, alpha 1.
TEST(DielectricWalk, agrees_with_an_independent_walk)
{
    const auto leaving =
        walk_orders(glass(GGX<float>(1.0f), 1.5).prepare(direction<float>(-1)), 400000);
    EXPECT_NEAR(leaving.total().reflect.x, 0.406, 4e-3);
    EXPECT_NEAR(leaving.total().reflect.x + leaving.total().transmit.x, 1, 1e-4);
    const auto entering =
        walk_orders(glass(GGX<float>(1.0f), 1.5).prepare(direction<float>(0.1)), 400000);
    EXPECT_NEAR(entering.order[0].reflect.x + entering.order[0].transmit.x, 0.164, 3e-3);
}

// Of the light that is transmitted on average, seen from both sides.
TEST(DielectricWalk, average_transmittances_differ_by_eta_squared)
{
    for (double eta : {1.2, 1.5, 2.4})
    {
        constexpr int n = 200000;
        const auto walk = glass(GGX<float>(0.6f), eta);
        Random random(3);
        double T[2] = {};
        for (int i = 0; i < n; ++i)
            for (int side : {0, 1})
            {
                const double mu = std::sqrt((i + 0.5) / n);
                T[side] += walk.prepare(direction<float>(side ? -mu : mu))
                               .path(random.cube<float>())
                               .transmitted;
            }
        const double out = T[1] / n, in = T[0] / n;
        const double sigma =
            std::hypot(std::sqrt(in * (1 - in) / n), eta * eta * std::sqrt(out * (1 - out) / n));
        EXPECT_NEAR(in, eta * eta * out, 4.5 * sigma) << "eta " << eta;
    }
}

TEST(DielectricWalk, integral_of_eval_is_the_mean_weight)
{
    for_each_distribution<double>([](const auto& distribution, const char* name) {
        for (double mu : {0.6, -0.5})
        {
            const auto prepared = glass(distribution, 1.8).prepare(direction<double>(mu, 0.3));
            Random random(4);
            Mean sampled[2], integrated[2];
            constexpr int side = 90;
            for (int i = 0; i < side * side; ++i)
            {
                const bool through = prepared.sample(random.cube<double>()).transmitted;
                sampled[0].add(through ? 0 : 1);
                sampled[1].add(through ? 1 : 0);
                const double z = std::sqrt((i / side + random.unit()) / side),
                             phi = 2 * pi * (i % side + random.unit()) / side;
                for (int beyond : {0, 1})
                {
                    const auto wi = direction<double>((mu > 0) == (beyond == 0) ? z : -z, phi);
                    integrated[beyond].add(prepared.eval(wi, random.cube<double>()).y * pi / z);
                }
            }
            for (int beyond : {0, 1})
                EXPECT_NEAR(integrated[beyond].value(), sampled[beyond].value(),
                            4.5 * std::hypot(integrated[beyond].error(), sampled[beyond].error()))
                    << name << ", mu " << mu << (beyond ? " transmitted" : " reflected");
        }
    });
}

TEST(DielectricWalk, samples_fall_where_eval_says)
{
    for (double mu : {0.5, -0.9})
    {
        const auto prepared = glass(GGX<double>(0.9, 0.6), 1.5).prepare(direction<double>(mu, 0.4));
        constexpr int rows = 8, columns = 12, samples = 200000, evals = 1500;
        std::vector<double> observed(rows * columns);
        Random random(6);
        for (int i = 0; i < samples; ++i)
        {
            const auto wi = prepared.sample(random.cube<double>()).wi;
            const double phi = std::atan2(wi.y, wi.x) / (2 * pi) + 0.5;
            const int row = std::min(int((0.5 * wi.z + 0.5) * rows), rows - 1),
                      column = std::min(int(phi * columns), columns - 1);
            ++observed[std::size_t(row * columns + column)];
        }
        for (int cell = 0; cell < rows * columns; ++cell)
        {
            Mean mean;
            for (int i = 0; i < evals; ++i)
            {
                const double z = 2 * (cell / columns + random.unit()) / rows - 1,
                             phi = ((cell % columns + random.unit()) / columns - 0.5) * 2 * pi;
                mean.add(prepared.eval(direction<double>(z, phi), random.cube<double>()).x);
            }
            const double area = 4 * pi / (rows * columns),
                         share = observed[std::size_t(cell)] / samples;
            const double sigma =
                std::hypot(std::sqrt(share * (1 - share) / samples), area * mean.error());
            EXPECT_NEAR(share, area * mean.value(), 5 * sigma + 1e-5)
                << "mu " << mu << ", cell " << cell;
        }
    }
}

// f(wo, wi) = eta_o^2 f(wi, wo), eta_o seen from wo; 1 on the same side.
TEST(DielectricWalk, mean_eval_is_reciprocal_with_eta_squared)
{
    for_each_distribution<double>([](const auto& distribution, const char* name) {
        const double eta = 1.5;
        const auto walk = glass(distribution, eta);
        EXPECT_TRUE(walk.traits().reciprocal);
        Random random(7);
        for (int pair = 0; pair < 4; ++pair)
        {
            const double side_a = pair % 2 ? -1 : 1, side_b = pair < 2 ? -side_a : side_a;
            const auto a = direction<double>(side_a * (0.2 + 0.8 * random.unit()), 1.0);
            const auto b = direction<double>(side_b * (0.2 + 0.8 * random.unit()), 3.5);
            const double factor = side_a == side_b ? 1 : side_a > 0 ? eta * eta : 1 / (eta * eta);
            Mean there, back;
            const auto from_a = walk.prepare(a), from_b = walk.prepare(b);
            for (int i = 0; i < 6000; ++i)
            {
                there.add(from_a.eval(b, random.cube<double>()).x / std::abs(b.z));
                back.add(factor * from_b.eval(a, random.cube<double>()).x / std::abs(a.z));
            }
            // A few joined paths weigh so much that the error cannot be told from those there are.
            EXPECT_NEAR(there.value(), back.value(),
                        4.5 * std::hypot(there.error(), back.error()) + 0.03 * back.value())
                << name << ", " << a << ", " << b;
        }
    });
}

// For any distribution and index. Over the R2 sequence (Roberts 2018).
TEST(DielectricWalk, pdf_integrates_to_one)
{
    const auto check = [](const auto& distribution, double eta, double mu) {
        const auto prepared = glass(distribution, eta).prepare(direction<double>(mu, 0.3));
        constexpr int n = 400000;
        double sum = 0, u = 0.5, v = 0.5;
        for (int i = 0; i < n; ++i)
        {
            u += 0.7548776662466927;
            v += 0.5698402909980532;
            u -= std::floor(u);
            v -= std::floor(v);
            const double z = u * u * (3 - 2 * u), jacobian = 6 * u * (1 - u);
            sum += prepared.pdf(direction<double>(z, 2 * pi * v)) * jacobian +
                   prepared.pdf(direction<double>(-z, 2 * pi * v)) * jacobian;
        }
        EXPECT_NEAR(sum * 2 * pi / n, 1, 5e-4) << "eta " << eta << ", mu " << mu;
    };
    for (double eta : {1.5, 2.4})
        for (double mu : {0.3, 0.9, -0.4, -1.0}) check(GGX<double>(0.7, 0.5), eta, mu);
    check(Beckmann<double>(0.7), 1.5, 0.6);
    check(GTR<double>(0.7, 1.0), 1.5, 0.6);
    check(STD<double>(0.7, 3.0), 1.5, 0.6);
}

// Pins how near the pdf is: relative rms over samples, of typical glass.
TEST(DielectricWalk, pdf_is_near_the_density)
{
    for (double alpha : {0.25, 0.5})
        for (double mu : {0.5, 0.9})
        {
            const auto prepared =
                glass(GGX<double>(alpha), 1.5, 1000).prepare(direction<double>(mu, 0.3));
            Random random(9);
            double sum = 0;
            constexpr int n = 100;
            for (int i = 0; i < n; ++i)
            {
                const auto s = prepared.sample(random.cube<double>());
                const double relative = s.pdf / prepared.eval(s.wi, random.cube<double>()).x - 1;
                sum += relative * relative;
            }
            EXPECT_LT(std::sqrt(sum / n), 0.4) << "alpha " << alpha << ", mu " << mu;
        }
}

// A tint multiplies all that leaves on its side, whatever it met before.
TEST(DielectricWalk, tints_multiply_the_sides)
{
    const Color3<double> red(0.9, 0.1, 0.2), blue(0.1, 0.3, 0.8);
    const DielectricWalk<GGX<double>> tinted(GGX<double>(0.8), 1.5, red, blue);
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

// A flat surface is smooth glass; at eta 1 there is no surface at all.
TEST(DielectricWalk, delta_limits)
{
    const auto wo = direction<double>(-0.9);
    const auto flat = glass(GGX<double>(0), 1.5).prepare(wo);
    const double F = DielectricFresnel<double>(1 / 1.5).reflectance(0.9);
    Random random(12);
    double reflected = 0;
    for (int i = 0; i < 20000; ++i)
    {
        const auto s = flat.sample(random.cube<double>());
        ASSERT_TRUE(s.valid && s.delta);
        EXPECT_NEAR(s.pdf, s.transmitted ? 1 - F : F, 1e-12);
        const auto expected =
            s.transmitted ? refract(Vec3<double>(wo.x, 0, 0.9), Vec3<double>(0, 0, 1), 1 / 1.5).wi
                          : direction<double>(0.9, pi);
        EXPECT_NEAR(s.wi.x, expected.x, 1e-9);
        reflected += !s.transmitted;
    }
    EXPECT_NEAR(reflected / 20000, F, 4.5 * std::sqrt(F * (1 - F) / 20000));
    EXPECT_EQ(flat.eval(direction<double>(0.9), {0.1, 0.2, 0.3}).x, 0);

    const auto nothing = glass(GGX<double>(0.8), 1).prepare(wo);
    for (int i = 0; i < 1000; ++i)
    {
        const auto s = nothing.sample(random.cube<double>());
        ASSERT_TRUE(s.valid && s.delta && s.transmitted);
        EXPECT_NEAR((s.wi + wo).length(), 0, 1e-9);
    }
}

}  // namespace
