// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Counts against probabilities that are known, in many cells at a time. A cell's deviation z has
/// mean 0 and variance 1 if they agree. Of each group of cells
///
///   the mean      sum z / sqrt(N)                       finds a bias that all share, however small
///   the spread    sum z^2, chi-squared of N degrees     finds deviations of either sign
///
/// have to be within 3 standard deviations, and no cell of the test may be further out than the
/// furthest of so many is once in a thousand tests. A bound on single cells alone has to be wide,
/// as some cell is always far out, and then hides what all have in common.

#pragma once

#include "closures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

namespace regain::tests {

/// Random numbers of the test that runs, and of a part of it: nobody chooses the seed. FNV-1a.
inline Random random_of_test(std::string_view part = {})
{
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    std::uint64_t hash = 0xCBF29CE484222325ull;
    for (const std::string_view text :
         {std::string_view(test->test_suite_name()), std::string_view(test->name()), part})
        for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3ull;
    return Random(hash);
}

/// What a normal deviate exceeds, in either direction, with the probability p.
inline double two_sided_bound(double p)
{
    double low = 0, high = 40;
    for (int i = 0; i < 100; ++i)
    {
        const double middle = 0.5 * (low + high);
        (std::erfc(middle / std::sqrt(2.0)) > p ? low : high) = middle;
    }
    return low;
}

/// The same for the furthest of n independent ones (Sidak 1967).
inline double furthest_of(std::size_t n, double p)
{
    return two_sided_bound(-std::expm1(std::log1p(-p) / double(n)));
}

/// chi2 of n degrees of freedom as a normal deviate (Wilson and Hilferty 1931).
inline double normal_of_chi_squared(double chi2, double n)
{
    const double variance = 2 / (9 * n);
    return (std::cbrt(chi2 / n) - (1 - variance)) / std::sqrt(variance);
}

/// Cells of one kind.
struct CellGroup
{
    std::string name;
    std::vector<double> z;
    std::vector<std::string> where;

    double mean() const
    {
        return std::accumulate(z.begin(), z.end(), 0.0) / std::sqrt(double(z.size()));
    }
    double spread() const
    {
        return normal_of_chi_squared(std::inner_product(z.begin(), z.end(), z.begin(), 0.0),
                                     double(z.size()));
    }
};

class Cells
{
public:
    /// Of n trials, so many came to each of some ends that exclude each other, which has these
    /// probabilities; the others came to an end of their own. Each count is compared with what it
    /// should be given those before it, so that the deviations are not correlated. An end that
    /// should have fewer than 50, or is all that is left but as few, stays with the others: it is
    /// too far from normal.
    void add(const std::string& group, const std::string& where, double n,
             const std::vector<double>& counts, const std::vector<double>& probabilities)
    {
        if (_groups.empty() || _groups.back().name != group) _groups.push_back({group, {}, {}});
        CellGroup& cells = _groups.back();
        double trials = n, left = 1;
        for (std::size_t i = 0; i < counts.size(); ++i)
        {
            const double p = probabilities[i] / left;
            if (n * probabilities[i] < 50 || n * (left - probabilities[i]) < 50) continue;
            cells.z.push_back((counts[i] - trials * p) / std::sqrt(trials * p * (1 - p)));
            cells.where.push_back(where + ", end " + std::to_string(i));
            trials -= counts[i];
            left -= probabilities[i];
        }
    }

    const std::deque<CellGroup>& groups() const { return _groups; }

    /// Expects all that is said above. What is seen is recorded with the test.
    void check() const
    {
        std::size_t n = 0;
        for (const CellGroup& g : _groups) n += g.z.size();
        const double furthest = furthest_of(n, 1e-3);
        for (const CellGroup& g : _groups)
        {
            EXPECT_LE(std::abs(g.mean()), 3) << g.name << ": the mean of " << g.z.size();
            EXPECT_LE(std::abs(g.spread()), 3) << g.name << ": the spread of " << g.z.size();
            double most = 0;
            for (std::size_t i = 0; i < g.z.size(); ++i)
            {
                EXPECT_LE(std::abs(g.z[i]), furthest) << g.name << ": " << g.where[i];
                most = std::max(most, std::abs(g.z[i]));
            }
            testing::Test::RecordProperty(
                g.name, std::to_string(g.z.size()) + " cells, mean " + std::to_string(g.mean()) +
                            ", spread " + std::to_string(g.spread()) + ", furthest " +
                            std::to_string(most) + " of " + std::to_string(furthest));
        }
    }

private:
    std::deque<CellGroup> _groups;
};

}  // namespace regain::tests
