// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Infinities and NaN in colours. Half-float images hold infinities where a light was in view, and
// a division in a shading network makes NaN: one texel in one channel. What it is taken for stands
// in the headers, and the other channels never feel it.

#include "questions.h"

#include <regain/closures/sheen.h>

#include <gtest/gtest.h>

using namespace regain;
using namespace regain::tests;

namespace {

template <class Real>
class Textures : public testing::Test
{};
TYPED_TEST_SUITE(Textures, Numbers, NumberNames);

struct Painted
{
    const char* name;
    Lobe lobe;
    Color3<double>& (*of)(Parameters&);
    double at_nan, at_infinity, at_minus_infinity;
};

// As the headers document them.
constexpr Painted colours[] = {{"n", Lobe::conductor, [](Parameters& s) -> auto& {return s.n;
}  // namespace
, 1, 1e4, 0
}
, {"k", Lobe::conductor, [](Parameters& s) -> auto& {return s.k;
}
, 0, 1e4, 0
}
, {"n under sheen", Lobe::sheened, [](Parameters& s) -> auto& {return s.n;
}
, 1, 1e4, 0
}
, {"color0", Lobe::schlick, [](Parameters& s) -> auto& {return s.color0;
}
, 0, 1, 0
}
, {"color82", Lobe::schlick, [](Parameters& s) -> auto& {return s.color82;
}
, 0, 1, 0
}
, {"color90", Lobe::schlick, [](Parameters& s) -> auto& {return s.color90;
}
, 0, 1, 0
}
, {"reflection tint", Lobe::dielectric, [](Parameters& s) -> auto& {return s.reflection_tint;
}
, 0, 1, 0
}
, {"transmission tint", Lobe::dielectric, [](Parameters& s) -> auto& {return s.transmission_tint;
}
, 0, 1, 0
}
, {"reflection tint", Lobe::sheet, [](Parameters& s) -> auto& {return s.reflection_tint;
}
, 0, 1, 0
}
, {"transmission tint", Lobe::sheet, [](Parameters& s) -> auto& {return s.transmission_tint;
}
, 0, 1, 0
}
, {"albedo", Lobe::diffuse, [](Parameters& s) -> auto& {return s.albedo;
}
, 0, 1, 0
}
, {"sheen color", Lobe::sheen, [](Parameters& s) -> auto& {return s.sheen_color;
}
, 0, 100, 0
}
,
}
;

template <class Real>
void expect_taken(const Painted& p, double given, double meant)
{
    for_each_kind<Real>([&](const auto& kind) { return kind.lobe == p.lobe; },
                        [&](const auto& kind) {
                            for (int channel = 0; channel < 3; ++channel)
                            {
                                Parameters bad, good;
                                p.of(bad)[channel] = given;
                                p.of(good)[channel] = meant;
                                expect_same_answers<Real>(
                                    *kind.make(bad), *kind.make(good),
                                    std::string(p.name) + " " + std::to_string(given));
                            }
                        });
}

TYPED_TEST(Textures, a_colour_that_is_no_number_is_what_its_header_says)
{
    REGAIN_NEEDS_INFINITIES();
    for (const Painted& p : colours) expect_taken<TypeParam>(p, tests::nan, p.at_nan);
}
TYPED_TEST(Textures, an_infinite_colour_is_the_end_of_its_range)
{
    REGAIN_NEEDS_INFINITIES();
    for (const Painted& p : colours)
    {
        expect_taken<TypeParam>(p, infinity, p.at_infinity);
        expect_taken<TypeParam>(p, -infinity, p.at_minus_infinity);
    }
}
// The largest numbers that are finite: overflow is next to them.
TYPED_TEST(Textures, a_huge_colour_is_the_end_of_its_range)
{
    for (const Painted& p : colours)
    {
        expect_taken<TypeParam>(p, 3e38, p.at_infinity);
        expect_taken<TypeParam>(p, -3e38, p.at_minus_infinity);
    }
}

// One bad channel: the other two are what they were.
TYPED_TEST(Textures, a_bad_channel_leaves_the_others_alone)
{
    REGAIN_NEEDS_INFINITIES();
    using Real = TypeParam;
    for (const Painted& p : colours)
        for_each_kind<Real>(
            // Where samples choose by the colours' sum, or walk by them, channels are one.
            [&](const auto& kind) {
                return kind.lobe == p.lobe && !kind.has_added_lobe() && !kind.is_walk();
            },
            [&](const auto& kind) {
                Parameters bad;
                p.of(bad).y = tests::nan;
                const auto a = kind.make(bad), b = kind.make(Parameters());
                const auto wo = towards<Real>(0.5);
                for (double mu : {0.4, -0.7})
                {
                    const auto f = a->eval(wo, towards<Real>(mu, 3)),
                               g = b->eval(wo, towards<Real>(mu, 3));
                    EXPECT_EQ(f.x, g.x);
                    EXPECT_EQ(f.z, g.z);
                    EXPECT_EQ(a->pdf(wo, towards<Real>(mu, 3)), b->pdf(wo, towards<Real>(mu, 3)));
                }
            });
}

// Numbers that are no colours but painted, too.
TYPED_TEST(Textures, an_exponent_and_a_weight_of_no_number_are_what_their_headers_say)
{
    REGAIN_NEEDS_INFINITIES();
    const Member exponent = [](Parameters&s) -> double & { return s.exponent; },
                 weight = [](Parameters&s) -> double & { return s.sheen_weight; };
    expect_taken_for<TypeParam>([](const auto& kind) { return kind.lobe == Lobe::schlick; },
                                exponent, "exponent",
                                {{tests::nan, 5}, {infinity, 100}, {-infinity, 0}});
    expect_taken_for<TypeParam>([](const auto& kind) { return kind.lobe == Lobe::sheen; }, weight,
                                "weight", {{tests::nan, 0}, {infinity, 1}, {-infinity, 0}});
}

// The tint of a sheen divides by a luminance: of black, and of what is none, it stays white.
TYPED_TEST(Textures, sheen_of_a_base_without_luminance_is_white)
{
    REGAIN_NEEDS_INFINITIES();
    using Real = TypeParam;
    const Color3<Real> black(Real(0)), white(Real(1));
    for (double luminance : {0.0, 1e-30, -1.0, tests::nan, -infinity})
    {
        const WhileLibraryRuns guard;
        EXPECT_EQ(sheen_color(black, Real(luminance), Real(1)), white) << luminance;
    }
    const WhileLibraryRuns guard;
    const Color3<Real> bad(Real(tests::nan), Real(0.5), Real(infinity));
    examine(sheen_color(bad, Real(0.5), Real(1)), "sheen_color");
    EXPECT_EQ(sheen_color(bad, Real(0.5), Real(1)).y, 1);
}

}  // namespace
