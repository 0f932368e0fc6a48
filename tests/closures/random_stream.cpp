// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Numbers drawn from the host's numbers: uniform, without correlation, the same for every type.

#include "../support/closures.h"

#include <regain/closures/random_stream.h>
#include <regain/closures/xsimd.h>

#include <gtest/gtest.h>

#include <vector>

using namespace regain;
using namespace regain::tests;

namespace {

template <class Real>
class RandomStreams : public testing::Test
{};
using Types = testing::Types<float, double>;
TYPED_TEST_SUITE(RandomStreams, Types);

// Chi-squared of the third number over 64 cells, and of pairs over 16 x 16, for neighbouring u.
TYPED_TEST(RandomStreams, are_uniform_and_uncorrelated)
{
    using Real = TypeParam;
    constexpr int n = 1 << 18;
    std::vector<double> cells(64), pairs(256);
    for (int i = 0; i < n; ++i)
    {
        RandomStream<Real> stream({Real(i) * Real(0x1p-18), Real(0.25), Real(0.75)});
        const auto a = stream.next2();
        const Real b = stream.next();
        ASSERT_TRUE(a.x >= 0 && a.x < 1 && a.y >= 0 && a.y < 1 && b >= 0 && b < 1);
        ++cells[static_cast<std::size_t>(b * 64)];
        ++pairs[static_cast<std::size_t>(a.x * 16) * 16 + static_cast<std::size_t>(a.y * 16)];
    }
    const auto chi2 = [](const std::vector<double>& counts) {
        double sum = 0;
        const double expected = double(n) / double(counts.size());
        for (double c : counts) sum += (c - expected) * (c - expected) / expected;
        return sum;
    };
    // Quantiles of 1 - 1e-6 with 63 and 255 degrees of freedom.
    EXPECT_LT(chi2(cells), 129.0);
    EXPECT_LT(chi2(pairs), 377.0);
}

TEST(RandomStreams, of_a_vector_are_those_of_its_lanes)
{
    using Batch = xsimd::batch<float>;
    Random random(5);
    alignas(64) float u[3][Batch::size], drawn[Batch::size];
    for (auto& row : u)
        for (float& x : row) x = random.unit<float>();
    RandomStream<Batch> vector(
        {Batch::load_aligned(u[0]), Batch::load_aligned(u[1]), Batch::load_aligned(u[2])});
    for (int draw = 0; draw < 5; ++draw)
    {
        vector.next().store_aligned(drawn);
        for (std::size_t lane = 0; lane < Batch::size; ++lane)
        {
            RandomStream<float> scalar({u[0][lane], u[1][lane], u[2][lane]});
            float expected = 0;
            for (int i = 0; i <= draw; ++i) expected = scalar.next();
            EXPECT_EQ(drawn[lane], expected);
        }
    }
}

}  // namespace
