// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Indices of refraction at and about 1, and at both ends. A renderer meets 1 where glass is faded
// out or lies in oil, values about 1 in air bubbles and heat, and anything where an index is
// painted.

#include "questions.h"

#include <gtest/gtest.h>

using namespace regain;
using namespace regain::tests;

namespace {

template <class Real>
class Indices : public testing::Test
{};
TYPED_TEST_SUITE(Indices, Numbers, NumberNames);

template <class Real>
const auto glass_like = [](const Kind<Real>& kind) { return kind.has_two_sides(); };

// Glass in oil of its own index cannot be seen: light goes straight on, and nothing comes back.
TYPED_TEST(Indices, an_index_of_1_lets_light_straight_on)
{
    using Real = TypeParam;
    for_each_kind<Real>(glass_like<Real>, [](const auto& kind) {
        // Added lobes know nothing of directions; tables of E^S < 1 at eta 1 give them light.
        if (kind.has_added_lobe()) return;
        for (double alpha : {0.0, 1e-3, 0.5, 1.0})
        {
            Parameters parameters = Parameters::white(alpha);
            parameters.eta = 1;
            const auto subject = kind.make(parameters);
            for (double mu : {0.9, 0.3, -0.6})
            {
                const auto wo = towards<Real>(mu);
                for (Real z : {Real(0), Real(0.5), Real(1)})
                {
                    const auto s = subject->sample(wo, {Real(0.3), Real(0.6), z});
                    if (kind.mode == ScatterMode::R)
                    {
                        EXPECT_EQ(s.weight, Color3<Real>(Real(0)));
                        continue;
                    }
                    // A sheet's facets lose at any index what a mirror's do.
                    if (kind.lobe == Lobe::sheet && !s.valid) continue;
                    ASSERT_TRUE(s.valid && s.delta && s.transmitted) << alpha << " " << mu;
                    EXPECT_LT((s.wi + wo).length(), 2 * rounding<Real>);
                    EXPECT_NEAR(s.pdf, 1, rounding<Real>);
                }
                for (double mu_i : {0.8, 0.1, -0.5, -0.95})
                    EXPECT_EQ(subject->eval(wo, towards<Real>(mu_i, 3)), Color3<Real>(Real(0)));
                EXPECT_EQ(subject->eval(wo, -wo), Color3<Real>(Real(0)));
                EXPECT_EQ(subject->pdf(wo, -wo), 0);
            }
        }
    });
}

// A fade to 1 has no last step: at 1 +- 1e-7 next to nothing is reflected, and what passes is
// turned by 1e-7 of a slope.
TYPED_TEST(Indices, an_index_within_1e_7_of_1_turns_light_by_no_more)
{
    using Real = TypeParam;
    const auto wanted = [](const Kind<Real>& kind) {
        return kind.is_bare() && kind.has_two_sides() && kind.mode == ScatterMode::RT;
    };
    for_each_kind<Real>(wanted, [](const auto& kind) {
        for (double eta : {1 + 1e-7, 1 - 1e-7})
            for (double alpha : {0.1, 1.0})
            {
                Parameters parameters = Parameters::white(alpha);
                parameters.eta = eta;
                const auto subject = kind.make(parameters);
                for (double mu : {0.9, 0.3, -0.6})
                {
                    const auto wo = towards<Real>(mu);
                    for (double u : {0.1, 0.5, 0.9})
                    {
                        const auto s = subject->sample(wo, {Real(0.3), Real(u), Real(0.5)});
                        if (kind.lobe == Lobe::sheet && !s.valid) continue;
                        ASSERT_TRUE(s.valid && s.transmitted);
                        // A sheet's two interfaces turn nothing, but its facets do.
                        if (kind.lobe == Lobe::dielectric || s.delta)
                        {
                            EXPECT_LT((s.wi + wo).length(), 1e-4);
                        }
                        // Choosing by F, it is worth the facet's shadowing: at most 1.
                        EXPECT_LE(s.weight.x, 1 + 20 * rounding<Real>);
                    }
                }
                const auto up =
                    kind.make(parameters)->sample({0, 0, 1}, {Real(0.3), Real(0.2), Real(0)});
                // F0 = (5e-8)^2 leaves a pdf of that times D.
                if (up.valid && !up.transmitted)
                {
                    EXPECT_LT(up.pdf, 1e-12);
                }
            }
    });
}

// The ends of the range, in closed form: F0 = ((eta - 1) / (eta + 1))^2 head on.
TYPED_TEST(Indices, smooth_glass_at_the_ends_reflects_F0)
{
    using Real = TypeParam;
    const auto wanted = [](const Kind<Real>& kind) {
        return kind.is_bare() && kind.lobe == Lobe::dielectric && kind.mode == ScatterMode::RT;
    };
    for_each_kind<Real>(wanted, [](const auto& kind) {
        for (double eta : {0.01, 0.5, 1.5, 100.0})
            for (double side : {1.0, -1.0})
            {
                Parameters parameters = Parameters::white(0);
                parameters.eta = eta;
                const auto subject = kind.make(parameters);
                const Vec3<Real> wo(0, 0, Real(side));
                const double r = (eta - 1) / (eta + 1), F0 = r * r;
                const auto R = subject->sample(wo, {Real(0.3), Real(0.6), Real(0)}),
                           T = subject->sample(wo, {Real(0.3), Real(0.6), Real(1)});
                EXPECT_NEAR(R.pdf, F0, 4 * rounding<Real>);
                EXPECT_NEAR(T.pdf, 1 - F0, 4 * rounding<Real>);
                EXPECT_LT((T.wi + wo).length(), rounding<Real>);
                EXPECT_NEAR(R.weight.x, 1, rounding<Real>);
                EXPECT_NEAR(T.weight.x, 1, rounding<Real>);
            }
    });
}

// Snell's law holds at the ends: sin_i = sin_o / eta.
TYPED_TEST(Indices, smooth_glass_refracts_by_snells_law_at_any_index)
{
    using Real = TypeParam;
    const auto wanted = [](const Kind<Real>& kind) {
        return kind.lobe == Lobe::dielectric && kind.mode == ScatterMode::RT &&
               !kind.has_added_lobe();
    };
    for_each_kind<Real>(wanted, [](const auto& kind) {
        for (double eta : {0.01, 0.9999999, 1.0000001, 1.5, 100.0})
            for (double mu : {0.99999, 0.5, -0.3, -0.99999})
            {
                Parameters parameters = Parameters::white(0);
                parameters.eta = eta;
                const auto subject = kind.make(parameters);
                const auto wo = towards<Real>(mu);
                const double eta_o = mu > 0 ? double(Real(eta)) : 1 / double(Real(eta));
                const double sine = std::hypot(double(wo.x), double(wo.y)) / eta_o;
                const auto s = subject->sample(wo, {Real(0.3), Real(0.6), Real(1)});
                ASSERT_TRUE(s.valid && s.delta);
                // Beyond the critical angle all is reflected, whatever the random number.
                ASSERT_EQ(s.transmitted, sine < 1) << eta << " " << mu;
                if (!s.transmitted) continue;
                // A cosine is known to an ulp, and so are squared sines, before eta multiplies.
                const double ulp = double(std::numeric_limits<Real>::epsilon());
                EXPECT_NEAR(std::hypot(double(s.wi.x), double(s.wi.y)), sine,
                            4 * rounding<Real> + ulp / (2 * eta_o * eta_o * sine));
                EXPECT_LT(s.wi.z * wo.z, 0);
            }
    });
}

// An index map painted in other units, an index of 0 for "none".
TYPED_TEST(Indices, indices_beyond_the_range_are_its_ends)
{
    const Member eta = [](Parameters& s) -> double& { return s.eta; };
    expect_taken_for<TypeParam>(glass_like<TypeParam>, eta, "eta",
                                {{1e-3, 1e-2},
                                 {0, 1e-2},
                                 {-0.0, 1e-2},
                                 {-1.5, 1e-2},
                                 {1e-30, 1e-2},
                                 {1e3, 1e2},
                                 {3e38, 1e2}});
}

TYPED_TEST(Indices, an_index_that_is_no_number_is_1_5)
{
    REGAIN_NEEDS_INFINITIES();
    const Member eta = [](Parameters& s) -> double& { return s.eta; };
    expect_taken_for<TypeParam>(glass_like<TypeParam>, eta, "eta",
                                {{tests::nan, 1.5}, {infinity, 1e2}, {-infinity, 1e-2}});
}

}  // namespace
