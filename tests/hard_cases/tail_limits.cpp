// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The tail parameter gamma of GTR and STD at the ends of its range, beyond them, and through the
// places where a formula has 0 / 0: GTR at 1 and 2. A renderer meets them where gamma is a slider.

#include "questions.h"

#include <regain/closures/beckmann.h>
#include <regain/closures/ggx.h>
#include <regain/closures/gtr.h>
#include <regain/closures/std.h>

#include <gtest/gtest.h>

using namespace regain;
using namespace regain::tests;

namespace {

template <class Real>
class TailLimits : public testing::Test
{};
TYPED_TEST_SUITE(TailLimits, Numbers, NumberNames);

const Member gamma_member = [](Parameters& s) -> double& { return s.gamma; };

template <class Real>
auto with_distribution(const char* distribution)
{
    return [=](const Kind<Real>& kind) { return kind.distribution == distribution; };
}

// Sliders go beyond what a law allows: the nearest there is.
TYPED_TEST(TailLimits, gammas_beyond_the_range_of_gtr_are_its_ends)
{
    expect_taken_for<TypeParam>(
        with_distribution<TypeParam>("gtr"), gamma_member, "gamma",
        {{0, 1e-3}, {-0.0, 1e-3}, {-5, 1e-3}, {1e-30, 1e-3}, {11, 10}, {1e30, 10}});
}
TYPED_TEST(TailLimits, gammas_beyond_the_range_of_std_are_its_ends)
{
    expect_taken_for<TypeParam>(
        with_distribution<TypeParam>("std"), gamma_member, "gamma",
        {{1.5, 1.51}, {1, 1.51}, {0, 1.51}, {-5, 1.51}, {101, 100}, {1e30, 100}});
}
TYPED_TEST(TailLimits, a_gamma_that_is_no_number_is_2)
{
    REGAIN_NEEDS_INFINITIES();
    expect_taken_for<TypeParam>(with_distribution<TypeParam>("gtr"), gamma_member, "gamma",
                                {{tests::nan, 2}, {infinity, 10}, {-infinity, 1e-3}});
    expect_taken_for<TypeParam>(with_distribution<TypeParam>("std"), gamma_member, "gamma",
                                {{tests::nan, 2}, {infinity, 100}, {-infinity, 1.51}});
}

template <class Real>
void expect_same_surface(Real a, Real b, double tolerance, const char* what, double mu)
{
    // Straight from below GGX sees nothing, and the others no more than 1e-15.
    EXPECT_NEAR(a, b, tolerance * std::abs(double(b)) + 1e-15) << what << " at " << mu;
}

// D and the projected area of two distributions, over all normals and directions.
template <class A, class B>
void expect_same_law(const A& a, const B& b, double tolerance)
{
    using Real = typename A::Real;
    for (double mu : {1.0, 0.9999, 0.99, 0.5, 1e-2, 1e-4})
    {
        const auto w = towards<Real>(mu, 0.9);
        expect_same_surface(a.D(w), b.D(w), tolerance, "D", mu);
        expect_same_surface(a.projected_area(w), b.projected_area(w), tolerance, "area", mu);
        expect_same_surface(a.projected_area(-w), b.projected_area(-w), 100 * tolerance,
                            "area from below", mu);
    }
}

// At 1 Burley's normalisation is a quotient of zeros; the law has no gap there.
TYPED_TEST(TailLimits, gtr_passes_through_gamma_1_without_a_gap)
{
    using Real = TypeParam;
    const Real step = Real(4 * double(std::numeric_limits<Real>::epsilon()));
    for (double alpha : {1e-3, 0.1, 0.5, 1.0})
        for (double ratio : {1.0, 0.3})
        {
            const WhileLibraryRuns guard;
            const Real x = Real(alpha), y = Real(alpha * ratio);
            const GTR<Real> at(x, y, Real(1));
            // D goes with alpha^(2 - 2 gamma): a step of gamma is worth its logarithm.
            const double tolerance = 1e3 * double(step) + 1e-5 * (sizeof(Real) == 4) + 4e-9;
            expect_same_law(GTR<Real>(x, y, Real(1) - step), at, tolerance);
            expect_same_law(GTR<Real>(x, y, Real(1) + step), at, tolerance);
            // Burley 2012: (a2 - 1) / (pi ln a2 (1 + (a2 - 1) cos^2)), at cos 1.
            const double a2 = double(x) * double(y);
            const double D = a2 == 1 ? 1 / double(pi) : (a2 - 1) / (double(pi) * std::log(a2)) / a2;
            EXPECT_NEAR(at.D({0, 0, 1}), D, 20 * rounding<Real> * D);
        }
}

// At 2 it is GGX, with the same albedo as the tables of GGX say; so is STD.
TYPED_TEST(TailLimits, at_gamma_2_both_tails_are_ggx)
{
    using Real = TypeParam;
    for (double alpha : {1e-3, 0.1, 0.5, 1.0})
        for (double ratio : {1.0, 0.3})
        {
            const WhileLibraryRuns guard;
            const Real x = Real(alpha), y = Real(alpha * ratio);
            const GGX<Real> ggx(x, y);
            // The area of GTR is a sum: see gtr.h.
            const double of_sums = sizeof(Real) == 4 ? 1e-5 : 2e-9;
            expect_same_law(GTR<Real>(x, y, Real(2)), ggx, of_sums);
            expect_same_law(STD<Real>(x, y, Real(2)), ggx, sizeof(Real) == 4 ? 1e-5 : 1e-11);
        }
}
TYPED_TEST(TailLimits, gtr_passes_through_gamma_2_without_a_gap)
{
    using Real = TypeParam;
    const Real step = Real(8 * double(std::numeric_limits<Real>::epsilon()));
    for (double alpha : {1e-3, 0.1, 0.5, 1.0})
    {
        const WhileLibraryRuns guard;
        const GTR<Real> at(Real(alpha), Real(2));
        const double tolerance = sizeof(Real) == 4 ? 1e-4 : 5e-9;
        expect_same_law(GTR<Real>(Real(alpha), Real(2) - step), at, tolerance);
        expect_same_law(GTR<Real>(Real(alpha), Real(2) + step), at, tolerance);
    }
}

// The normals make up the surface, seen from above: int D cos = 1, at the ends of gamma as well.
// Over rho = tan^2 theta: int pi D (1 + rho)^-2 drho.
TEST(TailEnds, the_normals_add_up_to_the_surface)
{
    const auto sum = [](const auto& distribution) {
        double total = 0;
        constexpr int n = 40000;
        constexpr double low = -40, high = 60;  // of ln rho
        for (int i = 0; i < n; ++i)
        {
            const double rho = std::exp(low + (high - low) * (i + 0.5) / n);
            const double z = 1 / std::sqrt(1 + rho), s = std::sqrt(rho) * z;
            if (z < 1e-11) break;
            total += double(pi) * distribution.D({s, 0, z}) * rho / ((1 + rho) * (1 + rho)) *
                     (high - low) / n;
        }
        return total;
    };
    for (double alpha : {1e-3, 0.3, 1.0})
    {
        for (double gamma : {gtr_min_gamma, 0.5, 1.0, 1.5, 2.0, 4.0, gtr_max_gamma})
            EXPECT_NEAR(sum(GTR<double>(alpha, gamma)), 1, 1e-6) << alpha << " " << gamma;
        for (double gamma : {std_min_gamma, 2.0, 10.0, std_max_gamma})
            EXPECT_NEAR(sum(STD<double>(alpha, gamma)), 1, 1e-6) << alpha << " " << gamma;
    }
}

// Without tails STD is Beckmann: (1 + t^2 / (gamma - 1))^-gamma goes to exp(-t^2), off by t^4 / 2
// over gamma.
TEST(TailEnds, std_at_its_largest_gamma_is_nearly_beckmann)
{
    for (double alpha : {1e-2, 0.3, 1.0})
    {
        const STD<double> heavy(alpha, std_max_gamma);
        const Beckmann<double> gaussian(alpha);
        for (double t : {0.0, 0.5, 1.0, 1.5})
        {
            const double slope = t * alpha, z = 1 / std::sqrt(1 + slope * slope);
            const Vec3<double> m(slope * z, 0, z);
            EXPECT_NEAR(heavy.D(m) / gaussian.D(m), 1, 5e-2) << alpha << " " << t;
        }
        const auto w = towards<double>(0.5);
        EXPECT_NEAR(heavy.projected_area(w), gaussian.projected_area(w), 4e-3);
    }
}

// Samples at the ends, where tails reach the horizon: what is drawn is evaluated to be there.
TYPED_TEST(TailLimits, at_both_ends_weights_are_F_G2_over_G1)
{
    using Real = TypeParam;
    const auto wanted = [](const Kind<Real>& kind) {
        return kind.has_tail() && kind.is_mirror() && kind.is_bare();
    };
    for_each_kind<Real>(wanted, [](const auto& kind) {
        const bool gtr = kind.distribution == "gtr";
        for (double gamma :
             {gtr ? gtr_min_gamma : std_min_gamma, gtr ? gtr_max_gamma : std_max_gamma})
            for (double alpha : {1e-3, 0.3, 1.0})
            {
                Parameters parameters = Parameters::isotropic(alpha);
                parameters.gamma = gamma;
                const auto subject = kind.make(parameters);
                for (double mu : {1e-4, 0.1, 0.9})
                    for (double u : {0.05, 0.5, 0.95})
                    {
                        const auto wo = towards<Real>(mu);
                        const auto s = subject->sample(wo, {Real(u), Real(1 - u), Real(0.4)});
                        if (!s.valid) continue;
                        expect_same_pdf(s.pdf, subject->pdf(wo, s.wi));
                        const double cosine =
                            std::min(double((exactly(wo) + exactly(s.wi)).length()) / 2, 1.0);
                        const auto F = facet_reflectance(kind, parameters, 1, cosine);
                        for (int c = 0; c < 3; ++c)
                        {
                            EXPECT_LE(s.weight[c], F[c] * (1 + 100 * rounding<Real>));
                            EXPECT_NEAR(s.weight[c] * F[0], s.weight[0] * F[c],
                                        100 * rounding<Real>);
                        }
                    }
            }
    });
}

}  // namespace
