// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The gain of both directions: energy by quadrature over eval, reciprocity, colour against the
// directional gain, which the walk is the measure of.

#include "../support/closures.h"
#include "../support/properties.h"
#include "../support/reflection_integral.h"

#include <regain/closures/balanced_gain.h>
#include <regain/closures/beckmann.h>
#include <regain/closures/gtr.h>
#include <regain/closures/std.h>
#include <regain/luts/anisotropic_balance.h>
#include <regain/luts/balance.h>
#include <regain/luts/library.h>

#include <gtest/gtest.h>

using namespace regain;
using namespace regain::tests;

namespace {

using Triple = Color3<double>;

MicrofacetTables tables_of(const std::string& distribution)
{
    MicrofacetTables tables = luts::microfacet_tables(distribution);
    luts::add_later_bounces(tables, distribution);
    luts::add_balance(tables, distribution);
    return tables;
}

// Of lobes of two widths, too.
MicrofacetTables stretched_tables_of(const std::string& distribution)
{
    MicrofacetTables tables = tables_of(distribution);
    luts::add_balance_anisotropy(tables, distribution);
    return tables;
}

template <class Distribution, class Fresnel = ConstantFresnel<double>>
auto balanced_lobe(const Distribution& distribution, const MicrofacetTables& tables,
                   const Fresnel& fresnel = Fresnel(), double strength = 1)
{
    return balanced(MicrofacetReflection<Distribution, Fresnel>(distribution, fresnel), tables,
                    strength);
}

template <class Closure>
Triple reflected(const Closure& closure, double mu, double alpha, int nodes = 64)
{
    const auto prepared = closure.prepare(direction<double>(mu));
    return integrate_reflections(prepared.wo(), alpha, alpha, nodes,
                                 [&](const Vec3<double>& wi) { return prepared.eval(wi); });
}

constexpr double grazing_cosines[] = {1e-3, 3e-3, 0.01, 0.03, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0};

TEST(Balanced, returns_all_energy_of_a_white_furnace)
{
    const MicrofacetTables ggx = tables_of("ggx"), beckmann = tables_of("beckmann");
    for (double alpha : {1e-3, 3e-3, 0.01, 0.03, 0.1, 0.25, 0.5, 0.75, 1.0})
        for (double mu : grazing_cosines)
        {
            const auto rough = balanced_lobe(GGX<double>(alpha), ggx);
            EXPECT_TRUE(rough.traits().energy_preserving);
            EXPECT_NEAR(reflected(rough, mu, alpha).x, 1, 2e-3) << "ggx " << alpha << " " << mu;
            EXPECT_NEAR(reflected(balanced_lobe(Beckmann<double>(alpha), beckmann), mu, alpha).x, 1,
                        2e-3)
                << "beckmann " << alpha << " " << mu;
        }
}

TEST(Balanced, returns_all_energy_with_long_tails)
{
    const MicrofacetTables gtr = tables_of("gtr"), student = tables_of("std");
    const auto expect = [&](auto distribution, const MicrofacetTables& tables, double mu) {
        const double alpha = distribution.alpha_x();
        EXPECT_NEAR(reflected(balanced_lobe(distribution, tables), mu, alpha, 64).x, 1, 2e-3)
            << distribution.gamma() << " " << alpha << " " << mu;
    };
    for (double alpha : {0.05, 0.3, 1.0})
        for (double mu : {0.05, 0.3, 1.0})
        {
            for (double gamma : {0.5, 1.0, 3.0}) expect(GTR<double>(alpha, gamma), gtr, mu);
            for (double gamma : {1.6, 5.0}) expect(STD<double>(alpha, gamma), student, mu);
        }
    // Where the nodes are farthest from each other.
    expect(GTR<double>(1e-3, 1.5), gtr, 3e-3);
    expect(GTR<double>(1.8e-3, 5), gtr, 1e-3);
    expect(STD<double>(1.3e-3, 1.51), student, 1.7e-3);
    expect(STD<double>(0.7, 1.525), student, 1e-3);
}

// Largest |1 - E| of all sides of a lobe.
template <class Closure>
double furnace_error(const Closure& closure, bool long_tail = false)
{
    const auto& distribution = closure.lobe().distribution();
    double worst = 0;
    for (double mu : {0.01, 0.1, 0.4, 0.8})
        for (double azimuth : {0.0, 0.7, 1.3, 1.52, -1.6})
        {
            const auto prepared = closure.prepare(direction<double>(mu, azimuth));
            const double E = integrate_reflections(
                prepared.wo(), distribution.alpha_x(), distribution.alpha_y(), long_tail ? 16 : 28,
                [&](const Vec3<double>& wi) { return prepared.eval(wi).x; }, long_tail);
            worst = std::max(worst, std::abs(E - 1));
        }
    return worst;
}

// Without their table the errors are up to 0.10 and 0.15.
TEST(Balanced, returns_all_energy_of_two_widths)
{
    const MicrofacetTables ggx = stretched_tables_of("ggx"),
                           beckmann = stretched_tables_of("beckmann");
    struct Widths
    {
        double x, y;
    };
    for (const Widths& w :
         {Widths{1, 0.5}, {1, 0.1}, {0.1, 1}, {0.5, 0.025}, {0.05, 1}, {0.02, 0.1}})
    {
        EXPECT_LT(furnace_error(balanced_lobe(GGX<double>(w.x, w.y), ggx)), 3e-3)
            << w.x << " " << w.y;
        EXPECT_LT(furnace_error(balanced_lobe(Beckmann<double>(w.x, w.y), beckmann)), 4e-3)
            << w.x << " " << w.y;
    }
    EXPECT_GT(furnace_error(balanced_lobe(GGX<double>(1, 0.1), tables_of("ggx"))), 0.05);
}

// Without it up to 0.14, and of GTR more.
TEST(Balanced, returns_all_energy_of_two_widths_with_long_tails)
{
    const MicrofacetTables gtr = stretched_tables_of("gtr"), student = stretched_tables_of("std");
    EXPECT_LT(furnace_error(balanced_lobe(STD<double>(1, 0.1, 1.7), student), true), 1e-2);
    EXPECT_LT(furnace_error(balanced_lobe(STD<double>(0.05, 1, 6), student), true), 1e-2);
    EXPECT_LT(furnace_error(balanced_lobe(GTR<double>(0.5, 0.05, 1.7), gtr), true), 1e-2);
    EXPECT_LT(furnace_error(balanced_lobe(GTR<double>(0.1, 1, 0.8), gtr), true), 1e-2);
}

TEST(Balanced, axes_may_be_exchanged)
{
    const MicrofacetTables tables = stretched_tables_of("ggx");
    const ConstantFresnel<double> white;
    const BalancedGain a(GGX<double>(0.8, 0.2), white, tables, 1.0),
        b(GGX<double>(0.2, 0.8), white, tables, 1.0);
    Random random(3);
    for (int i = 0; i < 100; ++i)
    {
        const auto wo = direction<double>(random.unit(), 7 * random.unit()),
                   wi = direction<double>(random.unit(), 7 * random.unit());
        EXPECT_EQ(a.pair(wo, wi), b.pair({wo.y, wo.x, wo.z}, {-wi.y, wi.x, wi.z}));
    }
}

TEST(Balanced, one_width_reads_no_table_of_two)
{
    const MicrofacetTables tables = tables_of("beckmann");
    MicrofacetTables other = tables;
    const std::uint16_t numbers[32] = {};
    const GridView<5> wrong{numbers, {2, 2, 2, 2, 2}, 3, 1};
    other.balance_anisotropy = &wrong;
    const ConstantFresnel<double> white;
    const auto wo = direction<double>(0.4), wi = direction<double>(0.9, 2);
    const auto gain = [&](double x, double y, const MicrofacetTables& t) {
        return BalancedGain(Beckmann<double>(x, y), white, t, 1.0).pair(wo, wi);
    };
    EXPECT_EQ(gain(0.6, 0.6, tables), gain(0.6, 0.6, other));
    EXPECT_NE(gain(0.6, 0.5, tables), gain(0.6, 0.5, other));
    // What that table holds is nothing where the widths come together.
    const MicrofacetTables stretched = stretched_tables_of("beckmann");
    EXPECT_NEAR(gain(0.6, 0.6 + 1e-9, stretched).x, gain(0.6, 0.6, tables).x, 1e-7);
}

TEST(Balanced, is_reciprocal)
{
    const MicrofacetTables tables = tables_of("ggx"), two_widths = stretched_tables_of("ggx");
    const auto metal = gold<double>(1, 1).fresnel();
    for (double alpha : {0.01, 0.1, 0.5, 1.0})
    {
        const auto closure = balanced_lobe(GGX<double>(alpha), tables, metal);
        EXPECT_TRUE(closure.traits().reciprocal);
        EXPECT_LT(asymmetry_of_reflection(closure), 1e-10) << alpha;
        const auto stretched = balanced_lobe(GGX<double>(alpha, 0.3 * alpha), two_widths, metal);
        EXPECT_TRUE(stretched.traits().reciprocal);
        EXPECT_LT(asymmetry_of_reflection(stretched), 1e-10) << alpha;
    }
}

// By the slopes of luts and by the closures' own directions.
TEST(Balanced, the_table_is_the_fixed_point)
{
    const MicrofacetTables tables = tables_of("ggx");
    for (double alpha : {0.01, 0.2, 1.0})
    {
        const luts::Balance balance(luts::SlopeLaw::ggx(alpha));
        const TableAxes<double> axes{GGX<double>(alpha)};
        for (double mu : {0.005, 0.05, 0.4, 1.0})
        {
            EXPECT_NEAR(axes.directional(tables.balance, mu) / balance.at(mu), 1, 8e-4);
            const auto prepared = white<double>(alpha, alpha).prepare(direction<double>(mu));
            const double row =
                integrate_reflections(prepared.wo(), alpha, alpha, 64, [&](const Vec3<double>& wi) {
                    return prepared.eval(wi).x * balance.at(std::min(wi.z, 1.0));
                });
            EXPECT_NEAR(row * balance.at(mu), 1, 2e-5) << alpha << " " << mu;
        }
    }
}

// Likewise of two widths, where it is a function of the azimuth, too.
TEST(Balanced, a_stretched_balance_is_the_fixed_point)
{
    const auto worst = [](const auto& distribution, double wider, double ratio,
                          const luts::AnisotropicBalance& g) {
        const MicrofacetReflection lobe(distribution, ConstantFresnel<double>());
        double error = 0;
        for (double mu : {0.03, 0.3, 0.8})
            for (double phi : {0.0, 0.8, 1.5})
            {
                const auto prepared = lobe.prepare(direction<double>(mu, phi));
                const double row = integrate_reflections(
                    prepared.wo(), wider, wider / ratio, 40,
                    [&](const Vec3<double>& wi) { return prepared.eval(wi).x * g.at(wi); });
                error = std::max(error, std::abs(row * g.at(prepared.wo()) - 1));
            }
        return error;
    };
    EXPECT_LT(worst(GGX<double>(1, 0.1), 1, 10, {"ggx", 1, 10, 0}), 1e-3);
    EXPECT_LT(worst(Beckmann<double>(0.7, 0.2), 0.7, 3.5, {"beckmann", 0.7, 3.5, 0}), 6e-4);
    EXPECT_LT(worst(GTR<double>(0.4, 0.1, 1), 0.4, 4, {"gtr", 0.4, 4, 1}), 1e-3);
    const luts::AnisotropicBalance same("ggx", 0.5, 1, 0);
    EXPECT_EQ(same.change(0.3, 0.4), 1);
}

// As tints go through both ends, the albedo is near that of the directional gain, which is within
// 5e-3 of the walk; docs/methods.md has the differences from the walk itself.
TEST(Balanced, has_the_colour_of_the_directional_gain)
{
    for (const std::string name : {"ggx", "beckmann"})
    {
        const MicrofacetTables tables = tables_of(name);
        double worst = 0;
        const auto measure = [&](const auto& distribution, const auto& fresnel) {
            const double alpha = distribution.alpha_x();
            const auto closure = balanced_lobe(distribution, tables, fresnel);
            const auto bare = closure.lobe();
            const DirectionalGain gain(distribution, fresnel, tables, 1.0);
            for (double mu : {0.05, 0.2, 0.5, 1.0})
            {
                const Triple off = reflected(closure, mu, alpha, 32) -
                                   reflected(bare, mu, alpha, 32) * gain.at(direction<double>(mu));
                for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(off[c]));
            }
        };
        const SchlickFresnel<double> dim(Triple(0.04, 0.2, 0.5));
        for (double alpha : {0.1, 0.5, 1.0})
        {
            if (name == "ggx")
            {
                measure(GGX<double>(alpha), dim);
                measure(GGX<double>(alpha), gold<double>(1, 1).fresnel());
            }
            else
            {
                measure(Beckmann<double>(alpha), dim);
                measure(Beckmann<double>(alpha), gold<double>(1, 1).fresnel());
            }
        }
        EXPECT_LT(worst, 1.1e-2) << name;
    }
}

