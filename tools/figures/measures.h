// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What Table 1 measures of a closure, through its public sample and eval alone.

#pragma once

#include "../random_numbers.h"

#include <regain/closures/closure.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <vector>

namespace regain::tools::figures {

/// A direction of the cosine mu in [-1, 1] and an azimuth in radians.
template <class Real>
Vec3<Real> at_angle(double mu, double azimuth = 0)
{
    const double s = std::sqrt((1 - mu) * (1 + mu));
    return {Real(s * std::cos(azimuth)), Real(s * std::sin(azimuth)), Real(mu)};
}

/// The i-th of n points that fill the unit cube evenly: a lattice of the generalised golden ratio
/// (Roberts 2018), shifted by `shift`.
inline Imath::V3d lattice_point(std::uint64_t i, const Imath::V3d& shift)
{
    constexpr double g = 1.22074408460575947536;  // x^4 = x + 1
    const double n = static_cast<double>(i) + 0.5;
    const auto fraction = [](double x) { return x - std::floor(x); };
    return {fraction(shift.x + n / g), fraction(shift.y + n / (g * g)),
            fraction(shift.z + n / (g * g * g))};
}

struct SampledEnergy
{
    Imath::Color3<double> reflect{0.0}, transmit{0.0};  ///< mean weight
    double variance = 0;        ///< of the first channel's weight, over the square of its mean
    double standard_error = 0;  ///< of independent samples; a lattice does better
    double largest = 0;         ///< weight seen
};

/// Mean weight of n samples.
template <class Prepared>
SampledEnergy sampled_energy(const Prepared& prepared, std::uint64_t n, std::uint64_t seed)
{
    using Real = typename std::decay_t<decltype(prepared.wo())>::BaseType;
    RandomNumbers random(seed);
    const double a = random.next<double>(), b = random.next<double>(), c = random.next<double>();
    SampledEnergy sum;
    double squares = 0, total = 0;
    for (std::uint64_t i = 0; i < n; ++i)
    {
        const Imath::V3d u = lattice_point(i, {a, b, c});
        const auto s = prepared.sample(
            Vec3<Real>(static_cast<Real>(u.x), static_cast<Real>(u.y), static_cast<Real>(u.z)));
        if (!s.valid) continue;
        const Imath::Color3<double> w(s.weight);
        (s.transmitted ? sum.transmit : sum.reflect) += w;
        total += w.x;
        squares += w.x * w.x;
        sum.largest = std::max(sum.largest, w.x);
    }
    const double count = static_cast<double>(n), mean = total / count;
    sum.reflect *= 1 / count;
    sum.transmit *= 1 / count;
    const double variance = std::max(0.0, squares / count - mean * mean);
    sum.variance = mean > 0 ? variance / (mean * mean) : 0;
    sum.standard_error = std::sqrt(variance / count);
    return sum;
}

/// Where the reflected energy goes: 512 bins of equal solid angle over the hemisphere, folded onto
/// the side y > 0, where an isotropic lobe has its mirror image.
using Histogram = std::vector<double>;
constexpr int histogram_rows = 16, histogram_columns = 16;
constexpr std::size_t histogram_bins = histogram_rows * histogram_columns;

/// The bin of a direction with w.z > 0.
inline std::size_t histogram_bin(const Imath::V3d& w)
{
    const double turn = std::atan2(std::abs(w.y), w.x) / std::acos(-1.0);
    const int row = std::clamp(static_cast<int>(w.z * histogram_rows), 0, histogram_rows - 1);
    const int column =
        std::clamp(static_cast<int>(turn * histogram_columns), 0, histogram_columns - 1);
    return static_cast<std::size_t>(row * histogram_columns + column);
}

template <class Prepared>
Histogram reflected_histogram(const Prepared& prepared, std::uint64_t n, std::uint64_t seed)
{
    using Real = typename std::decay_t<decltype(prepared.wo())>::BaseType;
    RandomNumbers random(seed);
    const double a = random.next<double>(), b = random.next<double>(), c = random.next<double>();
    Histogram bins(histogram_bins);
    for (std::uint64_t i = 0; i < n; ++i)
    {
        const Imath::V3d u = lattice_point(i, {a, b, c});
        const auto s = prepared.sample(
            Vec3<Real>(static_cast<Real>(u.x), static_cast<Real>(u.y), static_cast<Real>(u.z)));
        if (!s.valid || s.transmitted) continue;
        bins[histogram_bin(Imath::V3d(s.wi))] += double(s.weight.x) / static_cast<double>(n);
    }
    return bins;
}

/// Sum of absolute differences over the sum of `truth`.
inline double shape_error(const Histogram& lobe, const Histogram& truth)
{
    double difference = 0, total = 0;
    for (std::size_t i = 0; i < truth.size(); ++i)
    {
        difference += std::abs(lobe[i] - truth[i]);
        total += truth[i];
    }
    return difference / total;
}

/// Median over `repeats` of the nanoseconds that one call of `work(i)` takes, i in [0, inner).
template <class Work>
double nanoseconds(int repeats, int inner, const Work& work)
{
    using Clock = std::chrono::steady_clock;
    std::vector<double> times;
    double sink = 0;
    for (int r = 0; r < repeats; ++r)
    {
        const auto start = Clock::now();
        for (int i = 0; i < inner; ++i) sink += work(i);
        times.push_back(std::chrono::duration<double, std::nano>(Clock::now() - start).count() /
                        inner);
    }
    // What was computed has to be used, or it would not be computed.
    volatile double used = sink;
    static_cast<void>(used);
    std::nth_element(times.begin(), times.begin() + repeats / 2, times.end());
    return times[static_cast<std::size_t>(repeats / 2)];
}

}  // namespace regain::tools::figures
