// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The directional albedo, from tables and without them, against integrals of eval.

#include "../support/closures.h"
#include "../support/reflection_integral.h"

#include <regain/closures/dielectric_kulla_conty.h>
#include <regain/closures/gtr.h>
#include <regain/closures/kulla_conty.h>
#include <regain/closures/std.h>
#include <regain/closures/thin_dielectric.h>

#include <gtest/gtest.h>

using namespace regain;
using namespace regain::tests;

namespace {

template <class Closure>
Color3<double> integral(const Closure& closure, const Vec3<double>& wo, double alpha)
{
    const auto prepared = closure.prepare(wo);
    return integrate_reflections(wo, alpha, alpha, 32,
                                 [&](const auto& wi) { return prepared.eval(wi); });
}

template <class Lobe>
double worst_tabulated(Lobe (*make)(double, double))
{
    double worst = 0;
    for (double alpha : {1e-3, 0.02, 0.07, 0.2, 0.45, 0.8, 1.0})
        for (double mu : {1e-3, 0.03, 0.1, 0.42, 0.8, 1.0})
            for (Method method : {Method::none, Method::turquin})
            {
                const auto closure = compensated(make(alpha, alpha), method, luts::ggx_tables());
                const auto wo = direction<double>(mu);
                const auto exact = integral(closure, wo, alpha), table = closure.albedo(wo).reflect;
                for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(exact[c] - table[c]));
            }
    return worst;
}

// Schlick's curve is what the Fresnel table is exact for. Others have to be near enough for
// choosing lobes and for layering.
TEST(Albedo, tables_agree_with_the_integral)
{
    EXPECT_LT(worst_tabulated(artists_gold<double>), 2e-3);
    EXPECT_LT(worst_tabulated(gold<double>), 1.2e-2);
}

TEST(Albedo, without_tables_is_integrated)
{
    for (double alpha : {0.1, 0.5, 1.0})
        for (double mu : {0.1, 0.6, 1.0})
        {
            const auto lobe = gold<double>(alpha, alpha);
            const auto exact = integral(lobe, direction<double>(mu), alpha);
            const auto albedo = lobe.albedo(direction<double>(mu));
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(albedo.reflect[c], exact[c], 2e-3);
            EXPECT_EQ(albedo.transmit, Color3<double>(0.0));
        }
}

// Eq. 16 keeps the tint of gold between F and F^2, so compensation saturates.
// Of normals that take three numbers, against independent samples; an interface has its choice of
// lobe to take one, too.
template <class Closure>
void expect_sampled_albedo(const Closure& closure, const Vec3<double>& wo, double bound)
{
    const auto prepared = closure.prepare(wo);
    Random random(12);
    constexpr int n = 1 << 17;  // an error of 1.4e-3 at most
    double reflect = 0, transmit = 0;
    for (int i = 0; i < n; ++i)
    {
        const double x = random.unit(), y = random.unit();
        const Sample<double> s = prepared.sample(Vec3<double>(x, y, random.unit()));
        (s.transmitted ? transmit : reflect) += s.weight.x / n;
    }
    const Albedo<double> albedo = prepared.albedo();
    EXPECT_NEAR(albedo.reflect.x, reflect, bound) << wo;
    EXPECT_NEAR(albedo.transmit.x, transmit, bound) << wo;
}

TEST(Albedo, without_tables_is_near_that_of_samples_of_long_tails)
{
    for (double gamma : {1.7, 3.0})
        for (double alpha : {0.05, 1.0})
            for (double mu : {-0.8, -0.1, 0.1, 0.8})
            {
                const auto wo = direction<double>(mu);
                const GTR<double> gtr(alpha, gamma);
                const STD<double> student(alpha, gamma);
                expect_sampled_albedo(Dielectric<GTR<double>>(gtr, 1.5), wo, 1e-2);
                expect_sampled_albedo(Dielectric<STD<double>>(student, 1.5), wo, 1.5e-2);
                expect_sampled_albedo(ThinDielectric<GTR<double>>(gtr, 1.5), wo, 1e-2);
                expect_sampled_albedo(ThinDielectric<STD<double>>(student, 1.5), wo, 1.5e-2);
                expect_sampled_albedo(Dielectric<GTR<double>>(gtr, 1.5, ScatterMode::T), wo, 1e-2);
            }
}

TEST(Albedo, compensation_brightens_and_saturates)
{
    const auto wo = direction<double>(0.7);
    const auto lobe = gold<double>(1, 1);
    const auto single = compensated(lobe, Method::none, luts::ggx_tables()).albedo(wo).reflect;
    const auto full = compensated(lobe, Method::turquin, luts::ggx_tables()).albedo(wo).reflect;
    EXPECT_GT(full.x, 2 * single.x);
    EXPECT_LT(full.z / full.x, 0.9 * single.z / single.x);
}

// Compensation gives its tables to a lobe that has none for its albedo, and to no other.
TEST(Albedo, a_lobe_keeps_tables_of_its_own)
{
    const std::uint16_t own_data[8] = {}, given_data[8] = {};
    const auto microfacet = [](const std::uint16_t* data) {
        MicrofacetTables t;
        t.E_ss = t.falloff = t.dip = {data, 2, 2, 1};
        t.E_avg = {data, 2, 1, 1};
        return t;
    };
    const auto dielectric = [](const std::uint16_t* data) {
        DielectricTables t;
        for (int side = 0; side < 2; ++side) t.E[side] = t.R[side] = {data, 2, 2, 2};
        return t;
    };
    const MicrofacetTables own = microfacet(own_data), given = microfacet(given_data);
    const DielectricTables own_glass = dielectric(own_data), given_glass = dielectric(given_data);

    const WhiteMirror<double> bare = white<double>(0.5, 0.5);
    WhiteMirror<double> equipped = bare;
    equipped.set_tables(own);
    const auto check_mirror = [&](const auto& closure, const std::uint16_t* expected) {
        EXPECT_EQ(closure.lobe().tables().E_ss.data, expected);
    };
    check_mirror(compensated(bare, Method::turquin, given), given_data);
    check_mirror(compensated(equipped, Method::turquin, given), own_data);
    check_mirror(kulla_conty(bare, KullaContyForm::series, given), given_data);
    check_mirror(kulla_conty(equipped, KullaContyForm::series, given), own_data);

    const ThinDielectric<GGX<double>> sheet(GGX<double>(0.5), 1.5);
    ThinDielectric<GGX<double>> equipped_sheet = sheet;
    equipped_sheet.set_tables(own);
    check_mirror(compensated(sheet, Method::turquin, given), given_data);
    check_mirror(compensated(equipped_sheet, Method::turquin, given), own_data);

    const Dielectric<GGX<double>> glass(GGX<double>(0.5), 1.5);
    Dielectric<GGX<double>> equipped_glass = glass;
    equipped_glass.set_tables(own_glass);
    const auto check_glass = [&](const auto& closure, const std::uint16_t* expected) {
        EXPECT_EQ(closure.lobe().tables().E[1].data, expected);
    };
    check_glass(compensated(glass, Method::turquin, given_glass), given_data);
    check_glass(compensated(equipped_glass, Method::turquin, given_glass), own_data);
    check_glass(kulla_conty(glass, given_glass), given_data);
    check_glass(kulla_conty(equipped_glass, given_glass), own_data);
}

}  // namespace
