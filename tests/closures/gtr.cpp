// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// GTR against Burley's formula and against integrals over slopes, which know nothing of the mixture
// that the closure computes with.

#include "../support/closures.h"
#include "../support/reflection_integral.h"

#include <regain/closures/gtr.h>
#include <regain/closures/xsimd.h>

#include <gtest/gtest.h>

#include <cfenv>
#include <limits>
#include <vector>

using namespace regain;
using namespace regain::tests;

namespace {

using Batch = xsimd::batch<float>;
const double pi = std::acos(-1.0);

constexpr double gammas[] = {0.05, 0.3, 1, 1.5, 2, 2.5, 4, 5.5, 10};

// Burley 2012, appendix B, where the squared slope is rho; 1 + (alpha^2 - 1) cos^2 is
// (alpha^2 + rho) / (1 + rho).
double burley_D(double alpha, double gamma, double rho)
{
    const double a2 = alpha * alpha, fall = (1 + rho) / (a2 + rho);
    if (alpha == 1) return 1 / pi;
    const double c = gamma == 1 ? (a2 - 1) / (pi * 2 * std::log(alpha))
                                : (gamma - 1) * (a2 - 1) / (pi * (1 - std::pow(a2, 1 - gamma)));
    return c * std::pow(fall, gamma);
}
double slope_density(double alpha, double gamma, double rho)
{
    return burley_D(alpha, gamma, rho) / ((1 + rho) * (1 + rho));
}

// sigma(-w) of w = (1, 0, c): the integral of max(0, x - c) over slopes, in polar coordinates with
// the angle integrated: int_c^inf P(r^2) 2 r (sqrt(r^2 - c^2) - c acos(c / r)) dr, r^2 = c^2 + q^2.
double area_below(double alpha, double gamma, double c)
{
    constexpr int n = 2000;
    const double lo = std::log(alpha) - 14, h = (34 - lo) / n;
    double sum = 0;
    for (int i = 0; i <= n; ++i)
    {
        const double q = std::exp(lo + h * i), x = q / std::max(c, 1e-300), x2 = x * x;
        const double arm = x < 0.05 ? q * x2 * (1.0 / 3 - x2 * (1.0 / 5 - x2 * (1.0 / 7 - x2 / 9)))
                                    : q - c * std::atan(x);
        sum += slope_density(alpha, gamma, c * c + q * q) * q * q * arm;
    }
    return 2 * h * sum;
}

Vec3<double> with_slope(double c) { return Vec3<double>(1, 0, c) * (1 / std::sqrt(1 + c * c)); }

TEST(Gtr, density_is_burleys)
{
    for (double alpha : {1e-3, 0.05, 0.3, 0.9})
        for (double gamma : gammas)
        {
            const GTR<double> gtr(alpha, gamma);
            const GTR<float> single{float(alpha), float(gamma)};
            const double a = double(float(alpha)), g = double(float(gamma));
            for (double t : {0.0, 0.1, 1.0, 10.0, 1000.0})
            {
                const Vec3<double> m = Vec3<double>(t * alpha, 0, 1).normalized();
                const double rho = t * alpha * t * alpha;
                // Below 1e-25 D is 1e-25.
                const double expected = std::max(burley_D(alpha, gamma, rho), 1e-25);
                EXPECT_NEAR(gtr.D(m) / expected, 1, 1e-11);
                const float x = float(t * alpha);
                const double exact = burley_D(a, g, double(x) * double(x));
                if (exact < 1e-20) continue;
                EXPECT_NEAR(single.D({x, 0, 1}, 1 + x * x) / exact, 1, 2e-5)
                    << alpha << " " << gamma << " " << t;
            }
        }
}

// The formulas of gtr_mixture.h, as they stand there.
TEST(Gtr, is_a_positive_mixture_of_ggx_and_student_laws)
{
    for (double alpha : {0.05, 0.3})
        for (double gamma : {0.3, 1.0, 1.5, 2.5, 4.7, 9.6})
            for (double rho : {0.0, 1e-3, 0.1, 5.0})
            {
                const double beta = alpha * alpha;
                const int m = std::max(0, int(std::ceil(gamma - 2)));
                const double delta = m + 2 - gamma;
                double sum = 0, mass = 0;
                for (double y = -130; y <= 130; y += 0.4)
                {
                    const double s = std::exp(y), u = s / (1 + s), t = (1 + beta * s) / (1 + s);
                    double binomial = 1;
                    for (int j = 0; j <= m; ++j)
                    {
                        const double weight =
                            0.4 * binomial * std::pow(1 - beta, j) *
                            std::exp(std::lgamma(2.0 + j) - std::lgamma(2 - delta + j)) *
                            std::pow(u, 2 - delta + j) * std::pow(1 + s, -delta);
                        ASSERT_GE(weight, 0);
                        sum += weight * std::pow(t + rho, -2 - j);
                        mass += weight * pi / ((j + 1) * std::pow(t, j + 1));
                        binomial = binomial * (m - j) / (j + 1);
                    }
                }
                EXPECT_NEAR(sum / mass / slope_density(alpha, gamma, rho), 1, 1e-12)
                    << alpha << " " << gamma << " " << rho;
            }
}

TEST(Gtr, is_ggx_where_gamma_is_two_or_alpha_one)
{
    const auto compare = [](double ax, double ay, double gamma) {
        const GTR<double> gtr(ax, ay, gamma);
        const GTR<float> single{float(ax), float(ay), float(gamma)};
        const GGX<double> ggx(ax, ay);
        const GGX<float> single_ggx{float(ax), float(ay)};
        for (double mu : {-1.0, -0.3, -1e-3, 1e-3, 0.3, 0.9})
        {
            const auto w = direction<double>(mu, 0.7);
            const auto f = Vec3<float>(w);
            const double area = ggx.projected_area(w);
            EXPECT_NEAR(gtr.projected_area(w), area, 1e-12 * area);
            EXPECT_NEAR(single.projected_area(f), single_ggx.projected_area(f), 2e-6 * area);
            if (mu < 0) continue;
            EXPECT_NEAR(gtr.lambda(w) / ggx.lambda(w), 1, 1e-12);
            EXPECT_NEAR(gtr.D(w) / ggx.D(w), 1, 1e-12);
            EXPECT_NEAR(single.D(f) / single_ggx.D(f), 1, 5e-6);
        }
    };
    for (double alpha : {1e-3, 0.1, 0.5, 1.0})
        for (double ratio : {1.0, 0.2}) compare(alpha, alpha * ratio, 2);
    for (double gamma : gammas) compare(1, 1, gamma);
}

TEST(Gtr, is_continuous_in_gamma)
{
    for (double alpha : {1e-3, 0.1, 0.999999, 1.0})
        for (double gamma : {1.0, 2.0, 3.0, 6.0})
            for (double mu : {-0.1, 0.05, 0.5, 0.99})
            {
                const auto w = direction<double>(mu);
                const GTR<double> at(alpha, gamma);
                // What D and area change by over this step is of the order of 1e-9 ln(1 / alpha).
                for (double step : {-1e-9, 1e-9})
                {
                    const GTR<double> next(alpha, gamma + step);
                    EXPECT_NEAR(next.projected_area(w) / at.projected_area(w), 1, 5e-8);
                    if (mu > 0)
                    {
                        EXPECT_NEAR(next.lambda(w) / at.lambda(w), 1, 5e-8);
                        EXPECT_NEAR(next.D(w) / at.D(w), 1, 5e-8);
                    }
                }
            }
}

TEST(Gtr, visible_area_is_the_integral_over_slopes)
{
    for (double alpha : {1e-3, 0.05, 0.3, 1.0})
        for (double gamma : gammas)
        {
            const GTR<double> gtr(alpha, gamma);
            // In float the widths and gamma are those that it can represent.
            const float a = float(alpha), g = float(gamma);
            const GTR<float> single(a, g);
            for (double c : {0.0, 1e-3, 0.01, 0.1, 0.5, 2.0, 50.0})
            {
                const Vec3<double> w = with_slope(c);
                const double below = w.x * area_below(alpha, gamma, c);
                EXPECT_NEAR(gtr.projected_area(-w) / below, 1, 2e-9)
                    << "alpha " << alpha << ", gamma " << gamma << ", c " << c;
                EXPECT_NEAR(gtr.projected_area(w), below + w.z, 2e-9 * (below + w.z));
                EXPECT_NEAR(gtr.lambda(with_slope(c + 1e-6)) * with_slope(c + 1e-6).z /
                                gtr.projected_area(-with_slope(c + 1e-6)),
                            1, 1e-12);

                const Vec3<float> f(w);
                const double exact =
                    double(f.x) * area_below(double(a), double(g), double(f.z) / double(f.x));
                EXPECT_NEAR(single.projected_area(f) / (exact + double(f.z)), 1, 1.2e-5);
                if (exact < 1e-30) continue;
                EXPECT_NEAR(single.projected_area(-f) / exact, 1, 1.2e-5)
                    << "alpha " << alpha << ", gamma " << gamma << ", c " << c;
            }
        }
}

// gamma = 1 alone has an elementary Lambda (Atanasov et al. 2015, for V-Ray).
TEST(Gtr, lambda_of_gamma_one_is_the_closed_form)
{
    for (double a : {0.01, 0.1, 0.5, 0.9})
        for (double s : {0.01, 0.1, 0.5, 1.0, 3.0})
        {
            const double log = std::log(1 / a);
            const double closed = (std::sqrt(1 + s * s) - std::sqrt(a * a + s * s) -
                                   s * (log + std::asinh(s) - std::asinh(s / a))) /
                                  (2 * s * log);
            EXPECT_NEAR(GTR<double>(a, 1).lambda(with_slope(s)) / closed, 1, 2e-9);
        }
}

// Integral over normals by slopes r (ax cos, ay sin): log r covers the scales of long tails.
template <class F>
double over_normals(double alpha_x, double alpha_y, const F& f)
{
    constexpr int turns = 256;
    constexpr double lo = -9, hi = 16, step = 0.04;
    double sum = 0;
    for (double y = lo; y < hi; y += step)
        for (int j = 0; j < turns; ++j)
        {
            const double r = std::exp(y), phi = 2 * pi * (j + 0.5) / turns;
            const double p = alpha_x * r * std::cos(phi), q = alpha_y * r * std::sin(phi);
            const double z = 1 / std::sqrt(1 + p * p + q * q);
            sum += r * r * z * z * z * f(Vec3<double>(p * z, q * z, z));
        }
    return sum * step * (2 * pi / turns) * alpha_x * alpha_y;
}

TEST(Gtr, stretched_normals_integrate_to_one_and_to_the_area)
{
    for (double gamma : {0.3, 1.0, 2.5, 10.0})
    {
        const GTR<double> gtr(0.5, 0.1, gamma);
        EXPECT_NEAR(over_normals(0.5, 0.1, [&](const auto& m) { return gtr.D(m) * m.z; }), 1, 1e-6);
        for (double mu : {-0.2, 0.02, 0.6})
        {
            const auto wo = direction<double>(mu, 0.7);
            const double visible = over_normals(
                0.5, 0.1, [&](const auto& m) { return std::max(0.0, wo.dot(m)) * gtr.D(m); });
            EXPECT_NEAR(gtr.projected_area(wo) / visible, 1, mu < 0 ? 1e-3 : 1e-4);
        }
    }
}

// Chi-squared over slopes: log of their length after unstretching, and azimuth.
struct SampledCase
{
    double alpha_x, alpha_y, gamma, mu, azimuth;
};
constexpr SampledCase sampled_cases[] = {
    {0.1, 0.1, 1, 0.5, 0},       {0.01, 0.01, 1, 0.9, 2},    {0.3, 0.1, 0.5, 0.1, 0.7},
    {0.05, 0.2, 1.7, -0.2, 1.1}, {0.02, 0.02, 0.05, 0.3, 0}, {0.4, 0.4, 2, 0.3, 0.3},
    {0.4, 0.4, 2.5, 0.3, 0.3},   {0.2, 0.1, 4, 0.05, 2.5},   {0.3, 0.3, 5.5, -0.1, 0.2},
    {1, 0.5, 10, 0.7, 1.9},      {0.1, 0.1, 3.5, -0.5, 4.0}, {0.3, 0.3, 9.7, 0.02, 0.1},
    {0.003, 0.003, 2, -0.5, 1},  {0.01, 0.01, 1.5, -0.95, 1}};

class SlopeHistogram
{
public:
    static constexpr int rings = 14, sectors = 10, cells = rings * sectors;

