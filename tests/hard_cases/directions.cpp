// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Directions that are special or none at all: the pole, where azimuths vanish; wi = -wo; vectors of
// length 0, of a length that is only nearly 1, of NaN.

#include "questions.h"

#include <gtest/gtest.h>

using namespace regain;
using namespace regain::tests;

namespace {

template <class Real>
class Directions : public testing::Test
{};
TYPED_TEST_SUITE(Directions, Numbers, NumberNames);

constexpr double widths[] = {1e-4, 1e-3, 0.3, 1};

template <class Real>
const auto single =
    [](const Kind<Real>& kind) { return kind.is_bare() && !kind.distribution.empty(); };

// A camera ray that meets a plane head on, with a light behind the camera. In closed form:
// F0 D(0) / 4, since nothing is masked.
TYPED_TEST(Directions, at_the_pole_eval_is_F0_D_over_4)
{
    using Real = TypeParam;
    for_each_kind<Real>(single<Real>, [](const auto& kind) {
        for (double alpha : widths)
            for (double side : {1.0, -1.0})
            {
                if (side < 0 && !kind.has_two_sides()) continue;
                const Parameters s = Parameters::isotropic(alpha);
                const Vec3<Real> pole(0, 0, Real(side));
                const double D = peak(kind.distribution, alpha, alpha, s.gamma);
                const auto F = facet_reflectance(kind, s, s.eta, 1);
                const auto tint = kind.has_two_sides() ? s.reflection_tint : Color3<double>(1.0);
                const auto expected =
                    kind.mode == ScatterMode::T ? Color3<double>(0.0) : F * tint * (D / 4);
                const double tolerance = (kind.has_tail() ? 1e3 : 40) * rounding<Real>;
                const auto f = kind.make(s)->eval(pole, pole);
                expect_color_near(f, expected, tolerance * D, "eval");
            }
    });
}

// What the methods add to that is never less than nothing, and a walk's first bounce is exact.
TYPED_TEST(Directions, at_the_pole_no_method_takes_light_away)
{
    using Real = TypeParam;
    // A balance gives some directions what it takes from others.
    const auto wanted = [](const auto& kind) {
        return kind.is_mirror() && !kind.is_bare() && kind.method != "balanced";
    };
    for_each_kind<Real>(wanted, [](const auto& kind) {
        for (double alpha : widths)
        {
            const Parameters s = Parameters::isotropic(alpha);
            const Vec3<Real> pole(0, 0, 1);
            const double D = peak(kind.distribution, alpha, alpha, s.gamma);
            const auto F = facet_reflectance(kind, s, 1, 1);
            const auto f = kind.make(s)->eval(pole, pole);
            const double tolerance = (kind.has_tail() ? 1e3 : 40) * rounding<Real> * D;
            for (int c = 0; c < 3; ++c) EXPECT_GE(f[c], F[c] * D / 4 - tolerance);
        }
    });
}

// A sample at the pole leaves along it where the normal is the surface's: u = 0 for GGX.
TYPED_TEST(Directions, the_pole_looks_alike_from_all_azimuths)
{
    using Real = TypeParam;
    const auto wanted = [](const Kind<Real>& kind) {
        return kind.is_bare() && kind.is_mirror() && !kind.has_tail();
    };
    for_each_kind<Real>(wanted, [](const auto& kind) {
        const auto subject = kind.make(Parameters::isotropic(0.3));
        const Vec3<Real> pole(0, 0, 1);
        const auto first = subject->eval(pole, towards<Real>(0.7, 0));
        for (double azimuth : {0.5, 1.5, 3.0, 5.0})
        {
            const auto f = subject->eval(pole, towards<Real>(0.7, azimuth));
            expect_color_near(f, Color3<double>(first), 40 * rounding<Real> * first.x, "eval");
        }
    });
}

// Light from behind the surface, seen along itself. No mirror does that; glass does through facets
// that face it: (1 - F0) D(wo) G2 eta^2 / (cos (eta - 1)^2), since h = (1 - eta) wo.
TYPED_TEST(Directions, wi_opposite_to_wo_passes_the_facets_that_face_it)
{
    using Real = TypeParam;
    const auto wanted = [](const Kind<Real>& kind) {
        return kind.is_bare() && kind.lobe == Lobe::dielectric && !kind.has_tail();
    };
    for_each_kind<Real>(wanted, [](const auto& kind) {
        for (double alpha : {0.2, 1.0})
            for (double eta : {1.5, 0.5})
                for (double mu : {0.9, 0.4, -0.6})
                {
                    Parameters s = Parameters::isotropic(alpha);
                    s.eta = eta;
                    const Vec3<Real> wo = towards<Real>(mu), wi = -wo;
                    const double z = std::abs(double(wo.z)), eta_o = mu > 0 ? eta : 1 / eta;
                    const Surface surface{kind.distribution == "beckmann", Exact(alpha)};
                    const double L = double(surface.lambda(z));
                    const double G =
                        kind.shadowing == TransmissionShadowing::correlated
                            ? 1 / (1 + 2 * L)
                            : std::exp(2 * std::lgamma(1 + L) - std::lgamma(2 + 2 * L));
                    const double F = double(fresnel(eta_o, 0, 1));
                    const double f = (1 - F) * double(surface.D(Surface::tan2(z))) * G * eta_o *
                                     eta_o / (z * (eta_o - 1) * (eta_o - 1));
                    const auto expected =
                        kind.mode == ScatterMode::R ? Color3<double>(0.0) : s.transmission_tint * f;
                    // Lambda of float's erfc has 1e-6 of its own; D never is 0.
                    expect_color_near(kind.make(s)->eval(wo, wi), expected,
                                      200 * rounding<Real> * f + 1e-28, "eval");
                }
    });
}

// The same through a sheet, whose two interfaces leave the direction as it is: T' D(0) G2 / (4
// cos).
TYPED_TEST(Directions, wi_opposite_to_wo_passes_a_sheet_by_its_upright_facets)
{
    using Real = TypeParam;
    const auto wanted = [](const Kind<Real>& kind) {
        return kind.is_bare() && kind.lobe == Lobe::sheet && !kind.has_tail();
    };
    for_each_kind<Real>(wanted, [](const auto& kind) {
        for (double mu : {0.9, 0.4, -0.6})
        {
            const Parameters s = Parameters::isotropic(0.4);
            const Vec3<Real> wo = towards<Real>(mu), wi = -wo;
            const double z = std::abs(double(wo.z));
            const Surface surface{kind.distribution == "beckmann", Exact(0.4)};
            const double F = double(fresnel(s.eta, 0, z)), T = (1 - F) / (1 + F);
            const double f = T * double(surface.D(0)) / (4 * z * double(1 + 2 * surface.lambda(z)));
            const auto expected =
                kind.mode == ScatterMode::R ? Color3<double>(0.0) : s.transmission_tint * f;
            expect_color_near(kind.make(s)->eval(wo, wi), expected, 200 * rounding<Real> * f,
                              "eval");
        }
    });
}

// The same of everything that only reflects: exactly nothing, and below it nothing is seen.
TYPED_TEST(Directions, what_only_reflects_is_black_below_the_horizon)
{
    using Real = TypeParam;
    const auto wanted = [](const Kind<Real>& kind) { return !kind.has_two_sides(); };
    for_each_kind<Real>(wanted, [](const auto& kind) {
        const auto subject = kind.make(Parameters());
        const Vec3<Real> above = towards<Real>(0.5), below = towards<Real>(-0.3);
        const Color3<Real> black(Real(0));
        for (const auto& [wo, wi] : {std::pair(above, -above), std::pair(above, below),
                                     std::pair(below, above), std::pair(below, below)})
        {
            EXPECT_EQ(subject->eval(wo, wi), black);
            EXPECT_EQ(subject->pdf(wo, wi), 0);
        }
        EXPECT_FALSE(subject->sample(below, {Real(0.3), Real(0.3), Real(0.3)}).valid);
        EXPECT_EQ(subject->albedo(below).reflect, black);
    });
}

template <class Real>
std::vector<Vec3<Real>> no_directions()
{
    const Real huge = Real(1e18), tiny = Real(1e-30), tenth = Real(0.1);
    const auto w = towards<Real>(0.6);
    // Zero; a tenth too long, a tenth too short, half; far too long, far too short.
    return {{0, 0, 0},         w * (1 + tenth), w * (1 - tenth),   w * Real(0.5),
            {0, 0, Real(1.1)}, {huge, 0, huge}, {tiny, tiny, tiny}};
}
template <class Real>
std::vector<Vec3<Real>> nothing_like_directions()
{
    const Real nan_ = std::numeric_limits<Real>::quiet_NaN(),
               inf = std::numeric_limits<Real>::infinity(), most = std::numeric_limits<Real>::max();
    return {{nan_, nan_, nan_}, {nan_, 0, 1},  {0, nan_, 1}, {0, 0, nan_},       {inf, 0, 0},
            {0, 0, inf},        {0, 0, -inf},  {0, inf, 1},  {inf, -inf, inf},   {most, most, most},
            {nan_, inf, 1},     {0, 0, -nan_}, {-inf, 0, 1}, {-most, 0, Real(1)}};
}

template <class Real>
void expect_black(const Kind<Real>& kind, const std::vector<Vec3<Real>>& vectors)
{
    const auto subject = kind.make(Parameters());
    const Vec3<Real> w = towards<Real>(0.5), u(Real(0.3), Real(0.6), Real(0.9));
    const Color3<Real> black(Real(0));
    for (const Vec3<Real>& v : vectors)
    {
        EXPECT_EQ(subject->eval(v, w), black) << v;
        EXPECT_EQ(subject->eval(w, v), black) << v;
        EXPECT_EQ(subject->eval(v, v), black) << v;
        EXPECT_EQ(subject->pdf(v, w), 0) << v;
        EXPECT_EQ(subject->pdf(w, v), 0) << v;
        EXPECT_FALSE(subject->sample(v, u).valid) << v;
    }
    const auto albedo = subject->albedo(vectors.front());
    EXPECT_EQ(albedo.reflect, black);
    EXPECT_EQ(albedo.transmit, black);
}

// An interpolated normal of length 0 makes such frames, and a host that forgot to normalise.
TYPED_TEST(Directions, vectors_that_are_not_unit_are_black)
{
    for_each_kind<TypeParam>(
        [](const auto& kind) { expect_black(kind, no_directions<TypeParam>()); });
}

// A degenerate triangle makes NaN of a normal, and everything after it.
TYPED_TEST(Directions, vectors_of_nan_and_infinity_are_black)
{
    REGAIN_NEEDS_INFINITIES();
    for_each_kind<TypeParam>(
        [](const auto& kind) { expect_black(kind, nothing_like_directions<TypeParam>()); });
}

// Hosts turn directions by float matrices: lengths are off by some ulps, and that changes nothing
// beyond some ulps.
TYPED_TEST(Directions, a_length_off_by_an_ulp_is_still_a_direction)
{
    using Real = TypeParam;
    const auto wanted = [](const Kind<Real>& kind) { return !kind.is_walk(); };
    for_each_kind<Real>(wanted, [](const auto& kind) {
        const auto subject = kind.make(Parameters::isotropic(0.5));
        const Real ulp = std::numeric_limits<Real>::epsilon();
        for (double mu : {0.05, 0.7, 1.0})
        {
            const auto wo = towards<Real>(mu), wi = towards<Real>(0.4, 3.9);
            const auto f = subject->eval(wo, wi);
            const auto s = subject->sample(wo, {Real(0.3), Real(0.6), Real(0.1)});
            for (Real scale : {1 - ulp, 1 + ulp, 1 + 4 * ulp})
            {
                // What long tails lose is linear in theta: at the pole an ulp of a cosine is a
                // root of it.
                const bool linear = kind.has_tail() && kind.has_added_lobe() && mu == 1;
                const double tolerance =
                    (100 * rounding<Real> + (linear ? std::sqrt(ulp) : 0)) * (1e-3 + double(f.x));
                expect_color_near(subject->eval(wo * scale, wi), Color3<double>(f), tolerance,
                                  "eval");
                expect_color_near(subject->eval(wo, wi * scale), Color3<double>(f), tolerance,
                                  "eval");
                const auto t = subject->sample(wo * scale, {Real(0.3), Real(0.6), Real(0.1)});
                EXPECT_EQ(s.valid, t.valid);
                // A choice of lobe stretches the numbers of whose bits tails make streams.
                if (!(kind.has_tail() && kind.has_added_lobe()))
                {
                    EXPECT_LT((s.wi - t.wi).length(), 100 * rounding<Real>);
                }
                // At the pole, too, where a cosine of 1 + ulp would leave tables and roots.
                EXPECT_NEAR(subject->albedo(wo * scale).reflect.x, subject->albedo(wo).reflect.x,
                            100 * rounding<Real> + (linear ? std::sqrt(ulp) : 0));
            }
        }
    });
}

}  // namespace