TEST(Balanced, albedo_is_what_eval_integrates_to)
{
    const MicrofacetTables tables = tables_of("ggx");
    const SchlickFresnel<double> fresnel(Triple(0.04, 0.5, 1));
    for (double alpha : {0.1, 0.5, 1.0})
        for (double mu : {0.1, 0.5, 1.0})
        {
            const auto closure = balanced_lobe(GGX<double>(alpha), tables, fresnel);
            const Triple off = closure.prepare(direction<double>(mu)).albedo().reflect -
                               reflected(closure, mu, alpha);
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(off[c], 0, 2.5e-3) << alpha << " " << mu;
        }
}

TEST(Balanced, changes_no_direction_and_no_pdf)
{
    const auto closure = balanced_lobe(GGX<double>(0.6), tables_of("ggx"));
    const auto with = closure.prepare(direction<double>(0.3, 1));
    const auto without = closure.lobe().prepare(direction<double>(0.3, 1));
    Random random(5);
    for (int i = 0; i < 500; ++i)
    {
        const Vec2<double> u(random.unit(), random.unit());
        const auto a = with.sample(u), b = without.sample(u);
        EXPECT_EQ(a.wi, b.wi);
        EXPECT_EQ(a.pdf, b.pdf);
        EXPECT_EQ(with.pdf(a.wi), without.pdf(a.wi));
    }
    expect_weight_is_eval_over_pdf(closure, 1e-10);
}

