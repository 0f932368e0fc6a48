// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Frames of shading normals, and which directions they have.

#include "../support/closures.h"

#include <regain/closures/shading_frame.h>
#include <regain/closures/xsimd.h>

#include <gtest/gtest.h>

#include <limits>

using namespace regain;
using namespace regain::tests;

namespace {

template <class Real>
class ShadingFrames : public testing::Test
{};
using Precisions = testing::Types<float, double>;
TYPED_TEST_SUITE(ShadingFrames, Precisions);

template <class Real>
Vec3<Real> anywhere(Random& random)
{
    return direction<Real>(2 * random.unit() - 1, 2 * M_PI * random.unit());
}

TYPED_TEST(ShadingFrames, are_orthonormal_and_right_handed_for_any_tangent)
{
    using Real = TypeParam;
    const Real eps = Real(sizeof(Real) == 4 ? 1e-6 : 1e-14);
    Random random(1);
    for (int i = 0; i < 300; ++i)
    {
        const auto N = anywhere<Real>(random), Ng = anywhere<Real>(random);
        const Real nan = std::numeric_limits<Real>::quiet_NaN();
        const auto T = anywhere<Real>(random);
        const Vec3<Real> tangents[] = {
            T * Real(3),        T * Real(1e-6),    N, -N, Vec3<Real>(Real(0)), Vec3<Real>(nan),
            N + T * Real(3e-3), N - T * Real(1e-6)};
        for (const auto& t : tangents)
        {
            const auto f = ShadingFrame<Real>::of(N, Ng, t);
            EXPECT_EQ(f.z, N);
            EXPECT_EQ(f.geometric, Ng);
            EXPECT_NEAR(f.x.dot(f.z), 0, 400 * eps);
            EXPECT_NEAR(f.x.length(), 1, eps);
            EXPECT_NEAR(f.x.cross(f.y).dot(f.z), 1, eps);
        }
        const auto f = ShadingFrame<Real>::of(N, Ng, tangents[0]);
        EXPECT_GT(f.x.dot(tangents[0]), 0);
        EXPECT_NEAR(f.y.dot(tangents[0]), 0, 10 * eps);
        const auto w = anywhere<Real>(random);
        EXPECT_TRUE(f.to_world(f.to_local(w)).equalWithAbsError(w, 10 * eps));
        EXPECT_NEAR(f.to_local(w).z, N.dot(w), 2 * eps);
    }
}

// Both are turned, by the side that V is on of Ng and never of N.
TYPED_TEST(ShadingFrames, face_the_viewer_as_the_true_surface_does)
{
    using Real = TypeParam;
    const Vec3<Real> Ng(0, 0, 1), N = direction<Real>(0.5, 0), T(0, 1, 0);
    const auto between = direction<Real>(0.1, M_PI);  // above the surface, below the bump
    ASSERT_LT(between.dot(N), 0);
    const auto front = ShadingFrame<Real>::facing(between, N, Ng, T),
               back = ShadingFrame<Real>::facing(-between, N, Ng, T);
    EXPECT_EQ(front.z, N);
    EXPECT_EQ(front.geometric, Ng);
    EXPECT_EQ(back.z, -N);
    EXPECT_EQ(back.geometric, -Ng);
}

TYPED_TEST(ShadingFrames, a_direction_is_there_where_both_normals_see_it_from_one_side)
{
    using Real = TypeParam;
    const Vec3<Real> Ng(0, 0, 1), N = direction<Real>(0.5, 0);
    const auto frame = ShadingFrame<Real>::of(N, Ng, Vec3<Real>(0, 1, 0));
    Random random(2);
    int there = 0, known = 0;
    for (int i = 0; i < 1000; ++i)
    {
        const auto w = anywhere<Real>(random), local = frame.to_local(w);
        const bool expected = (w.dot(N) > 0) == (w.dot(Ng) > 0);
        EXPECT_EQ(frame.is_on_its_side(w, local), expected);
        EXPECT_EQ(frame.known(w), expected ? local : Vec3<Real>(Real(0)));
        there += expected;
        known += bool(detail::is_direction(frame.known(w)));
    }
    // Two lunes of 60 degrees are not: a third.
    EXPECT_NEAR(there / 1000.0, 2.0 / 3, 0.05);
    EXPECT_EQ(known, there);
}

TYPED_TEST(ShadingFrames, neither_horizon_has_a_side)
{
    using Real = TypeParam;
    const Real nan = std::numeric_limits<Real>::quiet_NaN(), one(1), zero(0);
    EXPECT_TRUE(sides_agree(one, one));
    EXPECT_TRUE(sides_agree(-one, -one));
    const Real others[][2] = {{one, -one},  {-one, one},   {zero, one}, {one, zero},
                              {zero, zero}, {-zero, -one}, {nan, one},  {one, nan}};
    for (const auto& o : others) EXPECT_FALSE(sides_agree(o[0], o[1])) << o[0] << ' ' << o[1];
}

TEST(ShadingFrames, of_vectors_are_those_of_floats)
{
    using Batch = xsimd::batch<float>;
    constexpr std::size_t lanes = Batch::size;
    Random random(3);
    Vec3<float> V[lanes], N[lanes], Ng[lanes], T[lanes], w[lanes];
    const auto load = [](const Vec3<float>(&from)[lanes]) {
        alignas(64) float c[3][lanes];
        for (std::size_t i = 0; i < lanes; ++i)
            for (int k = 0; k < 3; ++k) c[k][i] = from[i][k];
        return Vec3<Batch>(Batch::load_aligned(c[0]), Batch::load_aligned(c[1]),
                           Batch::load_aligned(c[2]));
    };
    for (int round = 0; round < 50; ++round)
    {
        for (std::size_t i = 0; i < lanes; ++i)
        {
            for (auto* v : {&V[i], &N[i], &Ng[i], &T[i], &w[i]}) *v = anywhere<float>(random);
            if (i == 1) T[i] = N[i];
        }
        const auto frame = ShadingFrame<Batch>::facing(load(V), load(N), load(Ng), load(T));
        const auto known = frame.known(load(w));
        alignas(64) float x[lanes], z[lanes];
        known.x.store_aligned(x);
        known.z.store_aligned(z);
        for (std::size_t i = 0; i < lanes; ++i)
        {
            if (i == 1) continue;  // rounding alone
            const auto one = ShadingFrame<float>::facing(V[i], N[i], Ng[i], T[i]).known(w[i]);
            EXPECT_NEAR(x[i], one.x, 2e-5f);
            EXPECT_NEAR(z[i], one.z, 2e-5f);
        }
    }
}

}  // namespace
