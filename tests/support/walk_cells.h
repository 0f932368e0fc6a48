// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Cells of directions, equally large: how much of what samples return falls into each, and how
/// much of a density does.

#pragma once

#include "cells.h"
#include "walks.h"

namespace regain::tests {

/// Rows along the cosine and columns along the azimuth, of the hemisphere or of the sphere.
struct DirectionCells
{
    int rows, columns;
    double lowest;  ///< cosine: 0 or -1

    int size() const { return rows * columns; }
    double area() const { return 2 * std::acos(-1.0) * (1 - lowest) / size(); }

    std::size_t of(const Vec3<double>& w) const
    {
        const double turn = std::atan2(w.y, w.x) / (2 * std::acos(-1.0)) + 0.5;
        const int row = std::min(int((w.z - lowest) / (1 - lowest) * rows), rows - 1),
                  column = std::min(int(turn * columns), columns - 1);
        return std::size_t(row * columns + column);
    }
    /// x and y in [0, 1] across the cell.
    Vec3<double> direction_in(int cell, double x, double y) const
    {
        const double z = lowest + (1 - lowest) * (cell / columns + x) / rows,
                     turn = (cell % columns + y) / columns - 0.5;
        return direction<double>(z, 2 * std::acos(-1.0) * turn);
    }
};

/// Expects that what samples of one prepared closure return, in the green, is in each cell what
/// eval of another says, of a multiple of 256 evals. The deviations have to be small each, on
/// average and in spread: a test like this fails once in 200 where nothing is wrong. `slack` is a
/// relative error to be added: where a few joined paths weigh much, the error cannot be told from
/// those there are.
template <class Sampled, class Evaluated>
void expect_samples_where_eval_says(const DirectionCells& cells, const Sampled& sampled,
                                    const Evaluated& evaluated, int samples, int evals,
                                    const std::string& name, double slack = 0)
{
    Random random = random_of_test(name);
    std::vector<double> sum(std::size_t(cells.size())), squares(sum);
    for (int i = 0; i < samples; ++i)
    {
        const auto s = sampled.sample(random.cube<double>());
        const std::size_t cell = cells.of(s.wi);
        sum[cell] += s.weight.y;
        squares[cell] += s.weight.y * s.weight.y;
    }
    CellGroup group{name, {}, {}};
    for (int cell = 0; cell < cells.size(); ++cell)
    {
        const double mean = sum[std::size_t(cell)] / samples,
                     square = squares[std::size_t(cell)] / samples;
        // Few counts are not normal.
        if (sum[std::size_t(cell)] < 50) continue;
        Mean value;
        for (int i = 0; i < evals; ++i)
        {
            const auto wi = cells.direction_in(cell, (i % 16 + random.unit()) / 16,
                                               (i / 16 % 16 + random.unit()) / 16);
            value.add(evaluated.eval(wi, random.cube<double>()).y * cells.area());
        }
        const double sigma =
            std::hypot(std::sqrt((square - mean * mean) / samples), value.error(), slack * mean);
        group.z.push_back((value.value() - mean) / sigma);
    }
    ASSERT_GT(group.z.size(), 20u) << name;
    const double furthest = furthest_of(group.z.size(), 1e-3);
    for (const double z : group.z) EXPECT_LE(std::abs(z), furthest) << name;
    EXPECT_LE(std::abs(group.mean()), 3.3) << name;
    EXPECT_LE(group.spread(), 3.3) << name;
}

/// L1 distance between the samples of a prepared closure, all that are kept(path), and a density,
/// over the cells.
template <class Prepared, class Keep, class Density>
double distance_to_samples(const DirectionCells& cells, const Prepared& prepared, int samples,
                           const Keep& keep, const Density& density)
{
    Random random = random_of_test();
    std::vector<double> share(std::size_t(cells.size()));
    for (int i = 0; i < samples; ++i)
    {
        const auto p = prepared.path(random.cube<double>());
        if (keep(p)) share[cells.of(p.wi)] += 1.0 / samples;
    }
    double distance = 0;
    constexpr int n = 6;
    for (int cell = 0; cell < cells.size(); ++cell)
    {
        double sum = 0;
        for (int i = 0; i < n * n; ++i)
            sum += density(cells.direction_in(cell, (i / n + 0.5) / n, (i % n + 0.5) / n));
        distance += std::abs(share[std::size_t(cell)] - sum / (n * n) * cells.area());
    }
    return distance;
}

/// Of a pdf over both hemispheres, or one, by the R2 sequence (Roberts 2018), which the edges of
/// the density do not line up with.
template <class Prepared>
double integral_of_pdf(const Prepared& prepared, int n)
{
    const double pi = std::acos(-1.0);
    double sum = 0, u = 0.5, v = 0.5;
    for (int i = 0; i < n; ++i)
    {
        u += 0.7548776662466927;
        v += 0.5698402909980532;
        u -= std::floor(u);
        v -= std::floor(v);
        const double z = u * u * (3 - 2 * u);  // more of them along the horizon and the normal
        sum += (prepared.pdf(direction<double>(z, 2 * pi * v)) +
                prepared.pdf(direction<double>(-z, 2 * pi * v))) *
               6 * u * (1 - u);
    }
    return sum * 2 * pi / n;
}

}  // namespace regain::tests
