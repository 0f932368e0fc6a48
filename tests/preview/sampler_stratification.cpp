// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The sampler's points: Sobol's, stratified, evenly spread, and each dimension on its own.

#include "preview/sampler.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

namespace regain::tools::preview { namespace {

TEST(SamplerStratification, SecondDimensionIsSobols)
{
    for (std::uint32_t index = 0; index < 5000; index += 7)
    {
        std::uint32_t direction = 1u << 31, expected = 0;
        for (std::uint32_t bits = index; bits; bits >>= 1, direction ^= direction >> 1)
            if (bits & 1u) expected ^= direction;
        EXPECT_EQ(sobol::reverse_bits(sobol::second_dimension_reversed(index)), expected);
    }
}

/// The first 64 samples of any pixel and dimension fall one into each elementary interval of area
/// 1/64, of every shape.
TEST(SamplerStratification, ElementaryIntervals)
{
    for (int pixel = 0; pixel < 50; ++pixel)
        for (const std::uint32_t dimension : {0u, 1u, 65u, 0x12345678u})
        {
            std::set<int> line;
            std::array<std::set<int>, 7> cells;
            for (int s = 0; s < 64; ++s)
            {
                const Sampler sampler(pixel, 7 * pixel, s, 3);
                line.insert(static_cast<int>(sampler.get1D(dimension) * 64.0f));
                const Imath::V2f p = sampler.get2D(dimension);
                for (int k = 0; k <= 6; ++k)
                {
                    const int nx = 1 << k, ny = 1 << (6 - k);
                    cells[static_cast<std::size_t>(k)].insert(
                        static_cast<int>(p.x * static_cast<float>(nx)) * ny +
                        static_cast<int>(p.y * static_cast<float>(ny)));
                }
            }
            EXPECT_EQ(line.size(), 64u);
            for (const auto& c : cells) EXPECT_EQ(c.size(), 64u);
        }
}

TEST(SamplerStratification, DimensionsAndPixelsAreIndependent)
{
    // Correlation of two dimensions over samples, and of one dimension over neighbouring pixels.
    double dimensions = 0.0, pixels = 0.0, mean = 0.0;
    constexpr int kPixels = 64, kSamples = 64;
    for (int y = 0; y < kPixels; ++y)
        for (int s = 0; s < kSamples; ++s)
        {
            const Sampler here(5, y, s, 1), beside(6, y, s, 1);
            const double a = here.get2D(2).x - 0.5, b = here.get2D(3).x - 0.5;
            dimensions += 12.0 * a * b;
            pixels += 12.0 * a * (beside.get2D(2).x - 0.5);
            mean += a;
        }
    constexpr double kCount = kPixels * kSamples;
    EXPECT_LT(std::abs(dimensions / kCount), 5.0 / std::sqrt(kCount));
    EXPECT_LT(std::abs(pixels / kCount), 5.0 / std::sqrt(kCount));
    EXPECT_LT(std::abs(mean / kCount), 1e-3);
}

TEST(SamplerStratification, StaysBelowOne)
{
    for (int s = 0; s < 100000; ++s)
    {
        const Sampler sampler(1, 2, s, 0);
        const Imath::V2f p = sampler.get2D(1);
        ASSERT_TRUE(p.x >= 0.0f && p.x < 1.0f && p.y >= 0.0f && p.y < 1.0f);
    }
}

}}  // namespace regain::tools::preview
