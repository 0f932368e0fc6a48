// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Directions and numbers that all files ask with, and the comparison of two subjects bit by bit.

#pragma once

#include "../support/closures.h"
#include "reference.h"

namespace regain::tests {

using Numbers = testing::Types<float, double>;
struct NumberNames
{
    template <class Real>
    static std::string GetName(int)
    {
        return sizeof(Real) == 4 ? "float" : "double";
    }
};

/// Not promised to hosts that compile with -ffinite-math-only: see docs/support.md.
#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
#define REGAIN_NEEDS_INFINITIES() GTEST_SKIP() << "not promised under -ffinite-math-only"
#else
#define REGAIN_NEEDS_INFINITIES() static_cast<void>(0)
#endif

/// A direction above (mu > 0) or below.
template <class Real>
Vec3<Real> towards(double mu, double azimuth = 0.7)
{
    auto w = direction<Real>(std::abs(mu), azimuth);
    if (mu < 0) w.z = -w.z;
    return w;
}

/// The largest number below 1.
template <class Real>
constexpr Real below_one = Real(1) - std::numeric_limits<Real>::epsilon() / 2;

/// How far apart two numbers of the type may be that are computed differently, relative.
template <class Real>
constexpr double rounding = sizeof(Real) == 4 ? 2e-6 : 1e-14;

template <class Real>
void expect_color_near(const Color3<Real>& c, const Color3<double>& expected, double tolerance,
                       const char* what)
{
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(double(c[i]), expected[i], tolerance) << what << ", channel " << i;
}

/// A pdf that is computed the same way twice.
template <class Real>
void expect_same_pdf(Real a, Real b)
{
    const double roundings = fast_math ? 1e3 : fused ? 1 : 0;
    EXPECT_NEAR(a, b, roundings * rounding<Real> * double(b));
}

template <class Real>
bool same_sample(const Sample<Real>& a, const Sample<Real>& b)
{
    return same_bits(a.wi, b.wi) && same_bits(a.weight, b.weight) && same_bits(a.pdf, b.pdf) &&
           a.valid == b.valid && a.delta == b.delta && a.transmitted == b.transmitted;
}

/// a and b answer alike, bit for bit: they are the same closure.
template <class Real>
void expect_same_answers(const Subject<Real>& a, const Subject<Real>& b, const std::string& what)
{
    const Vec3<Real> numbers[] = {{Real(0.2), Real(0.7), Real(0.4)},
                                  {Real(0.9), Real(0.1), Real(0.01)}};
    for (double mu : {0.8, 0.03, -0.5})
    {
        const Vec3<Real> wo = towards<Real>(mu);
        for (double mu_i : {0.6, -0.9})
        {
            const Vec3<Real> wi = towards<Real>(mu_i, 3.5);
            EXPECT_TRUE(same_bits(a.eval(wo, wi), b.eval(wo, wi)))
                << what << ": eval " << a.eval(wo, wi) << " and " << b.eval(wo, wi) << " at " << wo
                << wi;
            EXPECT_TRUE(same_bits(a.pdf(wo, wi), b.pdf(wo, wi))) << what;
        }
        for (const auto& u : numbers)
            EXPECT_TRUE(same_sample(a.sample(wo, u), b.sample(wo, u)))
                << what << ": weight " << a.sample(wo, u).weight << " and "
                << b.sample(wo, u).weight << " from " << wo;
    }
}

/// One number of a parameters, all alike whether it is a colour's or not.
using Member = double& (*)(Parameters&);

/// What a host passed, and what it is taken for.
struct Taken
{
    double given, meant;
};

/// Of every kind wanted, the member set to `given` is what it is set to `meant`.
template <class Real, class Wanted>
void expect_taken_for(const Wanted& wanted, Member member, const char* what,
                      std::initializer_list<Taken> cases,
                      const Parameters& parameters = Parameters())
{
    for_each_kind<Real>(wanted, [&](const auto& kind) {
        for (const Taken& c : cases)
        {
            Parameters given = parameters, meant = parameters;
            member(given) = c.given;
            member(meant) = c.meant;
            expect_same_answers<Real>(*kind.make(given), *kind.make(meant),
                                      std::string(what) + " " + std::to_string(c.given));
        }
    });
}

}  // namespace regain::tests
