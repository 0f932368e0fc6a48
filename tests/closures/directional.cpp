// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The gain whose colour depends on wo: its albedo against random walks, and its limits.

#include "../support/closures.h"

#include <regain/closures/beckmann.h>
#include <regain/closures/directional_gain.h>
#include <regain/closures/gtr.h>
#include <regain/closures/std.h>
#include <regain/closures/walk.h>
#include <regain/luts/albedo_integral.h>
#include <regain/luts/library.h>

#include <gtest/gtest.h>

using namespace regain;
using namespace regain::tests;

namespace {

MicrofacetTables tables_of(const std::string& distribution)
{
    MicrofacetTables tables = luts::microfacet_tables(distribution);
    luts::add_later_bounces(tables, distribution);
    return tables;
}

using Schlick = SchlickFresnel<double>;
using Metal = ConductorFresnel<double>;
using Triple = Color3<double>;

// By n and k at 650, 550 and 450 nm, from the refractiveindex.info database: gold, copper and
// silver of Johnson and Christy 1972, aluminium of Rakic 1995, nickel of Johnson and Christy 1974.
const Metal gold{Triple(0.156, 0.424, 1.383), Triple(3.602, 2.472, 1.916)},
    copper{Triple(0.238, 1.007, 1.240), Triple(3.626, 2.582, 2.393)},
    aluminium{Triple(1.558, 1.015, 0.633), Triple(7.712, 6.627, 5.454)},
    silver{Triple(0.052, 0.060, 0.040), Triple(4.409, 3.597, 2.648)},
    nickel{Triple(1.990, 1.921, 1.729), Triple(4.209, 3.616, 2.944)};
const Metal metals[] = {gold, copper, aluminium, silver, nickel};
const Schlick terms[] = {Schlick(Triple(0.02, 0.04, 0.1)), Schlick(Triple(0.2, 0.35, 0.5)),
                         Schlick(Triple(0.8, 0.95, 0.02))};
const Schlick tinted[] = {Schlick(Triple(0.9, 0.7, 0.3), Triple(0.9, 0.8, 0.5))};

// Albedo of a compensated lobe: single scattering by quadrature, times the gain.
template <class Gain, class Fresnel>
Triple compensated_albedo(const luts::SlopeLaw& law, const Gain& gain, const Fresnel& fresnel,
                          double mu)
{
    Triple single;
    for (int c = 0; c < 3; ++c)
        single[c] =
            luts::albedo(law, mu, [&](double cosine) { return fresnel.at(cosine)[c]; }, {24});
    return single * gain.at(direction<double>(mu));
}

// The largest difference from the mean of n walks, less four of its standard errors.
template <class Distribution, class Fresnel, class Gain>
double error_at(const Distribution& distribution, const luts::SlopeLaw& law, const Fresnel& fresnel,
                const Gain& gain, double mu, int n)
{
    const auto walk =
        Walk<Distribution, Fresnel>(distribution, fresnel).prepare(direction<double>(mu));
    const Vec3<double> start(0.31, 0.62, 0.17);
    Triple sum(0.0), squares(0.0);
    for (int i = 0; i < n; ++i)
    {
        const Triple w = walk.path(regain::detail::shifted_numbers(start, i)).weight;
        sum += w / n;
        squares += w * w / n;
    }
    const Triple off = compensated_albedo(law, gain, fresnel, mu) - sum;
    double worst = 0;
    for (int c = 0; c < 3; ++c)
    {
        const double error = std::sqrt(std::max(squares[c] - sum[c] * sum[c], 0.0) / n);
        worst = std::max(worst, std::abs(off[c]) - 4 * error);
    }
    return worst;
}

template <class Distribution, class Terms>
double worst_error(const std::string& name, double gamma, const Terms& fresnel_terms, int n)
{
    const MicrofacetTables tables = tables_of(name);
    double worst = 0;
    for (double alpha : {0.1, 0.4, 0.7, 1.0})
    {
        const luts::SlopeLaw law = luts::SlopeLaw::named(name, alpha, gamma);
        const auto distribution = [&] {
            if constexpr (Distribution::has_tail)
                return Distribution(alpha, gamma);
            else
                return Distribution(alpha);
        }();
        for (double mu : {0.05, 0.2, 0.5, 1.0})
            for (const auto& fresnel : fresnel_terms)
            {
                const DirectionalGain gain(distribution, fresnel, tables, 1.0);
                worst = std::max(worst, error_at(distribution, law, fresnel, gain, mu, n));
            }
    }
    return worst;
}

// Four standard errors of so many walks are below 4e-3. bench/albedo_error.cpp takes enough of
// them, and of angles and widths, to see the errors themselves.
constexpr int walks = 1 << 16;

TEST(Directional, albedo_is_that_of_the_walk_for_schlick)
{
    EXPECT_LT(worst_error<GGX<double>>("ggx", 0, terms, walks), 5e-3);
    EXPECT_LT(worst_error<Beckmann<double>>("beckmann", 0, terms, walks), 5e-3);
    EXPECT_LT(worst_error<GGX<double>>("ggx", 0, tinted, walks), 1e-2);
}

TEST(Directional, albedo_is_that_of_the_walk_for_metals)
{
    EXPECT_LT(worst_error<GGX<double>>("ggx", 0, metals, walks), 1.2e-2);
    EXPECT_LT(worst_error<Beckmann<double>>("beckmann", 0, metals, walks), 1.2e-2);
}

TEST(Directional, knows_the_bounces_of_long_tails)
{
    for (double gamma : {0.5, 3.0})
        EXPECT_LT(worst_error<GTR<double>>("gtr", gamma, terms, walks / 4), 3e-3) << gamma;
    for (double gamma : {1.55, 8.0})
        EXPECT_LT(worst_error<STD<double>>("std", gamma, terms, walks / 4), 1e-2) << gamma;
}

// Of a term that is known by its average alone.
TEST(Directional, an_average_gives_an_estimate)
{
    const MicrofacetTables tables = tables_of("ggx");
    double worst = 0;
    for (double alpha : {0.25, 0.5, 0.75, 1.0})
        for (double mu : {0.1, 0.5, 1.0})
            for (const Metal& metal : {gold, nickel})
            {
                const GGX<double> d(alpha);
                const DirectionalGain gain(d, ConstantFresnel<double>(metal.average()), tables,
                                           1.0);
                worst = std::max(worst,
                                 error_at(d, luts::SlopeLaw::ggx(alpha), metal, gain, mu, walks));
            }
    EXPECT_LT(worst, 0.03);
}

TEST(Directional, loses_nothing_where_nothing_is_absorbed)
{
    for (const std::string name : {"ggx", "beckmann"})
    {
        const MicrofacetTables tables = tables_of(name);
        for (double alpha : alphas)
            for (double mu : cosines)
            {
                const GGX<double> d(alpha);
                const DirectionalGain gain(d, ConstantFresnel<double>(), tables, 1.0);
                const double E = tables.albedo(TableAxes<double>(d), mu);
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(gain.at(direction<double>(mu))[c], 1 / E, 1e-12 / E)
                        << alpha << " " << mu;
            }
    }
}

TEST(Directional, colours_nothing_where_all_is_absorbed)
{
    const MicrofacetTables tables = tables_of("ggx");
    const DirectionalGain gain(GGX<double>(0.7), ConstantFresnel<double>(Triple(0.0)), tables, 1.0);
    EXPECT_EQ(gain.at(direction<double>(0.3)), Triple(1.0));
    EXPECT_EQ(gain.F_ms(0.3), Triple(0.0));
}

// The series, summed term by term.
TEST(Directional, the_tint_is_the_sum_of_its_series)
{
    for (double q : {0.0, 0.3, 0.9})
        for (double x : {0.0, 0.04, 0.5, 1.0})
        {
            double sum = 0, term = x * (1 - q);
            for (int k = 0; k < 1000; ++k, term *= q * x) sum += term;
            EXPECT_NEAR(later_bounces_tint(Triple(x), q).y, sum, 1e-12) << x << " " << q;
        }
}

TEST(Directional, strength_goes_from_nothing_to_all)
{
    const MicrofacetTables tables = tables_of("ggx");
    const GGX<double> d(0.6);
    const auto wo = direction<double>(0.4);
    const auto gain = [&](double strength) {
        return DirectionalGain(d, terms[1], tables, strength).at(wo);
    };
    EXPECT_EQ(gain(0), Triple(1.0));
    EXPECT_EQ(gain(-3), Triple(1.0));
    EXPECT_EQ(gain(std::nan("")), Triple(1.0));
    EXPECT_EQ(gain(7), gain(1));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(gain(0.5)[c] - 1, 0.5 * (gain(1)[c] - 1), 1e-14);
    EXPECT_TRUE(DirectionalGain(d, terms[1], tables, 1.0).energy_preserving());
    EXPECT_FALSE(DirectionalGain(d, terms[1], tables, 0.5).energy_preserving());
    EXPECT_FALSE(DirectionalGain(GGX<double>(0.6, 0.3), terms[1], tables, 1.0).energy_preserving());
}

TEST(Directional, without_its_tables_it_changes_nothing)
{
    const auto wo = direction<double>(0.4);
    const GGX<double> d(0.6);
    MicrofacetTables some = tables_of("ggx");
    some.mu_ms = {};
    for (const MicrofacetTables& tables : {MicrofacetTables(), some})
    {
        const DirectionalGain gain(d, terms[1], tables, 1.0);
        EXPECT_EQ(gain.at(wo), Triple(1.0));
        EXPECT_FALSE(gain.energy_preserving());
    }
}

TEST(Directional, a_mirror_gets_no_gain)
{
    const DirectionalGain gain(GGX<double>(0.0), terms[1], tables_of("ggx"), 1.0);
    EXPECT_EQ(gain.at(direction<double>(0.4)), Triple(1.0));
}

// Float, double and vectors say the same.
TEST(Directional, is_the_same_in_float)
{
    const MicrofacetTables tables = tables_of("ggx");
    for (double alpha : alphas)
        for (double mu : cosines)
        {
            const DirectionalGain wide(GGX<double>(alpha), gold, tables, 1.0);
            const ConductorFresnel<float> metal(Color3<float>(gold.n()), Color3<float>(gold.k()));
            const DirectionalGain narrow(GGX<float>(static_cast<float>(alpha)), metal, tables,
                                         1.0f);
            const auto a = wide.at(direction<double>(mu));
            const auto b = narrow.at(direction<float>(mu));
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(double(b[c]) / a[c], 1, 2e-5) << alpha << mu;
        }
}

}  // namespace
