// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What benchmarks ask closures about: directions and random numbers as structures of arrays, in an
/// order that no branch predictor learns and that is the same on every machine.

#pragma once

#include <regain/closures/vector.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <type_traits>

namespace regain::bench {

/// How many points a Real holds.
template <class Real>
constexpr std::size_t points_of()
{
    return sizeof(Real) / sizeof(ScalarOf<Real>);
}

/// The points from p[0] on.
template <class Real>
Real load(const float* p)
{
    if constexpr (std::is_floating_point_v<Real>)
        return static_cast<Real>(*p);
    else
        return Real::load_aligned(p);
}

constexpr std::size_t input_count = 4096;

/// Triples of numbers.
struct Triples
{
    alignas(64) float x[input_count], y[input_count], z[input_count];

    template <class Real>
    Vec3<Real> at(std::size_t i) const
    {
        return {load<Real>(x + i), load<Real>(y + i), load<Real>(z + i)};
    }
};

/// wo and wi of closures that reflect, above, and of those that transmit, around: the same, on
/// either side of the surface by chance.
struct Directions
{
    Triples wo, wi;
};

struct Inputs
{
    Directions above, around;
    Triples sample_numbers, eval_numbers;
    alignas(64) float share[input_count];  ///< in (0, 1)

    Inputs()
    {
        std::mt19937 random(1);
        const auto unit = [&] { return (static_cast<float>(random() >> 8) + 0.5f) * 0x1p-24f; };
        const auto put_direction = [&](Triples& up, Triples& either, std::size_t i) {
            const float z = 0.001f + 0.998f * unit(), phi = 6.2831853f * unit();
            const float s = std::sqrt(1 - z * z);
            up.x[i] = either.x[i] = s * std::cos(phi);
            up.y[i] = either.y[i] = s * std::sin(phi);
            up.z[i] = z;
            either.z[i] = unit() < 0.5f ? -z : z;
        };
        const auto put_numbers = [&](Triples& numbers, std::size_t i) {
            numbers.x[i] = unit();
            numbers.y[i] = unit();
            numbers.z[i] = unit();
        };
        for (std::size_t i = 0; i < input_count; ++i)
        {
            put_direction(above.wo, around.wo, i);
            put_direction(above.wi, around.wi, i);
            put_numbers(sample_numbers, i);
            put_numbers(eval_numbers, i);
            share[i] = unit();
        }
    }

    /// Widths up to a tenth below `alpha`, as a texture would have them.
    template <class Real>
    Real alpha(float alpha, std::size_t i) const
    {
        return Real(alpha) * (Real(1) - Real(0.1f) * load<Real>(share + i));
    }
};

inline const Inputs& inputs()
{
    static const Inputs all;
    return all;
}

}  // namespace regain::bench
