// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The white furnace of anisotropic glass: within 1e-2 up to a ratio of the widths of 10, within
// 2e-2 up to 20, from all azimuths and either side, in both forms of transmission shadowing. And
// what its table must not change.

#include "../support/glass.h"

#include <regain/closures/beckmann.h>
#include <regain/closures/dielectric_kulla_conty.h>
#include <regain/closures/dielectric_tail.h>
#include <regain/closures/xsimd.h>
#include <regain/luts/anisotropic_dielectric.h>
#include <regain/luts/bake.h>
#include <regain/luts/library.h>

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>
#include <vector>

using namespace regain;
using namespace regain::tests;

namespace {

constexpr auto correlated = TransmissionShadowing::correlated, beta = TransmissionShadowing::beta;
const double pi = std::acos(-1.0);

DielectricTables tables_of(const std::string& distribution, TransmissionShadowing form,
                           bool anisotropic = true)
{
    DielectricTables tables = luts::dielectric_tables(distribution, form);
    if (form == beta) luts::add_later_split(tables, distribution);
    if (anisotropic) luts::add_anisotropy(tables, distribution, form);
    return tables;
}

struct Place
{
    double x, y, eta, mu, azimuth;  // mu < 0: from below

    double ratio() const { return std::max(x / y, y / x); }
    Vec3<double> wo() const { return sided(mu, azimuth); }
    double eta_o() const { return mu < 0 ? 1 / eta : eta; }
    double bound() const { return ratio() > 10.5 ? 2e-2 : 1e-2; }
};

std::ostream& operator<<(std::ostream& out, const Place& p)
{
    return out << "alpha " << p.x << " " << p.y << ", eta " << p.eta << ", mu " << p.mu
               << ", azimuth " << p.azimuth;
}

// Near index 1 and far from it, from either side, along, across and between, and next to the
// critical angle.
const Place places[] = {
    {1, 0.1, 1.05, -0.1, 1.2},     {0.1, 1, 1.05, -0.25, 0.3},   {1, 0.05, 1.05, -0.2, 1.1},
    {0.5, 0.05, 1.05, 0.05, 0.2},  {1, 0.1, 1.1, -0.06, 1.1},    {0.8, 0.2, 1.1, -0.4, 0.8},
    {1, 0.1, 1.33, -0.1, 1.5},     {0.05, 0.9, 1.33, -0.3, 0.5}, {0.3, 0.03, 1.33, 0.03, 1.4},
    {1, 0.1, 1.5, -0.1, 0.5 * pi}, {1, 0.1, 1.5, -0.4, 0.9},     {1, 0.1, 1.5, -0.75, 0},
    {0.1, 1, 1.5, -0.85, 0.4},     {1, 0.5, 1.5, -0.3, 0.7},     {0.6, 0.06, 1 / 1.5, 0.2, 1.3},
    {1, 0.1, 1.5, 0.1, 0.5 * pi},  {0.2, 0.02, 1.5, 0.05, 1.5},  {1, 0.05, 1.5, 0.13, 1.55},
    {1, 0.1, 2, -0.2, 1.53},       {0.9, 0.3, 2, -0.8, 0.6},     {1, 0.25, 2, 0.3, 0.1},
    {0.1, 1, 3, -0.35, 0.1},       {0.7, 0.07, 3, -0.95, 0.8},   {1, 0.1, 3, 0.04, 0.3},
    {0.05, 0.01, 1.1, -0.42, 0.5}, {0.05, 0.005, 3, 0.03, 1.2},  {0.02, 0.4, 1.05, -0.31, 1.5},
    {0.5, 0.025, 2, 0.06, 1.54},   {1, 0.3, 1 / 1.1, 0.1, 1.3},  {0.3, 0.02, 1 / 3.0, 0.6, 1.0},
};

template <class Distribution>
Dielectric<Distribution> lobe_of(const Place& p, TransmissionShadowing form)
{
    const Color3<double> white(1.0);
    return {Distribution(p.x, p.y), p.eta, ScatterMode::RT, white, white, form};
}

// R + T of single scattering as the integral of eval.
template <class Lobe>
double integrated(const Lobe& lobe, const Place& p)
{
    const auto sums = integrals(lobe.prepare(p.wo()), p.wo(), p.eta, p.x, p.y, 3e-4);
    return sums.reflected.y + sums.transmitted.y;
}

template <class Distribution>
void expect_white(const std::string& name, std::size_t first)
{
    for (std::size_t i = first; i < std::size(places); i += 2)
        for (const auto form : {correlated, beta})
        {
            const Place& p = places[i];
            const DielectricTables tables = tables_of(name, form);
            const auto lobe = lobe_of<Distribution>(p, form);
            const double E = integrated(lobe, p);
            const auto gain = compensated(lobe, Method::turquin, tables);
            // Where next to nothing passes the first time, the gain is as far off as the little.
            if (E > 0.1)
            {
                EXPECT_NEAR(E * gain.gain().at(p.wo()).x, 1, p.bound()) << name << " " << p;
            }
            EXPECT_NEAR(E + kulla_conty(lobe, tables).added_lobe().prepare(p.wo()).loss(), 1,
                        p.bound())
                << name << " " << p;
            const auto albedo = gain.albedo(p.wo());
            EXPECT_NEAR(albedo.reflect.x + albedo.transmit.x, 1, 1e-6) << name << " " << p;
        }
}

TEST(AnisotropicGlass, white_furnace_of_ggx) { expect_white<GGX<double>>("ggx", 0); }
TEST(AnisotropicGlass, white_furnace_of_beckmann) { expect_white<Beckmann<double>>("beckmann", 1); }

// The whole closures, gain and added lobes, through eval.
TEST(AnisotropicGlass, closures_return_all_light)
{
    const Place p{0.8, 0.1, 1.4, 0.4, 0.9};
    const auto lobe = lobe_of<GGX<double>>(p, beta);
    const DielectricTables tables = tables_of("ggx", beta);
    EXPECT_NEAR(integrated(compensated(lobe, Method::turquin, tables), p), 1, 1e-2);

    const double E = integrated(lobe, p);
    static const luts::QuadratureRule rule = luts::gauss_legendre(24);
    const auto added = [&](const auto& closure) {
        const auto prepared = closure.added_lobe().prepare(p.wo());
        double sum = 0;
        for (std::size_t i = 0; i < rule.x.size(); ++i)
            for (int j = 0; j < 32; ++j)
                for (const double side : {1.0, -1.0})
                {
                    const double x = rule.x[i];
                    sum += prepared.eval(sided(side * x * x, pi * (j + 0.5) / 16)).x * 2 * x *
                           rule.weight[i] * pi / 16;
                }
        return sum;
    };
    EXPECT_NEAR(E + added(kulla_conty(lobe, tables)), 1, 1e-2);
    EXPECT_NEAR(E + added(fitted_tail(lobe, tables)), 1, 1e-2);
}

TEST(AnisotropicGlass, tail_is_reciprocal)
{
    const double eta = 1.4;
    const Place p{0.8, 0.1, eta, 1, 0};
    const auto added =
        fitted_tail(lobe_of<GGX<double>>(p, beta), tables_of("ggx", beta)).added_lobe();
    EXPECT_TRUE(added.traits().anisotropic);
    Random random(5);
    for (int i = 0; i < 300; ++i)
    {
        const auto direction = [&] {
            return sided(0.02 + 0.98 * random.unit(), 2 * pi * random.unit());
        };
        const auto a = direction();
        auto b = direction();
        const double forth = added.eval(a, b).x / b.z, back = added.eval(b, a).x / a.z;
        EXPECT_NEAR(forth, back, 1e-9 * forth);
        b.z = -b.z;
        const double down = added.eval(a, b).x / -b.z, up = added.eval(b, a).x / a.z;
        EXPECT_NEAR(down, eta * eta * up, 1e-9 * down);
    }
}

// What the tables are baked from is what eval integrates to.
TEST(AnisotropicGlass, integral_is_that_of_eval)
{
    for (std::size_t i = 0; i < std::size(places); i += 3)
        for (const auto form : {correlated, beta})
        {
            const Place& p = places[i];
            auto wo = p.wo();
            wo.z = std::abs(wo.z);
            const bool ggx = i % 2;
            const auto a = luts::anisotropic_dielectric_albedo(
                ggx ? luts::SlopeLaw::ggx(1) : luts::SlopeLaw::beckmann(1), p.x, p.y, wo, p.eta_o(),
                24);
            const double E = ggx ? integrated(lobe_of<GGX<double>>(p, form), p)
                                 : integrated(lobe_of<Beckmann<double>>(p, form), p);
            EXPECT_NEAR(
                a.reflected + (form == beta ? a.transmitted_beta : a.transmitted_correlated), E,
                1.5e-3)
                << p;
        }
}

// A place on the axes is the same to the closures and to the baker.
TEST(AnisotropicGlass, baking_and_look_ups_agree_about_axes)
{
    for (std::size_t i = 0; i < std::size(places); i += 4)
    {
        const Place& p = places[i];
        auto wo = p.wo();
        wo.z = std::abs(wo.z);
        const AnisotropicGlassPlace<double> place(p.x, p.y, wo, p.eta_o());
        const luts::SlopeLaw unit = luts::SlopeLaw::beckmann(1);
        const auto sum = [&](double x, double y) {
            const auto a = luts::anisotropic_dielectric_albedo(unit, x, y, wo, p.eta_o(), 12);
            return a.reflected + a.transmitted_correlated;
        };
        const double found =
            luts::exact_value(p.eta_o() < 1 ? "beckmann_anisotropy_correlated_inside"
                                            : "beckmann_anisotropy_correlated_outside",
                              {place.x[0], place.x[1], place.x[2], place.x[3], place.x[4]}, 12);
        if (place.x[2] >= 0)
        {
            EXPECT_NEAR(found, std::log(sum(p.x, p.y) / sum(place.alpha, place.alpha)), 1e-6) << p;
        }
    }
}

// Lobes of one width never ask the table, bit for bit; exchanged axes and mirrored directions are
// the same lobe; and lobes of nearly one width are nearly isotropic.
TEST(AnisotropicGlass, table_changes_nothing_else)
{
    using Lanes = xsimd::batch<float>;
    for (const auto form : {correlated, beta})
    {
        const DielectricTables with = tables_of("ggx", form),
                               without = tables_of("ggx", form, false);
        for (const Place& p : places)
        {
            const auto w = p.wo();
            const Vec3<float> wf(w);
            const GGX<float> same(static_cast<float>(p.x), static_cast<float>(p.x));
            const float eta = static_cast<float>(p.eta_o());
            EXPECT_EQ(with.albedo(same, eta, wf), without.albedo(same, eta, wf));
            EXPECT_EQ(with.albedo(same, eta, wf),
                      without.albedo(same.alpha_x(), eta, std::abs(wf.z)));

            const double E = with.albedo(GGX<double>(p.x, p.y), p.eta_o(), w);
            const Vec3<double> exchanged(w.y, w.x, w.z), mirrored(-w.x, w.y, w.z);
            EXPECT_NEAR(with.albedo(GGX<double>(p.y, p.x), p.eta_o(), exchanged), E, 1e-12);
            EXPECT_EQ(with.albedo(GGX<double>(p.x, p.y), p.eta_o(), mirrored), E);
            EXPECT_NEAR(with.albedo(GGX<double>(p.x, p.x * 1.0001), p.eta_o(), w),
                        with.albedo(GGX<double>(p.x), p.eta_o(), w), 1e-3)
                << p;

            // Some lanes are of one width, some see the other side.
            alignas(64) float lanes[Lanes::size], etas[Lanes::size];
            for (std::size_t k = 0; k < Lanes::size; ++k)
            {
                lanes[k] = static_cast<float>(k % 2 ? p.x : p.y);
                etas[k] = k % 3 ? eta : 1 / eta;
            }
            const GGX<Lanes> mixed(Lanes(static_cast<float>(p.x)), Lanes::load_aligned(lanes));
            const Lanes all = with.albedo(mixed, Lanes::load_aligned(etas),
                                          Vec3<Lanes>(Lanes(wf.x), Lanes(wf.y), Lanes(wf.z)));
            for (std::size_t k = 0; k < Lanes::size; ++k)
                EXPECT_NEAR(all.get(k),
                            with.albedo(GGX<float>(static_cast<float>(p.x), lanes[k]), etas[k], wf),
                            1e-4f);
        }
    }
}

}  // namespace
