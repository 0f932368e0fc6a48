// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Formulas in place of tables: against quadrature and walks, and in the methods that take them.

#include "../support/closures.h"
#include "../support/hostile.h"
#include "../support/reflection_integral.h"

#include <regain/closures/analytic_tables.h>
#include <regain/closures/directional_gain.h>
#include <regain/closures/fitted_tail.h>
#include <regain/closures/kulla_conty.h>
#include <regain/closures/walk.h>
#include <regain/closures/xsimd.h>
#include <regain/luts/albedo_integral.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

using namespace regain;
using namespace regain::tests;

namespace {

template <class Distribution>
const MicrofacetFits& fits_of()
{
    return *analytic_tables<Distribution>().fits;
}

template <class Distribution>
class AnalyticAlbedo : public testing::Test
{};
using Distributions = testing::Types<GGX<double>, Beckmann<double>>;

template <class Distribution>
luts::SlopeLaw law_of(double alpha)
{
    if constexpr (std::is_same_v<Distribution, GGX<double>>)
        return luts::SlopeLaw::ggx(alpha);
    else
        return luts::SlopeLaw::beckmann(alpha);
}

// visit(alpha, mu, exact) at places of all scales: along each alpha, evenly and about the dip at
// mu ~ alpha.
template <class Distribution, class Visit>
void visit_domain(const Visit& visit)
{
    Random random(5);
    for (int i = 0; i < 40; ++i)
    {
        const double alpha = i < 4    ? std::pow(10.0, -6 + i)
                             : i == 4 ? 1
                             : i % 2  ? random.unit()
                                      : std::pow(10.0, -3 * random.unit());
        const luts::SlopeLaw law = law_of<Distribution>(alpha);
        for (int j = 0; j < 60; ++j)
        {
            const double u = random.unit();
            const double mu = j == 0       ? 1
                              : j == 1     ? 1e-4
                              : j % 3 == 0 ? u
                              : j % 3 == 1 ? std::pow(10.0, -5 * u)
                                           : std::min(1.0, alpha * std::pow(10.0, 2 * u - 1));
            visit(alpha, mu, luts::albedo_moments(law, mu, {40}));
        }
    }
}

// The comma is for clang, which misses an argument without it.
TYPED_TEST_SUITE(AnalyticAlbedo, Distributions, );

// Both what is promised of E_ss itself and of the furnace, which gives back E_ss / fit.
TYPED_TEST(AnalyticAlbedo, E_ss_is_within_2e_3_from_grazing_to_normal)
{
    const MicrofacetFits& fits = fits_of<TypeParam>();
    visit_domain<TypeParam>([&](double alpha, double mu, const luts::AlbedoMoments& exact) {
        const double E = fits.E_ss(mu, alpha);
        EXPECT_NEAR(E, exact.E_ss, 1.8e-3) << "alpha " << alpha << ", mu " << mu;
        EXPECT_LE(exact.E_ss / E, 1.0019) << "alpha " << alpha << ", mu " << mu;
        EXPECT_GE(exact.E_ss / E, 0.9981) << "alpha " << alpha << ", mu " << mu;
    });
}

TYPED_TEST(AnalyticAlbedo, E_avg_is_within_2e_4)
{
    for (double alpha : {1e-6, 1e-3, 0.01, 0.03, 0.1, 0.2, 0.37, 0.5, 0.63, 0.8, 0.92, 1.0})
        EXPECT_NEAR(fits_of<TypeParam>().E_avg(alpha),
                    luts::average_albedo(law_of<TypeParam>(alpha), {40}), 2e-4)
            << alpha;
}

TYPED_TEST(AnalyticAlbedo, moments_are_those_of_what_is_scattered_once)
{
    visit_domain<TypeParam>([&](double alpha, double mu, const luts::AlbedoMoments& exact) {
        const FresnelMoments<double> m = fits_of<TypeParam>().moments(mu, alpha);
        EXPECT_NEAR(m.falloff * exact.E_ss, exact.falloff * exact.E_ss, 2e-3)
            << "alpha " << alpha << ", mu " << mu;
        EXPECT_NEAR(m.dip * exact.E_ss, exact.dip * exact.E_ss, 5e-4)
            << "alpha " << alpha << ", mu " << mu;
    });
}

// A mirror loses nothing, and neither does light along the surface.
TYPED_TEST(AnalyticAlbedo, nothing_is_lost_at_the_limits)
{
    const MicrofacetFits& fits = fits_of<TypeParam>();
    for (double x : {0.0, 1e-300, 1e-9, 1e-3, 0.5, 1.0})
    {
        EXPECT_NEAR(fits.E_ss(x, 0.0), 1, 1e-4) << x;
        EXPECT_EQ(fits.E_ss(0.0, x), 1) << x;
        EXPECT_NEAR(fits.E_ss(float(x), 0.0f), 1, 1e-4) << x;
        EXPECT_EQ(fits.E_ss(0.0f, float(x)), 1) << x;
    }
    EXPECT_EQ(fits.E_avg(0.0), 1);
}

TYPED_TEST(AnalyticAlbedo, every_number_is_in_its_range)
{
    const MicrofacetFits& fits = fits_of<TypeParam>();
    const auto expect = [](double x, double low, double high, const char* what) {
        EXPECT_TRUE(x >= low && x <= high) << what << " is " << x;
    };
    for (int i = 0; i <= 64; ++i)
        for (int j = 0; j <= 64; ++j)
        {
            const double alpha = std::pow(i / 64.0, 3), mu = std::pow(j / 64.0, 3);
            expect(fits.E_ss(mu, alpha), 0.25, 1, "E_ss");
            expect(fits.E_avg(alpha), 0.4, 1, "E_avg");
            expect(fits.q_ms(mu, alpha), 0, 0.5, "q_ms");
            expect(fits.mu_ms(mu, alpha), 0, 1, "mu_ms");
            expect(fits.moments(mu, alpha).falloff, 0, 1, "falloff");
            expect(fits.moments(mu, alpha).dip, 0, 0.06, "dip");
            expect(fits.spread(alpha), 0, 2, "spread");
            expect(fits.forward(alpha), 0, 1, "forward");
            expect(fits.tilt(alpha), -4, 8, "tilt");
        }
}

TYPED_TEST(AnalyticAlbedo, float_and_vectors_say_what_double_says)
{
    using Batch = xsimd::batch<float>;
    const MicrofacetFits& fits = fits_of<TypeParam>();
    Random random(3);
    for (int i = 0; i < 20000; ++i)
    {
        const float mu = float(i % 2 ? random.unit() : std::pow(10.0, -6 * random.unit())),
                    alpha = float(i % 3 ? random.unit() : std::pow(10.0, -5 * random.unit()));
        const auto lane = [](const Batch& b) { return double(b.get(Batch::size - 1)); };
        const auto near = [&](double a, double b, double c, double bound, const char* what) {
            EXPECT_NEAR(a, b, bound) << what << ", float, alpha " << alpha << ", mu " << mu;
            EXPECT_NEAR(c, b, bound) << what << ", vector, alpha " << alpha << ", mu " << mu;
        };
        const double m = mu, a = alpha;
        const Batch ms(mu), as(alpha);
        near(fits.E_ss(mu, alpha), fits.E_ss(m, a), lane(fits.E_ss(ms, as)), 2e-5, "E_ss");
        near(fits.E_avg(alpha), fits.E_avg(a), lane(fits.E_avg(as)), 1e-6, "E_avg");
        near(fits.q_ms(mu, alpha), fits.q_ms(m, a), lane(fits.q_ms(ms, as)), 1e-6, "q_ms");
        near(fits.mu_ms(mu, alpha), fits.mu_ms(m, a), lane(fits.mu_ms(ms, as)), 1e-6, "mu_ms");
        near(fits.moments(mu, alpha).falloff, fits.moments(m, a).falloff,
             lane(fits.moments(ms, as).falloff), 1e-5, "falloff");
        near(fits.moments(mu, alpha).dip, fits.moments(m, a).dip, lane(fits.moments(ms, as).dip),
             1e-5, "dip");
    }
}

template <class Distribution>
MicrofacetReflection<Distribution, ConstantFresnel<double>> mirror(double alpha)
{
    return {Distribution(alpha), ConstantFresnel<double>()};
}

// Through public eval.
template <class Closure>
double furnace(const Closure& closure, double mu, double alpha)
{
    const auto wo = direction<double>(mu);
    const auto prepared = closure.prepare(wo);
    return integrate_reflections(wo, alpha, alpha, 48,
                                 [&](const Vec3<double>& wi) { return prepared.eval(wi).x; });
}

TYPED_TEST(AnalyticAlbedo, gains_return_all_energy)
{
    const MicrofacetTables tables = analytic_tables<TypeParam>();
    for (double alpha : {1e-3, 0.01, 0.05, 0.1, 0.25, 0.5, 0.75, 1.0})
        for (double mu : {1e-4, 1e-3, 0.01, 0.05, 0.1, 0.3, 0.6, 1.0})
        {
            const auto lobe = mirror<TypeParam>(alpha);
            const auto closure = compensated(lobe, Method::series, tables);
            EXPECT_TRUE(closure.traits().energy_preserving);
            EXPECT_NEAR(furnace(closure, mu, alpha), 1, 2e-3) << "alpha " << alpha << ", mu " << mu;
            EXPECT_EQ(closure.gain().at(direction<double>(mu)).x,
                      directional(lobe, tables).gain().at(direction<double>(mu)).x);
        }
}

// Added lobes are asked for their albedo, which their own tests hold against eval.
TYPED_TEST(AnalyticAlbedo, added_lobes_return_what_is_lost)
{
    const MicrofacetTables tables = analytic_tables<TypeParam>();
    for (double alpha : {0.01, 0.1, 0.5, 1.0})
        for (double mu : {1e-3, 0.05, 0.3, 1.0})
        {
            const auto lobe = mirror<TypeParam>(alpha);
            const double single = luts::albedo(law_of<TypeParam>(alpha), mu);
            const auto wo = direction<double>(mu);
            const auto added = kulla_conty(lobe, KullaContyForm::series, tables).added_lobe();
            ASSERT_TRUE(added.bound());
            EXPECT_NEAR(single + added.prepare(wo).albedo().reflect.x, 1, 2e-3);
            const auto tail = fitted_tail(lobe, tables).added_lobe();
            ASSERT_TRUE(tail.bound());
            EXPECT_NEAR(single + tail.prepare(wo).albedo().reflect.x, 1, 2e-3);
        }
}

TYPED_TEST(AnalyticAlbedo, a_lobe_knows_its_albedo)
{
    using Triple = Color3<double>;
    const SchlickFresnel<double> plain(Triple(0.04, 0.5, 0.9)),
        tinted(Triple(0.9, 0.7, 0.3), Triple(0.9, 0.8, 0.5));
    for (const auto& fresnel : {plain, tinted})
        for (double alpha : {1e-3, 0.05, 0.2, 0.5, 1.0})
            for (double mu : {1e-3, 0.05, 0.3, 0.7, 1.0})
            {
                const luts::SlopeLaw law = law_of<TypeParam>(alpha);
                const MicrofacetReflection<TypeParam, SchlickFresnel<double>> lobe(
                    TypeParam(alpha), fresnel, analytic_tables<TypeParam>());
                const Triple found = lobe.albedo(direction<double>(mu)).reflect;
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(
                        found[c],
                        luts::albedo(law, mu, [&](double at) { return fresnel.at(at)[c]; }, {24}),
                        5e-3)
                        << "alpha " << alpha << ", mu " << mu;
            }
}

// Four standard errors of so many walks are below 4e-3.
template <class Distribution, class Fresnel>
double directional_error(const Fresnel& fresnel, double alpha, double mu)
{
    const Distribution distribution(alpha);
    const auto wo = direction<double>(mu);
    const auto walk = Walk<Distribution, Fresnel>(distribution, fresnel).prepare(wo);
    const Vec3<double> start(0.31, 0.62, 0.17);
    constexpr int n = 1 << 16;
    Color3<double> sum(0.0), squares(0.0), single;
    for (int i = 0; i < n; ++i)
    {
        const auto w = walk.path(regain::detail::shifted_numbers(start, i)).weight;
        sum += w / double(n);
        squares += w * w / double(n);
    }
    const luts::SlopeLaw law = law_of<Distribution>(alpha);
    for (int c = 0; c < 3; ++c)
        single[c] =
            luts::albedo(law, mu, [&](double cosine) { return fresnel.at(cosine)[c]; }, {24});
    const DirectionalGain gain(distribution, fresnel, analytic_tables<Distribution>(), 1.0);
    const auto off = single * gain.at(wo) - sum;
    double worst = 0;
    for (int c = 0; c < 3; ++c)
        worst = std::max(worst, std::abs(off[c]) -
                                    4 * std::sqrt(std::max(squares[c] - sum[c] * sum[c], 0.0) / n));
    return worst;
}

TYPED_TEST(AnalyticAlbedo, directional_is_as_good_as_with_tables)
{
    using Triple = Color3<double>;
    const SchlickFresnel<double> schlick(Triple(0.04, 0.35, 0.8));
    // Gold, Johnson and Christy 1972.
    const ConductorFresnel<double> metal(Triple(0.156, 0.424, 1.383), Triple(3.602, 2.472, 1.916));
    for (double alpha : {0.1, 0.5, 1.0})
        for (double mu : {0.05, 0.3, 1.0})
        {
            EXPECT_LT(directional_error<TypeParam>(schlick, alpha, mu), 5e-3) << alpha << " " << mu;
            EXPECT_LT(directional_error<TypeParam>(metal, alpha, mu), 1.2e-2) << alpha << " " << mu;
        }
}

template <class Distribution>
void expect_finite_answers()
{
    using Real = typename Distribution::Real;
    const MicrofacetTables tables = analytic_tables<Distribution>();
    Hostile<Real> hostile(11);
    const Trapped trapped;
    for (int i = 0; i < 20000; ++i)
    {
        const Distribution distribution(hostile.number(), hostile.number());
        const MicrofacetReflection<Distribution, SchlickFresnel<Real>> lobe(
            distribution, SchlickFresnel<Real>(hostile.color()), tables);
        // Whatever a closure is asked about, its gain is asked about unit directions.
        const Vec3<Real> wo =
            lobe.prepare({hostile.number(), hostile.number(), hostile.number()}).wo();
        const auto finite = [](const Color3<Real>& c) {
            return std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z);
        };
        const Real strength = hostile.number();
        EXPECT_TRUE(finite(MethodGain<Real>(lobe, Method::series, tables, strength).at(wo)));
        EXPECT_TRUE(finite(DirectionalGain(distribution, lobe.fresnel(), tables, strength).at(wo)));
        EXPECT_TRUE(finite(lobe.albedo(wo).reflect));
    }
}

