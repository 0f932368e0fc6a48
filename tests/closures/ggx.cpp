// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// What the distribution promises: it is normalised, its visible normals are seen, its masking
// follows from it.

#include "../support/normals.h"

#include <gtest/gtest.h>

using namespace regain;
using namespace regain::tests;

namespace {

TEST(Ggx, projected_normals_integrate_to_one)
{
    for (double ax : alphas)
        for (double ratio : {1.0, 10.0})
        {
            const GGX<double> d(ax, ax / ratio);
            EXPECT_NEAR(over_normals(ax, ax / ratio, [&](const auto& m) { return d.D(m) * m.z; }),
                        1, 1e-5);
        }
}

// Heitz 2014, Eq. 13: the visible area of the microsurface is that of the plane.
TEST(Ggx, visible_area_is_the_cosine)
{
    for (double ax : {0.05, 0.4, 1.0})
        for (double mu : {0.02, 0.3, 0.9})
            for (double azimuth : {0.0, 0.7})
            {
                const GGX<double> d(ax, 0.5 * ax);
                const auto wo = direction<double>(mu, azimuth);
                const double visible = over_normals(
                    ax, 0.5 * ax, [&](const auto& m) { return std::max(0.0, wo.dot(m)) * d.D(m); });
                EXPECT_NEAR(visible, d.projected_area(wo), 1e-4 * visible);
                EXPECT_NEAR(d.G1(wo) * visible, mu, 1e-4);
                EXPECT_NEAR(1 / (1 + d.lambda(wo)), d.G1(wo), 1e-12);
            }
}

// sigma(-w) = sigma(w) - w.z, to the last digits of what is small.
TEST(Ggx, visible_area_from_below_keeps_its_digits)
{
    for (double alpha : {1e-3, 0.3, 1.0})
        for (double mu : {1e-4, 0.3, 0.9999})
        {
            const auto w = direction<double>(mu, 0.7);
            const double exact = mu * GGX<double>(alpha).lambda(w);
            EXPECT_NEAR(GGX<float>(float(alpha)).projected_area(Vec3<float>(-w)) / exact, 1, 2e-3);
            EXPECT_NEAR(GGX<double>(alpha).projected_area(-w) / exact, 1, 1e-9);
        }
}

TEST(Ggx, shadowing_is_correlated_and_bounded)
{
    const GGX<double> d(0.6, 0.3);
    for (double a : {0.05, 0.4, 0.9})
        for (double b : {0.02, 0.5, 1.0})
        {
            const auto wo = direction<double>(a, 0.3), wi = direction<double>(b, 2.0);
            const double G2 = d.G2(wo, wi);
            EXPECT_LE(G2, std::min(d.G1(wo), d.G1(wi)) + 1e-15);
            EXPECT_GE(G2, d.G1(wo) * d.G1(wi) - 1e-15);
            EXPECT_DOUBLE_EQ(G2, d.G2(wi, wo));
        }
}

// Sampled visible normals are visible, and on the side of the surface.
TEST(Ggx, sampled_normals_are_visible)
{
    Random random(1);
    for (double alpha : {1e-3, 0.3, 1.0})
        for (double mu : {1e-5, 0.1, 1.0})
        {
            const auto wo = direction<float>(mu, 0.4);
            const auto visible =
                GGX<float>(float(alpha), float(0.5 * alpha), NormalSampling::full).visible(wo);
            for (int i = 0; i < 3000; ++i)
            {
                const auto m = visible.sample({random.unit<float>(), random.unit<float>(), 0});
                EXPECT_NEAR(m.length(), 1, 1e-6);
                EXPECT_GE(m.z, 0);
                EXPECT_GE(m.dot(wo), -1e-6);
            }
        }
}

// The component form of D keeps its digits at small alpha in float.
TEST(Ggx, float_is_as_good_as_double_at_small_alpha)
{
    for (double alpha : {1e-4, 1e-3, 1e-2})
        for (double t : {0.0, 0.3, 1.0, 5.0, 50.0})
        {
            const double s = std::sin(t * alpha), c = std::cos(t * alpha);
            const double exact = GGX<double>(alpha).D(Vec3<double>(s, 0, c));
            const float single = GGX<float>(float(alpha)).D(Vec3<float>(float(s), 0, float(c)));
            EXPECT_NEAR(single / exact, 1, 2e-6) << "alpha " << alpha << ", t " << t;
        }
}

// Rotating the axes with their widths changes nothing; so does mirroring.
TEST(Ggx, widths_belong_to_their_axes)
{
    Random random(9);
    for (int i = 0; i < 500; ++i)
    {
        const auto wo = direction<double>(random.unit(), 7 * random.unit());
        const auto wi = direction<double>(random.unit(), 7 * random.unit());
        const auto turned = [](const Vec3<double>& w) { return Vec3<double>(-w.y, w.x, w.z); };
        const auto mirrored = [](const Vec3<double>& w) { return Vec3<double>(-w.x, w.y, w.z); };
        const auto f = white<double>(0.7, 0.2), g = white<double>(0.2, 0.7);
        const double value = f.eval(wo, wi).x;
        EXPECT_NEAR(g.eval(turned(wo), turned(wi)).x, value, 1e-12 * (1 + value));
        EXPECT_NEAR(f.eval(mirrored(wo), mirrored(wi)).x, value, 1e-12 * (1 + value));
        EXPECT_GE(value, 0);
    }
}

}  // namespace
