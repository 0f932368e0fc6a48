// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Anisotropic lobes whose loss is looked up in a table of its own: the white furnace measured
// through eval and sample, what it is not allowed to change, and the table itself. Most of it is of
// the distributions with a tail, whose losses vary most.

#include "../support/closures.h"
#include "../support/reflection_integral.h"

#include <regain/closures/beckmann.h>
#include <regain/closures/fitted_tail.h>
#include <regain/closures/gtr.h>
#include <regain/closures/kulla_conty.h>
#include <regain/closures/std.h>
#include <regain/closures/xsimd.h>
#include <regain/luts/albedo_integral.h>
#include <regain/luts/anisotropic_albedo.h>
#include <regain/luts/library.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

using namespace regain;
using namespace regain::tests;

namespace {

const double pi = std::acos(-1.0);

template <class Distribution>
const char* const name_of = "gtr";
template <class Real>
const char* const name_of<STD<Real>> = "std";
template <class Real>
const char* const name_of<GGX<Real>> = "ggx";
template <class Real>
const char* const name_of<Beckmann<Real>> = "beckmann";

// Of the distributions without a tail gamma is nothing.
template <class Distribution>
Distribution make(double alpha_x, double alpha_y, double gamma)
{
    if constexpr (Distribution::has_tail)
        return Distribution(alpha_x, alpha_y, gamma);
    else
        return Distribution(alpha_x, alpha_y);
}

template <class Distribution>
MicrofacetTables tables_of()
{
    const std::string name = name_of<Distribution>;
    MicrofacetTables tables = luts::microfacet_tables(name);
    luts::add_anisotropy(tables, name);
    luts::add_later_bounces(tables, name);
    luts::add_later_shape(tables, name);
    return tables;
}

template <class Distribution>
auto white_lobe(double alpha_x, double alpha_y, double gamma)
{
    return MicrofacetReflection<Distribution, ConstantFresnel<double>>(
        make<Distribution>(alpha_x, alpha_y, gamma), ConstantFresnel<double>());
}

template <class Distribution>
luts::SlopeLaw law_of(double alpha, double gamma)
{
    return luts::SlopeLaw::named(name_of<Distribution>, alpha, gamma);
}

template <class Distribution>
double exact_albedo(double alpha_x, double alpha_y, double gamma, const Vec3<double>& w)
{
    const double stretch = std::sqrt(alpha_x / alpha_y);
    return luts::anisotropic_albedo(law_of<Distribution>(std::sqrt(alpha_x * alpha_y), gamma),
                                    stretch, 1 / stretch, w, 16);
}

struct Case
{
    double x, y, gamma;
    std::string name() const
    {
        return std::to_string(x) + " " + std::to_string(y) + ", gamma " + std::to_string(gamma);
    }
};
// Without the table the furnace of these is up to 0.5 off, of STD 0.05.
constexpr Case gtr_cases[] = {{1, 0.1, 1}, {0.05, 0.6, 0.2}, {0.3, 0.1, 1.4}, {0.04, 0.8, 6}};
constexpr Case std_cases[] = {{0.1, 1, 1.54}, {0.8, 0.2, 1.6}, {1, 0.05, 2.6}};
// By the formula these are up to 0.013 off.
constexpr Case short_cases[] = {{0.7, 0.07, 0}, {0.05, 1, 0}, {0.3, 0.15, 0}};

template <class Distribution>
double furnace_by_gain(const Case& c, const MicrofacetTables& tables, const Vec3<double>& wo)
{
    const auto white =
        compensated(white_lobe<Distribution>(c.x, c.y, c.gamma), Method::turquin, tables);
    const auto prepared = white.prepare(wo);
    return integrate_reflections(
        wo, c.x, c.y, 16, [&](const Vec3<double>& wi) { return prepared.eval(wi).x; }, true);
}

template <class Distribution, std::size_t count>
void expect_white_gain(const Case (&cases)[count], double tolerance, double without_it)
{
    const MicrofacetTables tables = tables_of<Distribution>();
    MicrofacetTables without = tables;
    without.anisotropy = nullptr;
    double worst_without = 0;
    for (const Case& c : cases)
        for (const double mu : {0.04, 0.35, 0.85})
            for (const double azimuth : {0.0, 0.8, 1.5, 0.5 * pi})
            {
                const auto wo = direction<double>(mu, azimuth);
                const double E = furnace_by_gain<Distribution>(c, tables, wo);
                EXPECT_NEAR(E, 1, tolerance)
                    << c.name() << ", mu " << mu << ", azimuth " << azimuth;
                const auto axes = DirectionAxes<double>(make<Distribution>(c.x, c.y, c.gamma));
                worst_without =
                    std::max(worst_without,
                             std::abs(E * axes.albedo(tables, wo) / axes.albedo(without, wo) - 1));
            }
    EXPECT_GT(worst_without, without_it);
}

TEST(AnisotropicTables, gtr_returns_all_with_a_gain)
{
    expect_white_gain<GTR<double>>(gtr_cases, 1e-2, 2e-2);
}

TEST(AnisotropicTables, std_returns_all_with_a_gain)
{
    expect_white_gain<STD<double>>(std_cases, 1e-2, 2e-2);
}

TEST(AnisotropicTables, those_without_a_tail_return_all_with_a_gain)
{
    expect_white_gain<GGX<double>>(short_cases, 4e-3, 4e-3);
    expect_white_gain<Beckmann<double>>(short_cases, 4e-3, 4e-3);
}

// Over all widths up to 20 : 1, gammas, directions: what is looked up, against quadrature without
// any of the closures' code.
template <class Distribution>
void expect_close_look_ups(double least_gamma, double greatest_gamma, double tolerance = 1e-2)
{
    const MicrofacetTables tables = tables_of<Distribution>();
    Random random(29);
    double worst = 0;
    for (int i = 0; i < 120; ++i)
    {
        const double wider = i % 8 ? std::pow(0.01, random.unit()) : 1,
                     narrower = wider * std::pow(0.05, random.unit());
        const double gamma = least_gamma * std::pow(greatest_gamma / least_gamma, random.unit());
        const double mu = i % 2 ? std::pow(0.01, random.unit()) : 0.01 + 0.99 * random.unit();
        const bool turned = i % 3 == 0;
        const double x = turned ? narrower : wider, y = turned ? wider : narrower;
        const auto w = direction<double>(mu, 2 * pi * random.unit());
        const double found =
            DirectionAxes<double>(make<Distribution>(x, y, gamma)).albedo(tables, w);
        worst = std::max(worst, std::abs(found / exact_albedo<Distribution>(x, y, gamma, w) - 1));
    }
    EXPECT_LT(worst, tolerance);
    EXPECT_GT(worst, 1e-4);
}

TEST(AnisotropicTables, look_ups_of_gtr_are_within_a_hundredth)
{
    expect_close_look_ups<GTR<double>>(0.05, 10);
    expect_close_look_ups<GTR<double>>(0.8, 1.6);
}

TEST(AnisotropicTables, look_ups_of_std_are_within_a_hundredth)
{
    expect_close_look_ups<STD<double>>(1.51, 1.7);
    expect_close_look_ups<STD<double>>(1.7, 100);
}

TEST(AnisotropicTables, look_ups_of_those_without_a_tail_are_closer)
{
    expect_close_look_ups<GGX<double>>(1, 1, 3.5e-3);
    expect_close_look_ups<Beckmann<double>>(1, 1, 3.5e-3);
}

// Over the hemisphere, nodes gathered at the horizon and ahead of wo.
template <class F>
double over_hemisphere(const Vec3<double>& wo, const F& f)
{
    static const luts::QuadratureRule rule = luts::gauss_legendre(28);
    const double ahead = std::atan2(-wo.y, -wo.x);
    double sum = 0;
    for (std::size_t i = 0; i < rule.x.size(); ++i)
        for (std::size_t j = 0; j < rule.x.size(); ++j)
            for (const int side : {-1, 1})
            {
                const double x = rule.x[i], y = rule.x[j];
                const double mu = x * x * x, phi = ahead + side * pi * y * y * y;
                sum += f(direction<double>(mu, phi)) * 9 * pi * x * x * y * y * rule.weight[i] *
                       rule.weight[j];
            }
    return sum;
}

// The added lobe is what eval integrates to, and makes the furnace white; samples follow its
// density; both ends can be exchanged.
template <class Distribution, class Closure>
void expect_sound_added_lobe(const Closure& closure, const Case& c)
{
    Random random(5);
    for (const double mu : {0.1, 0.6})
        for (const double azimuth : {0.1, 1.5})
        {
            const auto wo = direction<double>(mu, azimuth);
            const auto added = closure.added_lobe().prepare(wo);
            const double rest =
                over_hemisphere(wo, [&](const Vec3<double>& wi) { return added.eval(wi).x; });
            EXPECT_NEAR(rest, added.albedo().reflect.x, 4e-3) << c.name() << ", mu " << mu;
            EXPECT_NEAR(rest + exact_albedo<Distribution>(c.x, c.y, c.gamma, wo), 1, 1e-2)
                << c.name() << ", mu " << mu << ", azimuth " << azimuth;
            EXPECT_NEAR(over_hemisphere(wo, [&](const Vec3<double>& wi) { return added.pdf(wi); }),
                        1, 5e-3);

            double sum = 0, squares = 0;
            constexpr int count = 4000;
            for (int i = 0; i < count; ++i)
            {
                const auto s = added.sample(random.square<double>());
                const double weight = s.valid ? s.weight.x : 0;
                sum += weight / count;
                squares += weight * weight / count;
                if (!s.valid) continue;
                ASSERT_NEAR(added.pdf(s.wi) / s.pdf, 1, 1e-9);
                ASSERT_NEAR(added.eval(s.wi).x / (s.pdf * s.weight.x), 1, 1e-9);
            }
            EXPECT_NEAR(sum, rest, 5e-3 + 4 * std::sqrt((squares - sum * sum) / count));
        }
    for (int i = 0; i < 200; ++i)
    {
        const auto a = direction<double>(0.01 + 0.99 * random.unit(), 2 * pi * random.unit()),
                   b = direction<double>(0.01 + 0.99 * random.unit(), 2 * pi * random.unit());
        const double forth = closure.eval(a, b).x * a.z, back = closure.eval(b, a).x * b.z;
        EXPECT_NEAR(forth, back, 1e-6 * (forth + back) + 1e-12) << c.name();
    }
}

TEST(AnisotropicTables, added_lobes_are_sound)
{
    const MicrofacetTables gtr = tables_of<GTR<double>>(), std = tables_of<STD<double>>();
    for (const Case& c : {gtr_cases[0], gtr_cases[1]})
    {
        const auto lobe = white_lobe<GTR<double>>(c.x, c.y, c.gamma);
        expect_sound_added_lobe<GTR<double>>(kulla_conty(lobe, KullaContyForm::series, gtr), c);
        expect_sound_added_lobe<GTR<double>>(fitted_tail(lobe, gtr), c);
    }
    const Case c = std_cases[0];
    const auto lobe = white_lobe<STD<double>>(c.x, c.y, c.gamma);
    expect_sound_added_lobe<STD<double>>(kulla_conty(lobe, KullaContyForm::series, std), c);
    expect_sound_added_lobe<STD<double>>(fitted_tail(lobe, std), c);
}

// tail takes the lesser loss of both axes for what all azimuths lose.
TEST(AnisotropicTables, least_is_lost_along_an_axis)
{
    const MicrofacetTables tables = tables_of<GTR<double>>();
    Random random(31);
    for (int i = 0; i < 1000; ++i)
    {
        const double wider = std::pow(0.01, random.unit());
        const DirectionAxes<double> axes(
            GTR<double>(wider, wider * std::pow(0.05, random.unit()), 10 * random.unit()));
        const double mu = random.unit();
        const double most = std::max(axes.albedo(tables, direction<double>(mu, 0)),
                                     axes.albedo(tables, direction<double>(mu, 0.5 * pi)));
        EXPECT_LT(axes.albedo(tables, direction<double>(mu, 0.5 * pi * random.unit())),
                  most + 4e-3);
    }
}

template <class Distribution>
void expect_symmetry()
{
    const MicrofacetTables tables = tables_of<Distribution>();
    const DirectionAxes<double> axes(make<Distribution>(0.8, 0.1, 0.9)),
        exchanged(make<Distribution>(0.1, 0.8, 0.9));
    for (const double mu : {1e-3, 0.2, 0.8, 1.0})
        for (const double azimuth : {0.0, 0.4, 1.2, 1.52, 2.5})
        {
            const auto w = direction<double>(mu, azimuth);
            const double E = axes.albedo(tables, w);
            EXPECT_EQ(axes.albedo(tables, {-w.x, w.y, w.z}), E);
            EXPECT_EQ(axes.albedo(tables, {w.x, -w.y, w.z}), E);
            EXPECT_NEAR(exchanged.albedo(tables, {w.y, w.x, w.z}), E, 1e-12);
            EXPECT_NEAR(axes.albedo(tables, direction<double>(1 - 1e-9, azimuth)),
                        axes.albedo(tables, direction<double>(1)), 1e-3);
        }
}

TEST(AnisotropicTables, have_the_symmetry_of_the_surface)
{
    expect_symmetry<GTR<double>>();
    expect_symmetry<GGX<double>>();
    expect_symmetry<Beckmann<double>>();
}

// Isotropic lobes do not read the table, and what is nearly one is nearly the same.
template <class Distribution>
void expect_to_begin_at_the_isotropic_lobe()
{
    const MicrofacetTables tables = tables_of<Distribution>();
    MicrofacetTables without = tables;
    without.anisotropy = nullptr;
    for (const double alpha : {0.05, 0.3, 1.0})
    {
        const DirectionAxes<double> same(make<Distribution>(alpha, alpha, 1.8)),
            next(make<Distribution>(alpha, alpha * (1 - 1e-6), 1.8));
        EXPECT_FALSE(next.isotropic());
        for (const double mu : {0.02, 0.35, 1.0})
        {
            const auto w = direction<double>(mu, 0.7);
            EXPECT_EQ(same.albedo(tables, w), same.albedo(without, w));
            EXPECT_NEAR(next.albedo(tables, w), same.albedo(tables, w), 1e-5);
        }
    }
}

TEST(AnisotropicTables, begin_at_the_isotropic_lobe)
{
    expect_to_begin_at_the_isotropic_lobe<STD<double>>();
    expect_to_begin_at_the_isotropic_lobe<GGX<double>>();
    expect_to_begin_at_the_isotropic_lobe<Beckmann<double>>();
}

// A file is loaded by whom it is for.
TEST(AnisotropicTables, are_loaded_once_and_only_when_asked_for)
{
    for (const char* name : {"ggx", "beckmann"})
    {
        MicrofacetTables tables = luts::microfacet_tables(name);
        EXPECT_EQ(tables.anisotropy, nullptr);
        luts::add_anisotropy(tables, name);
        ASSERT_NE(tables.anisotropy, nullptr);
        EXPECT_EQ(tables.anisotropy->size[4], 1);
        const std::size_t before = luts::loaded_files().size();
        MicrofacetTables again = luts::microfacet_tables(name);
        luts::add_anisotropy(again, name);
        EXPECT_EQ(again.anisotropy, tables.anisotropy);
        EXPECT_EQ(luts::loaded_files().size(), before);
    }
}

// Lanes that are isotropic are looked up as such beside others that are not.
TEST(AnisotropicTables, answer_in_batches_as_in_floats)
{
    using Batch = xsimd::batch<float>;
    constexpr std::size_t lanes = Batch::size;
    const MicrofacetTables tables = tables_of<GTR<float>>();
    alignas(64) float x[lanes], y[lanes], gamma[lanes], wx[lanes], wy[lanes], wz[lanes];
    Random random(41);
    for (int round = 0; round < 50; ++round)
    {
        for (std::size_t i = 0; i < lanes; ++i)
        {
            x[i] = static_cast<float>(random.unit());
            y[i] = i % 3 ? static_cast<float>(random.unit()) : x[i];
            gamma[i] = static_cast<float>(3 * random.unit());
            const auto w = direction<float>(random.unit(), 7 * random.unit());
            wx[i] = w.x, wy[i] = w.y, wz[i] = w.z;
        }
        const auto load = [](const float* p) { return Batch::load_aligned(p); };
        const DirectionAxes<Batch> axes(GTR<Batch>(load(x), load(y), load(gamma)));
        const Batch all = axes.albedo(tables, Vec3<Batch>(load(wx), load(wy), load(wz)));
        for (std::size_t i = 0; i < lanes; ++i)
        {
            const DirectionAxes<float> one(GTR<float>(x[i], y[i], gamma[i]));
            EXPECT_NEAR(all.get(i), one.albedo(tables, {wx[i], wy[i], wz[i]}), 2e-5)
                << x[i] << " " << y[i] << " " << gamma[i] << " " << wz[i];
        }
    }
}

// However a law is stretched, the integral is that of the surface.
TEST(AnisotropicTables, the_integral_agrees_with_itself_and_with_the_isotropic_one)
{
    const auto w = direction<double>(0.3, 0.7);
    const luts::SlopeLaw gtr = luts::SlopeLaw::gtr(0.4, 0.7);
    EXPECT_NEAR(luts::anisotropic_albedo(gtr, 1, 1, w), luts::albedo(gtr, 0.3), 2e-5);
    const double one = luts::anisotropic_albedo(luts::SlopeLaw::ggx(1), 0.6, 0.05, w),
                 other = luts::anisotropic_albedo(luts::SlopeLaw::ggx(0.1), 6, 0.5, w);
    EXPECT_NEAR(one, other, 2e-5);
    const auto lobe = MicrofacetReflection<GGX<double>, ConstantFresnel<double>>(
                          GGX<double>(0.6, 0.05), ConstantFresnel<double>())
                          .prepare(w);
    EXPECT_NEAR(one,
                integrate_reflections(w, 0.6, 0.05, 32,
                                      [&](const Vec3<double>& wi) { return lobe.eval(wi).x; }),
                2e-5);
}

}  // namespace
