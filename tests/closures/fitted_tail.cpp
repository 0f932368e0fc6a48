// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The added lobe with the walk's shape: its azimuth, its colour, its energy and its limits. What
// the conformance kit asks of every closure (pdf, sampling, reciprocity, furnace) is not repeated.

#include "../support/closures.h"

#include <regain/closures/beckmann.h>
#include <regain/closures/fitted_tail.h>
#include <regain/closures/gtr.h>
#include <regain/closures/kulla_conty.h>
#include <regain/closures/std.h>
#include <regain/closures/walk.h>
#include <regain/luts/albedo_integral.h>
#include <regain/luts/library.h>

#include <gtest/gtest.h>

#include <array>

using namespace regain;
using namespace regain::tests;

namespace {

using Triple = Color3<double>;
using Spread = AzimuthSpread<double>;

const double pi = std::acos(-1.0);

MicrofacetTables tables_of(const std::string& distribution)
{
    MicrofacetTables tables = luts::microfacet_tables(distribution);
    luts::add_later_bounces(tables, distribution);
    luts::add_later_shape(tables, distribution);
    return tables;
}

Spread::Polar polar(double mu) { return {mu, std::sqrt((1 - mu) * (1 + mu))}; }

template <class F>
double integral_over_azimuth(const F& f)
{
    constexpr int n = 20000;
    double sum = 0;
    for (int i = 0; i < n; ++i) sum += f(pi * (2 * (i + 0.5) / n - 1)) * 2 * pi / n;
    return sum;
}

TEST(AzimuthSpread, is_a_density_that_both_directions_share)
{
    for (double k : {1e-4, 0.02, 0.3, 2.0})
        for (double m : {0.0, 0.3, 1.0})
            for (double a : {0.0, 0.01, 0.3, 0.8, 1.0})
                for (double b : {0.02, 0.5, 1.0})
                {
                    const Spread spread(k, m);
                    const auto there = spread.about(polar(a), polar(b)),
                               back = spread.about(polar(b), polar(a));
                    EXPECT_NEAR(integral_over_azimuth([&](double phi) {
                                    return there.relative_density(phi) / (2 * pi);
                                }),
                                1, 1e-6)
                        << k << " " << m << " " << a << " " << b;
                    for (double phi : {0.0, 0.4, -2.0, pi})
                        EXPECT_DOUBLE_EQ(there.relative_density(phi), back.relative_density(phi));
                }
}

// Along the normal there is no ahead.
TEST(AzimuthSpread, is_uniform_about_the_normal)
{
    const auto about = Spread(0.1, 0.9).about(polar(1), polar(0.5));
    for (double phi : {0.0, 1.0, 3.0}) EXPECT_NEAR(about.relative_density(phi), 1, 1e-6);
}

// The share of samples below any azimuth is the integral up to there.
TEST(AzimuthSpread, samples_have_the_density)
{
    for (double k : {0.01, 0.2, 3.0})
        for (double m : {0.0, 0.4, 1.0})
        {
            const auto about = Spread(k, m).about(polar(0.3), polar(0.6));
            constexpr int n = 20000;
            std::array<double, 64> share{};
            for (int i = 0; i < n; ++i)
            {
                const double phi = about.sample((i + 0.5) / n);
                ASSERT_LE(std::abs(phi), pi * (1 + 1e-12));
                share[std::min<std::size_t>(63, static_cast<std::size_t>((phi / pi + 1) * 32))] +=
                    1.0 / n;
            }
            for (std::size_t bin = 0; bin < share.size(); ++bin)
            {
                double expected = 0;
                for (int i = 0; i < 64; ++i)
                    expected += about.relative_density(
                                    pi * ((static_cast<double>(bin) + (i + 0.5) / 64) / 32 - 1)) /
                                4096;
                EXPECT_NEAR(share[bin], expected, 3.0 / n) << k << " " << m << " bin " << bin;
            }
        }
}

TEST(AzimuthSpread, measures_the_azimuth_from_straight_ahead)
{
    for (double mu : {0.2, 0.9})
        for (double phi : {0.0, 1e-6, 0.5, 2.0, pi - 1e-6, pi})
            EXPECT_NEAR(
                Spread::azimuth(direction<double>(mu, 0.7), direction<double>(0.4, 0.7 + pi + phi)),
                phi, 1e-9);
    EXPECT_EQ(Spread::azimuth({0, 0, 1}, direction<double>(0.4)), 0);
    EXPECT_NEAR(
        AzimuthSpread<float>::azimuth(direction<float>(0.5, 0.0), direction<float>(0.5, pi + 1e-3)),
        1e-3f, 1e-6f);
}

TEST(ColorCurve, follows_what_it_is_given)
{
    const auto polynomial = [](double mu) {
        const double x = std::sqrt(mu);
        return Triple(0.3 + 0.2 * x, 1, 0.9 - x * x * x * x * x * 0.4);
    };
    const regain::detail::ColorCurve<double> curve(polynomial);
    for (double mu : {0.0, 0.03, 0.2, 0.7, 1.0})
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(curve.at(mu)[c], polynomial(mu)[c], 1e-12);
}

// By n and k at 650, 550 and 450 nm, from the refractiveindex.info database: gold of Johnson and
// Christy 1972, aluminium of Rakic 1995.
const ConductorFresnel<double> metals[] = {
    {Triple(0.156, 0.424, 1.383), Triple(3.602, 2.472, 1.916)},
    {Triple(1.558, 1.015, 0.633), Triple(7.712, 6.627, 5.454)}};
const SchlickFresnel<double> terms[] = {SchlickFresnel<double>(Triple(0.02, 0.1, 0.35)),
                                        SchlickFresnel<double>(Triple(0.5, 0.8, 0.95))};

// Single scattering by quadrature and the tail's albedo, against the mean of walks; less four of
// its standard errors.
template <class Distribution, class Fresnel>
double albedo_error(const Distribution& distribution, const luts::SlopeLaw& law,
                    const Fresnel& fresnel, const MicrofacetTables& tables, double mu)
{
    constexpr int n = 1 << 16;
    const auto wo = direction<double>(mu);
    const auto walk = Walk<Distribution, Fresnel>(distribution, fresnel).prepare(wo);
    Triple sum(0.0), squares(0.0);
    for (int i = 0; i < n; ++i)
    {
        const Triple w =
            walk.path(regain::detail::shifted_numbers(Vec3<double>(0.3, 0.6, 0.2), i)).weight;
        sum += w / n;
        squares += w * w / n;
    }
    const MicrofacetReflection<Distribution, Fresnel> lobe(distribution, fresnel, tables);
    const Triple later = fitted_tail(lobe, tables).added_lobe().prepare(wo).albedo().reflect;
    double worst = 0;
    for (int c = 0; c < 3; ++c)
    {
        const double single =
            luts::albedo(law, mu, [&](double cosine) { return fresnel.at(cosine)[c]; }, {24});
        const double error = std::sqrt(std::max(squares[c] - sum[c] * sum[c], 0.0) / n);
        worst = std::max(worst, std::abs(single + later[c] - sum[c]) - 4 * error);
    }
    return worst;
}

template <class Make, class Terms>
double worst_albedo_error(const std::string& name, double gamma, const Make& make,
                          const Terms& fresnel_terms)
{
    const MicrofacetTables tables = tables_of(name);
    double worst = 0;
    for (double alpha : {0.1, 0.4, 1.0})
        for (double mu : {0.05, 0.3, 1.0})
            for (const auto& fresnel : fresnel_terms)
                worst = std::max(
                    worst, albedo_error(make(alpha), luts::SlopeLaw::named(name, alpha, gamma),
                                        fresnel, tables, mu));
    return worst;
}

TEST(FittedTail, albedo_is_that_of_the_walk)
{
    const auto ggx = [](double alpha) { return GGX<double>(alpha); };
    const auto beckmann = [](double alpha) { return Beckmann<double>(alpha); };
    EXPECT_LT(worst_albedo_error("ggx", 0, ggx, terms), 5e-3);
    EXPECT_LT(worst_albedo_error("ggx", 0, ggx, metals), 1.2e-2);
    EXPECT_LT(worst_albedo_error("beckmann", 0, beckmann, terms), 5e-3);
    EXPECT_LT(worst_albedo_error("beckmann", 0, beckmann, metals), 1.2e-2);
    EXPECT_LT(worst_albedo_error(
                  "gtr", 0.5, [](double a) { return GTR<double>(a, 0.5); }, terms),
              5e-3);
    EXPECT_LT(worst_albedo_error(
                  "std", 1.7, [](double a) { return STD<double>(a, 1.7); }, terms),
              1.2e-2);
}

// Light by cosine and azimuth: 8 x 16 cells of equal projected area, in the half that is like the
// other. (bench/shape_error.cpp has more, and enough samples for them.)
using Cells = std::array<double, 128>;

std::size_t cell_of(const Vec3<double>& wi)
{
    const double azimuth = std::atan2(std::abs(wi.y), wi.x) / pi;
    const auto row = std::min(7, static_cast<int>(wi.z * wi.z * 8)),
               column = std::min(15, static_cast<int>(azimuth * 16));
    return static_cast<std::size_t>(row * 16 + column);
}

template <class Prepared>
Cells cells_of_samples(const Prepared& prepared, int n)
{
    Cells cells{};
    for (int i = 0; i < n; ++i)
    {
        const auto s =
            prepared.sample(regain::detail::shifted_numbers(Vec3<double>(0.4, 0.1, 0.7), i));
        if (s.valid) cells[cell_of(s.wi)] += s.weight.x / n;
    }
    return cells;
}

double distance(const Cells& a, const Cells& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
    return sum;
}

template <class Distribution>
void expect_shape(const std::string& name, const Distribution& distribution, double mu,
                  double bound)
{
    const MicrofacetTables tables = tables_of(name);
    const MicrofacetReflection<Distribution, ConstantFresnel<double>> lobe(
        distribution, ConstantFresnel<double>(), tables);
    const auto wo = direction<double>(mu);
    constexpr int n = 1 << 18;
    const Cells walk = cells_of_samples(
        Walk<Distribution, ConstantFresnel<double>>(distribution, ConstantFresnel<double>())
            .prepare(wo),
        n);
    const double tail = distance(walk, cells_of_samples(fitted_tail(lobe, tables).prepare(wo), n)),
                 kulla_conty_lobe = distance(
                     walk, cells_of_samples(
                               kulla_conty(lobe, KullaContyForm::printed, tables).prepare(wo), n));
    EXPECT_LT(tail, bound) << name << " " << mu;
    EXPECT_LT(tail, kulla_conty_lobe + 0.005) << name << " " << mu;
}

TEST(FittedTail, has_the_shape_of_the_walk)
{
    // Some 0.01 of each bound is noise.
    for (double mu : {0.2, 0.9})
    {
        expect_shape("ggx", GGX<double>(0.25), mu, 0.035);
        expect_shape("ggx", GGX<double>(0.5), mu, 0.025);
        expect_shape("ggx", GGX<double>(1), mu, 0.035);
        expect_shape("beckmann", Beckmann<double>(0.5), mu, 0.025);
        expect_shape("beckmann", Beckmann<double>(1), mu, 0.025);
    }
}

TEST(FittedTail, strength_scales_it)
{
    const MicrofacetTables tables = tables_of("ggx");
    const MicrofacetReflection<GGX<double>, SchlickFresnel<double>> lobe(GGX<double>(0.6), terms[1],
                                                                         tables);
    const auto wo = direction<double>(0.4), wi = direction<double>(0.7, 2.0);
    const auto value = [&](double strength) {
        return fitted_tail(lobe, tables, strength).added_lobe().eval(wo, wi);
    };
    EXPECT_EQ(value(0), Triple(0.0));
    EXPECT_EQ(value(-1), Triple(0.0));
    EXPECT_EQ(value(std::nan("")), Triple(0.0));
    EXPECT_EQ(value(5), value(1));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(value(0.5)[c], 0.5 * value(1)[c], 1e-15);
    EXPECT_TRUE(fitted_tail(lobe, tables).traits().energy_preserving);
    EXPECT_FALSE(fitted_tail(lobe, tables, 0.5).traits().energy_preserving);
}

TEST(FittedTail, without_its_tables_nothing_is_added)
{
    const auto wo = direction<double>(0.4), wi = direction<double>(0.7, 2.0);
    MicrofacetTables some = tables_of("ggx");
    some.spread = {};
    const MicrofacetReflection<GGX<double>, SchlickFresnel<double>> lobe(GGX<double>(0.6), terms[1],
                                                                         some);
    const auto closure = fitted_tail(lobe, some);
    EXPECT_FALSE(closure.added_lobe().bound());
    EXPECT_FALSE(closure.traits().energy_preserving);
    EXPECT_EQ(closure.eval(wo, wi), lobe.eval(wo, wi));
    EXPECT_EQ(closure.pdf(wo, wi), lobe.pdf(wo, wi));
}

TEST(FittedTail, a_mirror_has_none)
{
    const MicrofacetTables tables = tables_of("ggx");
    const MicrofacetReflection<GGX<double>, SchlickFresnel<double>> lobe(GGX<double>(0.0), terms[1],
                                                                         tables);
    const auto prepared = fitted_tail(lobe, tables).added_lobe().prepare(direction<double>(0.4));
    EXPECT_EQ(prepared.eval(direction<double>(0.7)), Triple(0.0));
    EXPECT_EQ(prepared.albedo().reflect, Triple(0.0));
    EXPECT_FALSE(prepared.sample(Vec2<double>(0.3, 0.4)).valid);
}

}  // namespace
