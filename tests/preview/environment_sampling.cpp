// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The environment's pdf integrates to 1 and is that of its samples.

#include "preview/environment.h"
#include "preview/sampler.h"

#include <gtest/gtest.h>

#include <cmath>

namespace regain::tools::preview { namespace {

using Imath::C3f;
using Imath::V2f;
using Imath::V3f;

/// Hostile: a sun of one pixel in the last row and column, a black half, a black row.
LatLongImage hostile_image()
{
    LatLongImage image;
    image.width = 32;
    image.height = 16;
    image.pixels.assign(512, C3f(0.0f));
    for (int row = 0; row < 16; ++row)
        for (int column = 0; column < 16; ++column)
            if (row != 5) image.pixels[static_cast<std::size_t>(row * 32 + column)] = C3f(0.1f);
    image.pixels[511] = C3f(4000.0f, 3000.0f, 1000.0f);
    return image;
}

class EnvironmentSampling : public testing::TestWithParam<bool>
{
protected:
    Environment environment{GetParam() ? make_studio() : hostile_image()};
};

TEST_P(EnvironmentSampling, PdfIntegratesToOne)
{
    // The pdf is constant over each image pixel; both images' pixels are whole cells of this grid.
    constexpr int kColumns = 2048, kRows = 1024;
    double sum = 0.0;
    for (int row = 0; row < kRows; ++row)
    {
        const double angle = 2.0 * M_PI / kColumns *
                             (std::cos(M_PI * row / kRows) - std::cos(M_PI * (row + 1) / kRows));
        for (int column = 0; column < kColumns; ++column)
            sum += angle * environment
                               .at(latlong_direction((static_cast<float>(column) + 0.5f) / kColumns,
                                                     (static_cast<float>(row) + 0.5f) / kRows))
                               .pdf;
    }
    EXPECT_NEAR(sum, 1.0, 1e-4);
}

TEST_P(EnvironmentSampling, PdfIsThatOfTheSamples)
{
    // Shares of samples in bins against the pdf's integral over them.
    constexpr int kU = 16, kV = 8, kSamples = 1 << 16, kSub = 64;
    std::vector<double> seen(kU * kV, 0.0), expected(kU * kV, 0.0);
    for (int s = 0; s < kSamples; ++s)
    {
        const auto sample = environment.sample(Sampler(0, 0, s, 9).get2D(0));
        ASSERT_NEAR(sample.direction.length(), 1.0f, 1e-5f);
        ASSERT_GT(sample.light.pdf, 0.0f);
        const V2f p = latlong_point(sample.direction);
        const int bin = std::min(int(p.y * kV), kV - 1) * kU + std::min(int(p.x * kU), kU - 1);
        seen[static_cast<std::size_t>(bin)] += 1.0 / kSamples;
    }
    for (int row = 0; row < kV * kSub; ++row)
        for (int column = 0; column < kU * kSub; ++column)
        {
            const float v = (static_cast<float>(row) + 0.5f) / (kV * kSub);
            const double angle = 2.0 * M_PI / (kU * kSub) * M_PI / (kV * kSub) *
                                 std::sin(M_PI * static_cast<double>(v));
            const V3f d = latlong_direction((static_cast<float>(column) + 0.5f) / (kU * kSub), v);
            expected[static_cast<std::size_t>(row / kSub * kU + column / kSub)] +=
                environment.at(d).pdf * angle;
        }
    for (std::size_t i = 0; i < seen.size(); ++i)
        EXPECT_NEAR(seen[i], expected[i], 5.0 * std::sqrt(expected[i] / kSamples) + 3e-4) << i;
}

TEST_P(EnvironmentSampling, SampleAgreesWithPdfAndRadiance)
{
    int off = 0;
    for (int s = 0; s < 20000; ++s)
    {
        const auto sample = environment.sample(Sampler(3, 1, s, 9).get2D(0));
        const auto light = environment.at(sample.direction);
        const float radiance = sample.light.radiance.y;
        // Directions on a pixel's edge may round to its neighbour, and near a pole the longitude
        // of a direction rounds to several pixels.
        if (std::abs(light.pdf / sample.light.pdf - 1.0f) > 1e-4f ||
            std::abs(light.radiance.y - radiance) > 1e-2f * (1.0f + radiance))
            ++off;
    }
    EXPECT_LT(off, 100);
}

TEST_P(EnvironmentSampling, EstimatesItsTotalLight)
{
    double estimate = 0.0, total = 0.0;
    constexpr int kSamples = 1 << 16, kRows = 1024, kColumns = 2048;
    for (int s = 0; s < kSamples; ++s)
    {
        const auto sample = environment.sample(Sampler(8, 1, s, 9).get2D(0));
        estimate += static_cast<double>(sample.light.radiance.y / sample.light.pdf) / kSamples;
    }
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column)
        {
            const float v = (static_cast<float>(row) + 0.5f) / kRows;
            const V3f d = latlong_direction((static_cast<float>(column) + 0.5f) / kColumns, v);
            total += environment.at(d).radiance.y * std::sin(M_PI * static_cast<double>(v)) * M_PI /
                     kRows * 2.0 * M_PI / kColumns;
        }
    EXPECT_NEAR(estimate / total, 1.0, 5e-3);
}

INSTANTIATE_TEST_SUITE_P(Lights, EnvironmentSampling, testing::Bool(),
                         [](const auto& light) { return light.param ? "Studio" : "Hostile"; });

TEST(EnvironmentOrientation, RoundTrip)
{
    EXPECT_LT((latlong_direction(0.5f, 0.5f) - V3f(0, 0, 1)).length(), 1e-6f);
    EXPECT_LT((latlong_direction(0.25f, 0.5f) - V3f(1, 0, 0)).length(), 1e-6f);
    EXPECT_LT((latlong_direction(0.3f, 0.0f) - V3f(0, 1, 0)).length(), 1e-6f);
    for (float u = 0.01f; u < 1.0f; u += 0.07f)
        for (float v = 0.01f; v < 1.0f; v += 0.07f)
        {
            const V2f p = latlong_point(latlong_direction(u, v));
            EXPECT_NEAR(p.x, u, 1e-5f);
            EXPECT_NEAR(p.y, v, 1e-4f);
        }
}

}}  // namespace regain::tools::preview
