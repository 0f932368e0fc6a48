// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Colours and indices of metals at the ends of their ranges. A renderer meets them where a colour
// is black or white, or where n and k come from a picture or a slider.

#include "kinds.h"
#include "questions.h"

#include <regain/closures/artist_fresnel.h>
#include <regain/closures/conductor_fresnel.h>
#include <regain/closures/dielectric_fresnel.h>
#include <regain/closures/schlick_fresnel.h>
#include <regain/closures/xsimd.h>

#include <gtest/gtest.h>

using namespace regain;
using namespace regain::tests;

namespace {

template <class Real>
class FresnelLimits : public testing::Test
{};
TYPED_TEST_SUITE(FresnelLimits, Numbers, NumberNames);

constexpr double cosines_[] = {0, 1e-30, 1e-7, 1e-4, 1e-2, 0.3, 0.7, 1 - 1e-7, 1};

template <class Real>
ConductorFresnel<Real> conductor(double n, double k)
{
    return {Color3<Real>(Real(n)), Color3<Real>(Real(k))};
}

// Black, and as a colour of a metal: nothing is left, by any method, but the edge.
TYPED_TEST(FresnelLimits, a_black_metal_without_an_edge_is_black)
{
    using Real = TypeParam;
    const auto wanted = [](const auto& kind) { return kind.lobe == Lobe::schlick; };
    for_each_kind<Real>(wanted, [](const auto& kind) {
        Parameters parameters;
        parameters.color0 = parameters.color90 = Color3<double>(0.0);
        const auto subject = kind.make(parameters);
        for (double mu : {1e-4, 0.5, 1.0})
        {
            const auto wo = towards<Real>(mu);
            const Color3<Real> black(Real(0));
            EXPECT_EQ(subject->eval(wo, towards<Real>(0.4, 3)), black);
            EXPECT_EQ(subject->albedo(wo).reflect, black);
            for (Real u : {Real(0), Real(0.4), Real(1)})
                EXPECT_EQ(subject->sample(wo, {u, u, u}).weight, black);
        }
    });
}

// White is F = 1 at every cosine: the furnace's mirror, exactly, so that nothing is lost in it.
TYPED_TEST(FresnelLimits, white_is_exactly_1_at_every_cosine)
{
    using Real = TypeParam;
    const WhileLibraryRuns guard;
    const SchlickFresnel<Real> white(Color3<Real>(Real(1)));
    for (double mu : cosines_) EXPECT_EQ(white.at(Real(mu)), Color3<Real>(Real(1)));
    EXPECT_EQ(white.normal_incidence(), Color3<Real>(Real(1)));
    EXPECT_EQ(white.average(), Color3<Real>(Real(1)));
}

// A colour above 1, from an image in another scale, is white; no metal makes light.
TYPED_TEST(FresnelLimits, colours_beyond_0_and_1_are_their_ends)
{
    const auto schlick_like = [](const auto& kind) { return kind.lobe == Lobe::schlick; };
    const auto cases = {Taken{1.5, 1}, Taken{3e38, 1},   Taken{1 + 1e-6, 1},
                        Taken{-1, 0},  Taken{-0.0, 0.0}, Taken{-1e-30, 0}};
    const Member color0 = [](Parameters&s) -> double & { return s.color0.x; },
                 color82 = [](Parameters&s) -> double & { return s.color82.y; },
                 color90 = [](Parameters&s) -> double & { return s.color90.z; };
    expect_taken_for<TypeParam>(schlick_like, color0, "color0", cases);
    expect_taken_for<TypeParam>(schlick_like, color82, "color82", cases);
    expect_taken_for<TypeParam>(schlick_like, color90, "color90", cases);
}

// n = 0, a perfect plasma: it lets nothing in and absorbs nothing.
TYPED_TEST(FresnelLimits, an_index_of_0_reflects_everything)
{
    using Real = TypeParam;
    for (double k : {0.0, 1e-3, 1.0, 5.0, 1e4})
        for (double mu : cosines_)
        {
            const WhileLibraryRuns guard;
            EXPECT_EQ(conductor<Real>(0, k).at(Real(mu)).x, 1) << k << " " << mu;
        }
}

// n = 1, k = 0 is air: nothing is reflected, except along the surface, where 0 / 0 means 1 for any
// other index and nothing is there to reflect for this one.
TYPED_TEST(FresnelLimits, air_reflects_nothing)
{
    using Real = TypeParam;
    for (double mu : cosines_)
    {
        const WhileLibraryRuns guard;
        const Real metal = conductor<Real>(1, 0).at(Real(mu)).x,
                   glass = DielectricFresnel<Real>(Real(1)).reflectance(Real(mu));
        EXPECT_EQ(glass, 0) << mu;
        if (mu >= 1e-7)
        {
            EXPECT_LE(metal, rounding<Real>) << mu;
        }
    }
}

// k = 0 is a dielectric: textures of k are black between the metal parts.
TYPED_TEST(FresnelLimits, without_extinction_a_conductor_is_a_dielectric)
{
    using Real = TypeParam;
    for (double n : {0.01, 0.5, 0.8, 1.1, 1.5, 4.0, 100.0})
        for (double mu : {1e-7, 1e-4, 1e-2, 0.3, 0.7, 1.0})
        {
            // About the critical angle both follow the last digit of n.
            if (n < 1 && std::abs(mu * mu - (1 - n * n)) < 1e-2) continue;
            const WhileLibraryRuns guard;
            const Real metal = conductor<Real>(n, 0).at(Real(mu)).x,
                       glass = DielectricFresnel<Real>(Real(n)).reflectance(Real(mu));
            EXPECT_NEAR(metal, glass, 8 * rounding<Real>) << n << " " << mu;
        }
}

// The textbook's complex arithmetic in long double, at extremes of n and k.
TYPED_TEST(FresnelLimits, extreme_metals_follow_the_textbook)
{
    using Real = TypeParam;
    for (double n : {1e-6, 0.05, 1.0, 3.0, 1e4})
        for (double k : {1e-6, 0.5, 10.0, 1e4})
            for (double mu : cosines_)
            {
                const Real rn = Real(n), rk = Real(k), rmu = Real(mu);
                const double expected = double(fresnel(rn, rk, rmu));
                const WhileLibraryRuns guard;
                EXPECT_NEAR(conductor<Real>(n, k).at(rmu).x, expected, 4 * rounding<Real>)
                    << n << " " << k << " " << mu;
            }
}

// Head on, an artist's metal is the colour that was asked for; white has no index, and is 0.999.
TYPED_TEST(FresnelLimits, an_artists_metal_is_its_colour_head_on)
{
    using Real = TypeParam;
    for (double r : {0.0, 1e-6, 0.5, 0.999, 1.0, 2.0})
        for (double g : {0.0, 0.5, 1.0})
        {
            const WhileLibraryRuns guard;
            const ArtistFresnel<Real> metal(Color3<Real>{Real(r)}, Color3<Real>{Real(g)});
            const double expected = std::min(r, 0.999);
            EXPECT_NEAR(metal.at(Real(1)).x, expected, 20 * rounding<Real>) << r << " " << g;
            EXPECT_NEAR(metal.normal_incidence().x, expected, rounding<Real>);
            EXPECT_NEAR(metal.at(Real(0)).x, 1, rounding<Real>);
        }
}

// F82 is named for what it does: at cos 82 degrees, 1 / 7, it multiplies. At 0 that angle is black.
TYPED_TEST(FresnelLimits, the_tint_multiplies_at_one_seventh)
{
    using Real = TypeParam;
    for (double F0 : {0.0, 0.04, 0.9, 1.0})
        for (double tint : {0.0, 0.5, 1.0})
        {
            const WhileLibraryRuns guard;
            const SchlickFresnel<Real> curve(Color3<Real>{Real(F0)}, Color3<Real>{Real(tint)});
            const double untinted = F0 + (1 - F0) * std::pow(6.0 / 7, 5);
            EXPECT_NEAR(curve.at(Real(1.0 / 7)).x, tint * untinted, rounding<Real>);
            EXPECT_NEAR(curve.at(Real(0)).x, 1, rounding<Real>);
            EXPECT_NEAR(curve.at(Real(1)).x, F0, rounding<Real>);
        }
}

// An exponent of 0 makes (1 - mu)^0 = 1: the edge's colour everywhere, head on as well, in vectors
// as well, where powers are taken by logarithms.
TYPED_TEST(FresnelLimits, an_exponent_of_0_is_the_edge_everywhere)
{
    using Real = TypeParam;
    const WhileLibraryRuns guard;
    const Color3<Real> F0{Real(0.2)}, one{Real(1)}, F90{Real(0.7)};
    const SchlickFresnel<Real> flat(F0, one, F90, Real(0));
    for (double mu : cosines_) EXPECT_NEAR(flat.at(Real(mu)).x, 0.7, rounding<Real>) << mu;
    EXPECT_NEAR(flat.normal_incidence().x, 0.7, rounding<Real>);
    EXPECT_NEAR(flat.average().x, 0.7, rounding<Real>);
}

TEST(FresnelLimitsOfVectors, an_exponent_of_0_is_the_edge_everywhere)
{
    if (!vectors_are_promised) GTEST_SKIP() << "vectors are not promised under clang's -ffast-math";
    using Batch = xsimd::batch<float>;
    const WhileLibraryRuns guard;
    const Color3<Batch> F0{Batch(0.2f)}, one{Batch(1.0f)}, F90{Batch(0.7f)};
    const SchlickFresnel<Batch> flat(F0, one, F90, Batch(0.0f));
    for (double mu : cosines_) EXPECT_NEAR(flat.at(Batch(float(mu))).x.get(0), 0.7f, 2e-6f) << mu;
}

// Exponents at the other end: the edge is a line, and everything else F0.
TYPED_TEST(FresnelLimits, an_exponent_of_100_leaves_F0_but_at_the_edge)
{
    using Real = TypeParam;
    const WhileLibraryRuns guard;
    const Color3<Real> F0{Real(0.2)}, one{Real(1)}, F90{Real(0.7)};
    const SchlickFresnel<Real> steep(F0, one, F90, Real(100));
    EXPECT_NEAR(steep.at(Real(1)).x, 0.2, rounding<Real>);
    EXPECT_NEAR(steep.at(Real(0.3)).x, 0.2, rounding<Real>);
    EXPECT_NEAR(steep.at(Real(0)).x, 0.7, rounding<Real>);
    EXPECT_NEAR(steep.average().x, 0.2 + 0.5 * 2 / (101.0 * 102.0), rounding<Real>);
}

}  // namespace
