// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The critical angle. Every look out of water or glass crosses it, and there Fresnel's formulas
// have a vertical tangent: the last digit of a cosine decides whether anything is transmitted.

#include "questions.h"

#include <regain/closures/dielectric_fresnel.h>

#include <gtest/gtest.h>

using namespace regain;
using namespace regain::tests;

namespace {

template <class Real>
class CriticalAngle : public testing::Test
{};
TYPED_TEST_SUITE(CriticalAngle, Numbers, NumberNames);

// cos_c^2 = 1 - eta^2 of the index as the number type has it.
template <class Real>
double critical_cosine(Real eta)
{
    const double e = double(eta);
    return std::sqrt((1 - e) * (1 + e));
}

constexpr double below_1[] = {0.01, 0.5, 0.6, 1 / 1.5, 0.75, 0.99};

// On the far side of the critical angle nothing passes, to the last bit.
TYPED_TEST(CriticalAngle, below_the_critical_cosine_F_is_exactly_1)
{
    using Real = TypeParam;
    for (double eta : below_1)
    {
        const WhileLibraryRuns guard;
        const DielectricFresnel<Real> fresnel_of{Real(eta)};
        const double critical = critical_cosine(Real(eta));
        for (double mu : {critical - 1e-6, 0.999 * critical, 0.5 * critical, 1e-7, 0.0})
        {
            EXPECT_EQ(fresnel_of.reflectance(Real(mu)), 1) << eta << " " << mu;
            EXPECT_EQ(fresnel_of.transmittance(Real(mu)), 0) << eta << " " << mu;
            EXPECT_FALSE(refract(towards<Real>(mu), Vec3<Real>(0, 0, 1), Real(eta)).valid);
        }
    }
}

// On the near side 1 - F begins with a root; F and 1 - F each keep their digits, as far as the
// cosine itself has them.
TYPED_TEST(CriticalAngle, above_the_critical_cosine_F_is_fresnels)
{
    using Real = TypeParam;
    for (double eta : below_1)
    {
        const DielectricFresnel<Real> fresnel_of{Real(eta)};
        const double critical = critical_cosine(Real(eta));
        for (double excess : {1e-7, 1e-6, 1e-4, 1e-2})
        {
            const Real mu = Real(critical + excess);
            const Exact from = Exact(mu) - critical;
            if (from <= 0 || mu > 1) continue;
            // g^2 = mu^2 - cos_c^2 is a difference; eta itself is rounded in the same way.
            const Exact g2 = Exact(mu) * mu - (1 - Exact(Real(eta)) * Real(eta));
            const double tolerance = 4 * rounding<Real> * (1 + double(critical * critical / g2));
            const double T = double(1 - fresnel(Exact(Real(eta)), 0, mu));
            const WhileLibraryRuns guard;
            EXPECT_NEAR(fresnel_of.transmittance(mu), T, tolerance * T + rounding<Real> / 4)
                << eta << " " << excess;
            EXPECT_NEAR(fresnel_of.reflectance(mu), 1 - T, tolerance * T + rounding<Real>);
        }
    }
}

// Exactly there, where the numbers are: eta 0.6, cos_c 0.8. Either answer is right to half an ulp
// of the cosine, and 1 - F = 4 (1 + 1 / eta^2) g / cos_c at most sqrt(ulp) away from 0.
TYPED_TEST(CriticalAngle, at_the_critical_cosine_F_and_1_minus_F_add_up)
{
    using Real = TypeParam;
    const DielectricFresnel<Real> fresnel_of(Real(0.6));
    const Real at = Real(0.8), ulp = std::numeric_limits<Real>::epsilon();
    for (Real mu : {at - ulp, at - ulp / 2, at, at + ulp / 2, at + ulp})
    {
        const WhileLibraryRuns guard;
        const auto F = fresnel_of.split(mu);
        EXPECT_NEAR(F.reflectance + F.transmittance, 1, rounding<Real>);
        EXPECT_LE(F.transmittance, 20 * std::sqrt(ulp));
        EXPECT_GE(F.transmittance, 0);
    }
}

// Smooth glass from inside: beyond the angle a perfect mirror, and alone its transmission is none.
TYPED_TEST(CriticalAngle, smooth_glass_is_a_perfect_mirror_beyond_it)
{
    using Real = TypeParam;
    const auto wanted = [](const Kind<Real>& kind) { return kind.lobe == Lobe::dielectric; };
    for_each_kind<Real>(wanted, [](const auto& kind) {
        const Parameters parameters = Parameters::white(0);
        const auto subject = kind.make(parameters);
        const double critical = critical_cosine(1 / parameters.eta);
        for (double mu : {critical - 1e-6, 0.5, 1e-3})
            for (Real z : {Real(0), Real(0.5), Real(1)})
            {
                const auto wo = towards<Real>(-mu);
                const auto s = subject->sample(wo, {Real(0.3), Real(0.6), z});
                if (kind.mode == ScatterMode::T)
                {
                    EXPECT_FALSE(s.valid);
                    continue;
                }
                ASSERT_TRUE(s.valid && s.delta && !s.transmitted);
                EXPECT_EQ(s.pdf, 1);
                EXPECT_NEAR(s.weight.x, 1, rounding<Real>);
                EXPECT_LT((s.wi - Vec3<Real>(-wo.x, -wo.y, wo.z)).length(), rounding<Real>);
            }
    });
}

// And this side of it, the share of Fresnel's formulas passes, flat along the other side.
TYPED_TEST(CriticalAngle, smooth_glass_transmits_1_minus_F_just_above_it)
{
    using Real = TypeParam;
    const auto wanted = [](const Kind<Real>& kind) {
        return kind.lobe == Lobe::dielectric && kind.mode == ScatterMode::RT && kind.is_bare();
    };
    for_each_kind<Real>(wanted, [](const auto& kind) {
        const Parameters parameters = Parameters::white(0);
        const auto subject = kind.make(parameters);
        const double mu = critical_cosine(1 / parameters.eta) + 1e-4;
        const auto wo = towards<Real>(-mu);
        const auto s = subject->sample(wo, {Real(0.3), Real(0.6), Real(1)});
        ASSERT_TRUE(s.valid && s.transmitted);
        const double T = double(1 - fresnel(1 / Exact(parameters.eta), 0, Exact(mu)));
        // A cosine known to an ulp, 1e-4 from where the slope is infinite.
        EXPECT_NEAR(s.pdf, T, T * 1e4 * rounding<Real>);
        EXPECT_LT(s.wi.z, std::sqrt(2 * 1e-4 * 1.5 * 1.5));
        EXPECT_GT(s.wi.z, 0);
    });
}

// A rough surface blurs the angle: nothing of it jumps when a direction crosses.
TYPED_TEST(CriticalAngle, rough_glass_does_not_jump_there)
{
    using Real = TypeParam;
    const auto wanted = [](const Kind<Real>& kind) {
        return kind.lobe == Lobe::dielectric && kind.mode == ScatterMode::RT && !kind.is_walk() &&
               !kind.has_tail();
    };
    for_each_kind<Real>(wanted, [](const auto& kind) {
        const Parameters parameters = Parameters::white(0.3);
        const auto subject = kind.make(parameters);
        const double critical = critical_cosine(1 / parameters.eta);
        const auto below = towards<Real>(-critical + 1e-6), above = towards<Real>(-critical - 1e-6);
        const auto a = subject->albedo(below), b = subject->albedo(above);
        // Tables are as exact as docs/support.md says, on either side by themselves.
        const double table = kind.shadowing == TransmissionShadowing::correlated ? 4e-3 : 5e-3;
        EXPECT_NEAR(a.reflect.x, b.reflect.x, table);
        EXPECT_NEAR(a.transmit.x, b.transmit.x, table);
        // Of a white interface no more than all light leaves; with compensation, all of it.
        EXPECT_LE(a.reflect.x + a.transmit.x, 1 + 1e-4);
        if (!kind.is_bare())
        {
            EXPECT_NEAR(a.reflect.x + a.transmit.x, 1, 1e-4);
        }
        for (double mu_i : {0.5, -0.5})
        {
            const auto wi = towards<Real>(mu_i, 3.5);
            const double f = double(subject->eval(below, wi).x),
                         g = double(subject->eval(above, wi).x);
            EXPECT_NEAR(f, g, 1e-3 * std::max(f, g));
        }
    });
}

}  // namespace
