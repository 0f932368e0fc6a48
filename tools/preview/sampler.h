// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Random numbers as a function of (pixel, sample, dimension, seed): Owen-scrambled Sobol points by
/// hashing, after Burley, "Practical Hash-based Owen Scrambling", JCGT 2020. There is no state, so
/// nothing depends on the order of pixels or on threads.

#pragma once

#include <Imath/ImathVec.h>

#include <cstdint>

namespace regain::tools::preview {

namespace sobol {

inline std::uint32_t reverse_bits(std::uint32_t x)
{
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
    return (x >> 16) | (x << 16);
}

/// Two words into one, every bit depending on every bit.
inline std::uint32_t hash(std::uint32_t a, std::uint32_t b)
{
    std::uint32_t x = a * 0x9e3779b9u ^ (b + 0x7f4a7c15u + (a << 6) + (a >> 2));
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
}

/// Owen scrambling of a bit-reversed number: each bit is flipped by a hash of the bits below it
/// (Laine and Karras; the constants are those of Vegdahl's search).
inline std::uint32_t scramble_reversed(std::uint32_t x, std::uint32_t seed)
{
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

/// Second Sobol dimension of `index`, bit-reversed: the index times Pascal's triangle modulo 2.
inline std::uint32_t second_dimension_reversed(std::uint32_t index)
{
    index ^= (index & 0xffff0000u) >> 16;
    index ^= (index & 0xff00ff00u) >> 8;
    index ^= (index & 0xf0f0f0f0u) >> 4;
    index ^= (index & 0xccccccccu) >> 2;
    index ^= (index & 0xaaaaaaaau) >> 1;
    return index;
}

}  // namespace sobol

class Sampler
{
public:
    Sampler() = default;
    Sampler(int x, int y, int sample, std::uint32_t seed)
        : _key(sobol::hash(
              sobol::hash(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)), seed)),
          _index(sobol::reverse_bits(static_cast<std::uint32_t>(sample)))
    {}

    /// In [0, 1). Over the samples of a pixel every dimension is stratified; any two dimensions are
    /// independent.
    float get1D(std::uint32_t dimension) const
    {
        const std::uint32_t key = sobol::hash(_key, dimension);
        return to_unit(sobol::reverse_bits(sobol::scramble_reversed(shuffled(key), key * 3u + 1u)));
    }

    /// In [0, 1)^2, stratified in two dimensions over the samples of a pixel.
    Imath::V2f get2D(std::uint32_t dimension) const
    {
        using namespace sobol;
        const std::uint32_t key = hash(_key, dimension);
        const std::uint32_t i = shuffled(key);
        const std::uint32_t x = scramble_reversed(i, hash(key, 1));
        const std::uint32_t y = scramble_reversed(second_dimension_reversed(i), hash(key, 2));
        return {to_unit(reverse_bits(x)), to_unit(reverse_bits(y))};
    }

private:
    /// The sample's place in a shuffled order of the sequence, so that dimensions can be paired.
    std::uint32_t shuffled(std::uint32_t key) const
    {
        return sobol::reverse_bits(sobol::scramble_reversed(_index, key));
    }
    static float to_unit(std::uint32_t x) { return static_cast<float>(x >> 8) * 0x1p-24f; }

    std::uint32_t _key = 0;
    std::uint32_t _index = 0;  // bit-reversed
};

}  // namespace regain::tools::preview