// The gain's factor of wi is small at grazing angles, where masking lets least of the light out,
// and largest along the normal: that evens out whose light comes from above, and adds to what
// varies little at grazing angles.
TEST(Balanced, weights_vary_less_than_a_scaled_lobes_but_at_grazing_angles)
{
    const MicrofacetTables tables = tables_of("ggx");
    for (double alpha : {0.1, 0.25, 0.5, 1.0})
        for (double mu : {0.05, 0.1, 0.2, 0.5, 0.9})
        {
            const auto closure = balanced_lobe(GGX<double>(alpha), tables);
            const auto wo = direction<double>(mu);
            const auto with = sample_statistics(closure.prepare(wo), 40000),
                       without = sample_statistics(closure.lobe().prepare(wo), 40000);
            EXPECT_NEAR(with.mean.x, 1, 6e-3);
            EXPECT_LT(with.largest, 2.2);
            const double scaled = without.variance / std::pow(without.mean.x, 2);
            EXPECT_LT(with.variance, mu < 0.2 ? 0.2 : scaled + 0.01) << alpha << " " << mu;
        }
}

TEST(Balanced, strength_goes_from_nothing_to_all)
{
    const MicrofacetTables tables = tables_of("ggx");
    const auto wo = direction<double>(0.4), wi = direction<double>(0.9, 2);
    const SchlickFresnel<double> dim(Triple(0.04, 0.2, 0.5));
    const auto gain = [&](double strength) {
        return BalancedGain(GGX<double>(0.6), dim, tables, strength).pair(wo, wi);
    };
    EXPECT_EQ(gain(0), Triple(1.0));
    EXPECT_EQ(gain(-3), Triple(1.0));
    EXPECT_EQ(gain(std::nan("")), Triple(1.0));
    EXPECT_EQ(gain(7), gain(1));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(gain(0.5)[c] - 1, 0.5 * (gain(1)[c] - 1), 1e-14);
    EXPECT_FALSE(BalancedGain(GGX<double>(0.6), dim, tables, 0.5).energy_preserving());
    EXPECT_FALSE(BalancedGain(GGX<double>(0.6, 0.3), dim, tables, 1.0).energy_preserving());
}