    explicit SlopeHistogram(const SampledCase& c)
        : _alpha(std::sqrt(c.alpha_x * c.alpha_y)),
          _x(c.alpha_x / _alpha),
          _y(c.alpha_y / _alpha),
          _expected(cells),
          _counts(cells)
    {
        const Vec3<double> wo = direction<double>(c.mu, c.azimuth);
        constexpr int fine = 24;
        double total = 0;
        for (int i = 0; i < cells; ++i)
        {
            // Open rings at both ends: there is nothing to speak of beyond these.
            const int ring = i / sectors;
            const double from = ring == 0 ? lo() - 6 : edge(ring),
                         to = ring == rings - 1 ? edge(rings) + 12 : edge(ring + 1);
            for (int j = 0; j < fine * fine; ++j)
            {
                const double y = from + (to - from) * (j / fine + 0.5) / fine, r = std::exp(y);
                const double phi = 2 * pi * (i % sectors + (j % fine + 0.5) / fine) / sectors;
                const double lit =
                    wo.z + r * (wo.x * _x * std::cos(phi) + wo.y * _y * std::sin(phi));
                _expected[std::size_t(i)] += std::max(0.0, lit) * r * r * (to - from) *
                                             slope_density(_alpha, c.gamma, r * r);
            }
            total += _expected[std::size_t(i)];
        }
        for (double& e : _expected) e /= total;
    }

