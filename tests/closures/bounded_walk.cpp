// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The walk of bounded cost on a conductor: it is the plain walk but for what lies beyond its bound,
// loses nothing, and has a pdf that is near its density.

#include "../support/closures.h"
#include "../support/walk_cells.h"

#include <regain/closures/bounded_walk.h>
#include <regain/closures/walk_orders.h>
#include <regain/luts/library.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

using namespace regain;
using namespace regain::tests;

namespace {

const double pi = std::acos(-1.0);

template <class Real>
ConductorFresnel<Real> gold_fresnel()
{
    return gold<Real>(1, 1).fresnel();
}

template <class Distribution>
auto white_bounded(const Distribution& distribution, int bounces = default_bounces,
                   const MicrofacetTables& tables = {}, int eval_samples = 1)
{
    using White = ConstantFresnel<typename Distribution::Real>;
    return BoundedWalk<Distribution, White>(distribution, White(), eval_samples, tables, bounces);
}

MicrofacetTables tables_of(const std::string& distribution)
{
    MicrofacetTables tables = luts::microfacet_tables(distribution);
    luts::add_later_bounces(tables, distribution);
    luts::add_later_shape(tables, distribution);
    return tables;
}

TEST(BoundedWalk, loses_nothing_within_its_bound)
{
    for_each_distribution<double>([](const auto& distribution, const char* name) {
        for (int bounces : {2, 3, 16})
        {
            const auto walk = white_bounded(distribution, bounces);
            EXPECT_TRUE(walk.traits().energy_preserving);
            Random random(1);
            for (double mu : {1e-6, 1e-3, 0.2, 1.0})
            {
                const auto prepared = walk.prepare(direction<double>(mu, 2.1));
                for (int i = 0; i < 1000; ++i)
                {
                    const auto u = random.cube<double>();
                    const auto s = prepared.sample(u);
                    ASSERT_TRUE(s.valid) << name << ", mu " << mu;
                    ASSERT_NEAR(s.weight.y, 1, 1e-12);
                    ASSERT_GT(s.wi.z, 0);
                    ASSERT_GT(s.pdf, 0);
                    ASSERT_EQ(s.pdf, prepared.pdf(s.wi));
                    ASSERT_LE(prepared.path(u).bounces, bounces);
                }
            }
        }
    });
}

TEST(BoundedWalk, bound_is_clamped)
{
    const GGX<double> distribution(0.5);
    EXPECT_EQ(white_bounded(distribution).bounces(), default_bounces);
    EXPECT_EQ(white_bounded(distribution, 0).bounces(), 2);
    EXPECT_EQ(white_bounded(distribution, 1000).bounces(), most_bounces);
}

// Rays up and down in turn, of very different rates: as many leave at each, and as late ones would
// leave straight up, as where depths are drawn.
TEST(BoundedWalk, phases_are_the_law_of_the_depth)
{
    const double rates[] = {0.3, 4, 6, 9, 0.2, 5, 0.5, 2, 1};
    const bool up[] = {false, false, true, true, false, true, false, true, true};
    constexpr int steps = 9, n = 400000;
    Random random = random_of_test();
    double left[2][steps] = {};
    Mean straight[2];
    const auto exponential = [&](double rate) { return -std::log(1 - random.unit()) / rate; };
    for (int i = 0; i < n; ++i)
    {
        regain::detail::WalkPhases<double, 8> phases(1.0, 0.7);
        double depth = exponential(0.7);
        bool inside[2] = {true, true};
        for (int k = 0; k < steps; ++k)
        {
            if (inside[0] && up[k])
            {
                const double stays = phases.stay_probability(1, rates[k]);
                ASSERT_NEAR(stays, 1 - phases.escape_probability(1, rates[k]), 1e-12);
                inside[0] = !phases.rise(1, rates[k], random.unit(), true);
                left[0][k] += !inside[0];
            }
            else if (inside[0])
                phases.sink(1, rates[k], true);
            if (!inside[1]) continue;
            depth += (up[k] ? -1 : 1) * exponential(rates[k]);
            inside[1] = depth > 0;
            left[1][k] += !inside[1];
        }
        if (inside[0]) straight[0].add(phases.escape_probability(1, 0.8));
        if (inside[1]) straight[1].add(std::exp(-0.8 * depth));
    }
    for (int k = 0; k < steps; ++k)
        EXPECT_LE(std::abs(left[0][k] - left[1][k]), 4.5 * std::sqrt(left[0][k] + left[1][k]));
    EXPECT_NEAR(straight[0].value(), straight[1].value(),
                4.5 * std::hypot(straight[0].error(), straight[1].error()));
    EXPECT_LT(straight[0].error(), straight[1].error());
}

// As many walks of each order as the plain walk has, which draws depths where this one does not.
TEST(BoundedWalk, meets_as_many_facets_as_the_plain_walk)
{
    std::vector<double> z;
    for_each_kind<double>([&](const char* kind, const auto& distributions) {
        Random random = random_of_test(kind);
        for (const auto& distribution : distributions)
            for (double mu : {0.15, 0.8})
            {
                const auto wo = direction<double>(mu, 0.7);
                const auto plain = white_walk(distribution).prepare(wo);
                const auto bounded = white_bounded(distribution, 32).prepare(wo);
                double counts[2][6] = {};
                for (int i = 0; i < 10000; ++i)
                {
                    ++counts[0][std::min(int(plain.path(random.cube<double>()).bounces), 5)];
                    ++counts[1][std::min(int(bounded.path(random.cube<double>()).bounces), 5)];
                }
                for (int k = 1; k < 6; ++k)
                    if (counts[0][k] > 50)
                        z.push_back((counts[0][k] - counts[1][k]) /
                                    std::sqrt(counts[0][k] + counts[1][k]));
            }
    });
    ASSERT_GT(z.size(), 100u);
    for (const double deviation : z) EXPECT_LE(std::abs(deviation), furthest_of(z.size(), 1e-3));
    EXPECT_LE(normal_of_chi_squared(std::inner_product(z.begin(), z.end(), z.begin(), 0.0),
                                    double(z.size())),
              3.3);
}

// The mean of eval is where samples of the plain walk fall.
TEST(BoundedWalk, mean_of_eval_is_the_plain_walk)
{
    const DirectionCells cells{8, 12, 0};
    for_each_distribution<double>([&](const auto& distribution, const char* name) {
        using Distribution = std::decay_t<decltype(distribution)>;
        const auto wo = direction<double>(0.5, 0.4);
        const Walk<Distribution, ConductorFresnel<double>> plain(distribution,
                                                                 gold_fresnel<double>());
        const BoundedWalk<Distribution, ConductorFresnel<double>> bounded(
            distribution, gold_fresnel<double>(), 1, {}, 32);
        expect_samples_where_eval_says(cells, plain.prepare(wo), bounded.prepare(wo), 60000, 512,
                                       name);
    });
}

// Of its own, too, where much goes on beyond the bound.
TEST(BoundedWalk, samples_fall_where_eval_says)
{
    const DirectionCells cells{8, 12, 0};
    for (double mu : {0.3, 0.95})
    {
        const BoundedWalk<GGX<double>, ConductorFresnel<double>> walk(
            GGX<double>(1), gold_fresnel<double>(), 1, {}, 3);
        const auto prepared = walk.prepare(direction<double>(mu, 0.4));
        expect_samples_where_eval_says(cells, prepared, prepared, 300000, 2048,
                                       "mu " + std::to_string(mu));
    }
}

// Through eval. The false alarms of each are 1 in 150,000.
TEST(BoundedWalk, white_furnace_by_eval)
{
    for_each_distribution<double>([](const auto& distribution, const char* name) {
        for (double mu : {0.3, 0.9})
        {
            const auto prepared = white_bounded(distribution).prepare(direction<double>(mu, 0.3));
            Random random = random_of_test(name);
            Mean mean;
            constexpr int side = 120;
            for (int i = 0; i < side * side; ++i)
            {
                const double z = std::sqrt((i / side + random.unit()) / side);
                const auto wi = direction<double>(z, 2 * pi * (i % side + random.unit()) / side);
                mean.add(prepared.eval(wi, random.cube<double>()).y * pi / z);
            }
            EXPECT_NEAR(mean.value(), 1, 4.5 * mean.error() + 1e-3) << name << ", mu " << mu;
        }
    });
}

// What the bound costs: of gold at alpha 1, where light stays longest, next to nothing.
TEST(BoundedWalk, bound_moves_little)
{
    const auto wo = direction<double>(1);
    const auto albedo = [&](const auto& walk) {
        return walk_orders(walk.prepare(wo), 400000).total().reflect;
    };
    const GGX<double> ggx(1);
    const auto plain =
        albedo(Walk<GGX<double>, ConductorFresnel<double>>(ggx, gold_fresnel<double>()));
    const auto bounded = [&](int bounces) {
        return albedo(BoundedWalk<GGX<double>, ConductorFresnel<double>>(
            ggx, gold_fresnel<double>(), 1, {}, bounces));
    };
    // Standard errors are 5e-4 at most, of 400000 walks.
    const auto four = bounded(4), eight = bounded(8);
    for (int c = 0; c < 3; ++c)
    {
        EXPECT_NEAR(eight[c], plain[c], 2.5e-3);
        EXPECT_NEAR(four[c], plain[c], 1e-2);
    }
}

TEST(BoundedWalk, mean_eval_is_reciprocal)
{
    for_each_distribution<double>([](const auto& distribution, const char* name) {
        using Distribution = std::decay_t<decltype(distribution)>;
        const BoundedWalk<Distribution, ConductorFresnel<double>> walk(
            distribution, gold_fresnel<double>(), 1, {}, 32);
        EXPECT_TRUE(walk.traits().reciprocal);
        Random random = random_of_test(name);
        for (int pair = 0; pair < 3; ++pair)
        {
            const auto a = direction<double>(0.1 + 0.9 * random.unit(), 7 * random.unit());
            const auto b = direction<double>(0.1 + 0.9 * random.unit(), 7 * random.unit());
            Mean there, back;
            const auto from_a = walk.prepare(a), from_b = walk.prepare(b);
            for (int i = 0; i < 3000; ++i)
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

// With tables as well as these know E_ss; without, exactly.
TEST(BoundedWalk, pdf_integrates_to_one)
{
    const auto ggx = tables_of("ggx"), beckmann = tables_of("beckmann");
    for (double alpha : {0.25, 0.5, 1.0})
        for (double mu : {0.1, 0.3, 0.9})
        {
            const auto wo = direction<double>(mu, 0.3);
            EXPECT_NEAR(
                integral_of_pdf(white_bounded(GGX<double>(alpha), 16, ggx).prepare(wo), 100000), 1,
                1e-3)
                << "alpha " << alpha << ", mu " << mu;
            EXPECT_NEAR(
                integral_of_pdf(white_bounded(Beckmann<double>(alpha), 16, beckmann).prepare(wo),
                                100000),
                1, 1.5e-3)
                << "alpha " << alpha << ", mu " << mu;
        }
    for_each_distribution<double>([](const auto& distribution, const char* name) {
        // The core of this one is too narrow for so few points.
        if (std::string(name) == "STD, anisotropic") return;
        for (double mu : {0.2, 0.8})
            EXPECT_NEAR(
                integral_of_pdf(white_bounded(distribution).prepare(direction<double>(mu, 0.3)),
                                100000),
                1, 1e-3)
                << name << ", mu " << mu;
    });
}

// Within 10 % in the mean over samples: all that is not exact is the light of later facets, so it
// is counted alone; of 200000 samples the counts themselves are off by 0.01 at most.
TEST(BoundedWalk, pdf_is_near_the_density)
{
    const auto check = [](const auto& distribution, const MicrofacetTables& tables, double mu) {
        using Distribution = std::decay_t<decltype(distribution)>;
        const auto wo = direction<double>(mu, 0.3);
        const auto prepared = white_bounded(distribution, 16, tables).prepare(wo);
        const auto single = MicrofacetReflection<Distribution, ConstantFresnel<double>>(
                                distribution, ConstantFresnel<double>())
                                .prepare(wo);
        const double distance = distance_to_samples(
            {16, 16, 0}, prepared, 200000, [](const auto& p) { return p.bounces > 1; },
            [&](const auto& wi) { return prepared.pdf(wi) - single.eval(wi).x; });
        EXPECT_LT(distance, 0.09) << place(distribution, mu);
    };
    const auto ggx = tables_of("ggx"), beckmann = tables_of("beckmann");
    for (double alpha : {0.1, 0.5, 1.0})
        for (double mu : {0.05, 0.2, 0.5, 0.9})
        {
            check(GGX<double>(alpha), ggx, mu);
            check(Beckmann<double>(alpha), beckmann, mu);
        }
}

// f cos / pdf of what any light may shine on, by many walks.
TEST(BoundedWalk, weights_by_pdf_are_bounded)
{
    const auto tables = tables_of("ggx");
    Random random = random_of_test();
    double most = 0, noise = 0;
    for (double alpha : {0.1, 0.3, 1.0})
    {
        const auto walk = white_bounded(GGX<double>(alpha), 16, tables, 64);
        for (int i = 0; i < 300; ++i)
        {
            const auto prepared = walk.prepare(direction<double>(0.05 + 0.95 * random.unit()));
            const auto wi = direction<double>(0.02 + 0.98 * random.unit(), 7 * random.unit());
            Mean value;
            for (int j = 0; j < 16; ++j) value.add(prepared.eval(wi, random.cube<double>()).x);
            const double weight = value.value() / prepared.pdf(wi);
            if (weight > most) noise = value.error() / prepared.pdf(wi);
            most = std::max(most, weight);
        }
    }
    EXPECT_LT(most, 2 + 4.5 * noise);
}

// A host that weighs both techniques with pdf() is unbiased, though the pdf is not the density.
TEST(BoundedWalk, multiple_importance_sampling_is_unbiased)
{
    const auto walk = white_bounded(GGX<double>(0.8), 16, tables_of("ggx"));
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

// Relative variance of an eval, in the mean over wi of the lobe.
template <class Prepared>
double relative_variance(const Prepared& prepared)
{
    Random random = random_of_test();
    double sum = 0;
    constexpr int pairs = 150, n = 400;
    for (int i = 0; i < pairs; ++i)
    {
        const auto wi = prepared.path(random.cube<double>()).wi;
        Mean mean;
        for (int k = 0; k < n; ++k) mean.add(prepared.eval(wi, random.cube<double>()).x);
        const double e = mean.error() / mean.value();
        sum += e * e * n / pairs;
    }
    return sum;
}

// Of which there is a fraction of the plain walk's; by how much less time counts, too, which no
// test looks at.
TEST(BoundedWalk, eval_is_quieter_than_the_plain_walk)
{
    const auto ratio = [](double alpha, double mu) {
        const auto wo = direction<double>(mu);
        return relative_variance(white_bounded(GGX<double>(alpha)).prepare(wo)) /
               relative_variance(white_walk(GGX<double>(alpha)).prepare(wo));
    };
    EXPECT_LT(ratio(0.1, 0.9), 0.2);
    EXPECT_LT(ratio(0.5, 0.9), 0.6);
    EXPECT_LT(ratio(0.5, 0.2), 0.85);
    EXPECT_LT(ratio(1, 0.9), 0.75);
}

TEST(BoundedWalk, eval_samples_set_the_noise)
{
    const auto wo = direction<double>(0.4), wi = direction<double>(0.8, 2);
    const auto one = white_bounded(GGX<double>(0.7)).prepare(wo),
               many = white_bounded(GGX<double>(0.7), 16, {}, 16).prepare(wo);
    Random random(8);
    Mean single, averaged;
    for (int i = 0; i < 4000; ++i)
    {
        single.add(one.eval(wi, random.cube<double>()).x);
        averaged.add(many.eval(wi, random.cube<double>()).x);
    }
    EXPECT_NEAR(single.value(), averaged.value(),
                4.5 * std::hypot(single.error(), averaged.error()));
    EXPECT_LT(averaged.error(), 0.4 * single.error());
}

TEST(BoundedWalk, albedo_is_what_samples_return)
{
    for (double alpha : {0.3, 1.0})
        for (double mu : {0.2, 0.8})
        {
            const auto wo = direction<double>(mu);
            EXPECT_NEAR(white_bounded(GGX<double>(alpha)).albedo(wo).reflect.x, 1, 1e-12);
            using Gold = BoundedWalk<GGX<double>, ConductorFresnel<double>>;
            const Gold bare(GGX<double>(alpha), gold_fresnel<double>()),
                tabulated(GGX<double>(alpha), gold_fresnel<double>(), 1, tables_of("ggx"));
            const auto truth = walk_orders(bare.prepare(wo), 100000).total().reflect;
            for (int c = 0; c < 3; ++c)
            {
                EXPECT_NEAR(bare.albedo(wo).reflect[c], truth[c], 0.02);
                EXPECT_NEAR(tabulated.albedo(wo).reflect[c], truth[c], 9e-3);
            }
        }
}

TEST(BoundedWalk, a_mirror_is_a_mirror)
{
    const auto prepared = white_bounded(GGX<double>(0)).prepare(direction<double>(0.4));
    const auto s = prepared.sample({0.3, 0.6, 0.9});
    EXPECT_TRUE(s.valid && s.delta);
    EXPECT_NEAR(s.wi.x, -direction<double>(0.4).x, 1e-12);
    EXPECT_EQ(s.weight.x, 1);
    EXPECT_EQ(prepared.eval(s.wi, {0.3, 0.6, 0.9}).x, 0);
    EXPECT_EQ(prepared.pdf(s.wi), 0);
}

}  // namespace
