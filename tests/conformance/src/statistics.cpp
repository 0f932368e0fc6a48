// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "statistics.h"

#include <algorithm>
#include <cmath>

REGAIN_NAMESPACE_BEGIN
namespace conformance {
namespace {

constexpr double tiny = 1e-300, precise = 1e-15;
constexpr int most_terms = 10000;

// Lentz's evaluation of b0 + a1 / (b1 + a2 / (b2 + ...)) (Press et al., Numerical Recipes, 5.2).
template <class Term>
double continued_fraction(double b0, const Term& term)
{
    const auto off_zero = [](double x) { return std::abs(x) < tiny ? tiny : x; };
    double f = off_zero(b0), c = f, d = 0;
    for (int i = 1; i < most_terms; ++i)
    {
        const auto [a, b] = term(i);
        d = 1 / off_zero(b + a * d);
        c = off_zero(b + a / c);
        f *= c * d;
        if (std::abs(c * d - 1) < precise) break;
    }
    return f;
}

struct Term
{
    double a, b;
};

// Abramowitz and Stegun 6.5.29 and 6.5.31.
double upper_gamma(double a, double x)
{
    if (x <= 0) return 1;
    const double scale = std::exp(a * std::log(x) - x - std::lgamma(a));
    if (x < a + 1)
    {
        double sum = 1 / a, term = sum;
        for (int n = 1; n < most_terms && term > sum * precise; ++n) sum += term *= x / (a + n);
        return std::max(0.0, 1 - scale * sum);
    }
    return scale / continued_fraction(x + 1 - a, [&](int i) {
               return Term{-i * (i - a), x + 2 * i + 1 - a};
           });
}

// 26.5.8.
double incomplete_beta(double a, double b, double x)
{
    if (x <= 0) return 0;
    if (x >= 1) return 1;
    if (x > (a + 1) / (a + b + 2)) return 1 - incomplete_beta(b, a, 1 - x);
    const double scale = std::exp(a * std::log(x) + b * std::log1p(-x) + std::lgamma(a + b) -
                                  std::lgamma(a) - std::lgamma(b));
    return scale / a / continued_fraction(1, [&](int i) {
               const int m = i / 2;
               const double d = i % 2 ? -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))
                                      : m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
               return Term{d, 1};
           });
}

}  // namespace

double chi_squared_tail(double x, double degrees) { return upper_gamma(degrees / 2, x / 2); }

double student_tail(double t, double degrees)
{
    return incomplete_beta(degrees / 2, 0.5, degrees / (degrees + t * t));
}

// P(N >= n) = P(n, expected), the lower gamma function.
double count_tail(double found, double expected)
{
    return found > 0 ? 1 - upper_gamma(found, expected) : 1;
}

double sidak_level(double family, std::size_t tests)
{
    return tests > 0 ? -std::expm1(std::log1p(-family) / static_cast<double>(tests)) : family;
}

double RunningMean::standard_error() const
{
    return _n > 1 ? std::sqrt(variance() / static_cast<double>(_n)) : 0;
}

double tail_beyond(const RunningMean& mean, double expected, double bound)
{
    const double beyond = std::abs(mean.mean() - expected) - bound;
    if (!(beyond > 0)) return std::isnan(beyond) ? 0 : 1;
    const double error = mean.standard_error();
    return error > 0 ? student_tail(beyond / error, static_cast<double>(mean.count() - 1)) : 0;
}

}  // namespace conformance
REGAIN_NAMESPACE_END