TEST(Balanced, a_mirror_and_a_lobe_without_tables_get_no_gain)
{
    const MicrofacetTables tables = tables_of("ggx");
    const auto wo = direction<double>(0.4), wi = direction<double>(0.9, 2);
    EXPECT_EQ(BalancedGain(GGX<double>(0.0), ConstantFresnel<double>(), tables, 1.0).pair(wo, wi),
              Triple(1.0));
    using Table = TableView MicrofacetTables::*;
    for (Table missing : {Table(&MicrofacetTables::E_ss), Table(&MicrofacetTables::q_ms),
                          Table(&MicrofacetTables::mu_ms), Table(&MicrofacetTables::balance)})
    {
        MicrofacetTables some = tables;
        some.*missing = {};
        const BalancedGain gain(GGX<double>(0.6), ConstantFresnel<double>(), some, 1.0);
        EXPECT_EQ(gain.pair(wo, wi), Triple(1.0));
        EXPECT_FALSE(gain.energy_preserving());
    }
}

TEST(Balanced, answers_in_batches_as_in_floats)
{
    const MicrofacetTables tables = stretched_tables_of("ggx");
    for (const float narrowing : {1.0f, 0.3f})
        expect_batch_answers_as_float([&](auto alpha) {
            using Real = decltype(alpha);
            const SchlickFresnel<Real> fresnel(Color3<Real>(Real(0.9f), Real(0.6f), Real(0.2f)));
            const GGX<Real> distribution(alpha, alpha * Real(narrowing));
            return balanced(
                MicrofacetReflection<GGX<Real>, SchlickFresnel<Real>>(distribution, fresnel),
                tables);
        });
}

}  // namespace
