// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "measure.h"

#include "../figures/measures.h"

#include <algorithm>
#include <cmath>

namespace regain::tools::cost {
namespace {

using figures::histogram_bins;

// Samples in one call: those of a block stay in the second cache.
constexpr std::uint64_t block = 2048;

// Calls visit with the samples that are valid, block by block.
template <class Visit>
void for_each_sample(const Subject& subject, double mu, std::uint64_t n, std::uint64_t seed,
                     const std::function<bool()>& stopped, const Visit& visit)
{
    RandomNumbers random(seed);
    const double a = random.next<double>(), b = random.next<double>(), c = random.next<double>();
    const Vec3<float> wo = figures::at_angle<float>(mu);
    std::vector<Vec3<float>> u;
    std::vector<Sample<float>> found;
    for (std::uint64_t first = 0; first < n; first += block)
    {
        if (stopped()) throw figures::Stopped();
        const std::uint64_t last = std::min(n, first + block);
        u.clear();
        for (std::uint64_t i = first; i < last; ++i)
        {
            const Imath::V3d p = figures::lattice_point(i, {a, b, c});
            // Below 1 also after rounding.
            const auto rounded = [](double x) {
                return std::min(static_cast<float>(x), std::nextafter(1.0f, 0.0f));
            };
            u.emplace_back(rounded(p.x), rounded(p.y), rounded(p.z));
        }
        found.resize(u.size());
        subject.sample(wo, u, found);
        for (const Sample<float>& s : found)
            if (s.valid) visit(s);
    }
}

// Of one lattice.
struct Means
{
    std::array<std::array<double, 3>, 2> mean{}, squares{};  // reflected, transmitted
};

Means means_along(const Subject& subject, double mu, std::uint64_t samples, std::uint64_t seed,
                  const std::function<bool()>& stopped)
{
    Means m;
    for_each_sample(subject, mu, samples, seed, stopped, [&](const Sample<float>& s) {
        const std::size_t side = s.transmitted ? 1 : 0;
        for (std::size_t c = 0; c < 3; ++c)
        {
            const double w = double(s.weight[static_cast<int>(c)]);
            m.mean[side][c] += w;
            m.squares[side][c] += w * w;
        }
    });
    for (auto* sums : {&m.mean, &m.squares})
        for (auto& side : *sums)
            for (double& x : side) x /= static_cast<double>(samples);
    return m;
}

Seen seen_along(const Subject& subject, double mu, std::uint64_t samples, std::uint64_t seed,
                const std::function<bool()>& stopped)
{
    constexpr double n = lattices;
    std::array<std::array<double, 3>, 2> sum{}, sum_of_squares{}, of_weight{};
    for (std::uint64_t k = 0; k < lattices; ++k)
    {
        const Means m = means_along(subject, mu, samples / lattices, seed + k, stopped);
        for (std::size_t side = 0; side < 2; ++side)
            for (std::size_t c = 0; c < 3; ++c)
            {
                sum[side][c] += m.mean[side][c];
                sum_of_squares[side][c] += m.mean[side][c] * m.mean[side][c];
                of_weight[side][c] += m.squares[side][c] / n;
            }
    }
    Seen seen;
    for (std::size_t c = 0; c < 3; ++c)
    {
        seen.reflect[c] = sum[0][c] / n;
        seen.transmit[c] = sum[1][c] / n;
        const double mean = seen.reflect[c] + seen.transmit[c];
        const double variance = std::max(0.0, of_weight[0][c] + of_weight[1][c] - mean * mean);
        seen.variance[c] = mean > 0 ? variance / (mean * mean) : 0;
        // R + T may be known where R is not.
        for (std::size_t side = 0; side < 2; ++side)
        {
            const double spread =
                std::max(0.0, sum_of_squares[side][c] - sum[side][c] * sum[side][c] / n);
            seen.standard_error[c] =
                std::max(seen.standard_error[c], std::sqrt(spread / (n * (n - 1))));
        }
    }
    return seen;
}

std::size_t bin_of(const Imath::V3d& wi, bool transmitted)
{
    return figures::histogram_bin({wi.x, wi.y, std::abs(wi.z)}) +
           (transmitted ? histogram_bins : 0);
}

Shape sampled_shape(const Subject& subject, double mu, std::uint64_t n, std::uint64_t seed,
                    const std::function<bool()>& stopped)
{
    Shape shape;
    shape.fill(figures::Histogram(2 * histogram_bins));
    for_each_sample(subject, mu, n, seed, stopped, [&](const Sample<float>& s) {
        const std::size_t bin = bin_of(Imath::V3d(s.wi), s.transmitted);
        for (std::size_t c = 0; c < 3; ++c)
            shape[c][bin] += double(s.weight[static_cast<int>(c)]) / static_cast<double>(n);
    });
    return shape;
}

// Midpoints of cells x cells in each bin.
Shape integrated_shape(const Subject& subject, double mu, bool transmits, int cells)
{
    const int rows = figures::histogram_rows * cells, columns = figures::histogram_columns * cells;
    const double pi = std::acos(-1.0);
    // Each stands for itself and its mirror image.
    const double solid_angle = 2 * pi / (double(rows) * columns);
    const Vec3<float> wo = figures::at_angle<float>(mu);
    Shape shape;
    shape.fill(figures::Histogram(2 * histogram_bins));
    std::vector<Vec3<float>> wi(static_cast<std::size_t>(columns));
    std::vector<Color3<float>> value(wi.size());
    for (const double side : {1.0, -1.0})
    {
        const bool transmitted = (side > 0) != (mu > 0);
        if (transmitted && !transmits) continue;
        for (int row = 0; row < rows; ++row)
        {
            const double z = side * (row + 0.5) / rows;
            for (int column = 0; column < columns; ++column)
                wi[static_cast<std::size_t>(column)] =
                    figures::at_angle<float>(z, pi * (column + 0.5) / columns);
            subject.evaluate(wo, wi, value);
            for (std::size_t i = 0; i < wi.size(); ++i)
            {
                const std::size_t bin = bin_of(Imath::V3d(wi[i]), transmitted);
                for (std::size_t c = 0; c < 3; ++c)
                    shape[c][bin] += double(value[i][static_cast<int>(c)]) * solid_angle;
            }
        }
    }
    return shape;
}

}  // namespace

Lobe measured(const Subject& subject, double side, const Effort& effort, std::uint64_t seed,
              const std::function<bool()>& stopped)
{
    Lobe lobe;
    for (std::size_t i = 0; i < cosines.size(); ++i)
        lobe.seen[i] =
            seen_along(subject, side * cosines[i], effort.samples, seed + lattices * i, stopped);
    for (std::size_t k = 0; k < shape_cosines.size(); ++k)
    {
        const double mu = side * cosines[shape_cosines[k]];
        if (subject.is_stochastic())
        {
            lobe.shapes[k] = sampled_shape(subject, mu, effort.shape_samples, seed + k, stopped);
            continue;
        }
        const auto& through = lobe.seen[shape_cosines[k]].transmit;
        const bool transmits = *std::max_element(through.begin(), through.end()) > 0;
        lobe.shapes[k] = integrated_shape(subject, mu, transmits, effort.cells);
    }
    return lobe;
}

void add_base(Lobe& lobe, double base)
{
    const auto of_base = [&](const Seen& seen, std::size_t c) {
        return base * (1 - seen.reflect[c] - seen.transmit[c]);
    };
    for (std::size_t k = 0; k < shape_cosines.size(); ++k)
        for (std::size_t c = 0; c < 3; ++c)
        {
            const double diffuse = of_base(lobe.seen[shape_cosines[k]], c);
            // The share of a cosine lobe in a row of bins is the difference of squared cosines.
            constexpr double rows = figures::histogram_rows, columns = figures::histogram_columns;
            for (std::size_t bin = 0; bin < histogram_bins; ++bin)
            {
                const double row = std::floor(static_cast<double>(bin) / columns);
                lobe.shapes[k][c][bin] += diffuse * (2 * row + 1) / (rows * rows * columns);
            }
        }
    for (Seen& seen : lobe.seen)
        for (std::size_t c = 0; c < 3; ++c)
        {
            seen.reflect[c] += of_base(seen, c);
            seen.standard_error[c] *= 1 - base;
        }
}

Errors compared(const Lobe& lobe, const Lobe& walk, const Part& part)
{
    Errors e;
    const auto first = static_cast<std::size_t>(part.first),
               last = static_cast<std::size_t>(part.last);
    const double channels = static_cast<double>(last - first + 1);
    const auto total = [](const Seen& s, std::size_t c) { return s.reflect[c] + s.transmit[c]; };
    const auto mean_of = [&](const Seen& s) {
        double sum = 0;
        for (std::size_t c = first; c <= last; ++c) sum += total(s, c);
        return sum / channels;
    };
    for (std::size_t i = 0; i < cosines.size(); ++i)
    {
        const Seen &a = lobe.seen[i], &b = walk.seen[i];
        const double mean_a = mean_of(a), mean_b = mean_of(b);
        for (std::size_t c = first; c <= last; ++c)
        {
            // Each side by itself, or a wrong split would not be seen.
            const double off = std::max(std::abs(a.reflect[c] - b.reflect[c]),
                                        std::abs(a.transmit[c] - b.transmit[c]));
            e.worst = std::max(e.worst, off);
            e.mean += off / (channels * double(cosines.size()));
            e.variance += a.variance[c] / (channels * double(cosines.size()));
            e.standard_error = std::max(e.standard_error, b.standard_error[c]);
            e.noise = std::max(e.noise, std::hypot(a.standard_error[c], b.standard_error[c]));
            if (first != last && mean_a > 0 && mean_b > 0)
                e.tint = std::max(e.tint, std::abs(total(a, c) / mean_a - total(b, c) / mean_b));
        }
    }
    for (std::size_t k = 0; k < shape_cosines.size(); ++k)
        for (std::size_t c = first; c <= last; ++c)
            e.shape += figures::shape_error(lobe.shapes[k][c], walk.shapes[k][c]) /
                       (channels * double(shape_cosines.size()));
    return e;
}

}  // namespace regain::tools::cost
