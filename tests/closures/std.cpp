// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The Student t-distribution of normals: it is normalised, its visible area and normals follow from
// its density for every tail parameter, in every number type, and it ends where it has to: in GGX
// and in Beckmann.

#include "../support/normals.h"
#include "../support/reflection_integral.h"
#include "../support/trapped.h"

#include <regain/closures/beckmann.h>
#include <regain/closures/std.h>
#include <regain/closures/xsimd.h>

#include <gtest/gtest.h>

#include <limits>

using namespace regain;
using namespace regain::tests;

namespace {

using Batch = xsimd::batch<float>;

constexpr double gammas[] = {1.51, 1.55, 1.7, 2, 2.2, 2.5, 3, 4.3, 7, 12, 25, 50, 100};

// int (1 + t^2)^-gamma dt over all t, with t = sinh(v) by the trapezoidal rule.
double integral_across(double gamma)
{
    constexpr double h = 0.05;
    double sum = 1;
    for (int i = 1; i < 4000; ++i)
        sum += 2 *
               std::exp((1 - 2 * gamma) * (i * h + std::log1p(std::exp(-2 * i * h)) - std::log(2)));
    return h * sum;
}

// sigma(w) by quadrature over both slopes, in units of sqrt(gamma - 1) alpha: across w as above,
// along w from the first visible slope -c with x = sinh(v0 + exp(pi / 2 sinh t)).
double area_by_quadrature(double gamma, double alpha, const Vec3<double>& w)
{
    // The quadrature looks closely at the first visible slope, so that is where most must be: from
    // far above, by sigma(w) = sigma(-w) + w.z, as the mean slope is 0.
    if (w.z > std::hypot(alpha * w.x, alpha * w.y))
        return w.z + area_by_quadrature(gamma, alpha, -w);
    const double p = gamma - 1, s = std::sqrt(p) * alpha * std::hypot(w.x, w.y), c = w.z / s;
    const double first = -std::asinh(c);
    constexpr double h = 1.0 / 64;
    double sum = 0;
    for (int i = -4 * 64; i <= 3 * 64; ++i)
    {
        const double t = i * h, beyond = std::exp(2 * std::sinh(t)), v = first + beyond;
        // c + x = 2 cosh((v + first) / 2) sinh((v - first) / 2), which does not cancel.
        const double log_height = std::log1p(std::exp(-std::abs(v + first))) +
                                  std::abs(v + first) / 2 + beyond / 2 +
                                  std::log(-std::expm1(-beyond)) - std::log(2);
        const double log_cosh = std::abs(v) + std::log1p(std::exp(-2 * std::abs(v))) - std::log(2);
        sum += std::exp(log_height + (2 - 2 * gamma) * log_cosh) * beyond * 2 * std::cosh(t);
    }
    return s * p / std::acos(-1.0) * integral_across(gamma) * sum * h;
}

TEST(Std, visible_area_matches_quadrature_over_slopes)
{
    for (double gamma : gammas)
    {
        const auto single_gamma = static_cast<float>(gamma);
        for (double alpha : {0.02, 0.3, 1.0})
            for (double mu : {1e-5, 0.02, 0.2, 0.5, 0.8, 0.95, 0.999})
            {
                const auto w = direction<double>(mu, 0.7);
                const STD<double> d(alpha, gamma);
                const double exact = area_by_quadrature(gamma, alpha, w);
                EXPECT_NEAR(d.projected_area(w) / exact, 1, 1e-11) << gamma << " " << alpha << mu;
                const STD<double> rounded(alpha, double(single_gamma));
                const STD<float> f(static_cast<float>(alpha), single_gamma);
                EXPECT_NEAR(f.projected_area(Vec3<float>(w)) / rounded.projected_area(w), 1, 2e-6)
                    << gamma << " " << alpha << mu;
            }
    }
}

// The same from below, where what is left may be tiny.
TEST(Std, visible_area_from_below_keeps_its_digits)
{
    for (double gamma : gammas)
        for (double alpha : {0.02, 0.3, 1.0})
            for (double mu : {1e-5, 0.02, 0.2, 0.5, 0.8, 0.95, 0.999})
            {
                const auto w = direction<double>(mu, 0.7);
                const STD<double> d(alpha, gamma);
                const double exact = area_by_quadrature(gamma, alpha, -w);
                if (exact < 1e-250) continue;
                EXPECT_NEAR(d.projected_area(-w) / exact, 1, 1e-9) << gamma << " " << alpha << mu;
                EXPECT_NEAR(d.lambda(w) * mu / exact, 1, 1e-9);
                EXPECT_NEAR(d.projected_area(-w), d.projected_area(w) - mu, 1e-14 * (1 + exact));
                if (exact < 1e-25) continue;
                const auto single_gamma = static_cast<float>(gamma);
                const STD<double> rounded(alpha, double(single_gamma));
                const STD<float> f(static_cast<float>(alpha), single_gamma);
                EXPECT_NEAR(f.projected_area(Vec3<float>(-w)) / rounded.projected_area(-w), 1, 1e-4)
                    << gamma << " " << alpha << mu;
            }
}

TEST(Std, projected_normals_integrate_to_one)
{
    // The tangent of the angle has the same distribution at every alpha, so that one integral of
    // the density over the slopes holds for all of them. It leaves out what lies beyond slope R,
    // (1 + R^2 / (gamma - 1))^(1 - gamma).
    for (double gamma : gammas)
        for (double alpha : {0.01, 1.0})
        {
            const STD<double> d(alpha, alpha, gamma);
            constexpr double R = 40;
            const auto rule = luts::gauss_legendre(96);
            double sum = 0;
            for (std::size_t i = 0; i < rule.x.size(); ++i)
            {
                const double rho = R * rule.x[i] * rule.x[i],
                             z = 1 / std::sqrt(1 + alpha * alpha * rho * rho);
                const Vec3<double> m(0.6 * alpha * rho * z, 0.8 * alpha * rho * z, z);
                sum += rule.weight[i] * 2 * R * rule.x[i] * 2 * std::acos(-1.0) * alpha * alpha *
                       rho * z * z * z * z * d.D(m);
            }
            const double beyond = std::pow(1 + R * R / (gamma - 1), 1 - gamma);
            EXPECT_NEAR(sum, 1 - beyond, 1e-9) << gamma;
        }
}

TEST(Std, two_is_ggx)
{
    Random random(3);
    for (int i = 0; i < 2000; ++i)
    {
        const double ax = random.unit(), ay = random.unit();
        const STD<double> d(ax, ay, 2);
        const GGX<double> g(ax, ay);
        const auto w = direction<double>(random.unit(), 7 * random.unit()),
                   m = direction<double>(random.unit(), 7 * random.unit());
        EXPECT_NEAR(d.D(m) / g.D(m), 1, 1e-13);
        EXPECT_NEAR(d.projected_area(w) / g.projected_area(w), 1, 1e-13);
        EXPECT_NEAR(d.projected_area(-w) / g.projected_area(-w), 1, 1e-12);
        EXPECT_NEAR(d.lambda(w) / g.lambda(w), 1, 1e-12);
        EXPECT_NEAR(d.G2(w, m) / g.G2(w, m), 1, 1e-13);
    }
}

// STD(gamma) is a Gamma mixture of Beckmann laws: 1 / b^2 has the shape gamma - 1 and the rate
// (gamma - 1) alpha^2 (d'Eon 2023). With y = exp(t) the trapezoidal rule over t is exact to
// rounding.
TEST(Std, is_a_gamma_mixture_of_beckmann)
{
    for (double gamma : {1.55, 2.0, 3.5, 20.0})
        for (double alpha : {0.05, 0.4, 1.0})
        {
            const STD<double> law(alpha, gamma);
            const double shape = gamma - 1, rate = shape * alpha * alpha;
            for (double tangent : {0.0, 0.1, 1.0, 8.0})
            {
                const double z = 1 / std::sqrt(1 + tangent * tangent);
                const Vec3<double> w(tangent * z, 0, z);
                double weight = 0, D = 0, area = 0;
                constexpr double step = 0.02;
                for (double t = -700; t < 12; t += step)
                {
                    const double y = std::exp(t) / rate;
                    const double p = step * std::exp(shape * t - std::exp(t)) / std::tgamma(shape);
                    // In slopes, as alphas beyond 1 are none to the library.
                    const double s = 1 / std::sqrt(y), c = z / (s * tangent * z + 1e-300);
                    weight += p;
                    D +=
                        p * y / std::acos(-1.0) * std::exp(-y * tangent * tangent) / std::pow(z, 4);
                    area += p * (tangent > 0 ? 0.5 * (z * (1 + std::erf(c)) +
                                                      s * tangent * z * std::exp(-c * c) /
                                                          std::sqrt(std::acos(-1.0)))
                                             : z);
                }
                EXPECT_NEAR(weight, 1, 1e-9);
                EXPECT_NEAR(law.D(w) / D, 1, 1e-9) << gamma << " " << alpha << " " << tangent;
                EXPECT_NEAR(law.projected_area(w) / area, 1, 1e-9)
                    << gamma << " " << alpha << " " << tangent;
            }
        }
}

// The difference goes with 1 / gamma.
TEST(Std, large_gamma_tends_to_beckmann)
{
    for (double alpha : {0.1, 0.6})
        for (double mu : {0.05, 0.4, 0.9})
        {
            const Beckmann<double> b(alpha);
            const auto w = direction<double>(mu, 0.3),
                       m = direction<double>(std::sqrt(1 - 0.4 * alpha * alpha));
            double last_area = 0, last_D = 0;
            for (double gamma : {25.0, 50.0, 100.0})
            {
                const STD<double> d(alpha, gamma);
                const double area = std::abs(d.projected_area(w) - b.projected_area(w)),
                             D = std::abs(d.D(m) / b.D(m) - 1);
                EXPECT_LT(area, 0.2 * alpha / gamma);
                EXPECT_LT(D, 1 / gamma);
                if (gamma > 25)
                {
                    // Beyond slopes of a few alpha, larger gamma are needed.
                    if (mu < alpha)
                    {
                        EXPECT_NEAR(area / last_area, 0.5, 0.05);
                    }
                    EXPECT_NEAR(D / last_D, 0.5, 0.1);
                }
                last_area = area;
                last_D = D;
            }
        }
}

TEST(Std, shadowing_is_correlated_and_bounded)
{
    const STD<double> d(0.6, 0.3, 1.6);
    for (double a : {0.05, 0.4, 0.9})
        for (double b : {0.02, 0.5, 1.0})
        {
            const auto wo = direction<double>(a, 0.3), wi = direction<double>(b, 2.0);
            const double G2 = d.G2(wo, wi);
            EXPECT_LE(G2, std::min(d.G1(wo), d.G1(wi)) + 1e-15);
            EXPECT_GE(G2, d.G1(wo) * d.G1(wi) - 1e-15);
            EXPECT_DOUBLE_EQ(G2, d.G2(wi, wo));
        }
}

TEST(Std, float_is_as_good_as_double_at_small_alpha)
{
    for (float gamma : {1.55f, 3.0f, 100.0f})
        for (double alpha : {1e-4, 1e-3, 1e-2})
            for (double t : {0.0, 0.3, 1.0, 5.0, 50.0})
            {
                const double s = std::sin(t * alpha), c = std::cos(t * alpha);
                const double exact = STD<double>(alpha, double(gamma)).D(Vec3<double>(s, 0, c));
                if (exact < 1e-30) continue;
                const float single =
                    STD<float>(float(alpha), gamma).D(Vec3<float>(float(s), 0, float(c)));
                EXPECT_NEAR(single / exact, 1, 1e-6 * (2 + 0.5 * double(gamma)))
                    << "alpha " << alpha << ", t " << t;
            }
}

TEST(Std, sampled_normals_follow_the_visible_density)
{
    for (float gamma : {1.51f, 1.7f, 2.0f, 2.6f, 5.0f, 100.0f})
        for (double alpha : {0.05, 1.0})
            for (double ratio : {1.0, 0.2})
                for (double mu : {0.99, 0.5, 0.02, -0.02, -0.5, -0.97})
                {
                    const double alpha_y = alpha * ratio;
                    const auto wo = direction<double>(mu, 0.7);
                    const STD<double> d(alpha, alpha_y, double(gamma));
                    if (!(d.projected_area(wo) > 1e-200)) continue;
                    const auto af = static_cast<float>(alpha), bf = static_cast<float>(alpha_y);
                    EXPECT_LT(deviate_of_samples(d, d, wo, 20000, 1), 4.5)
                        << gamma << " " << alpha << " " << mu;
                    EXPECT_LT(deviate_of_samples(d, STD<float>(af, bf, gamma), wo, 20000, 2), 4.5)
                        << gamma << " " << alpha << " " << mu;
                    const STD<Batch> vector{Batch(af), Batch(bf), Batch(gamma)};
                    EXPECT_LT(deviate_of_samples(d, vector, wo, 20000, 3), 4.5)
                        << gamma << " " << alpha << " " << mu;
                }
}

// Lanes have their own widths and tails.
TEST(Std, vectors_of_floats_answer_as_floats)
{
    Random random(7);
    constexpr std::size_t lanes = Batch::size;
    for (int n = 0; n < 300; ++n)
    {
        alignas(64) float alpha[lanes], gamma[lanes], x[lanes], y[lanes], z[lanes];
        for (std::size_t i = 0; i < lanes; ++i)
        {
            alpha[i] = random.unit<float>();
            gamma[i] = 1.51f + 0.4f / (random.unit<float>() + 0.01f);
            const auto w = direction<float>(2 * random.unit() - 1, 7 * random.unit());
            x[i] = w.x;
            y[i] = w.y;
            z[i] = w.z;
        }
        const STD<Batch> vector(Batch::load_aligned(alpha), Batch(0.3f),
                                Batch::load_aligned(gamma));
        const Vec3<Batch> w(Batch::load_aligned(x), Batch::load_aligned(y), Batch::load_aligned(z));
        const Batch area = vector.projected_area(w), D = vector.D(w), tail = vector.tail();
        for (std::size_t i = 0; i < lanes; ++i)
        {
            const STD<float> one(alpha[i], 0.3f, gamma[i]);
            const Vec3<float> v(x[i], y[i], z[i]);
            const double expected = one.projected_area(v);
            EXPECT_NEAR(area.get(i), expected, 1e-5 * expected + 1e-30);
            EXPECT_NEAR(D.get(i), one.D(v), 1e-4 * one.D(v) + 1e-30);
            EXPECT_NEAR(tail.get(i), one.tail(), 1e-6);
        }
    }
}

// Of some lanes the direction is below, of others above, where normals are proposed otherwise.
TEST(Std, vectors_of_floats_sample_as_floats)
{
    Random random(8);
    constexpr std::size_t lanes = Batch::size;
    int different = 0, all = 0;
    for (int n = 0; n < 2000; ++n)
    {
        alignas(64) float gamma[lanes], w[3][lanes], u[3][lanes];
        for (std::size_t i = 0; i < lanes; ++i)
        {
            gamma[i] = 1.51f + 0.4f / (random.unit<float>() + 0.01f);
            const auto wo = direction<float>(1.9 * random.unit() - 0.9, 7 * random.unit());
            for (int k = 0; k < 3; ++k)
            {
                w[k][i] = wo[k];
                u[k][i] = random.unit<float>();
            }
        }
        const auto load = [](const float(&x)[3][lanes]) {
            return Vec3<Batch>(Batch::load_aligned(x[0]), Batch::load_aligned(x[1]),
                               Batch::load_aligned(x[2]));
        };
        const STD<Batch> vector(Batch(0.5f), Batch(0.3f), Batch::load_aligned(gamma));
        const Vec3<Batch> m = vector.visible(load(w)).sample(load(u));
        for (std::size_t i = 0; i < lanes; ++i, ++all)
        {
            const Vec3<float> expected = STD<float>(0.5f, 0.3f, gamma[i])
                                             .visible({w[0][i], w[1][i], w[2][i]})
                                             .sample({u[0][i], u[1][i], u[2][i]});
            const Vec3<float> found(m.x.get(i), m.y.get(i), m.z.get(i));
            different += !found.equalWithAbsError(expected, 1e-3f);
        }
    }
    // Rounding may take a try in one and refuse it in the other.
    EXPECT_LT(different, all / 1000);
}

TEST(Std, hostile_inputs_give_unit_normals_and_finite_areas)
{
    const float nan = std::numeric_limits<float>::quiet_NaN(),
                inf = std::numeric_limits<float>::infinity(), last = 1 - 0x1p-24f;
    const Trapped trapped;
    for (float gamma : {1.0f, 1.51f, 2.0f, 30.0f, inf, -inf, nan})
        for (float alpha : {0.0f, 1e-5f, 1e-3f, 0.3f, 1.0f, inf, -1.0f, nan})
            for (float mu : {1.0f, 0.5f, 1e-3f, 1e-12f, 0.0f, -1e-12f, -1e-3f, -0.5f, -1.0f})
                for (float x : {0.0f, 1e-8f, 0.5f, last, nan})
                    for (float y : {0.0f, 0.5f, last, 1.0f, nan})
                        for (float z : {0.0f, 1e-8f, last})
                        {
                            const auto wo = direction<float>(mu, 0.4);
                            const STD<float> d(alpha, 0.3f * alpha, gamma);
                            const auto visible = d.visible(wo);
                            const auto m = visible.sample({x, y, z});
                            EXPECT_NEAR(m.length(), 1, 1e-6);
                            EXPECT_GT(m.z, 0);
                            EXPECT_TRUE(std::isfinite(d.D(m)) && d.D(m) >= 0);
                            EXPECT_TRUE(std::isfinite(visible.projected_area()));
                            EXPECT_GE(visible.projected_area(), 0);
                        }
    EXPECT_EQ(STD<float>(0.5f, nan).gamma(), 2);
    EXPECT_EQ(STD<float>(0.5f, 0).gamma(), static_cast<float>(std_min_gamma));
    EXPECT_EQ(STD<double>(0.5, 1e9).gamma(), std_max_gamma);
}

TEST(Std, tail_coordinates_are_monotone_and_invertible)
{
    const auto check = [](double lo, double hi, double (*tail)(const double&),
                          double (*gamma)(const double&)) {
        EXPECT_NEAR(tail(lo), 0, 1e-15);
        EXPECT_NEAR(tail(hi), 1, 1e-15);
        EXPECT_EQ(tail(2 * hi), tail(hi));
        EXPECT_EQ(tail(std::numeric_limits<double>::quiet_NaN()), tail(2));
        double last = -1;
        for (int i = 0; i <= 200; ++i)
        {
            const double g = lo + (hi - lo) * std::pow(i / 200.0, 3);
            EXPECT_NEAR(gamma(tail(g)) / g, 1, 1e-12);
            EXPECT_GT(tail(g), last);
            EXPECT_LE(tail(g), 1);
            last = tail(g);
            EXPECT_NEAR(tail(gamma(i / 200.0)), i / 200.0, 1e-12);
        }
    };
    check(std_min_gamma, std_max_gamma, std_tail<double>, std_gamma<double>);
    check(gtr_min_gamma, gtr_max_gamma, gtr_tail<double>, gtr_gamma<double>);
}

// What a single bounce keeps, F = 1. The numbers are from a program of its own, which found them by
// quadrature over outgoing directions and again over normals, to 1e-5; it prints four digits per
// direction and five of the average over the cosine.
TEST(Std, reflected_energy_matches_independent_quadrature)
{
    const auto lobe = [](double alpha) {
        return MicrofacetReflection<STD<double>, ConstantFresnel<double>>(
            STD<double>(alpha, 1.55), ConstantFresnel<double>{});
    };
    const auto albedo = [&](double alpha, double mu) {
        const auto prepared = lobe(alpha).prepare(direction<double>(mu, 0.3));
        return integrate_reflections(prepared.wo(), alpha, alpha, 24,
                                     [&](const auto& wi) { return prepared.eval(wi).x; });
    };
    const double directions[][2] = {{0.01, .3276}, {0.05, .2196}, {0.1, .1739},
                                    {0.2, .1325},  {0.35, .1052}, {0.5, .0921},
                                    {0.7, .0849},  {0.9, .0878},  {1, .1096}};
    for (const auto& known : directions)
        EXPECT_NEAR(albedo(1, known[0]), known[1], 7e-5) << known[0];

    const double averages[][2] = {{0.1, .66922}, {0.25, .42053}, {0.5, .22880}, {1, .09454}};
    const auto rule = luts::gauss_legendre(16);
    for (const auto& known : averages)
    {
        double average = 0;
        for (std::size_t i = 0; i < rule.x.size(); ++i)
            average += 2 * rule.x[i] * rule.weight[i] * albedo(known[0], rule.x[i]);
        EXPECT_NEAR(average, known[1], 2e-5) << known[0];
    }
}

// The lobe built on it: weight = eval / pdf, and the mean weight is the integral of eval.
TEST(Std, reflection_samples_agree_with_eval)
{
    Random random(5);
    for (double gamma : {1.55, 4.0})
    {
        const MicrofacetReflection<STD<double>, ConstantFresnel<double>> lobe(
            STD<double>(0.6, 0.3, gamma), ConstantFresnel<double>{});
        const auto prepared = lobe.prepare(direction<double>(0.3, 0.6));
        const double exact = integrate_reflections(
            prepared.wo(), 0.6, 0.3, 48, [&](const auto& wi) { return prepared.eval(wi).x; });
        double sum = 0, squares = 0;
        constexpr int n = 20000;
        for (int i = 0; i < n; ++i)
        {
            const auto s =
                prepared.sample(Vec3<double>(random.unit(), random.unit(), random.unit()));
            sum += s.weight.x;
            squares += s.weight.x * s.weight.x;
            if (!s.valid) continue;
            EXPECT_NEAR(s.weight.x * prepared.pdf(s.wi) / prepared.eval(s.wi).x, 1, 1e-9);
        }
        const double deviation = std::sqrt((squares / n - sum / n * sum / n) / n);
        EXPECT_NEAR(sum / n, exact, 4.5 * deviation);
    }
}

}  // namespace
