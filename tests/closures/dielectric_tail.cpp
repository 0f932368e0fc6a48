// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The tail of a rough dielectric: energy on both sides, the split of the random walk, reciprocity
// with eta squared, sampling.

#include "../support/closures.h"
#include "../support/glass.h"
#include "../support/hostile.h"
#include "../support/properties.h"

#include <regain/closures/beckmann.h>
#include <regain/closures/dielectric_tail.h>
#include <regain/closures/dielectric_walk.h>
#include <regain/luts/dielectric_integral.h>
#include <regain/luts/library.h>

#include <gtest/gtest.h>

#include <map>
#include <string>

using namespace regain;
using namespace regain::tests;

namespace {

const DielectricTables& tables_of(const std::string& distribution)
{
    const auto loaded = [](const std::string& name) {
        DielectricTables tables = luts::dielectric_tables(name, TransmissionShadowing::beta);
        luts::add_later_split(tables, name);
        return tables;
    };
    static std::map<std::string, DielectricTables> all;
    const auto known = all.find(distribution);
    return known != all.end() ? known->second : all[distribution] = loaded(distribution);
}

template <class Distribution>
auto beta_glass(const Distribution& distribution, double eta, ScatterMode mode = ScatterMode::RT,
                double R = 1, double T = 1)
{
    using Real = typename Distribution::Real;
    const auto number = [](double v) { return regain::detail::constant<Real>(v); };
    return Dielectric<Distribution>(distribution, number(eta), mode, Color3<Real>(number(R)),
                                    Color3<Real>(number(T)), TransmissionShadowing::beta);
}

template <class Real>
auto tail_of(double alpha, double eta, ScatterMode mode = ScatterMode::RT, double strength = 1)
{
    return fitted_tail(beta_glass(GGX<Real>(Real(alpha)), eta, mode), tables_of("ggx"),
                       Real(strength));
}

// f over the side of wo and over the other, of an azimuthally symmetric f that may change as fast
// as it likes at grazing angles, along the normal and on either side of the critical cosine.
struct Halves
{
    double reflected, transmitted;
    double sum() const { return reflected + transmitted; }
};
template <class F>
Halves halves(double wo_z, double eta, const F& f)
{
    const double critical = std::sqrt(1 - std::pow(std::min(eta, 1 / eta), 2));
    const auto of_side = [&](double sign) {
        double sum = 0;
        const auto piece = [&](double singular, double end) {
            constexpr int n = 320;
            constexpr double decades = -16;
            for (int i = 0; i < n; ++i)
            {
                const double step = std::exp(decades * (1 - (i + 0.5) / n));
                auto wi = direction<double>(singular + (end - singular) * step);
                wi.z *= sign;
                sum += f(wi) * step * (-decades / n) * std::abs(end - singular);
            }
        };
        piece(0, critical / 2);
        piece(critical, critical / 2);
        piece(critical, (1 + critical) / 2);
        piece(1, (1 + critical) / 2);
        return sum * 2 * std::acos(-1.0);
    };
    const double sign = wo_z < 0 ? -1 : 1;
    return {of_side(sign), of_side(-sign)};
}

template <class Check>
void for_each_glass(const Check& check)
{
    for (double index : {1.0, 1.0001, 1.01, 1.1, 1.5, 2.0, 4.0})
        for (double alpha : {1e-3, 0.06, 0.25, 0.6, 1.0})
            for (bool inverse : {false, true}) check(alpha, inverse ? 1 / index : index);
}

// Single scattering by luts/dielectric_integral.h, which shares no code with the closures; the
// added lobes by their eval.
TEST(DielectricTail, returns_all_energy_on_both_sides)
{
    for_each_glass([](double alpha, double eta) {
        const auto closure = tail_of<double>(alpha, eta);
        EXPECT_TRUE(closure.traits().energy_preserving);
        for (double mu : {0.02, 0.1, 0.3, 0.6, 1.0, -0.02, -0.05, -0.2, -0.8})
        {
            const double eta_o = mu < 0 ? 1 / eta : eta;
            const auto single =
                luts::dielectric_albedo(luts::SlopeLaw::ggx(alpha), std::abs(mu), eta_o, 16);
            const double E = single.reflected + single.transmitted_beta;
            const auto prepared = closure.prepare(sided(mu));
            const auto eval = [&](const Vec3<double>& wi) { return prepared.second().eval(wi).x; };
            EXPECT_NEAR(E + halves(mu, eta, eval).sum(), 1, 5e-3)
                << "alpha " << alpha << ", eta " << eta << ", mu " << mu;
        }
    });
}

// R of the closure, by quadrature as above, against walks by numbers that baking did not take.
template <class Distribution>
void expect_the_share_of_the_walk(const std::string& name)
{
    for (double eta : {1.1, 1.5, 3.0, 1 / 1.1, 1 / 1.5, 1 / 3.0})
        for (double alpha : {0.1, 0.3, 0.6, 1.0})
        {
            const Distribution distribution(alpha);
            const auto closure = fitted_tail(beta_glass(distribution, eta), tables_of(name));
            for (double mu : {0.05, 0.3, 0.8})
            {
                const auto single =
                    luts::dielectric_albedo(luts::SlopeLaw::named(name, alpha, 0), mu, eta, 12);
                const auto prepared = closure.prepare(sided(mu));
                const Halves added = halves(
                    mu, eta, [&](const Vec3<double>& wi) { return prepared.second().eval(wi).x; });
                const double R = single.reflected + added.reflected;
                const double sum = single.reflected + single.transmitted_beta + added.sum();
                const auto walk = sum_samples(
                    DielectricWalk<Distribution>(distribution, eta).prepare(sided(mu)), 1 << 13);
                EXPECT_NEAR(R / sum, walk.reflected, 0.03)
                    << name << " alpha " << alpha << ", eta " << eta << ", mu " << mu;
            }
        }
}

TEST(DielectricTail, splits_as_the_walk_does)
{
    expect_the_share_of_the_walk<GGX<double>>("ggx");
    expect_the_share_of_the_walk<Beckmann<double>>("beckmann");
}

TEST(DielectricTail, is_reciprocal_with_eta_squared)
{
    Random random(43);
    for_each_glass([&](double alpha, double eta) {
        const auto closure = tail_of<double>(alpha, eta, ScatterMode::RT, 0.8);
        EXPECT_TRUE(closure.traits().reciprocal);
        for (int i = 0; i < 40; ++i)
        {
            const double z_o = 0.02 + 0.98 * random.unit(), z_i = 0.02 + 0.98 * random.unit();
            const auto wo = sided(random.bits() % 2 ? z_o : -z_o),
                       wi = sided(random.bits() % 2 ? z_i : -z_i, 7 * random.unit());
            const double eta_o = wo.z < 0 ? 1 / eta : eta;
            const double scale = wo.z * wi.z > 0 ? 1 : eta_o * eta_o;
            const double there = closure.eval(wo, wi).x / std::abs(wi.z);
            const double back = scale * closure.eval(wi, wo).x / std::abs(wo.z);
            EXPECT_NEAR(there, back, 1e-8 * std::max(there, back))
                << "alpha " << alpha << ", eta " << eta << ", wo " << wo << ", wi " << wi;
        }
    });
}

TEST(DielectricTail, samples_return_all_energy_with_small_weights)
{
    double largest = 0, variance = 0;
    for_each_glass([&](double alpha, double eta) {
        const auto closure = tail_of<double>(alpha, eta);
        for (double mu : {0.05, 0.4, 1.0, -0.05, -0.4, -1.0})
        {
            const auto s = sample_statistics(closure.prepare(sided(mu)), 1000);
            EXPECT_NEAR(s.mean.x, 1, 0.02) << "alpha " << alpha << ", eta " << eta << ", mu " << mu;
            largest = std::max(largest, s.largest);
            variance = std::max(variance, s.variance);
        }
    });
    EXPECT_LT(largest, 6);
    EXPECT_LT(variance, 0.6);
}

// Of the added lobes, whose eval and pdf are functions of the cosine: the lobe's own have tests of
// their own, and so has the mixture of any two.
TEST(DielectricTail, added_samples_are_those_of_eval_and_pdf)
{
    for_each_glass([](double alpha, double eta) {
        const auto closure = tail_of<double>(alpha, eta);
        for (double mu : {0.3, -0.3, -0.9})
        {
            const auto prepared = closure.prepare(sided(mu)).second();
            const auto place = [&] {
                return "alpha " + std::to_string(alpha) + ", eta " + std::to_string(eta) + ", mu " +
                       std::to_string(mu);
            };
            const Halves pdf =
                halves(mu, eta, [&](const Vec3<double>& wi) { return prepared.pdf(wi); });
            const Halves f =
                halves(mu, eta, [&](const Vec3<double>& wi) { return prepared.eval(wi).x; });
            const SampleSums s = sum_samples(prepared, 2048);
            if (prepared.loss() <= 0) continue;
            EXPECT_NEAR(pdf.sum(), 1, 4e-4) << place();
            EXPECT_EQ(s.nothing, 0) << place();
            EXPECT_NEAR(s.reflected, f.reflected, 2e-3) << place();
            EXPECT_NEAR(s.transmitted, f.transmitted, 2e-3) << place();
            const auto albedo = prepared.albedo();
            EXPECT_NEAR(albedo.reflect.x, f.reflected, 2e-3) << place();
            EXPECT_NEAR(albedo.transmit.x, f.transmitted, 2e-3) << place();
        }
    });
}

// All of the closure: the lobe's integrals are over facets, which lead to fewer directions than the
// added lobes do.
TEST(DielectricTail, pdf_and_nothing_are_one_and_weights_are_those_of_eval)
{
    for (double eta : {1.5, 1 / 1.5})
        for (double alpha : {0.25, 1.0})
        {
            const auto closure = tail_of<double>(alpha, eta);
            for (double mu : {0.2, 0.9})
            {
                const auto prepared = closure.prepare(sided(mu));
                const auto lobe = integrals(prepared.first(), sided(mu), eta, alpha, alpha);
                const auto added = [&](const auto& f) { return halves(mu, eta, f); };
                const double p = prepared.first_probability();
                const double lobe_pdf = lobe.reflected.x + lobe.transmitted.x;
                const double added_pdf =
                    added([&](const auto& wi) { return prepared.second().pdf(wi); }).sum();
                const Halves f =
                    added([&](const auto& wi) { return prepared.second().eval(wi).x; });
                const SampleSums s = sum_samples(prepared, 1 << 15);
                EXPECT_NEAR(p * lobe_pdf + (1 - p) * added_pdf + s.nothing, 1, 5e-4)
                    << alpha << " " << eta << " " << mu;
                EXPECT_NEAR(lobe.reflected.y + f.reflected, s.reflected, 2e-3)
                    << alpha << " " << eta << " " << mu;
                EXPECT_NEAR(lobe.transmitted.y + f.transmitted, s.transmitted, 2e-3)
                    << alpha << " " << eta << " " << mu;
            }
        }
}

TEST(DielectricTail, weight_is_eval_over_pdf)
{
    for (double eta : {0.6, 1.0, 1.5})
        for (double alpha : {0.05, 0.5, 1.0})
        {
            expect_weight_is_eval_over_pdf(tail_of<float>(alpha, eta), 2e-6, true);
            expect_weight_is_eval_over_pdf(tail_of<double>(alpha, eta), 1e-13, true);
        }
}

// What is looked up, moved as little as reciprocity asks for: least where most is transmitted.
TEST(DielectricTail, scales_are_near_one)
{
    for (double index : {1.1, 1.5, 3.0})
        for (double alpha : {0.25, 0.5, 1.0})
            for (bool inverse : {false, true})
            {
                const auto added = tail_of<double>(alpha, inverse ? 1 / index : index).added_lobe();
                EXPECT_NEAR(added.scale(inverse), 1, 0.02) << alpha << " " << index;
                EXPECT_NEAR(added.scale(!inverse), 1, 0.2) << alpha << " " << index;
                EXPECT_LE(added.scale(inverse), 1 + 1e-12);
            }
}

TEST(DielectricTail, modes_and_tints_take_their_part)
{
    const double eta = 2, alpha = 0.5625;
    const auto both = tail_of<double>(alpha, eta), R = tail_of<double>(alpha, eta, ScatterMode::R),
               T = tail_of<double>(alpha, eta, ScatterMode::T);
    const auto tinted = fitted_tail(beta_glass(GGX<double>(alpha), eta, ScatterMode::RT, 0.5, 0.25),
                                    tables_of("ggx"));
    EXPECT_FALSE(R.traits().energy_preserving || T.traits().energy_preserving);
    EXPECT_FALSE(R.added_lobe().traits().transmissive);
    Random random(5);
    for (int i = 0; i < 200; ++i)
    {
        const auto wo = sided(i % 2 ? -random.unit() : random.unit()),
                   wi = sided(i % 3 ? -random.unit() : random.unit(), 3);
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

TEST(DielectricTail, strength_scales_the_added_lobes)
{
    const auto wo = sided(-0.4), wi = sided(0.6, 1);
    const double whole = tail_of<double>(0.5, 1.5).added_lobe().eval(wo, wi).x;
    EXPECT_DOUBLE_EQ(tail_of<double>(0.5, 1.5, ScatterMode::RT, 0.25).added_lobe().eval(wo, wi).x,
                     0.25 * whole);
    EXPECT_FALSE(tail_of<double>(0.5, 1.5, ScatterMode::RT, 0.25).traits().energy_preserving);
    EXPECT_EQ(tail_of<double>(0.5, 1.5, ScatterMode::RT, std::nan("")).added_lobe().eval(wo, wi).x,
              0);
}

// Without any of its tables; and of the correlated form, whose first bounce is not the walk's.
TEST(DielectricTail, without_what_it_needs_is_the_lobe_alone)
{
    const auto lobe = beta_glass(GGX<float>(0.5f), 1.5);
    DielectricTables without = tables_of("ggx");
    without.later[1] = {};
    const auto wo = direction<float>(0.4);
    for (const DielectricTables& tables : {DielectricTables{}, without})
    {
        const auto closure = fitted_tail(lobe, tables);
        EXPECT_FALSE(closure.traits().energy_preserving);
        EXPECT_FALSE(closure.added_lobe().bound());
        for (float z : {-0.7f, 0.7f})
        {
            const auto wi = Vec3<float>(sided(z, 2.0));
            EXPECT_EQ(closure.eval(wo, wi), lobe.eval(wo, wi));
            EXPECT_EQ(closure.pdf(wo, wi), lobe.pdf(wo, wi));
        }
    }
    const auto correlated = glass<float>(0.5, 1.5);
    const auto closure = fitted_tail(correlated, tables_of("ggx"));
    EXPECT_FALSE(closure.traits().energy_preserving);
    EXPECT_FALSE(closure.lobe().tables());
    EXPECT_EQ(closure.eval(wo, direction<float>(0.7)), correlated.eval(wo, direction<float>(0.7)));
    const auto reflecting =
        fitted_tail(glass<float>(0.5, 1.5, TransmissionShadowing::correlated, ScatterMode::R),
                    tables_of("ggx"));
    EXPECT_TRUE(reflecting.added_lobe().bound());
}

TEST(DielectricTail, a_flat_surface_has_no_added_lobe)
{
    const auto closure = tail_of<float>(0, 1.5);
    const auto s = closure.sample(direction<float>(1e-5), {0.1f, 0.2f, 0.99f});
    EXPECT_TRUE(s.valid && s.delta);
    EXPECT_EQ(closure.pdf(direction<float>(0.3), direction<float>(0.5)), 0);
}

// Where next to nothing is missing, a float knows of 1 - E^S little but that.
TEST(DielectricTail, a_float_answers_as_a_double_does)
{
    Random random(9);
    for (double eta : {1.01, 1.5, 4.0, 0.6})
        for (double alpha : {0.15, 0.4, 1.0})
        {
            const auto exact = tail_of<double>(alpha, eta).added_lobe();
            const auto found = tail_of<float>(alpha, eta).added_lobe();
            for (int i = 0; i < 50; ++i)
            {
                const auto wo = sided(random.unit() - 0.5), wi = sided(random.unit() - 0.5, 2);
                const double f = exact.eval(wo, wi).x, pdf = exact.pdf(wo, wi);
                const Vec3<float> o(wo), in(wi);
                EXPECT_NEAR(found.eval(o, in).x, f, 1e-3 * f + 1e-5) << alpha << " " << eta;
                EXPECT_NEAR(found.pdf(o, in), pdf, 1e-2 * pdf + 1e-6) << alpha << " " << eta;
                EXPECT_NEAR(found.albedo(o).reflect.x, exact.albedo(wo).reflect.x, 1e-4);
            }
        }
}

TEST(DielectricTail, a_vector_of_floats_answers_as_a_float_does)
{
    for (double eta : {0.7, 1.5})
        expect_batch_answers_as_float(
            [eta](const auto& alpha) {
                using Real = std::decay_t<decltype(alpha)>;
                return fitted_tail(beta_glass(GGX<Real>(alpha), eta), tables_of("ggx"));
            },
            1e-4, true);
}

template <class Real>
void run_hostile(long calls)
{
    Hostile<Real> hostile(sizeof(Real) + 120);
    long failures = 0;
    const auto& tables = tables_of("ggx");
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
        const auto closure = fitted_tail(lobe, tables, hostile.parameter());
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
            ADD_FAILURE() << "alpha " << ggx.alpha_x() << " " << ggx.alpha_y() << ", eta "
                          << lobe.eta() << ", wo " << wo << ", wi " << wi << ": eval "
                          << prepared.eval(wi) << ", pdf " << pdf << ", sample " << s.wi << " "
                          << s.weight << " " << s.pdf << " albedo " << albedo.reflect
                          << albedo.transmit;
    }
    EXPECT_EQ(failures, 0);
}

TEST(DielectricTail, stays_finite_whatever_comes_in)
{
    run_hostile<float>(30000);
    run_hostile<double>(15000);
}

}  // namespace
