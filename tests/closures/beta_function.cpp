// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// B(1 + a, 1 + b) against identities and the C library, in every number type.

#include <regain/closures/beta_function.h>
#include <regain/closures/xsimd.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace regain;

namespace {

constexpr double arguments[] = {0,  1e-9, 1e-3, 0.1, 0.5, 1,    2.5, 6,
                                20, 100,  1e3,  1e6, 1e9, 1e12, 1e15};

// In extended precision, which leaves 1e-13 where the arguments are below 1e3.
long double reference(double a, double b)
{
    return std::exp(std::lgamma(1.0L + a) + std::lgamma(1.0L + b) - std::lgamma(2.0L + a + b));
}

TEST(BetaFunction, agrees_with_the_gamma_function)
{
    for (double a : arguments)
        for (double b : arguments)
        {
            if (a > 1e3 || b > 1e3) continue;
            const long double B = reference(a, b);
            const double bits = 3 - double(std::log(B));
            if (B < 1e-300L) continue;
            EXPECT_LT(std::abs(double(beta_function(a, b) / B - 1)), 1e-12) << a << ", " << b;
            const long double Bf = reference(double(float(a)), double(float(b)));
            if (Bf < 1e-35L) continue;
            EXPECT_LT(std::abs(double(beta_function(float(a), float(b)) / Bf - 1)), 1.5e-7 * bits)
                << a << ", " << b;
        }
}

TEST(BetaFunction, is_a_simple_quotient_where_one_argument_is_an_integer)
{
    for (double a : arguments)
    {
        EXPECT_NEAR(beta_function(a, 0.0) * (1 + a), 1, 1e-13) << a;
        EXPECT_NEAR(beta_function(1.0, a) * ((1 + a) * (2 + a)), 1, 1e-12) << a;
        const float f = float(a);
        EXPECT_NEAR(double(beta_function(f, 0.0f)) * (1 + double(f)), 1, 6e-7) << a;
        EXPECT_NEAR(double(beta_quotient(f, 0.0f)), 1, 6e-7) << a;
        if (a > 1e12) continue;
        EXPECT_NEAR(double(beta_function(0.5f, f)) / beta_function(0.5, double(f)), 1, 2e-6);
    }
}

TEST(BetaFunction, neither_overflows_nor_exceeds_one)
{
    for (double a : {0.0, 1.0, 1e6, 1e12, 1e20, 1e30})
        for (double b : {0.0, 1.0, 1e6, 1e12, 1e20, 1e30})
        {
            for (double value : {double(beta_function(float(a), float(b))), beta_function(a, b),
                                 double(beta_quotient(float(a), float(b))), beta_quotient(a, b)})
                EXPECT_TRUE(value >= 0 && value <= 1 + 1e-6) << a << ", " << b << ": " << value;
            EXPECT_EQ(beta_function(a, b), beta_function(b, a));
        }
}

// At grazing angles a -> infinity with b fixed, (1 + a) B -> Gamma(1 + b) a^-b.
TEST(BetaFunction, quotient_keeps_its_power_law_at_grazing)
{
    for (double b : {0.01, 0.2, 0.5, 1.3})
        for (double a : {1e8, 1e10, 1e12})
        {
            const double expected = std::tgamma(1 + b) * std::pow(a, -b);
            EXPECT_NEAR(beta_quotient(a, b) / expected, 1, 1e-7);
            EXPECT_NEAR(beta_quotient(float(a), float(b)) / expected, 1, 1e-5);
        }
}

TEST(BetaFunction, answers_a_vector_as_it_answers_a_float)
{
    using Batch = xsimd::batch<float>;
    for (double a : arguments)
        for (double b : arguments)
        {
            alignas(64) float value[Batch::size];
            beta_quotient(Batch(float(a)), Batch(float(b))).store_aligned(value);
            const float scalar = beta_quotient(float(a), float(b));
            if (scalar < 1e-20f) continue;
            EXPECT_NEAR(value[0] / scalar, 1, 1e-5) << a << ", " << b;
        }
}

}  // namespace
