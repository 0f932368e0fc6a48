// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Albedos by quadrature of the public eval, against the slope integral of the tables, which shares
// no code with the closures, against Monte Carlo, and against what is known in closed form.

#include "hemisphere.h"
#include "measured_albedo.h"
#include "random_numbers.h"

#include <regain/luts/albedo_integral.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace regain;
using namespace regain::tools;

namespace {

ClosureSpec white(double alpha_x, double alpha_y, Method method = Method::none)
{
    ClosureSpec spec;
    spec.alpha_x = alpha_x;
    spec.alpha_y = alpha_y;
    spec.fresnel = ConstantParameters{};
    spec.method = method;
    spec.precision = Precision::twice;
    return spec;
}

AlbedoSettings by(AlbedoMethod how, std::uint64_t samples = 65536)
{
    AlbedoSettings settings;
    settings.how = how;
    settings.samples = samples;
    return settings;
}

const AlbedoSettings quadrature = by(AlbedoMethod::quadrature);

constexpr double alphas[] = {1e-3, 0.01, 0.04, 0.1, 0.25, 0.5, 0.75, 1};
constexpr double cosines[] = {1e-3, 0.01, 0.05, 0.1, 0.3, 0.5, 0.7, 0.9, 1};

double largest_furnace_error(Precision precision)
{
    double largest = 0;
    for (double alpha : alphas)
        for (double mu : cosines)
        {
            ClosureSpec spec = white(alpha, alpha, Method::turquin);
            spec.precision = precision;
            const MeasuredAlbedo a = measured_albedo(spec, direction_at(mu), quadrature);
            largest = std::max(largest, std::abs(a.reflect.x - 1));
        }
    return largest;
}

}  // namespace

TEST(albedo_quadrature, rough_mirror_at_normal_incidence_keeps_1_less_ln_2)
{
    const MeasuredAlbedo a = measured_albedo(white(1, 1), {0, 0, 1}, quadrature);
    EXPECT_NEAR(a.reflect.x, 1 - std::log(2.0), 1e-12);
    EXPECT_EQ(a.transmit.x, 0);
}

TEST(albedo_quadrature, agrees_with_the_slope_integral)
{
    for (double alpha : alphas)
        for (double mu : cosines)
        {
            const MeasuredAlbedo a =
                measured_albedo(white(alpha, alpha), direction_at(mu), quadrature);
            EXPECT_NEAR(a.reflect.y, luts::ggx_albedo(mu, alpha, {}, {128}), 1e-6)
                << "alpha " << alpha << ", mu " << mu;
        }
}

TEST(albedo_quadrature, agrees_with_the_slope_integral_for_a_fresnel_term)
{
    for (double alpha : {0.05, 0.3, 1.0})
        for (double mu : {0.05, 0.4, 0.9})
        {
            ClosureSpec spec = white(alpha, alpha);
            spec.fresnel = SchlickParameters{{0.1, 0.1, 0.1}, {1, 1, 1}, {1, 1, 1}, 5};
            const double exact = luts::ggx_albedo(
                mu, alpha, [](double c) { return 0.1 + 0.9 * std::pow(1 - c, 5); });
            EXPECT_NEAR(measured_albedo(spec, direction_at(mu), quadrature).reflect.z, exact, 1e-7);
        }
}

TEST(albedo_quadrature, white_furnace_of_turquin)
{
    EXPECT_LE(largest_furnace_error(Precision::twice), 2e-3);
}

TEST(albedo_quadrature, white_furnace_of_turquin_in_float)
{
    EXPECT_LE(largest_furnace_error(Precision::single), 5e-3);
}

TEST(albedo_quadrature, error_estimate_holds)
{
    for (double alpha : {0.001, 0.02, 0.5, 1.0})
        for (double mu : {1e-3, 0.1, 0.8})
        {
            const MeasuredAlbedo a =
                measured_albedo(white(alpha, alpha), direction_at(mu), quadrature);
            const double exact = luts::ggx_albedo(mu, alpha, {}, {256});
            EXPECT_LE(std::abs(a.reflect.x - exact), *a.error + 1e-9) << alpha << ", " << mu;
        }
}

TEST(albedo_quadrature, does_not_depend_on_the_azimuth_of_an_isotropic_lobe)
{
    for (double alpha : {0.01, 0.6})
        for (double phi : {0.3, 2.0, 3.14159265358979, -1.0})
            EXPECT_NEAR(
                measured_albedo(white(alpha, alpha), direction_at(0.2, phi), quadrature).reflect.x,
                measured_albedo(white(alpha, alpha), direction_at(0.2), quadrature).reflect.x,
                1e-8);
}

