// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The kit's random numbers. A seed is the hash of the name of what is tested, so that a case gives
/// the same numbers alone and in a whole run, on any number of threads.

#pragma once

#include <regain/conformance/tested_closure.h>

#include <cstdint>
#include <string_view>

REGAIN_NAMESPACE_BEGIN
namespace conformance {

/// FNV-1a, 64 bits.
constexpr std::uint64_t hash_of(std::string_view text, std::uint64_t salt = 0)
{
    std::uint64_t h = 0xcbf29ce484222325u ^ salt;
    for (char c : text) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    return h;
}

/// SplitMix64 (Steele, Lea and Flood 2014).
class Random
{
public:
    explicit Random(std::uint64_t seed) : _state(seed) {}

    std::uint64_t bits()
    {
        std::uint64_t z = _state += 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    /// In [0, 1).
    double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    Direction cube()
    {
        const double x = unit(), y = unit();
        return {x, y, unit()};
    }
    /// Uniform over the sphere.
    Direction direction()
    {
        const double z = 2 * unit() - 1, phi = 6.283185307179586 * unit();
        const double r = std::sqrt((1 - z) * (1 + z));
        return {r * std::cos(phi), r * std::sin(phi), z};
    }

private:
    std::uint64_t _state;
};

/// Points of the unit cube that fill it evenly, from a random start: the Kronecker sequence R3
/// (Roberts 2018), whose estimates are unbiased and, of smooth functions, err by little more than
/// 1 / n.
class EvenPoints
{
public:
    explicit EvenPoints(const Direction& start) : _u(start) {}

    Direction next()
    {
        constexpr double step[] = {0.8191725133961644, 0.6710436067037893, 0.5497004779019703};
        for (int k = 0; k < 3; ++k)
        {
            _u[k] += step[k];
            if (_u[k] >= 1) _u[k] -= 1;
        }
        return _u;
    }

private:
    Direction _u;
};

}  // namespace conformance
REGAIN_NAMESPACE_END
