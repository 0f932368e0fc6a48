// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Directions along the surface. A renderer meets them at every silhouette, and where a shading
// normal leans away from the viewer; there cosines cancel, and are what everything is divided by.

#include "questions.h"

#include <gtest/gtest.h>

using namespace regain;
using namespace regain::tests;

namespace {

template <class Real>
class Grazing : public testing::Test
{};
TYPED_TEST_SUITE(Grazing, Numbers, NumberNames);

// Silhouettes exactly: a cosine of 0, of either sign, and cosines too small to divide by.
TYPED_TEST(Grazing, on_the_horizon_everything_is_black)
{
    using Real = TypeParam;
    for_each_kind<Real>([](const auto& kind) {
        const auto subject = kind.make(Parameters());
        const auto w = towards<Real>(0.5);
        const Color3<Real> black(Real(0));
        for (double z : {0.0, -0.0, 1e-30, -1e-30, 9e-13, -9e-13})
        {
            const Vec3<Real> flat(Real(0.6), Real(-0.8), Real(z));
            EXPECT_EQ(subject->eval(flat, w), black) << z;
            EXPECT_EQ(subject->eval(w, flat), black) << z;
            EXPECT_EQ(subject->eval(flat, flat), black) << z;
            EXPECT_EQ(subject->pdf(flat, w), 0) << z;
            EXPECT_EQ(subject->pdf(w, flat), 0) << z;
            EXPECT_FALSE(subject->sample(flat, {Real(0.3), Real(0.6), Real(0.2)}).valid) << z;
        }
        const auto albedo = subject->albedo({1, 0, 0});
        EXPECT_EQ(albedo.reflect, black);
        EXPECT_EQ(albedo.transmit, black);
    });
}

// A hair above it, lobes answer: with both directions there, too.
TYPED_TEST(Grazing, just_above_the_horizon_everything_answers)
{
    using Real = TypeParam;
    const auto wanted = [](const auto& kind) { return kind.mode == ScatterMode::RT; };
    for_each_kind<Real>(wanted, [](const auto& kind) {
        const auto subject = kind.make(Parameters::isotropic(0.5));
        for (double z : {2e-12, 1e-7, 1e-4, 1e-2, 1.0})
            for (double side : {1.0, -1.0})
            {
                const auto wo = towards<Real>(side * z);
                int found = 0;
                for (double u : {0.1, 0.3, 0.5, 0.7, 0.9})
                    for (double v : {0.1, 0.5, 0.9})
                        if (subject->sample(wo, {Real(v), Real(u), Real(v)}).valid) ++found;
                EXPECT_GT(found, 0) << side * z;
            }
    });
}

template <class Real>
const auto closed_form =
    [](const Kind<Real>& kind) { return kind.is_mirror() && kind.is_bare() && !kind.has_tail(); };

// The limit has a closed form: f cos_i = F D / (4 sigma_o), sigma_o being half the mean slope.
TYPED_TEST(Grazing, as_wo_sinks_eval_tends_to_F_D_over_4_sigma)
{
    using Real = TypeParam;
    for_each_kind<Real>(closed_form<Real>, [](const auto& kind) {
        for (double alpha : {0.3, 1.0})
            for (double mu : {1e-11, 1e-7, 1e-4})
            {
                const Parameters parameters = Parameters::isotropic(alpha);
                const Surface surface{kind.distribution == "beckmann", Exact(alpha)};
                const auto wo = towards<Real>(mu), wi = towards<Real>(0.5, 3.0);
                const Half facet(exactly(wo), exactly(wi));
                const double value = double(surface.D(facet.tan2) / (4 * surface.grazing_area()));
                const auto F = facet_reflectance(kind, parameters, 1, double(facet.cosine));
                // What is left out of sigma is of the order of mu.
                expect_color_near(kind.make(parameters)->eval(wo, wi), F * value,
                                  value * (4 * mu / alpha + 20 * rounding<Real>), "eval");
            }
    });
}

// The textbook's formula in long double, both directions anywhere: nothing cancels.
TYPED_TEST(Grazing, eval_is_the_textbooks_at_any_cosines)
{
    using Real = TypeParam;
    for_each_kind<Real>(closed_form<Real>, [](const auto& kind) {
        for (double alpha : {1e-3, 0.5, 1.0})
        {
            const Parameters parameters = Parameters::isotropic(alpha);
            const Surface surface{kind.distribution == "beckmann", Exact(alpha)};
            const auto subject = kind.make(parameters);
            for (double mu_o : {1e-7, 1e-4, 1e-2, 0.5, 1.0})
                for (double mu_i : {1e-7, 1e-4, 1e-2, 0.5, 1.0})
                    for (double azimuth : {0.1, 1.5, 3.1415926})
                    {
                        const auto wo = towards<Real>(mu_o, 0), wi = towards<Real>(mu_i, azimuth);
                        const auto o = exactly(wo), i = exactly(wi);
                        const Half facet(o, i);
                        const double value = double(single_scattering(surface, o, i));
                        const auto F = facet_reflectance(kind, parameters, 1, double(facet.cosine));
                        // A half-vector is known to an ulp; D varies over alpha, at tan theta_m
                        // over alpha times as fast, and Beckmann's with the square of that.
                        const double steep =
                            double(std::sqrt(facet.tan2)) / alpha / alpha + 1 / alpha;
                        const double tolerance =
                            40 * rounding<Real> * (1 + (surface.gaussian ? steep : 1 / alpha));
                        if (tolerance > 0.1) continue;
                        const auto f = subject->eval(wo, wi);
                        for (int c = 0; c < 3; ++c)
                            EXPECT_NEAR(f[c], F[c] * value,
                                        tolerance * F[c] * value + 1e-30 / alpha / alpha)
                                << alpha << " " << mu_o << " " << mu_i << " " << azimuth;
                    }
        }
    });
}

// A path can be walked from either end: f(wo, wi) = f(wi, wo), across an interface times eta^2.
TYPED_TEST(Grazing, what_is_reciprocal_stays_so_along_the_surface)
{
    using Real = TypeParam;
    const auto wanted = [](const auto& kind) { return !kind.is_walk(); };
    for_each_kind<Real>(wanted, [](const auto& kind) {
        const Parameters parameters = Parameters::isotropic(0.5);
        const auto subject = kind.make(parameters);
        if (!subject->traits().reciprocal) return;
        for (double mu_o : {1e-4, 1e-2, 0.7, -1e-3})
            for (double mu_i : {1e-3, 0.4, -1e-2, -0.9})
                for (double azimuth : {0.3, 2.9})
                {
                    const auto wo = towards<Real>(mu_o, 0), wi = towards<Real>(mu_i, azimuth);
                    const auto there = subject->eval(wo, wi), back = subject->eval(wi, wo);
                    const bool across = (mu_o > 0) != (mu_i > 0) && kind.lobe == Lobe::dielectric;
                    const double eta_o = mu_o > 0 ? parameters.eta : 1 / parameters.eta,
                                 scale = across ? eta_o * eta_o : 1;
                    for (int c = 0; c < 3; ++c)
                    {
                        const double a = double(there[c]) / std::abs(mu_i),
                                     b = double(back[c]) / std::abs(mu_o) * scale;
                        EXPECT_NEAR(a, b, 1e3 * rounding<Real> * std::max(a, b))
                            << mu_o << " " << mu_i << " " << azimuth;
                    }
                }
    });
}

// What a float renderer sees along a silhouette is what a double one sees: its mean sample.
TEST(GrazingFloat, reflects_as_much_as_double)
{
    const auto& doubles = kinds<double>();
    const auto mean = [](const auto& subject, const auto& wo, const auto& number) {
        using Real = std::decay_t<decltype(number)>;
        Color3<double> sum(0.0);
        constexpr int n = 12;
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
            {
                const double third = (i * n + j + 0.5) * 0.6180339887498949;
                const Vec3<Real> u(Real((i + 0.5) / n), Real((j + 0.5) / n),
                                   Real(third - int(third)));
                const auto s = subject->sample(wo, u);
                sum += Color3<double>(s.weight) * (1.0 / (n * n));
            }
        return sum;
    };
    for_each_kind<float>(
        // Streams of random numbers, which walks and tails draw, are made from the bits.
        [](const auto& kind) {
            return !kind.is_walk() && !kind.has_tail() && !kind.distribution.empty() &&
                   (!kind.is_mirror() || kind.is_bare() || kind.method == "turquin" ||
                    kind.has_added_lobe());
        },
        [&](const auto& kind) {
            std::string name = kind.name;
            if (kind.batch) name.resize(name.find(", in vectors"));
            for (const auto& other : doubles)
            {
                if (other.name != name) continue;
                const Parameters parameters = Parameters::isotropic(0.5);
                for (double mu : {1e-7, 1e-3})
                {
                    const auto single = mean(kind.make(parameters), towards<float>(mu), 0.0f),
                               precise = mean(other.make(parameters), towards<double>(mu), 0.0);
                    // One sample of 144 may fall on the other side of a choice.
                    expect_color_near(Color3<float>(single), precise, 1e-2, "mean weight");
                }
                return;
            }
            ADD_FAILURE() << "there is no double of " << name;
        });
}

// At the horizon a compensated white metal still gives everything back, in float as well.
TYPED_TEST(Grazing, a_white_metal_along_the_horizon_gives_everything_back)
{
    using Real = TypeParam;
    const auto wanted = [](const Kind<Real>& kind) {
        return kind.lobe == Lobe::schlick && kind.method == "turquin" && !kind.has_tail();
    };
    for_each_kind<Real>(wanted, [](const auto& kind) {
        for (double alpha : {0.1, 1.0})
            for (double mu : {1e-3, 1e-2})
            {
                const auto subject = kind.make(Parameters::white(alpha));
                const auto wo = towards<Real>(mu);
                constexpr int n = 96;
                double sum = 0;
                for (int j = 0; j < n; ++j)
                    for (int i = 0; i < n; ++i)
                        sum += double(subject
                                          ->sample(wo, {Real((i + 0.5) / n), Real((j + 0.5) / n),
                                                        Real(0.5)})
                                          .weight.x) /
                               (n * n);
                // docs/support.md for the tables; the grid has 2e-3 of its own.
                EXPECT_NEAR(sum, 1, 3e-3) << alpha << " " << mu;
            }
    });
}

}  // namespace
