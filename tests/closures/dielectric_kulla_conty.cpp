// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Kulla and Conty's added lobes of a rough dielectric: energy on both sides, reciprocity with eta
// squared, sampling.

#include "../support/closures.h"
#include "../support/dielectric_bake.h"
#include "../support/hostile.h"
#include "../support/properties.h"

#include <regain/closures/dielectric_kulla_conty.h>

#include <gtest/gtest.h>

using namespace regain;
using namespace regain::tests;

namespace {

template <class Real>
Dielectric<GGX<Real>> glass(double alpha, double eta, bool beta = false,
                            ScatterMode mode = ScatterMode::RT, double R = 1, double T = 1)
{
    return {GGX<Real>(Real(alpha)),
            Real(eta),
            mode,
            Color3<Real>(Real(R)),
            Color3<Real>(Real(T)),
            beta ? TransmissionShadowing::beta : TransmissionShadowing::correlated};
}

template <class Real>
auto compensated_glass(double alpha, double eta, bool beta = false,
                       KullaContySplit split = KullaContySplit::kulla_conty, double strength = 1)
{
    return kulla_conty(glass<Real>(alpha, eta, beta),
                       baked_dielectric(alpha > 0 ? alpha : 1, eta, beta), Real(strength), split);
}

// Over both sides, of an azimuthally symmetric f.
template <class F>
double both_sides(const F& f)
{
    return integrate_symmetric(f) + integrate_symmetric([&](Vec3<double> wi) {
               wi.z = -wi.z;
               return f(wi);
           });
}

Vec3<double> on_side(double mu, int side)
{
    auto wo = direction<double>(mu);
    if (side) wo.z = -wo.z;
    return wo;
}

template <class Check>
void for_each_glass(const Check& check)
{
    for (bool beta : {false, true})
        for (double index : {1.0, 1.05, 1.33, 2.0, 4.0})
            for (double alpha : {0.06, 0.25, 0.6, 1.0})
                for (bool inverse : {false, true}) check(alpha, inverse ? 1 / index : index, beta);
}

// Single scattering by luts/dielectric_integral.h, which shares no code with the closures; the
// added lobes by their eval.
TEST(DielectricKullaConty, returns_all_energy_on_both_sides)
{
    for_each_glass([](double alpha, double eta, bool beta) {
        const auto closure = compensated_glass<double>(alpha, eta, beta);
        EXPECT_TRUE(closure.traits().energy_preserving);
        for (int side : {0, 1})
            for (double mu : {0.02, 0.1, 0.3, 0.6, 1.0})
            {
                const auto single = luts::dielectric_albedo(luts::SlopeLaw::ggx(alpha), mu,
                                                            side ? 1 / eta : eta, 16);
                const auto prepared = closure.prepare(on_side(mu, side));
                const double added = both_sides(
                    [&](const Vec3<double>& wi) { return prepared.second().eval(wi).x; });
                const double E = single.reflected +
                                 (beta ? single.transmitted_beta : single.transmitted_correlated);
                EXPECT_NEAR(E + added, 1, 2.5e-3)
                    << "alpha " << alpha << ", eta " << eta << ", mu " << mu << ", side " << side;
            }
    });
}

TEST(DielectricKullaConty, samples_return_all_energy_with_small_weights)
{
    double largest = 0, variance = 0;
    for_each_glass([&](double alpha, double eta, bool beta) {
        const auto closure = compensated_glass<double>(alpha, eta, beta);
        for (int side : {0, 1})
            for (double mu : {0.05, 0.4, 1.0})
            {
                const auto s = sample_statistics(closure.prepare(on_side(mu, side)), 8000);
                EXPECT_NEAR(s.mean.x, 1, 5e-3)
                    << "alpha " << alpha << ", eta " << eta << ", mu " << mu << ", side " << side;
                largest = std::max(largest, s.largest);
                variance = std::max(variance, s.variance);
            }
    });
    EXPECT_LT(largest, 4);
    EXPECT_LT(variance, 0.6);
}

TEST(DielectricKullaConty, is_reciprocal_with_eta_squared)
{
    Random random(41);
    for (KullaContySplit split : {KullaContySplit::kulla_conty, KullaContySplit::greatest})
        for_each_glass([&](double alpha, double eta, bool beta) {
            const auto closure = compensated_glass<double>(alpha, eta, beta, split, 0.8);
            EXPECT_TRUE(closure.traits().reciprocal);
            for (int i = 0; i < 40; ++i)
            {
                const auto wo = on_side(0.02 + 0.98 * random.unit(), int(random.bits() % 2));
                auto wi = direction<double>(0.02 + 0.98 * random.unit(), 7 * random.unit());
                if (random.bits() % 2) wi.z = -wi.z;
                const double eta_o = wo.z < 0 ? 1 / eta : eta;
                const double scale = wo.z * wi.z > 0 ? 1 : eta_o * eta_o;
                const double there = closure.eval(wo, wi).x / std::abs(wi.z);
                const double back = scale * closure.eval(wi, wo).x / std::abs(wo.z);
                EXPECT_NEAR(there, back, 1e-8 * std::max(there, back))
                    << "alpha " << alpha << ", eta " << eta << ", wo " << wo << ", wi " << wi;
            }
        });
}

TEST(DielectricKullaConty, weight_is_eval_over_pdf)
{
    for (double eta : {0.6, 1.0, 1.5})
        for (double alpha : {0.05, 0.5, 1.0})
        {
            expect_weight_is_eval_over_pdf(compensated_glass<float>(alpha, eta), 2e-6, true);
            expect_weight_is_eval_over_pdf(compensated_glass<double>(alpha, eta, true), 1e-13,
                                           true);
        }
}

TEST(DielectricKullaConty, added_pdf_integrates_to_one)
{
    for_each_glass([](double alpha, double eta, bool beta) {
        const auto closure = compensated_glass<double>(alpha, eta, beta);
        for (int side : {0, 1})
        {
            const auto prepared = closure.prepare(on_side(0.3, side));
            EXPECT_NEAR(
                both_sides([&](const Vec3<double>& wi) { return prepared.second().pdf(wi); }), 1,
                1e-4);
            const auto s = sample_statistics(prepared.second(), 4000);
            EXPECT_EQ(s.nothing, 0);
            EXPECT_LT(s.largest, 1.3 * s.mean.x);
        }
    });
}

TEST(DielectricKullaConty, albedo_is_that_of_all_lobes)
{
    const auto closure = compensated_glass<double>(0.5625, 1.5);
    for (int side : {0, 1})
        for (double mu : {0.1, 0.7})
        {
            const auto prepared = closure.prepare(on_side(mu, side));
            const auto albedo = prepared.albedo();
            EXPECT_NEAR(albedo.reflect.x + albedo.transmit.x, 1, 1e-12);
            EvenCube cube;
            double R = 0;
            constexpr int n = 100000;
            for (int i = 0; i < n; ++i)
            {
                const auto s = prepared.sample(cube.next());
                if (!s.transmitted) R += s.weight.x / n;
            }
            EXPECT_NEAR(albedo.reflect.x, R, 5e-3);
        }
}

// The loss next to the critical cosine is as narrow as alpha, and no table is needed to see whether
// it is found: the average against many more nodes.
TEST(DielectricKullaConty, average_loss_finds_the_critical_cosine)
{
    for (double alpha : {2e-3, 0.03, 0.3})
        for (double eta : {1 / 1.5, 1 / 1.01})
        {
            const auto loss = [&](double mu) {
                const auto a = luts::dielectric_albedo(luts::SlopeLaw::ggx(alpha),
                                                       std::max(mu, 1e-6), eta, 24);
                return std::max(0.0, 1 - a.reflected - a.transmitted_correlated);
            };
            const double critical = std::sqrt(1 - eta * eta);
            const MissingEnergy<double, 3, 16> few(alpha, loss, critical);
            const MissingEnergy<double, 3, 80> many(alpha, loss, critical);
            EXPECT_NEAR(few.average() / many.average(), 1, 0.01) << alpha << " " << eta;
        }
}

// b_o l_o = eta_o^2 b_o' l_o', and the two choices of what that leaves free.
TEST(DielectricKullaConty, splits_are_as_documented)
{
    const double eta = 1.5;
    for (KullaContySplit split : {KullaContySplit::kulla_conty, KullaContySplit::greatest})
    {
        const auto closure = compensated_glass<double>(0.25, eta, false, split);
        const auto& added = closure.added_lobe();
        const double b[] = {added.transmitted_share(0), added.transmitted_share(1)};
        const double l[] = {added.average_loss(0), added.average_loss(1)};
        EXPECT_NEAR(b[0] * l[0], eta * eta * b[1] * l[1], 1e-12);
        const double T[] = {1 - DielectricFresnel<double>(eta).average_reflectance(),
                            1 - DielectricFresnel<double>(1 / eta).average_reflectance()};
        if (split == KullaContySplit::kulla_conty)
            EXPECT_NEAR(b[0] / T[0] + b[1] / T[1], 1, 1e-12);
        else
            EXPECT_NEAR(std::max(b[0] / T[0], b[1] / T[1]), 1, 1e-12);
    }
    const auto at_one = [](KullaContySplit split) {
        return compensated_glass<double>(0.25, 1, false, split).added_lobe().transmitted_share(0);
    };
    EXPECT_NEAR(at_one(KullaContySplit::greatest), 1, 1e-12);
    EXPECT_NEAR(at_one(KullaContySplit::kulla_conty), 0.5, 1e-12);
}

TEST(DielectricKullaConty, modes_and_tints_take_their_part)
{
    const double eta = 2.0;
    const auto& tables = baked_dielectric(0.5625, eta, false);
    const auto both = kulla_conty(glass<double>(0.5625, eta), tables);
    const auto R = kulla_conty(glass<double>(0.5625, eta, false, ScatterMode::R), tables);
    const auto T = kulla_conty(glass<double>(0.5625, eta, false, ScatterMode::T), tables);
    const auto tinted =
        kulla_conty(glass<double>(0.5625, eta, false, ScatterMode::RT, 0.5, 0.25), tables);
    EXPECT_FALSE(R.traits().energy_preserving || T.traits().energy_preserving);
    EXPECT_FALSE(R.added_lobe().traits().transmissive);
    Random random(5);
    for (int i = 0; i < 200; ++i)
    {
        const auto wo = on_side(random.unit(), i % 2);
        auto wi = direction<double>(random.unit(), 3.0);
        if (i % 3) wi.z = -wi.z;
        const double f = both.added_lobe().eval(wo, wi).x;
        const double r = R.added_lobe().eval(wo, wi).x, t = T.added_lobe().eval(wo, wi).x;
        EXPECT_DOUBLE_EQ(f, r + t);
        EXPECT_EQ(wo.z * wi.z > 0 ? t : r, 0);
        EXPECT_NEAR(tinted.added_lobe().eval(wo, wi).x, 0.5 * r + 0.25 * t, 1e-12);
    }
    expect_weight_is_eval_over_pdf(R, 1e-13, true);
    expect_weight_is_eval_over_pdf(T, 1e-13, true);
    expect_weight_is_eval_over_pdf(tinted, 1e-13, true);
}

TEST(DielectricKullaConty, without_tables_is_the_lobe_alone)
{
    const auto lobe = glass<float>(0.5, 1.5);
    const auto closure = kulla_conty(lobe, DielectricTables{});
    EXPECT_FALSE(closure.traits().energy_preserving);
    const auto wo = direction<float>(0.4);
    for (float z : {-0.7f, 0.7f})
    {
        const auto wi = direction<float>(z, 2.0);
        EXPECT_EQ(closure.eval(wo, wi), lobe.eval(wo, wi));
        EXPECT_EQ(closure.pdf(wo, wi), lobe.pdf(wo, wi));
    }
    const auto off = kulla_conty(lobe, baked_dielectric(0.3, 0.7, false), 0.0f);
    EXPECT_EQ(off.pdf(wo, direction<float>(0.7)), lobe.pdf(wo, direction<float>(0.7)));
}

TEST(DielectricKullaConty, a_flat_surface_has_no_added_lobe)
{
    const auto closure = compensated_glass<float>(0, 1.5);
    const auto s = closure.sample(direction<float>(1e-5), {0.1f, 0.2f, 0.99f});
    EXPECT_TRUE(s.valid && s.delta);
    EXPECT_EQ(closure.pdf(direction<float>(0.3), direction<float>(0.5)), 0);
}

TEST(DielectricKullaConty, a_vector_of_floats_answers_as_a_float_does)
{
    expect_batch_answers_as_float(
        [](const auto& alpha) {
            using Real = std::decay_t<decltype(alpha)>;
            return kulla_conty(Dielectric<GGX<Real>>(GGX<Real>(alpha), Real(0.7f)),
                               baked_dielectric(0.3, 0.7, false));
        },
        1e-4, true);
    using Batch = xsimd::batch<float>;
    const Dielectric<GGX<Batch>> lobe(GGX<Batch>(Batch(0.5f)), Batch(1.5f));
    EXPECT_TRUE(kulla_conty(lobe, baked_dielectric(0.3, 1.5, false)).traits().transmissive);
}

template <class Real>
void run_hostile(long calls)
{
    Hostile<Real> hostile(sizeof(Real) + 110);
    long failures = 0;
    const auto& tables = baked_dielectric(0.3, 1.5, true);
    const Trapped trapped;
    for (long i = 0; i < calls; ++i)
    {
        const GGX<Real> ggx(hostile.parameter(), hostile.parameter());
        const auto mode = i % 3 == 0   ? ScatterMode::R
                          : i % 3 == 1 ? ScatterMode::T
                                       : ScatterMode::RT;
        const Dielectric<GGX<Real>> lobe(
            ggx, i % 2 ? hostile.number() : Real(0.5) + hostile.parameter(), mode, hostile.color(),
            hostile.color(), TransmissionShadowing::beta);
        const auto closure =
            kulla_conty(lobe, tables, hostile.parameter(),
                        i % 5 ? KullaContySplit::kulla_conty : KullaContySplit::greatest);
        const Vec3<Real> wo = hostile.any_direction(), wi = hostile.any_direction();
        const auto prepared = closure.prepare(wo);
        const Real pdf = prepared.pdf(wi);
        const Real x = hostile.random_number(), y = hostile.random_number();
        const Sample<Real> s = prepared.sample(Vec3<Real>(x, y, hostile.random_number()));
        const auto albedo = prepared.albedo();
        const bool good = sane(prepared.eval(wi)) && sane(s.weight) && sane(albedo.reflect) &&
                          sane(albedo.transmit) && std::isfinite(pdf) && pdf >= 0 &&
                          std::isfinite(s.pdf) && s.pdf >= 0 && (!s.valid || s.pdf > 0) &&
                          std::abs(s.wi.length() - 1) < 2e-6;
        if (!good && failures++ < 5)
            ADD_FAILURE() << "wo " << wo << ", wi " << wi << ": eval " << prepared.eval(wi)
                          << ", pdf " << pdf << ", sample " << s.wi << " " << s.weight << " "
                          << s.pdf << " albedo " << albedo.reflect << albedo.transmit;
    }
    EXPECT_EQ(failures, 0);
}

TEST(DielectricKullaConty, stays_finite_whatever_comes_in)
{
    run_hostile<float>(100000);
    run_hostile<double>(30000);
}

}  // namespace