    void add(const Vec3<double>& m)
    {
        const double p = m.x / (m.z * _x), q = m.y / (m.z * _y);
        const double y = 0.5 * std::log(p * p + q * q), phi = std::atan2(q, p);
        const int ring = int(std::floor((y - lo()) / width()));
        const int sector = int(std::floor((phi < 0 ? phi + 2 * pi : phi) / (2 * pi) * sectors));
        ++_counts[std::size_t(std::min(std::max(ring, 0), rings - 1) * sectors +
                              std::min(sector, sectors - 1))];
        ++_n;
    }

    // Standard deviations by which chi-squared exceeds what it should be (Wilson and Hilferty).
    double excess() const
    {
        double chi2 = 0, rest_expected = 0, rest = 0;
        int freedom = -1;
        const auto pool = [&](double expected, double count) {
            chi2 += (count - expected) * (count - expected) / expected;
            ++freedom;
        };
        for (std::size_t i = 0; i < _counts.size(); ++i)
        {
            const double expected = _expected[i] * _n;
            if (expected > 20)
                pool(expected, _counts[i]);
            else
            {
                rest_expected += expected;
                rest += _counts[i];
            }
        }
        if (rest_expected > 1)
            pool(rest_expected, rest);
        else
            EXPECT_LT(rest, 12) << "expected " << rest_expected;
        const double k = 2.0 / (9 * freedom);
        return (std::cbrt(chi2 / freedom) - (1 - k)) / std::sqrt(k);
    }

private:
    double lo() const { return std::log(_alpha) - 2; }
    double width() const { return (2 - lo()) / rings; }
    double edge(int ring) const { return lo() + width() * ring; }