TEST(albedo_quadrature, turning_an_anisotropic_lobe_turns_its_albedo)
{
    const double quarter = std::acos(0.0);
    EXPECT_NEAR(
        measured_albedo(white(0.8, 0.05), direction_at(0.3, 0.4), quadrature).reflect.x,
        measured_albedo(white(0.05, 0.8), direction_at(0.3, 0.4 + quarter), quadrature).reflect.x,
        1e-6);
}

TEST(albedo_quadrature, agrees_with_monte_carlo_for_anisotropic_lobes)
{
    for (auto [ax, ay] : {std::pair(0.5, 0.05), std::pair(0.02, 1.0)})
        for (double mu : {0.05, 0.5})
        {
            const ClosureSpec spec = white(ax, ay);
            const Imath::V3d wo = direction_at(mu, 0.7);
            const MeasuredAlbedo q = measured_albedo(spec, wo, quadrature);
            const MeasuredAlbedo mc = measured_albedo(spec, wo, by(AlbedoMethod::monte_carlo));
            EXPECT_NEAR(q.reflect.x, mc.reflect.x, 5 * *mc.error) << ax << ", " << ay << ", " << mu;
            EXPECT_LE(*q.error, 1e-5);
        }
}

TEST(albedo_quadrature, density_and_misses_add_up_to_1)
{
    const GGX<double> ggx(0.6, 0.2);
    const MicrofacetReflection lobe(ggx, ConstantFresnel<double>());
    const Imath::V3d wo = direction_at(0.15, 1);
    const auto prepared = lobe.prepare(wo);
    const double density = integrate_reflection(wo, 0.6, 0.2, 64, [&](const Imath::V3d& wi) {
                               return ColorD(prepared.pdf(wi));
                           }).x;
    RandomNumbers random(0);
    const int n = 200000;
    int missed = 0;
    for (int i = 0; i < n; ++i)
    {
        const double u = random.next<double>();
        missed += !prepared.sample({u, random.next<double>()}).valid;
    }
    const double p = static_cast<double>(missed) / n;
    EXPECT_NEAR(density + p, 1, 5 * std::sqrt(p * (1 - p) / n) + 1e-5);
}

TEST(albedo_quadrature, a_mirror_has_its_fresnel_reflectance)
{
    ClosureSpec spec = white(0, 0);
    spec.fresnel = ConductorParameters{};
    const ConductorParameters gold;
    const ColorD F = ConductorFresnel<double>(gold.n, gold.k).at(0.4);
    for (auto how : {AlbedoMethod::quadrature, AlbedoMethod::monte_carlo, AlbedoMethod::table})
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(measured_albedo(spec, direction_at(0.4), by(how, 100)).reflect[c], F[c],
                        1e-12);
}

TEST(albedo_quadrature, below_the_horizon_nothing_is_reflected)
{
    for (double mu : {-1.0, -0.2, 0.0})
        for (auto how : {AlbedoMethod::quadrature, AlbedoMethod::monte_carlo})
            EXPECT_EQ(measured_albedo(white(0.5, 0.5), direction_at(mu), by(how, 100)).reflect.x,
                      0);
}

TEST(average_albedo, agrees_with_the_slope_integral)
{
    for (double alpha : {0.1, 0.5, 1.0})
    {
        const double exact = luts::ggx_average_albedo(alpha);
        const MeasuredAlbedo q = measured_average_albedo(white(alpha, alpha), quadrature);
        EXPECT_NEAR(q.reflect.x, exact, 1e-6);
        const MeasuredAlbedo table =
            measured_average_albedo(white(alpha, alpha), by(AlbedoMethod::table));
        EXPECT_NEAR(table.reflect.x, exact, 1e-3);
        EXPECT_FALSE(table.error);
        const MeasuredAlbedo mc =
            measured_average_albedo(white(alpha, alpha), by(AlbedoMethod::monte_carlo));
        EXPECT_NEAR(mc.reflect.x, exact, 5 * *mc.error);
    }
}

TEST(average_albedo, of_an_anisotropic_lobe_is_over_all_azimuths)
{
    const MeasuredAlbedo q = measured_average_albedo(white(0.7, 0.1), quadrature);
    const MeasuredAlbedo mc =
        measured_average_albedo(white(0.7, 0.1), by(AlbedoMethod::monte_carlo));
    EXPECT_NEAR(q.reflect.x, mc.reflect.x, 5 * *mc.error);
}

TEST(random_numbers, are_those_of_the_published_generator)
{
    // First draw of SplitMix64 for seed 0, from the reference implementation by Sebastiano Vigna.
    EXPECT_EQ(RandomNumbers(0).next<double>(),
              static_cast<double>(0xe220a8397b1dcdafu >> 11) / 9007199254740992.0);
    EXPECT_EQ(RandomNumbers(0).next<float>(), static_cast<float>(0xe220a8u) / 16777216.0f);
}
