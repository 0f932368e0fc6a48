// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What every distribution of normals promises, checked against sums over its density.

#pragma once

#include "closures.h"

#include <regain/luts/quadrature.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace regain::tests {

/// Integral over unit normals m, by slopes stretched by the widths: dm = m_z^3 dp dq.
template <class F>
double over_normals(double alpha_x, double alpha_y, const F& f)
{
    const auto rule = luts::gauss_legendre(64);
    const double pi = std::acos(-1.0);
    constexpr int turns = 256;
    double sum = 0;
    for (std::size_t i = 0; i < rule.x.size(); ++i)
        for (int j = 0; j < turns; ++j)
        {
            // rho = x / (1 - x) reaches every slope.
            const double x = rule.x[i], rho = x / (1 - x), phi = 2 * pi * (j + 0.5) / turns;
            const double p = alpha_x * rho * std::cos(phi), q = alpha_y * rho * std::sin(phi);
            const double z = 1 / std::sqrt(1 + p * p + q * q);
            sum += rule.weight[i] * (2 * pi / turns) * alpha_x * alpha_y * rho /
                   ((1 - x) * (1 - x)) * z * z * z * f(Vec3<double>(p * z, q * z, z));
        }
    return sum;
}

/// The number in one lane.
inline double lane(float x, std::size_t) { return x; }
inline double lane(double x, std::size_t) { return x; }
template <class Batch>
double lane(const Batch& x, std::size_t i)
{
    return x.get(i);
}
template <class Real>
constexpr std::size_t lane_count()
{
    if constexpr (std::is_floating_point_v<Real>)
        return 1;
    else
        return Real::size;
}

/// How well sampled visible normals follow max(0, wo.m) D(m) / sigma(wo): a chi-squared test over
/// cells in the slopes along and across wo, as a deviate of the normal distribution (Wilson and
/// Hilferty 1931). `exact` is the distribution in double; `distribution` of any number type.
template <class Exact, class Distribution>
double deviate_of_samples(const Exact& exact, const Distribution& distribution,
                          const Vec3<double>& wo, int samples, std::uint64_t seed)
{
    using Real = typename Distribution::Real;
    constexpr int columns = 8, rows = 6;
    static const auto rule = luts::gauss_legendre(16);

    const double ax = exact.alpha_x(), ay = exact.alpha_y();
    const double s = std::hypot(ax * wo.x, ay * wo.y), cosine = ax * wo.x / s, sine = ay * wo.y / s;
    const double edge = -wo.z / s;
    // Slopes along wo begin where normals become visible, unless that is far away.
    const bool whole = edge < -3;

    struct Slopes
    {
        double along, across;
    };
    const auto slopes_of = [&](double mx, double my, double mz) {
        const double p = mx / mz / ax, q = my / mz / ay;
        return Slopes{p * cosine + q * sine - (whole ? 0 : edge), q * cosine - p * sine};
    };

    // The scales of the cells: medians of a few samples. Where tails are so long that most samples
    // are far out, the cells look at where they are not.
    Random random(seed);
    std::vector<double> along, across;
    for (int i = 0; i < 101; ++i)
    {
        const Vec3<double> m =
            exact.visible(wo).sample({random.unit(), random.unit(), random.unit()});
        along.push_back(std::abs(slopes_of(m.x, m.y, m.z).along));
        across.push_back(std::abs(slopes_of(m.x, m.y, m.z).across));
    }
    std::sort(along.begin(), along.end());
    std::sort(across.begin(), across.end());
    const double longest = 3 * std::max(1.0, edge);
    const double scale_along = std::min(along[50], longest),
                 scale_across = std::min(across[50], longest);

    // A cell is a rectangle of [0, 1]^2; t / (1 + |t|) takes all slopes to [-1, 1].
    const auto unbounded = [](double t) { return t / (1 - std::abs(t)); };
    const auto derivative = [](double t) { return 1 / ((1 - std::abs(t)) * (1 - std::abs(t))); };
    const auto bounded = [](double t) { return t / (1 + std::abs(t)); };
    const double sigma = exact.projected_area(wo);
    std::vector<double> expected(columns * rows + 1, 0), found(columns * rows + 1, 0);
    double rest = 1;
    for (int column = 0; column + 1 < columns; ++column)
        for (int row = 0; row < rows; ++row)
        {
            double sum = 0;
            for (std::size_t i = 0; i < rule.x.size(); ++i)
                for (std::size_t j = 0; j < rule.x.size(); ++j)
                {
                    const double x01 = (column + rule.x[i]) / columns,
                                 x = whole ? 2 * x01 - 1 : x01,
                                 y = (row + rule.x[j]) / rows * 2 - 1;
                    const double p = scale_along * unbounded(x) + (whole ? 0 : edge),
                                 q = scale_across * unbounded(y);
                    const double area = scale_along * derivative(x) * (whole ? 2 : 1) *
                                        scale_across * derivative(y) * 2;
                    Vec3<double> m(ax * (p * cosine - q * sine), ay * (p * sine + q * cosine), 1);
                    const double z = 1 / m.length();
                    m *= z;
                    sum += rule.weight[i] * rule.weight[j] * area * z * z * z *
                           std::max(0.0, wo.dot(m)) * exact.D(m);
                }
            const double share = sum * ax * ay / (columns * rows) / sigma;
            expected[column * rows + row] = share * samples;
            rest -= share;
        }
    expected[columns * rows] = rest * samples;

    const Vec3<Real> w(Real(static_cast<ScalarOf<Real>>(wo.x)),
                       Real(static_cast<ScalarOf<Real>>(wo.y)),
                       Real(static_cast<ScalarOf<Real>>(wo.z)));
    const auto visible = distribution.visible(w);
    constexpr std::size_t lanes = lane_count<Real>();
    const auto number = [&] {
        if constexpr (lanes == 1)
            return random.unit<Real>();
        else
        {
            alignas(64) float values[lanes];
            for (float& v : values) v = random.unit<float>();
            return Real::load_aligned(values);
        }
    };
    for (int i = 0; i < samples; i += static_cast<int>(lanes))
    {
        const Real x = number(), y = number();
        const Vec3<Real> m = visible.sample({x, y, number()});
        for (std::size_t k = 0; k < lanes && i + static_cast<int>(k) < samples; ++k)
        {
            const Slopes slopes = slopes_of(lane(m.x, k), lane(m.y, k), lane(m.z, k));
            const double a = bounded(slopes.along / scale_along),
                         b = bounded(slopes.across / scale_across);
            const int column = static_cast<int>(columns * std::max(0.0, whole ? (a + 1) / 2 : a));
            const int row = std::min(rows - 1, static_cast<int>(rows * (b + 1) / 2));
            ++found[column + 1 < columns ? column * rows + row : columns * rows];
        }
    }

    // Cells with few samples count as one.
    double chi2 = 0, few = 0, few_found = 0;
    int cells = 0;
    for (std::size_t i = 0; i < expected.size(); ++i)
        if (expected[i] < 10)
        {
            few += expected[i];
            few_found += found[i];
        }
        else
        {
            chi2 += (found[i] - expected[i]) * (found[i] - expected[i]) / expected[i];
            ++cells;
        }
    if (few >= 10)
    {
        chi2 += (few_found - few) * (few_found - few) / few;
        ++cells;
    }
    const double n = cells - 1, c = 2 / (9 * n);
    return (std::cbrt(chi2 / n) - (1 - c)) / std::sqrt(c);
}

}  // namespace regain::tests
