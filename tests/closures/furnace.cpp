// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The white furnace: a mirror-like surface of any roughness that absorbs nothing returns all
// energy.

#include "../support/closures.h"
#include "../support/reflection_integral.h"

#include <regain/closures/beckmann.h>
#include <regain/closures/gtr.h>
#include <regain/closures/std.h>
#include <regain/luts/albedo_integral.h>
#include <regain/luts/library.h>

#include <gtest/gtest.h>

#include <functional>
#include <string>

using namespace regain;
using namespace regain::tests;

namespace {

template <class Closure>
double furnace(const Closure& closure, const Vec3<double>& wo, double alpha_x, double alpha_y)
{
    const auto prepared = closure.prepare(wo);
    return integrate_reflections(wo, alpha_x, alpha_y, 48,
                                 [&](const Vec3<double>& wi) { return prepared.eval(wi).x; });
}

// The bound is 2e-3; 6.2e-4 is what the tables leave.
TEST(Furnace, turquin_returns_all_energy)
{
    for (double alpha : alphas)
        for (double mu : cosines)
        {
            const auto closure =
                compensated(white<double>(alpha, alpha), Method::turquin, luts::ggx_tables());
            EXPECT_NEAR(furnace(closure, direction<double>(mu), alpha, alpha), 1, 7e-4)
                << "alpha " << alpha << ", mu " << mu;
        }
}

// Directions are rounded to float on their way into eval, as a renderer's are.
TEST(Furnace, float_is_as_good_as_double_at_grazing_angles)
{
    for (double alpha : {1e-3, 0.01, 0.2})
        for (double mu : {1e-5, 1e-4, 1e-3, 0.01, 0.3})
            for (double azimuth : {0.0, 0.7, 1.3})
            {
                const auto wo = direction<double>(mu, azimuth);
                const auto prepared =
                    compensated(white<float>(alpha, alpha), Method::turquin, luts::ggx_tables())
                        .prepare(Vec3<float>(wo));
                const double E = integrate_reflections(wo, alpha, alpha, 48, [&](const auto& wi) {
                    return double(prepared.eval(Vec3<float>(wi)).x);
                });
                EXPECT_NEAR(E, 1, 2e-3) << "alpha " << alpha << ", mu " << mu << ", " << azimuth;
            }
}

// With F = 1 every method that compensates at all is the same gain.
TEST(Furnace, every_method_returns_all_energy)
{
    for (Method method : all_methods)
        for (double alpha : {0.1, 0.5, 1.0})
        {
            if (method == Method::none) continue;
            const auto closure =
                compensated(white<double>(alpha, alpha), method, luts::ggx_tables());
            EXPECT_TRUE(closure.traits().energy_preserving);
            EXPECT_NEAR(furnace(closure, direction<double>(0.4), alpha, alpha), 1, 7e-4)
                << name(method) << ", alpha " << alpha;
        }
}

// Against an integral that shares no code with the closures.
TEST(Furnace, uncompensated_loses_what_single_scattering_loses)
{
    for (double alpha : alphas)
        for (double mu : cosines)
            EXPECT_NEAR(furnace(white<double>(alpha, alpha), direction<double>(mu), alpha, alpha),
                        luts::ggx_albedo(mu, alpha), 2e-6)
                << "alpha " << alpha << ", mu " << mu;
}

TEST(Furnace, strength_blends_linearly)
{
    const double alpha = 0.8, mu = 0.6, E = luts::ggx_albedo(mu, alpha);
    for (double s : {0.0, 0.25, 0.5, 1.0})
    {
        const auto closure =
            compensated(white<double>(alpha, alpha), Method::turquin, luts::ggx_tables(), s);
        EXPECT_NEAR(furnace(closure, direction<double>(mu), alpha, alpha), E + s * (1 - E), 7e-4);
    }
}

// The same of the other distributions and the tables that are shipped. The quadrature is checked
// on the way: without compensation it finds what the law of slopes says.
template <class Distribution>
void expect_white_furnace(const std::string& name, double gamma, double bound, double quadrature,
                          const std::function<Distribution(double)>& make)
{
    const MicrofacetTables tables = luts::microfacet_tables(name);
    for (double alpha : {1e-3, 0.01, 0.05, 0.1, 0.25, 0.5, 0.75, 1.0})
    {
        const luts::SlopeLaw law = luts::SlopeLaw::named(name, alpha, gamma);
        const MicrofacetReflection<Distribution, ConstantFresnel<double>> lobe(
            make(alpha), ConstantFresnel<double>());
        const auto closure = compensated(lobe, Method::turquin, tables);
        EXPECT_TRUE(closure.traits().energy_preserving);
        for (double mu : {1e-3, 0.01, 0.05, 0.1, 0.3, 0.6, 1.0})
        {
            const auto where = testing::Message()
                               << name << " " << gamma << ", alpha " << alpha << ", mu " << mu;
            const auto wo = direction<double>(mu);
            EXPECT_NEAR(furnace(closure, wo, alpha, alpha), 1, bound) << where;
            if (mu == 1e-3 || mu == 0.3)
            {
                EXPECT_NEAR(furnace(lobe, wo, alpha, alpha), luts::albedo(law, mu), quadrature)
                    << where;
            }
        }
    }
}

TEST(Furnace, beckmann_returns_all_energy)
{
    expect_white_furnace<Beckmann<double>>("beckmann", 0, 1e-3, 1e-6,
                                           [](double alpha) { return Beckmann<double>(alpha); });
}

TEST(Furnace, gtr_returns_all_energy)
{
    for (double gamma : {0.3, 1.0, 1.7, 3.0, 10.0})
        expect_white_furnace<GTR<double>>("gtr", gamma, 3e-3, 1e-5,
                                          [&](double alpha) { return GTR<double>(alpha, gamma); });
}

// With gamma near 1.5 facets of all slopes count, however small alpha is; what is left of the
// quadrature's error is at mu and alpha of 1e-3.
TEST(Furnace, std_returns_all_energy)
{
    for (double gamma : {1.55, 1.7, 2.0, 3.0, 10.0, 60.0})
        expect_white_furnace<STD<double>>("std", gamma, 3e-3, gamma < 1.6 ? 1e-4 : 1e-5,
                                          [&](double alpha) { return STD<double>(alpha, gamma); });
}

}  // namespace
