// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The Beckmann distribution: it is normalised, its visible area and normals follow from its
// density, in every number type.

#include "../support/normals.h"
#include "../support/reflection_integral.h"
#include "../support/trapped.h"

#include <regain/closures/beckmann.h>
#include <regain/closures/xsimd.h>

#include <gtest/gtest.h>

#include <limits>

using namespace regain;
using namespace regain::tests;

namespace {

using Batch = xsimd::batch<float>;

// exp(x^2) erfc(x) times sqrt(pi) x, subtracted from 1, in long double: the text-book formula where
// it is good, the continued fraction DLMF 7.9 to its end elsewhere.
long double deficit(long double x)
{
    if (x < 2) return 1 - std::sqrt(std::acos(-1.0L)) * x * std::exp(x * x) * std::erfc(x);
    const long double w = 1 / (2 * x * x);
    long double v = 1;
    for (int n = 400; n >= 2; --n) v = 1 + n * w / v;
    return w / v / (1 + w / v);
}

// The share of the visible slopes beyond x, for a cotangent c of either sign.
long double share_beyond(long double c, long double x)
{
    const long double root_pi = std::sqrt(std::acos(-1.0L));
    if (c >= 0)
    {
        const auto beyond = [&](long double v) {
            return (std::exp(-v * v) + root_pi * c * std::erfc(v)) / 2;
        };
        return beyond(x) / beyond(-c);
    }
    return std::exp((-c - x) * (x - c)) * (x + c - c * deficit(x)) / (x * deficit(-c));
}

TEST(Beckmann, gaussian_tails_keep_their_digits)
{
    for (double x = 0; x < 9; x += 0.013)
    {
        const auto exact = [](long double t) {
            return std::exp(-t * t) * deficit(t) / std::sqrt(std::acos(-1.0L));
        };
        EXPECT_NEAR(double(detail::ierfc(x) / exact(x)), 1, 1e-12) << x;
        EXPECT_NEAR(double(detail::erfcx_deficit(x) / deficit(x)), 1, 1e-12) << x;
        const auto single = static_cast<float>(x);
        EXPECT_NEAR(double(detail::ierfc(single) / exact(single)), 1, 1e-5) << x;
        EXPECT_NEAR(double(detail::erfcx_deficit(single) / deficit(single)), 1, 1e-5) << x;
    }
}

TEST(Beckmann, inverse_error_function_is_the_inverse)
{
    for (double y = -0.9999; y < 1; y += 1.0 / 777)
    {
        EXPECT_NEAR(std::erf(detail::erf_inverse(y)), y, 1e-15);
        const auto single = static_cast<float>(y);
        EXPECT_NEAR(std::erf(double(detail::erf_inverse(single))), single, 3e-7);
    }
    for (double tail : {1e-4, 1e-8, 1e-12, 0x1p-50})
        EXPECT_NEAR(std::erfc(detail::erf_inverse(1 - tail)) / (1 - (1 - tail)), 1, 1e-13);
    EXPECT_TRUE(std::isfinite(detail::erf_inverse(1.0)));
    EXPECT_TRUE(std::isfinite(detail::erf_inverse(-1.0f)));
}

// The sampled slope is where the distribution function says, to the last digits of the number type,
// from all cotangents and to both ends of [0, 1): nothing but that makes D_visible the pdf.
template <class Real>
double worst_slope(double c, double rounding)
{
    double worst = 0;
    for (int i = 0; i <= 100; ++i)
        for (double number :
             {(i + 0.5) / 101, std::pow(10.0, -i / 14.5), 1 - std::pow(10.0, -i / 14.5)})
        {
            const Real u = static_cast<Real>(number), cotangent = static_cast<Real>(c);
            if (!(u < 1)) continue;
            const Real x = detail::visible_gaussian_slope(cotangent, u);
            // Far below the horizon the slope itself, rounded, moves the share.
            const double unknown = rounding * (8 + 2 * std::min(c, 0.0) * std::min(c, 0.0));
            worst = std::max(worst, double(std::abs(share_beyond(cotangent, x) - u)) / unknown);
        }
    return worst;
}
TEST(Beckmann, slopes_invert_the_distribution_to_the_last_digits)
{
    for (double size : {1e7, 300.0, 20.0, 6.0, 4.1, 3.2, 2.6, 2.0, 1.4, 1.0, 0.5, 0.1, 1e-3, 0.0})
        for (double c : {size, -size})
        {
            if (c < -100) continue;  // where the rounded slope is all that is left
            EXPECT_LT(worst_slope<double>(c, 0x1p-53), 8) << c;
            EXPECT_LT(worst_slope<float>(c, 0x1p-24), 8) << c;
        }
}

TEST(Beckmann, projected_normals_integrate_to_one)
{
    for (double ax : alphas)
        for (double ratio : {1.0, 10.0})
        {
            const Beckmann<double> d(ax, ax / ratio);
            EXPECT_NEAR(over_normals(ax, ax / ratio, [&](const auto& m) { return d.D(m) * m.z; }),
                        1, 1e-9);
        }
}

// Heitz 2014, Eq. 13: the visible area of the microsurface is that of the plane.
TEST(Beckmann, visible_area_is_the_cosine)
{
    for (double ax : {0.05, 0.4, 1.0})
        for (double mu : {0.02, 0.3, 0.9, -0.02, -0.3})
            for (double azimuth : {0.0, 0.7})
            {
                const Beckmann<double> d(ax, 0.5 * ax);
                const auto wo = direction<double>(mu, azimuth);
                const double visible = over_normals(
                    ax, 0.5 * ax, [&](const auto& m) { return std::max(0.0, wo.dot(m)) * d.D(m); });
                // From below only a rim is left, which the sum sees with less precision.
                EXPECT_NEAR(visible, d.projected_area(wo), 2e-4 * visible + 1e-5);
                if (mu < 0) continue;
                EXPECT_NEAR(d.G1(wo) * visible, mu, 2e-4);
                EXPECT_NEAR(1 / (1 + d.lambda(wo)), d.G1(wo), 1e-12);
            }
}

// Walter et al. 2007, Eq. 26, as printed, in long double: a = 1 / (alpha tan theta).
TEST(Beckmann, visible_area_keeps_its_digits)
{
    for (double alpha : {1e-3, 0.1, 0.3, 1.0})
        for (double mu : {1e-5, 1e-3, 0.1, 0.3, 0.6, 0.9, 0.99})
        {
            const auto w = direction<double>(mu, 0.7);
            const long double s = alpha * std::sqrt(1.0L - (long double)mu * mu), a = mu / s;
            const long double excess =
                s * std::exp(-a * a) * deficit(a) / std::sqrt(std::acos(-1.0L)) / 2;
            const Beckmann<double> d(alpha);
            const Beckmann<float> f{static_cast<float>(alpha)};
            EXPECT_NEAR(double(d.projected_area(w) / (mu + excess)), 1, 1e-14);
            EXPECT_NEAR(f.projected_area(Vec3<float>(w)) / double(mu + excess), 1, 1e-6);
            // Far below the horizon the exponential magnifies how alpha and w were rounded, and
            // ends.
            if (a < 25)
            {
                const double bound = double(1e-14L * (10 + a * a));
                EXPECT_NEAR(double(d.projected_area(-w) / excess), 1, bound);
                EXPECT_NEAR(double(d.lambda(w) * mu / excess), 1, bound);
            }
            if (a < 8)
            {
                EXPECT_NEAR(f.projected_area(Vec3<float>(-w)) / double(excess), 1,
                            2e-6 * (4 + double(a * a)));
            }
        }
}

TEST(Beckmann, shadowing_is_correlated_and_bounded)
{
    const Beckmann<double> d(0.6, 0.3);
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

TEST(Beckmann, float_is_as_good_as_double_at_small_alpha)
{
    for (double alpha : {1e-4, 1e-3, 1e-2})
        for (double t : {0.0, 0.3, 1.0, 3.0})
        {
            const double s = std::sin(t * alpha), c = std::cos(t * alpha);
            const double exact = Beckmann<double>(alpha).D(Vec3<double>(s, 0, c));
            const float single =
                Beckmann<float>(float(alpha)).D(Vec3<float>(float(s), 0, float(c)));
            EXPECT_NEAR(single / exact, 1, 1e-6 * (2 + 2 * t * t)) << alpha << ", t " << t;
        }
}

TEST(Beckmann, sampled_normals_follow_the_visible_density)
{
    for (double alpha : {0.05, 0.5, 1.0})
        for (double ratio : {1.0, 0.2})
            for (double mu : {0.99, 0.5, 0.02, -0.02, -0.4, -0.9})
            {
                const double alpha_y = alpha * ratio;
                const auto wo = direction<double>(mu, 0.7);
                const Beckmann<double> d(alpha, alpha_y);
                // Nothing to compare with where double itself has no density left.
                if (wo.z < -12 * std::hypot(alpha * wo.x, alpha_y * wo.y)) continue;
                const auto af = static_cast<float>(alpha), bf = static_cast<float>(alpha_y);
                EXPECT_LT(deviate_of_samples(d, d, wo, 20000, 1), 4.5) << alpha << " " << mu;
                EXPECT_LT(deviate_of_samples(d, Beckmann<float>(af, bf), wo, 20000, 2), 4.5)
                    << alpha << " " << mu;
                EXPECT_LT(
                    deviate_of_samples(d, Beckmann<Batch>(Batch(af), Batch(bf)), wo, 20000, 3), 4.5)
                    << alpha << " " << mu;
            }
}

TEST(Beckmann, hostile_inputs_give_unit_normals_and_finite_areas)
{
    const float nan = std::numeric_limits<float>::quiet_NaN(),
                inf = std::numeric_limits<float>::infinity(), last = 1 - 0x1p-24f;
    const Trapped trapped;
    for (float alpha : {0.0f, 1e-5f, 1e-3f, 0.3f, 1.0f, inf, -1.0f, nan})
        for (float mu : {1.0f, 0.5f, 1e-3f, 1e-12f, 0.0f, -1e-12f, -1e-3f, -0.5f, -1.0f})
            for (float x : {0.0f, 1e-8f, 0.5f, last, 1.0f, nan})
                for (float y : {0.0f, 1e-8f, 0.5f, last, 1.0f, nan})
                {
                    const auto wo = direction<float>(mu, 0.4);
                    const Beckmann<float> d(alpha, 0.3f * alpha);
                    const auto visible = d.visible(wo);
                    const auto m = visible.sample({x, y, 0});
                    EXPECT_NEAR(m.length(), 1, 1e-6);
                    EXPECT_GT(m.z, 0);
                    EXPECT_TRUE(std::isfinite(d.D(m)) && d.D(m) >= 0);
                    EXPECT_TRUE(std::isfinite(visible.projected_area()));
                    EXPECT_GE(visible.projected_area(), 0);
                }
}

// What a single bounce keeps, averaged over the cosine, F = 1. The numbers are from a program of
// its own, which found them by quadrature over outgoing directions and again over normals, to 1e-5.
TEST(Beckmann, reflected_energy_matches_independent_quadrature)
{
    const struct
    {
        double alpha, average;
    } known[] = {{0.1, 0.99526}, {0.25, 0.97115}, {0.5, 0.89342}, {1, 0.66368}};
    const auto rule = luts::gauss_legendre(16);
    for (const auto& k : known)
    {
        const MicrofacetReflection<Beckmann<double>, ConstantFresnel<double>> lobe(
            Beckmann<double>(k.alpha), ConstantFresnel<double>{});
        double average = 0;
        for (std::size_t i = 0; i < rule.x.size(); ++i)
        {
            const auto wo = direction<double>(rule.x[i], 0.3);
            const auto prepared = lobe.prepare(wo);
            average += 2 * rule.x[i] * rule.weight[i] *
                       integrate_reflections(wo, k.alpha, k.alpha, 24,
                                             [&](const auto& wi) { return prepared.eval(wi).x; });
        }
        EXPECT_NEAR(average, k.average, 1.5e-5) << k.alpha;
    }
}

// The lobe built on it: weight = eval / pdf, and the mean weight is the integral of eval.
TEST(Beckmann, reflection_samples_agree_with_eval)
{
    Random random(5);
    for (double alpha : {0.2, 0.8})
    {
        const MicrofacetReflection<Beckmann<double>, ConstantFresnel<double>> lobe(
            Beckmann<double>(alpha, 0.5 * alpha), ConstantFresnel<double>{});
        const auto prepared = lobe.prepare(direction<double>(0.3, 0.6));
        const double exact =
            integrate_reflections(prepared.wo(), alpha, 0.5 * alpha, 48,
                                  [&](const auto& wi) { return prepared.eval(wi).x; });
        double sum = 0, squares = 0;
        constexpr int n = 20000;
        for (int i = 0; i < n; ++i)
        {
            const auto s = prepared.sample(Vec2<double>(random.unit(), random.unit()));
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
