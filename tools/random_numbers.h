// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Random numbers that anyone can reproduce: SplitMix64 (Steele, Lea and Flood 2014), whose state
/// starts at the seed and grows by 0x9e3779b97f4a7c15 a draw. A number in [0, 1) is made of the
/// upper bits of a draw: 24 for float, 53 for double.

#pragma once

#include <cstdint>

namespace regain::tools {

class RandomNumbers
{
public:
    explicit RandomNumbers(std::uint64_t seed) : _state(seed) {}

    template <class Real>
    Real next()
    {
        constexpr int bits = sizeof(Real) == 4 ? 24 : 53;
        return static_cast<Real>(draw() >> (64 - bits)) *
               (Real(1) / static_cast<Real>(std::uint64_t(1) << bits));
    }

private:
    std::uint64_t draw()
    {
        std::uint64_t z = _state += 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }

    std::uint64_t _state;
};

}  // namespace regain::tools
