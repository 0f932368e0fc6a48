// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The random walk on a conductor: it loses nothing, begins as single scattering does, and its
// estimates agree with each other.

#include "../support/cells.h"
#include "../support/closures.h"
#include "../support/reflection_integral.h"
#include "../support/walks.h"

#include <regain/closures/walk_orders.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

using namespace regain;
using namespace regain::tests;

namespace {

const double pi = std::acos(-1.0);

ConductorFresnel<double> gold_fresnel() { return gold<double>(1, 1).fresnel(); }

// With F = 1 every weight is 1, so what could be missing is walks.
TEST(Walk, loses_nothing)
{
    for_each_distribution<double>([](const auto& distribution, const char* name) {
        const auto walk = white_walk(distribution);
        EXPECT_TRUE(walk.traits().energy_preserving);
        Random random(1);
        for (double mu : {1e-6, 1e-3, 0.2, 1.0})
        {
            const auto prepared = walk.prepare(direction<double>(mu, 2.1));
            for (int i = 0; i < 2500; ++i)
            {
                const auto s = prepared.sample(random.cube<double>());
                ASSERT_TRUE(s.valid) << name << ", mu " << mu;
                ASSERT_EQ(s.weight.y, 1.0);
                ASSERT_GT(s.pdf, 0.0);
                ASSERT_EQ(s.pdf, prepared.pdf(s.wi));
            }
        }
    });
}

// What leaves at the first bounce is what the single-scattering closure returns, of facets tilted
// either way.
TEST(Walk, first_bounce_is_single_scattering)
{
    Cells cells;
    for_each_kind<double>([&](const char* kind, const auto& distributions) {
        Random random = random_of_test(kind);
        for (const auto& distribution : distributions)
            for (double mu : {0.1, 0.4, 0.8, 0.98})
            {
                using Distribution = std::decay_t<decltype(distribution)>;
                const MicrofacetReflection<Distribution, ConstantFresnel<double>> single(
                    distribution, ConstantFresnel<double>());
                const auto wo = direction<double>(mu, 0.8 + 5 * mu);
                const auto once = single.prepare(wo);
                const auto towards = [&](const Vec3<double>& wi) {
                    return is_tilted_towards(wo, wo + wi);
                };
                const Vec2<double> E = integrate_reflections(
                    wo, distribution.alpha_x(), distribution.alpha_y(), 40, [&](const auto& wi) {
                        const double f = once.eval(wi).x;
                        return towards(wi) ? Vec2<double>(f, 0) : Vec2<double>(0, f);
                    });

                constexpr int n = 40000;
                const auto prepared = white_walk(distribution).prepare(wo);
                std::vector<double> counts(2);
                for (int i = 0; i < n; ++i)
                {
                    const auto p = prepared.path(random.cube<double>());
                    if (p.bounces == 1) ++counts[towards(p.wi) ? 0 : 1];
                }
                cells.add(kind, place(distribution, mu), n, counts, {E.x, E.y});
            }
    });
    cells.check();
}

// Cosine-averaged number of bounces with F = 1, from a walk in heights instead of optical depths,
// in double precision and by another author; Turquin's estimate is 1 + alpha sqrt(alpha).
TEST(Walk, mean_depth_is_that_of_an_independent_walk)
{
    const auto check = [](const auto& distribution, double expected) {
        constexpr int n = 300000;
        const auto walk = white_walk(distribution);
        Random random(3);
        double sum = 0, squares = 0;
        for (int i = 0; i < n; ++i)
        {
            const auto wo = direction<float>(std::sqrt((i + 0.5) / n));
            const double bounces = double(walk.prepare(wo).path(random.cube<float>()).bounces);
            sum += bounces;
            squares += bounces * bounces;
        }
        const double mean = sum / n, sigma = std::sqrt((squares / n - mean * mean) / n);
        // They are given to three decimals, and are estimates themselves.
        EXPECT_NEAR(mean, expected, 4.5 * sigma + 1e-3);
    };
    const double depths[][2] = {{0.1, 1.030}, {0.25, 1.133}, {0.4, 1.273}, {0.5, 1.380},
                                {0.6, 1.494}, {0.75, 1.676}, {0.9, 1.868}, {1, 1.9995}};
    for (const auto& [alpha, depth] : depths)
    {
        check(GGX<float>(float(alpha)), depth);
        EXPECT_NEAR(depth, 1 + alpha * std::sqrt(alpha), 0.03) << "Turquin 2019, below Eq. 13";
    }
    check(Beckmann<float>(1.0f), 1.379);
}

// The same source; n and k of gold at 630, 532 and 465 nm.
TEST(Walk, colour_of_rough_gold)
{
    const Walk<GGX<double>, ConductorFresnel<double>> walk(
        GGX<double>(1), ConductorFresnel<double>({0.143, 0.375, 1.442}, {3.983, 2.386, 1.603}));
    const auto orders = walk_orders(walk.prepare(direction<double>(0.7)), 400000);
    const Color3<double> total = orders.total().reflect;
    EXPECT_NEAR(total.x, 0.929, 1.5e-3);
    EXPECT_NEAR(total.y, 0.662, 1.5e-3);
    EXPECT_NEAR(total.z, 0.180, 1.5e-3);
}

TEST(Walk, orders_add_up_and_begin_with_single_scattering)
{
    const auto walk = white_walk(GGX<float>(0.8f));
    const auto prepared = walk.prepare(direction<float>(0.6));
    const auto orders = walk_orders(prepared, 300000, 5);
    EXPECT_NEAR(orders.total().reflect.x, 1, 1e-4);
    EXPECT_EQ(orders.total().transmit.x, 0);
    EXPECT_NEAR(orders.order[0].reflect.x,
                luts::ggx_tables().albedo(TableAxes<float>(walk.distribution()), 0.6f), 4e-3);
    double bounces = 0;
    for (int k = 0; k < orders.tracked; ++k) bounces += (k + 1) * orders.order[k].reflect.x;
    EXPECT_NEAR(bounces, double(orders.mean_bounces), 1e-3);
    EXPECT_EQ(orders.rest.reflect.x, 0);
}

// eval averaged over directions is the mean weight of samples: two estimates of the albedo that
// share only the first facet.
TEST(Walk, integral_of_eval_is_the_mean_weight)
{
    for_each_distribution<double>([](const auto& distribution, const char* name) {
        using Distribution = std::decay_t<decltype(distribution)>;
        const Walk<Distribution, ConductorFresnel<double>> walk(distribution, gold_fresnel());
        const auto prepared = walk.prepare(direction<double>(0.5, 0.3));
        Random random(4);
        Mean sampled, integrated;
        constexpr int side = 120;
        for (int i = 0; i < side * side; ++i)
        {
            sampled.add(prepared.sample(random.cube<double>()).weight.y);
            const double z = std::sqrt((i / side + random.unit()) / side);
            const auto wi = direction<double>(z, 2 * pi * (i % side + random.unit()) / side);
            integrated.add(prepared.eval(wi, random.cube<double>()).y * pi / z);
        }
        EXPECT_NEAR(integrated.value(), sampled.value(),
                    4.5 * std::hypot(integrated.error(), sampled.error()))
            << name;
    });
}

// Samples fall where eval says, cell by cell.
TEST(Walk, samples_fall_where_eval_says)
{
    for (double alpha_y : {1.0, 0.3})
    {
        const auto prepared =
            white_walk(GGX<double>(0.9, alpha_y)).prepare(direction<double>(0.6, 0.4));
        constexpr int rows = 8, columns = 16, samples = 200000, evals = 1500;
        std::vector<double> observed(rows * columns);
        Random random(6);
        for (int i = 0; i < samples; ++i)
        {
            const auto wi = prepared.sample(random.cube<double>()).wi;
            const double phi = std::atan2(wi.y, wi.x) / (2 * pi) + 0.5;
            const int row = std::min(int(wi.z * rows), rows - 1),
                      column = std::min(int(phi * columns), columns - 1);
            ++observed[std::size_t(row * columns + column)];
        }
        for (int cell = 0; cell < rows * columns; ++cell)
        {
            Mean mean;
            for (int i = 0; i < evals; ++i)
            {
                const double z = (cell / columns + random.unit()) / rows,
                             phi = ((cell % columns + random.unit()) / columns - 0.5) * 2 * pi;
                mean.add(prepared.eval(direction<double>(z, phi), random.cube<double>()).x);
            }
            const double area = 2 * pi / (rows * columns),
                         share = observed[std::size_t(cell)] / samples;
            const double sigma =
                std::hypot(std::sqrt(share * (1 - share) / samples), area * mean.error());
            EXPECT_NEAR(share, area * mean.value(), 5 * sigma) << "cell " << cell;
        }
    }
}

TEST(Walk, mean_eval_is_reciprocal)
{
    for_each_distribution<double>([](const auto& distribution, const char* name) {
        using Distribution = std::decay_t<decltype(distribution)>;
        const Walk<Distribution, ConductorFresnel<double>> walk(distribution, gold_fresnel());
        EXPECT_TRUE(walk.traits().reciprocal);
        Random random(7);
        for (int pair = 0; pair < 3; ++pair)
        {
            const auto a = direction<double>(0.1 + 0.9 * random.unit(), 7 * random.unit());
            const auto b = direction<double>(0.1 + 0.9 * random.unit(), 7 * random.unit());
            Mean there, back;
            const auto from_a = walk.prepare(a), from_b = walk.prepare(b);
            for (int i = 0; i < 4000; ++i)
            {
                there.add(from_a.eval(b, random.cube<double>()).z / b.z);
                back.add(from_b.eval(a, random.cube<double>()).z / a.z);
            }
            EXPECT_NEAR(there.value(), back.value(),
                        4.5 * std::hypot(there.error(), back.error()) + 1e-12)
                << name << ", " << a << ", " << b;
        }
    });
}

// More samples, less noise, the same mean.
TEST(Walk, eval_samples_set_the_noise)
{
    const Walk<GGX<double>, ConstantFresnel<double>> one(GGX<double>(0.7),
                                                         ConstantFresnel<double>()),
        many(GGX<double>(0.7), ConstantFresnel<double>(), 16);
    const auto wo = direction<double>(0.4), wi = direction<double>(0.8, 2);
    Random random(8);
    Mean single, averaged;
    for (int i = 0; i < 4000; ++i)
    {
        single.add(one.eval(wo, wi, random.cube<double>()).x);
        averaged.add(many.eval(wo, wi, random.cube<double>()).x);
    }
    EXPECT_NEAR(single.value(), averaged.value(),
                4.5 * std::hypot(single.error(), averaged.error()));
    EXPECT_LT(averaged.error(), 0.4 * single.error());
}

// Over the R2 sequence (Roberts 2018), which the edges of the density do not line up with.
template <class Prepared>
double integral_of_pdf(const Prepared& prepared, int n)
{
    double sum = 0, u = 0.5, v = 0.5;
    for (int i = 0; i < n; ++i)
    {
        u += 0.7548776662466927;
        v += 0.5698402909980532;
        u -= std::floor(u);
        v -= std::floor(v);
        const double z = u * u * (3 - 2 * u);  // more of them along the horizon and the normal
        sum += prepared.pdf(direction<double>(z, 2 * pi * v)) * 6 * u * (1 - u);
    }
    return sum * 2 * pi / n;
}

// With tables the bound is what they leave; without, the integral is 1 for any distribution.
TEST(Walk, pdf_integrates_to_one)
{
    for (double alpha : {0.25, 0.5, 1.0})
        for (double mu : {0.1, 0.3, 0.9})
        {
            const Walk<GGX<double>, ConstantFresnel<double>> walk(
                GGX<double>(alpha), ConstantFresnel<double>(), 1, luts::ggx_tables());
            EXPECT_NEAR(integral_of_pdf(walk.prepare(direction<double>(mu, 0.3)), 300000), 1, 5e-4)
                << "alpha " << alpha << ", mu " << mu;
        }
    for_each_distribution<double>([](const auto& distribution, const char* name) {
        // The core of this one is too narrow for so few points.
        if (std::string(name) == "STD, anisotropic") return;
        for (double mu : {0.2, 0.8})
            EXPECT_NEAR(integral_of_pdf(
                            white_walk(distribution).prepare(direction<double>(mu, 0.3)), 300000),
                        1, 5e-4)
                << name << ", mu " << mu;
    });
}

// Relative rms difference of pdf and density over samples.
template <class Closure>
double pdf_error(const Closure& walk, double mu)
{
    const auto prepared = walk.prepare(direction<double>(mu, 0.3));
    Random random(9);
    double sum = 0;
    constexpr int n = 100;
    for (int i = 0; i < n; ++i)
    {
        const auto s = prepared.sample(random.cube<double>());
        const double relative = s.pdf / prepared.eval(s.wi, random.cube<double>()).x - 1;
        sum += relative * relative;
    }
    return std::sqrt(sum / n);
}

// Pins how near the pdf is, as the documentation says.
TEST(Walk, pdf_is_near_the_density)
{
    double with_tables = 0, without = 0;
    for (double alpha : {0.25, 0.5, 1.0})
        for (double mu : {0.2, 0.5, 0.9})
        {
            Walk<GGX<double>, ConstantFresnel<double>> walk(GGX<double>(alpha),
                                                            ConstantFresnel<double>(), 1000);
            // Without, the error of small alpha is in a few samples: 0.02 to 2.
            if (alpha > 0.4) without = std::max(without, pdf_error(walk, mu));
            walk.set_tables(luts::ggx_tables());
            with_tables = std::max(with_tables, pdf_error(walk, mu));
        }
    EXPECT_LT(with_tables, 0.17);
    EXPECT_LT(without, 0.8);
}

// A host that weighs both techniques with pdf() is unbiased, though the pdf is not the density.
TEST(Walk, multiple_importance_sampling_is_unbiased)
{
    const auto walk = white_walk(GGX<double>(0.8, 0.4));
    const auto prepared = walk.prepare(direction<double>(0.5));
    const auto light = [](const Vec3<double>& w) { return std::pow(std::max(0.0, w.x), 3); };
    const double light_pdf = 1 / (2 * pi);
    Random random(10);
    Mean by_samples, combined;
    for (int i = 0; i < 60000; ++i)
    {
        const auto s = prepared.sample(random.cube<double>());
        by_samples.add(s.weight.x * light(s.wi));

        double sum = s.weight.x * light(s.wi) * s.pdf / (s.pdf + light_pdf);
        const auto wi = direction<double>(random.unit(), 2 * pi * random.unit());
        sum +=
            prepared.eval(wi, random.cube<double>()).x * light(wi) / (prepared.pdf(wi) + light_pdf);
        combined.add(sum);
    }
    EXPECT_NEAR(combined.value(), by_samples.value(),
                4.5 * std::hypot(combined.error(), by_samples.error()));
}

TEST(Walk, albedo_is_what_samples_return)
{
    for (double alpha : {0.3, 1.0})
        for (double mu : {0.2, 0.8})
        {
            const auto wo = direction<double>(mu);
            EXPECT_NEAR(white_walk(GGX<double>(alpha)).albedo(wo).reflect.x, 1, 1e-12);
            Walk<GGX<double>, ConductorFresnel<double>> walk(GGX<double>(alpha), gold_fresnel());
            const auto truth = walk_orders(walk.prepare(wo), 100000).total().reflect;
            const auto walked = walk.albedo(wo).reflect;
            walk.set_tables(luts::ggx_tables());
            const auto tabulated = walk.albedo(wo).reflect;
            for (int c = 0; c < 3; ++c)
            {
                EXPECT_NEAR(walked[c], truth[c], 0.01);
                EXPECT_NEAR(tabulated[c], truth[c], 0.05);
            }
            const Walk<GGX<double>, ConstantFresnel<double>> white(
                GGX<double>(alpha), ConstantFresnel<double>(), 1, luts::ggx_tables());
            EXPECT_NEAR(white.albedo(wo).reflect.x, 1, 1e-6);
        }
}

TEST(Walk, of_a_flat_surface_is_a_mirror)
{
    const Walk<GGX<float>, ConductorFresnel<float>> walk(GGX<float>(0.0f),
                                                         gold<float>(0, 0).fresnel());
    EXPECT_TRUE(walk.traits().delta);
    const auto prepared = walk.prepare(direction<float>(0.3));
    const auto s = prepared.sample({0.3f, 0.6f, 0.9f});
    EXPECT_TRUE(s.valid && s.delta);
    EXPECT_NEAR(s.wi.x, -direction<float>(0.3).x, 1e-6);
    EXPECT_EQ(s.weight, walk.fresnel().at(prepared.wo().z));
    EXPECT_EQ(s.pdf, 1.0f);
    EXPECT_EQ(prepared.eval(s.wi, {0.1f, 0.2f, 0.3f}).x, 0.0f);
    EXPECT_EQ(prepared.pdf(s.wi), 0.0f);
}

}  // namespace
