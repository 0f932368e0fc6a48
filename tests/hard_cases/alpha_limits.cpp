// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Widths at the ends of their range and beyond. A renderer meets them where a roughness is painted:
// black is a mirror, white is 1, and filters ring past both.

#include "questions.h"

#include <gtest/gtest.h>

using namespace regain;
using namespace regain::tests;

namespace {

template <class Real>
class AlphaLimits : public testing::Test
{
public:
    // At or below the bound of the number type: alpha_x, alpha_y.
    static std::vector<double> flat_widths()
    {
        return {0, 1e-30, sizeof(Real) == 4 ? 1e-7 : 1e-10, sizeof(Real) == 4 ? 1e-5 : 1e-9};
    }
};
TYPED_TEST_SUITE(AlphaLimits, Numbers, NumberNames);

template <class Real>
bool has_width(const Kind<Real>& kind)
{
    return !kind.distribution.empty() && kind.lobe != Lobe::sheened;
}

// A black texel of a roughness map is a mirror: one direction, F of it, and nothing to evaluate.
TYPED_TEST(AlphaLimits, a_width_of_zero_reflects_F_in_the_mirror_direction)
{
    using Real = TypeParam;
    for_each_kind<Real>(has_width<Real>, [&](const auto& kind) {
        if (kind.mode == ScatterMode::T) return;
        for (double alpha : this->flat_widths())
            for (double mu : {1e-3, 0.3, 1.0, -0.6})
            {
                if (mu < 0 && !kind.has_two_sides()) continue;
                const Parameters parameters = Parameters::isotropic(alpha);
                const auto subject = kind.make(parameters);
                const Vec3<Real> wo = towards<Real>(mu);
                const auto s = subject->sample(wo, {Real(0.3), Real(0.8), Real(0)});
                ASSERT_TRUE(s.valid && s.delta && !s.transmitted) << alpha;
                EXPECT_TRUE(subject->traits().delta);
                EXPECT_LT((s.wi - Vec3<Real>(-wo.x, -wo.y, wo.z)).length(), rounding<Real>);
                // A sheet has one medium on both sides.
                const double eta =
                    mu < 0 && kind.lobe == Lobe::dielectric ? 1 / parameters.eta : parameters.eta;
                const auto F = facet_reflectance(kind, parameters, eta, std::abs(double(wo.z)));
                // Glass with both lobes chooses one by F, which is then in the pdf.
                const bool chosen = kind.mode == ScatterMode::RT;
                const auto tint =
                    kind.has_two_sides() ? parameters.reflection_tint : Color3<double>(1.0);
                const double tolerance = 8 * rounding<Real>;
                expect_color_near(s.weight, chosen ? tint : F * tint, tolerance, "weight");
                EXPECT_NEAR(s.pdf, chosen ? F.x : 1, tolerance);
                EXPECT_EQ(subject->pdf(wo, s.wi), 0);
                EXPECT_EQ(subject->eval(wo, s.wi), Color3<Real>(Real(0)));
                EXPECT_EQ(subject->eval(wo, towards<Real>(0.5, 2)), Color3<Real>(Real(0)));
                EXPECT_EQ(subject->eval(wo, towards<Real>(-0.5, 2)), Color3<Real>(Real(0)));
            }
    });
}

// The albedo steers a renderer's choice of lobes. No method adds to a mirror's: it loses nothing.
TYPED_TEST(AlphaLimits, the_albedo_of_a_width_of_zero_is_F_with_every_method)
{
    using Real = TypeParam;
    for_each_kind<Real>(has_width<Real>, [&](const auto& kind) {
        const Parameters parameters = Parameters::isotropic(0);
        const auto subject = kind.make(parameters);
        for (double mu : {0.02, 0.5, 1.0})
        {
            const Vec3<Real> wo = towards<Real>(mu);
            const auto F = facet_reflectance(kind, parameters, parameters.eta, double(wo.z));
            const auto albedo = subject->albedo(wo);
            const Color3<double> none(0.0), all(1.0);
            const bool glass = kind.has_two_sides();
            // Of a walk through glass it is the mean of 1024 that choose: see closure.h.
            const bool estimate = glass && kind.is_walk();
            const double tolerance = estimate ? 2e-3 : 50 * rounding<Real>;
            expect_color_near(albedo.reflect,
                              kind.mode == ScatterMode::T ? none
                              : glass                     ? F * parameters.reflection_tint
                                                          : F,
                              tolerance, "reflected");
            expect_color_near(albedo.transmit,
                              glass && kind.mode != ScatterMode::R
                                  ? (all - F) * parameters.transmission_tint
                                  : none,
                              tolerance, "transmitted");
        }
    });
}

// Nearly smooth metal: the lobe is a few alpha wide and weighs F, and the gain is 1.
TYPED_TEST(AlphaLimits, a_narrow_lobe_reflects_F_close_to_the_mirror_direction)
{
    using Real = TypeParam;
    const auto wanted = [](const auto& kind) {
        return kind.is_mirror() && !kind.has_added_lobe() &&
               (kind.distribution == "ggx" || kind.distribution == "beckmann");
    };
    for_each_kind<Real>(wanted, [&](const auto& kind) {
        std::vector<double> widths{1e-4, 1e-3};
        if (sizeof(Real) == 8) widths.push_back(1e-7);
        for (double alpha : widths)
        {
            const Parameters parameters = Parameters::isotropic(alpha);
            const auto subject = kind.make(parameters);
            const Vec3<Real> wo = towards<Real>(0.8), mirror(-wo.x, -wo.y, wo.z);
            const auto F = facet_reflectance(kind, parameters, 1, double(wo.z));
            for (double u : {0.1, 0.5, 0.9})
                for (double v : {0.1, 0.5, 0.9})
                {
                    const auto s = subject->sample(wo, {Real(u), Real(v), Real(0.999)});
                    ASSERT_TRUE(s.valid && !s.delta);
                    // Nine tenths of GGX's slopes are below 3 alpha, and a slope turns by twice.
                    EXPECT_LT((s.wi - mirror).length(), 10 * alpha);
                    // Nodes of a balance are levelled about 1, which nothing clamps.
                    const double levelled = kind.method == "balanced" ? 5e-4 : 0;
                    expect_color_near(s.weight, F, 10 * alpha * alpha + 3 * alpha + levelled,
                                      "weight");
                }
        }
    });
}

// The roughest surface there is. By GGX's law it reflects 1 - ln 2 of what meets it head on, once.
TEST(AlphaOne, ggx_reflects_1_minus_ln_2_at_normal_incidence)
{
    for_each_kind<double>(
        [](const auto& kind) {
            return kind.lobe == Lobe::schlick && kind.is_bare() && kind.distribution == "ggx";
        },
        [](const auto& kind) {
            const auto subject = kind.make(Parameters::white(1));
            double sum = 0;
            constexpr int n = 256;
            for (int i = 0; i < n; ++i)  // all azimuths are alike
                sum += subject->sample({0, 0, 1}, {0.25, (i + 0.5) / n, 0.5}).weight.x / n;
            EXPECT_NEAR(sum, 1 - std::log(2.0), 1e-5);
        });
}

#ifndef REGAIN_HARD_CASES_OF_GGX
// At alpha 1 the tail parameter of GTR drops out: an artist's slider must not change the picture.
TYPED_TEST(AlphaLimits, gtr_of_width_one_is_ggx_for_every_gamma)
{
    using Real = TypeParam;
    const auto find = [](const char* distribution) {
        for (const auto& kind : kinds<Real>())
            if (kind.distribution == distribution && kind.lobe == Lobe::schlick && kind.is_bare())
                return kind;
        throw std::logic_error("no such kind");
    };
    Parameters parameters = Parameters::isotropic(1);
    const auto ggx = find("ggx").make(parameters);
    for (double gamma : {1e-3, 0.5, 1.0, 1.999999, 2.0, 2.5, 10.0})
    {
        parameters.gamma = gamma;
        const auto gtr = find("gtr").make(parameters);
        for (double mu : {1e-4, 0.2, 1.0})
            for (double mu_i : {1e-2, 0.7, 1.0})
            {
                const auto wo = towards<Real>(mu), wi = towards<Real>(mu_i, 2.0);
                const double expected = double(ggx->eval(wo, wi).x);
                EXPECT_NEAR(gtr->eval(wo, wi).x, expected, 20 * rounding<Real> * expected) << gamma;
            }
    }
}
#endif

// Brushed metal, polished along one axis: a row of mirrors, which keeps the x of a direction.
TYPED_TEST(AlphaLimits, a_width_of_zero_on_one_axis_turns_x_round_and_spreads_y)
{
    using Real = TypeParam;
    const auto wanted = [](const auto& kind) {
        return kind.is_mirror() && !kind.has_added_lobe() && !kind.is_walk() && !kind.has_tail();
    };
    for_each_kind<Real>(wanted, [&](const auto& kind) {
        Parameters parameters, bound;
        parameters.alpha_x = 0;
        bound.alpha_x = sizeof(Real) == 4 ? 1e-5 : 1e-9;
        parameters.alpha_y = bound.alpha_y = 1;
        const auto subject = kind.make(parameters);
        EXPECT_FALSE(subject->traits().delta);
        expect_same_answers<Real>(*subject, *kind.make(bound), "alpha_x 0");
        const Vec3<Real> wo = towards<Real>(0.8, 0.4);
        double spread = 0;
        for (double u : {0.1, 0.3, 0.5, 0.7, 0.9})
            for (double v : {0.1, 0.5, 0.9})
            {
                const auto s = subject->sample(wo, {Real(u), Real(v), Real(0.5)});
                if (!s.valid) continue;
                EXPECT_FALSE(s.delta);
                EXPECT_NEAR(s.wi.x, -wo.x, 20 * bound.alpha_x);
                spread = std::max(spread, std::abs(double(s.wi.y) + double(wo.y)));
            }
        EXPECT_GT(spread, 0.5);
    });
}

// White metal that is as rough as can be gives all light back: the compensation is all that counts.
TEST(AlphaOne, every_compensating_method_gives_white_light_back)
{
    for_each_kind<double>(
        [](const auto& kind) { return kind.lobe == Lobe::schlick && !kind.is_bare(); },
        [](const auto& kind) {
            const auto subject = kind.make(Parameters::white(1));
            const auto wo = towards<double>(0.6);
            constexpr int n = 40;
            double sum = 0, squares = 0;
            for (int j = 0; j < n; ++j)
                for (int i = 0; i < n; ++i)
                {
                    const double third = (i * n + j + 0.5) * 0.6180339887498949;
                    const double w =
                        subject->sample(wo, {(i + 0.5) / n, (j + 0.5) / n, third - int(third)})
                            .weight.x;
                    if (kind.is_walk())
                    {
                        EXPECT_NEAR(w, 1, 1e-14);
                    }
                    sum += w / (n * n);
                    squares += w * w / (n * n);
                }
            // docs/support.md for the tables, and four standard errors of random points for these,
            // which are more even than such.
            const double table = kind.has_tail() ? 3e-3 : 1e-3;
            const double error = std::sqrt(std::max(squares - sum * sum, 0.0)) / n;
            EXPECT_NEAR(sum, 1, table + 4 * error);
        });
}

// A slider beyond its end, an image whose filter rings: the nearest width there is.
TYPED_TEST(AlphaLimits, widths_beyond_the_range_are_its_ends)
{
    const Member alpha_x = [](Parameters&s) -> double & { return s.alpha_x; },
                 alpha_y = [](Parameters&s) -> double & { return s.alpha_y; };
    const auto cases = {Taken{2, 1},     Taken{1 + 1e-7, 1}, Taken{3e38, 1},
                        Taken{-0.5, 0},  Taken{-0.0, 0},     Taken{-1e-30, 0},
                        Taken{1e-38, 0}, Taken{1e-45, 0},    Taken{-3e38, 0}};
    expect_taken_for<TypeParam>(has_width<TypeParam>, alpha_x, "alpha_x", cases);
    expect_taken_for<TypeParam>(has_width<TypeParam>, alpha_y, "alpha_y", cases);
}

// A missing texture, a division by zero in a network: NaN is a rough surface, as documented.
TYPED_TEST(AlphaLimits, a_width_that_is_no_number_is_1)
{
    REGAIN_NEEDS_INFINITIES();
    const Member alpha_x = [](Parameters&s) -> double & { return s.alpha_x; },
                 alpha_y = [](Parameters&s) -> double & { return s.alpha_y; };
    const auto cases = {Taken{tests::nan, 1}, Taken{infinity, 1}, Taken{-infinity, 0}};
    expect_taken_for<TypeParam>(has_width<TypeParam>, alpha_x, "alpha_x", cases);
    expect_taken_for<TypeParam>(has_width<TypeParam>, alpha_y, "alpha_y", cases);
}

}  // namespace