TEST(AnalyticTables, hostile_inputs_stay_finite)
{
    expect_finite_answers<GGX<float>>();
    expect_finite_answers<GGX<double>>();
    expect_finite_answers<Beckmann<float>>();
    expect_finite_answers<Beckmann<double>>();
}

// Lanes of their own width and direction.
template <template <class> class Distribution>
void compare_lanes()
{
    using Batch = xsimd::batch<float>;
    constexpr std::size_t lanes = Batch::size;
    const MicrofacetTables tables = analytic_tables<Distribution<float>>();
    Random random(23);
    for (int i = 0; i < 500; ++i)
    {
        alignas(64) float alpha[lanes], mu[lanes];
        for (std::size_t l = 0; l < lanes; ++l)
        {
            alpha[l] = float(random.unit() * random.unit());
            mu[l] = float(random.unit() * random.unit());
        }
        const Batch z = Batch::load_aligned(mu);
        const Vec3<Batch> wo(xsimd::sqrt(1.0f - z * z), Batch(0.0f), z);
        const Distribution<Batch> wide(Batch::load_aligned(alpha));
        const SchlickFresnel<Batch> fresnel(Color3<Batch>(Batch(0.9f), Batch(0.5f), Batch(0.1f)));
        const auto gains = DirectionalGain(wide, fresnel, tables, Batch(1.0f)).at(wo);
        for (std::size_t l = 0; l < lanes; ++l)
        {
            const SchlickFresnel<float> one(Color3<float>(0.9f, 0.5f, 0.1f));
            const auto gain = DirectionalGain(Distribution<float>(alpha[l]), one, tables, 1.0f)
                                  .at(Vec3<float>(std::sqrt(1 - mu[l] * mu[l]), 0, mu[l]));
            EXPECT_NEAR(gains.y.get(l), gain.y, 2e-5 * gain.y) << alpha[l] << " " << mu[l];
        }
    }
}

TEST(AnalyticTables, lanes_answer_as_a_float_does)
{
    compare_lanes<GGX>();
    compare_lanes<Beckmann>();
}

TEST(AnalyticTables, are_there_for_two_distributions)
{
    EXPECT_TRUE(has_analytic_tables<GGX<float>>);
    EXPECT_TRUE(has_analytic_tables<Beckmann<double>>);
    EXPECT_FALSE(has_analytic_tables<int>);
    const MicrofacetTables none, fits = analytic_tables<GGX<float>>();
    using Has = bool (MicrofacetTables::*)() const;
    for (const Has has :
         {Has(&MicrofacetTables::has_albedo), Has(&MicrofacetTables::has_average_albedo),
          Has(&MicrofacetTables::has_moments), Has(&MicrofacetTables::has_later_bounces),
          Has(&MicrofacetTables::has_later_shape)})
    {
        EXPECT_TRUE((fits.*has)());
        EXPECT_FALSE((none.*has)());
    }
}

}  // namespace
