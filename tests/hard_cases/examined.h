// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What is asked of every answer of every closure in every hard case: numbers are finite and not
/// negative, directions are unit, and a sample that is none says so in all its members.
///
/// A program that is compiled to know no NaN may not look for one by comparing it, so the bits are
/// looked at.

#pragma once

#include <regain/closures/closure.h>

#include <gtest/gtest.h>

#include <cstring>

namespace regain::tests {

/// With -ffast-math the compiler orders sums as it likes and takes roots and quotients by
/// approximation: what holds to the last bit otherwise, holds to some ulps.
#ifdef __FAST_MATH__
constexpr bool fast_math = true;
#else
constexpr bool fast_math = false;
#endif

/// Where the processor multiplies and adds in one, g++ chooses anew in each inlined copy of a
/// function which sums to fuse, so two answers to the same question may differ by a few roundings.
#if defined(__FMA__) || defined(__FP_FAST_FMAF)
constexpr bool fused = true;
#else
constexpr bool fused = false;
#endif

inline bool is_finite(float x)
{
    std::uint32_t bits;
    std::memcpy(&bits, &x, sizeof bits);
    return (bits & 0x7F800000u) != 0x7F800000u;
}
inline bool is_finite(double x)
{
    std::uint64_t bits;
    std::memcpy(&bits, &x, sizeof bits);
    return (bits & 0x7FF0000000000000u) != 0x7FF0000000000000u;
}

template <class Real>
bool same_bits(const Real& a, const Real& b)
{
    return std::memcmp(&a, &b, sizeof(Real)) == 0;
}

template <class Real>
void examine(Real x, const char* what)
{
    if (!is_finite(x) || x < 0) ADD_FAILURE() << what << " is " << x;
}
template <class Real>
void examine(const Color3<Real>& c, const char* what)
{
    for (int i = 0; i < 3; ++i) examine(c[i], what);
}
template <class Real>
void examine(const Albedo<Real>& a)
{
    examine(a.reflect, "albedo().reflect");
    examine(a.transmit, "albedo().transmit");
}

template <class Real>
void examine(const Sample<Real>& s)
{
    examine(s.weight, "the weight of a sample");
    examine(s.pdf, "the pdf of a sample");
    constexpr int ulps = fast_math ? 16 : 8;
    bool unit = true;
    for (int i = 0; i < 3; ++i) unit = unit && is_finite(s.wi[i]);
    const double length = std::sqrt(double(s.wi.x) * double(s.wi.x) + double(s.wi.y * s.wi.y) +
                                    double(s.wi.z) * double(s.wi.z));
    if (!unit || std::abs(length - 1) > ulps * double(std::numeric_limits<Real>::epsilon()))
        ADD_FAILURE() << "a sampled direction is " << s.wi << ", " << length - 1 << " off unit";
    if (s.valid)
    {
        EXPECT_GT(s.pdf, 0) << "of a sample";
        EXPECT_NE(s.wi.z, 0) << "a sample along the surface";
        return;
    }
    EXPECT_EQ(s.wi, Vec3<Real>(0, 0, 1)) << "no sample";
    EXPECT_EQ(s.weight, Color3<Real>(Real(0))) << "no sample";
    EXPECT_EQ(s.pdf, 0) << "no sample";
    EXPECT_FALSE(s.delta || s.transmitted) << "no sample";
}

}  // namespace regain::tests