    double _alpha, _x, _y;
    std::vector<double> _expected, _counts;
    double _n = 0;
};

template <class Real>
void expect_visible_normals(int n, std::uint64_t seed)
{
    const double backlit = std::is_same_v<Real, double> ? -1e-6 : -2e-3;
    Random random(seed);
    for (const SampledCase& c : sampled_cases)
    {
        SlopeHistogram histogram(c);
        const GTR<Real> gtr(Real(float(c.alpha_x)), Real(float(c.alpha_y)), Real(float(c.gamma)));
        const Vec3<double> wo = direction<double>(c.mu, c.azimuth);
        const auto visible =
            gtr.visible(Vec3<Real>(Real(float(wo.x)), Real(float(wo.y)), Real(float(wo.z))));
        const auto check = [&](const Vec3<double>& m) {
            EXPECT_NEAR(m.length(), 1, 1e-6);
            EXPECT_GT(m.z, 0);
            // GGX's sampler adds two unit vectors; where they are opposed, floats keep few digits.
            EXPECT_GE(m.dot(wo), backlit);
            histogram.add(m);
        };
        if constexpr (std::is_floating_point_v<Real>)
            for (int i = 0; i < n; ++i)
            {
                const Vec2<Real> u = random.square<Real>();
                check(Vec3<double>(visible.sample({u.x, u.y, random.unit<Real>()})));
            }
        else
            for (int i = 0; i < n; i += int(Batch::size))
            {
                alignas(64) float u[3][Batch::size];
                for (auto& row : u)
                    for (float& x : row) x = random.unit<float>();
                const auto m = visible.sample({Batch::load_aligned(u[0]), Batch::load_aligned(u[1]),
                                               Batch::load_aligned(u[2])});
                m.x.store_aligned(u[0]);
                m.y.store_aligned(u[1]);
                m.z.store_aligned(u[2]);
                for (std::size_t l = 0; l < Batch::size; ++l)
                    check(Vec3<double>(double(u[0][l]), double(u[1][l]), double(u[2][l])));
            }
        EXPECT_LT(histogram.excess(), 4.5) << "alpha " << c.alpha_x << " " << c.alpha_y
                                           << ", gamma " << c.gamma << ", mu " << c.mu;
    }
}

TEST(Gtr, sampled_normals_are_the_visible_ones_in_double)
{
    expect_visible_normals<double>(100000, 1);
}
TEST(Gtr, sampled_normals_are_the_visible_ones_in_float)
{
    expect_visible_normals<float>(100000, 2);
}
TEST(Gtr, sampled_normals_are_the_visible_ones_in_vectors)
{
    expect_visible_normals<Batch>(100000, 3);
}

TEST(Gtr, a_vector_of_floats_answers_as_a_float_does)
{
    Random random(4);
    int different = 0, samples = 0;
    for (int i = 0; i < 3000; ++i)
    {
        alignas(64) float in[9][Batch::size], out[6][Batch::size];
        const double all_gammas[] = {0.05, 0.7, 1, 1.9, 2, 2.5, 4, 6.3, 10};
        for (std::size_t l = 0; l < Batch::size; ++l)
        {
            in[0][l] = float(std::pow(random.unit(), 2));
            in[1][l] = i % 2 ? in[0][l] : float(random.unit());
            in[2][l] = float(all_gammas[random.bits() % 9]);
            const auto w = direction<float>(2 * random.unit() - 1, 7 * random.unit());
            in[3][l] = w.x;
            in[4][l] = w.y;
            in[5][l] = w.z;
            for (int k = 6; k < 9; ++k) in[k][l] = random.unit<float>();
        }
        Batch b[9];
        for (int k = 0; k < 9; ++k) b[k] = Batch::load_aligned(in[k]);
        const GTR<Batch> gtr(b[0], b[1], b[2]);
        const Vec3<Batch> w(b[3], b[4], b[5]);
        const auto m = gtr.visible(w).sample({b[6], b[7], b[8]});
        m.x.store_aligned(out[0]);
        m.y.store_aligned(out[1]);
        m.z.store_aligned(out[2]);
        gtr.D(w).store_aligned(out[3]);
        gtr.projected_area(w).store_aligned(out[4]);
        gtr.tail().store_aligned(out[5]);
        for (std::size_t l = 0; l < Batch::size; ++l)
        {
            const GTR<float> one(in[0][l], in[1][l], in[2][l]);
            const Vec3<float> v(in[3][l], in[4][l], in[5][l]);
            const auto n = one.visible(v).sample({in[6][l], in[7][l], in[8][l]});
            // Where a number is within rounding of where one term of the mixture ends and the next
            // begins, or a try is kept or not, the two may differ.
            different += (Vec3<float>(out[0][l], out[1][l], out[2][l]) - n).length() > 1e-3f;
            ++samples;
            EXPECT_NEAR(out[3][l] / one.D(v), 1, 1e-4);
            EXPECT_NEAR(out[5][l], one.tail(), 1e-6);
            if (one.projected_area(v) < 1e-30f) continue;
            EXPECT_NEAR(out[4][l] / one.projected_area(v), 1, 2e-5);
        }
    }
    EXPECT_LT(different, samples / 1000);
}

template <class Real>
using White = MicrofacetReflection<GTR<Real>, ConstantFresnel<Real>>;

// Cosine averages of the albedo at F = 1, gamma = 1, height-correlated: quadrature over outgoing
// directions and over micronormals, with a numeric Lambda, by code written for that alone.
TEST(Gtr, average_albedo_is_that_of_independent_quadratures)
{
    const auto rule = luts::gauss_legendre(12);
    const double known[][2] = {{0.1, 0.76542}, {0.25, 0.66723}, {0.5, 0.55339}, {1, 0.40914}};
    for (const auto& row : known)
    {
        const White<double> lobe(GTR<double>(row[0], 1), ConstantFresnel<double>());
        double sum = 0;
        for (std::size_t i = 0; i < rule.x.size(); ++i)
        {
            // mu = x^2: the albedo changes fastest at grazing angles.
            const double mu = rule.x[i] * rule.x[i];
            const auto prepared = lobe.prepare(direction<double>(mu));
            sum +=
                rule.weight[i] * 4 * mu * rule.x[i] *
                integrate_reflections(direction<double>(mu), row[0], row[0], 40,
                                      [&](const Vec3<double>& wi) { return prepared.eval(wi).x; });
        }
        EXPECT_NEAR(sum, row[1], 3e-5) << "alpha " << row[0];
    }
}

TEST(Gtr, albedo_is_continuous_in_gamma_and_that_of_ggx_at_two)
{
    for (double alpha : {0.1, 0.6})
        for (double mu : {0.1, 0.8})
        {
            const auto wo = direction<double>(mu);
            const auto albedo = [&](const auto& distribution) {
                const MicrofacetReflection<std::decay_t<decltype(distribution)>,
                                           ConstantFresnel<double>>
                    lobe(distribution, ConstantFresnel<double>());
                const auto prepared = lobe.prepare(wo);
                return integrate_reflections(wo, alpha, alpha, 40, [&](const Vec3<double>& wi) {
                    return prepared.eval(wi).x;
                });
            };
            EXPECT_NEAR(albedo(GTR<double>(alpha, 2)), albedo(GGX<double>(alpha)), 1e-10);
            for (double gamma : {1.0, 2.0})
                for (double step : {-1e-7, 1e-7})
                    EXPECT_NEAR(albedo(GTR<double>(alpha, gamma + step)),
                                albedo(GTR<double>(alpha, gamma)), 2e-7);
        }
}

TEST(Gtr, samples_of_a_lobe_return_its_integral)
{
    Random random(5);
    for (double gamma : {0.7, 1.0, 3.5})
        for (double mu : {0.05, 0.6})
        {
            const auto wo = direction<double>(mu, 0.4);
            const White<double> lobe(GTR<double>(0.3, 0.15, gamma), ConstantFresnel<double>());
            const auto prepared = lobe.prepare(wo);
            const White<float> single(GTR<float>(0.3f, 0.15f, float(gamma)),
                                      ConstantFresnel<float>());
            const auto prepared_single = single.prepare(Vec3<float>(wo));
            constexpr int n = 100000;
            double sum = 0, square = 0, hits = 0;
            for (int i = 0; i < n; ++i)
            {
                const Vec2<float> u = random.square<float>();
                const auto s = prepared_single.sample({u.x, u.y, random.unit<float>()});
                sum += double(s.weight.x);
                square += double(s.weight.x) * double(s.weight.x);
                hits += s.valid;
            }
            const double mean = sum / n, spread = std::sqrt((square / n - mean * mean) / n);
            const auto integral = [&](const auto& f) {
                return integrate_reflections(wo, 0.3, 0.15, 64, f);
            };
            EXPECT_NEAR(mean, integral([&](const Vec3<double>& w) { return prepared.eval(w).x; }),
                        4.5 * spread + 1e-4);
            const double p = hits / n;
            EXPECT_NEAR(p, integral([&](const Vec3<double>& w) { return prepared.pdf(w); }),
                        4.5 * std::sqrt(p * (1 - p) / n) + 1e-4);
        }
}

template <class Real>
void expect_finite(int n)
{
    using Limits = std::numeric_limits<Real>;
    const Real parameters[] = {Real(0),
                               -Real(0),
                               Real(1),
                               Real(2),
                               Real(10),
                               Real(-5),
                               Limits::max(),
                               Limits::infinity(),
                               Limits::min(),
                               Limits::quiet_NaN(),
                               Limits::denorm_min(),
                               Real(1e-9),
                               Real(1e-5),
                               Real(1) - Limits::epsilon(),
                               Real(2) + 2 * Limits::epsilon(),
                               Real(3)};
    const Real numbers[] = {Real(0),   Limits::denorm_min(),
                            Real(0.5), Real(1) - Limits::epsilon() / 2,
                            Real(1),   Limits::quiet_NaN()};
    Random random(6);
    const auto parameter = [&](double scale) {
        const auto pick = random.bits() % 32;
        return pick < 16 ? parameters[pick] : Real(scale * random.unit());
    };
    const auto number = [&] {
        const auto pick = random.bits() % 12;
        return pick < 6 ? numbers[pick] : random.unit<Real>();
    };
    feenableexcept(FE_INVALID | FE_DIVBYZERO);
    long failures = 0;
    for (int i = 0; i < n; ++i)
    {
        const GTR<Real> gtr(parameter(1), parameter(1), parameter(10));
        const double mu = random.bits() % 2
                              ? 2 * random.unit() - 1
                              : std::ldexp(random.unit() - 0.5, -int(random.bits() % 40));
        Vec3<Real> w = direction<Real>(mu, 7 * random.unit());
        if (i % 16 == 0) w = {Real(0), Real(0), i % 32 ? Real(1) : Real(-1)};
        if (i % 16 == 1) w = {Real(0), Real(-1), Real(0)};
        const auto visible = gtr.visible(w);
        const Real x = number(), y = number();
        const Vec3<Real> m = visible.sample({x, y, number()});
        const Real answers[] = {gtr.D(m),
                                gtr.projected_area(w),
                                visible.projected_area(),
                                visible.reflected_density(),
                                gtr.gamma(),
                                gtr.tail(),
                                w.z > Real(1e-12) ? gtr.lambda(w) : Real(0),
                                w.z > Real(1e-12) ? gtr.G2(w, m) : Real(0)};
        bool good = std::abs(m.length() - 1) < Real(2e-6) && m.z > 0;
        for (Real answer : answers) good = good && std::isfinite(answer) && answer >= 0;

        const White<Real> lobe(gtr, ConstantFresnel<Real>());
        const auto prepared = lobe.prepare(w);
        const auto s = prepared.sample({x, y, number()});
        good = good && std::isfinite(s.weight.x) && s.weight.x >= 0 && std::isfinite(s.pdf) &&
               s.pdf >= 0 && (!s.valid || s.pdf > 0) && std::isfinite(prepared.eval(m).x);
        if (!good && failures++ < 5)
            ADD_FAILURE() << "alpha " << gtr.alpha_x() << " " << gtr.alpha_y() << ", gamma "
                          << gtr.gamma() << ", w " << w << ", m " << m << ", area "
                          << gtr.projected_area(w) << ", weight " << s.weight.x << ", pdf "
                          << s.pdf;
    }
    feclearexcept(FE_ALL_EXCEPT);
    fedisableexcept(FE_INVALID | FE_DIVBYZERO);
    EXPECT_EQ(failures, 0);
}

TEST(Gtr, answers_are_finite_whatever_comes_in)
{
    expect_finite<float>(100000);
    expect_finite<double>(30000);
}

}  // namespace
