// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Random numbers at the ends of [0, 1). A sampler returns each of them once in some million
// samples, 1 among them where doubles are rounded to float, and one such pixel stays in the image.

#include "questions.h"

#include <gtest/gtest.h>

using namespace regain;
using namespace regain::tests;

namespace {

template <class Real>
class RandomNumbers : public testing::Test
{
public:
    static std::vector<Real> ends()
    {
        return {Real(0), std::numeric_limits<Real>::denorm_min(), Real(0.5), below_one<Real>,
                Real(1)};
    }
    /// Each end of each number with each end of each other.
    static std::vector<Vec3<Real>> corners()
    {
        const std::vector<Real> end = ends();
        const std::size_t n = end.size();
        std::vector<Vec3<Real>> all;
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j)
                all.push_back({end[i], end[j], end[(i + 2 * j) % n]});
        return all;
    }
    static std::vector<Parameters> all_parameters()
    {
        Parameters rough, narrow = Parameters::isotropic(1e-3), wide = Parameters::isotropic(1);
        wide.eta = 0.7;
        return {rough, narrow, wide};
    }
};
/// One of all kinds that differ in a gain alone, which no direction and no pdf knows of.
template <class Real>
const auto shapes = [](const Kind<Real>& kind) {
    return kind.is_bare() || kind.has_added_lobe() || kind.is_walk() || kind.method == "turquin" ||
           kind.lobe == Lobe::sheened;
};
TYPED_TEST_SUITE(RandomNumbers, Numbers, NumberNames);

// The estimator of every path tracer: weight = f cos / pdf, with the pdf that the host can ask for.
TYPED_TEST(RandomNumbers, at_the_corners_a_weight_is_eval_over_pdf)
{
    using Real = TypeParam;
    for_each_kind<Real>(shapes<Real>, [&](const auto& kind) {
        for (const Parameters& parameters : this->all_parameters())
        {
            const auto subject = kind.make(parameters);
            const Traits traits = subject->traits();
            for (double mu : {1e-4, 1.0, -0.7})
                for (const Vec3<Real>& u : this->corners())
                {
                    const auto wo = towards<Real>(mu);
                    const auto s = subject->sample(wo, u);
                    if (!s.valid || s.delta) continue;
                    expect_same_pdf(s.pdf, subject->pdf(wo, s.wi));
                    if (!traits.exact_pdf || traits.stochastic_eval) continue;
                    const auto f = subject->eval(wo, s.wi);
                    for (int c = 0; c < 3; ++c)
                        EXPECT_NEAR(double(s.weight[c]) * double(s.pdf), f[c],
                                    20 * rounding<Real> * double(f[c]) + 1e-30)
                            << u << " " << mu;
                }
        }
    });
}

// Visible normals leave a weight of F G2 / G1, which is at most 1: no firefly can come of one lobe.
TYPED_TEST(RandomNumbers, at_the_corners_no_single_scattering_weight_is_above_1)
{
    using Real = TypeParam;
    const auto wanted = [](const Kind<Real>& kind) {
        return kind.is_bare() && !kind.distribution.empty();
    };
    for_each_kind<Real>(wanted, [&](const auto& kind) {
        for (const Parameters& parameters : this->all_parameters())
        {
            const auto subject = kind.make(parameters);
            for (double mu : {1e-7, 1e-4, 0.4, 1.0, -0.7, -1e-3})
                for (const Vec3<Real>& u : this->corners())
                {
                    const auto s = subject->sample(towards<Real>(mu), u);
                    for (int c = 0; c < 3; ++c)
                        EXPECT_LE(s.weight[c], 1 + 20 * rounding<Real>) << u << " " << mu;
                }
        }
    });
}

// The third number chooses: glass reflects at 0 whatever F is, and transmits at 1 unless F is 1.
TYPED_TEST(RandomNumbers, the_ends_of_the_third_choose_reflection_and_transmission)
{
    using Real = TypeParam;
    const auto wanted = [](const Kind<Real>& kind) {
        return kind.is_bare() && kind.mode == ScatterMode::RT;
    };
    for_each_kind<Real>(wanted, [](const auto& kind) {
        const auto subject = kind.make(Parameters::isotropic(0.1));
        for (double mu : {0.9, 0.5, -0.9})
            for (Real x : {Real(0.2), Real(0.6)})
            {
                const auto wo = towards<Real>(mu);
                const auto R = subject->sample(wo, {x, Real(0.4), Real(0)}),
                           T = subject->sample(wo, {x, Real(0.4), Real(1)});
                ASSERT_TRUE(R.valid && T.valid);
                EXPECT_FALSE(R.transmitted);
                EXPECT_TRUE(T.transmitted);
                EXPECT_GT(R.wi.z * wo.z, 0);
                EXPECT_LT(T.wi.z * wo.z, 0);
            }
    });
}

// 1 in place of the largest number below it is no other sample.
TYPED_TEST(RandomNumbers, one_is_as_good_as_the_largest_number_below_it)
{
    using Real = TypeParam;
    // Gaussian slopes have no end at 1.
    const auto wanted = [](const Kind<Real>& kind) {
        return !kind.is_walk() && (kind.distribution == "ggx" || kind.distribution.empty());
    };
    for_each_kind<Real>(wanted, [](const auto& kind) {
        const auto subject = kind.make(Parameters::isotropic(0.3));
        const auto wo = towards<Real>(0.6);
        const Real most = below_one<Real>;
        // The second's 1 is the edge of what is visible, where nothing is.
        for (int axis : {0, 2})
        {
            Vec3<Real> at(Real(0.4), Real(0.4), Real(0.4)), below = at;
            at[axis] = 1;
            below[axis] = most;
            const auto a = subject->sample(wo, at), b = subject->sample(wo, below);
            EXPECT_EQ(a.valid, b.valid);
            EXPECT_EQ(a.transmitted, b.transmitted);
            // Roots and logarithms of 1 - u spread the last number: an ulp is sqrt(ulp) there.
            EXPECT_LT((a.wi - b.wi).length(), 4 * std::sqrt(std::numeric_limits<Real>::epsilon()))
                << axis;
        }
    });
}

// Cosine-weighted sampling in closed form: cos^2 = 1 - u, and every weight is the albedo.
TYPED_TEST(RandomNumbers, a_diffuse_weight_is_the_albedo_at_the_corners)
{
    using Real = TypeParam;
    const auto wanted = [](const auto& kind) { return kind.lobe == Lobe::diffuse; };
    for_each_kind<Real>(wanted, [&](const auto& kind) {
        const Parameters parameters;
        const auto subject = kind.make(parameters);
        for (const Vec3<Real>& u : this->corners())
        {
            const auto s = subject->sample(towards<Real>(0.3), u);
            ASSERT_TRUE(s.valid);
            EXPECT_EQ(s.weight, Color3<Real>(parameters.albedo));
            // The horizon itself has no density, so 1 stops short of it.
            EXPECT_NEAR(s.wi.z, std::sqrt(1 - double(u.x)), rounding<Real> + 2.1e-12);
            EXPECT_NEAR(s.pdf, double(s.wi.z) / double(pi), rounding<Real>);
        }
    });
}

// A generator that goes astray is the host's, but no reason for a NaN in the image.
TYPED_TEST(RandomNumbers, beyond_the_ends_samples_stay_samples)
{
    REGAIN_NEEDS_INFINITIES();
    using Real = TypeParam;
    for_each_kind<Real>(shapes<Real>, [](const auto& kind) {
        const auto subject = kind.make(Parameters());
        const auto wo = towards<Real>(0.6);
        const Real out[] = {Real(0.5),        Real(-1),       Real(2),
                            Real(tests::nan), Real(infinity), Real(-infinity)};
        constexpr int n = sizeof out / sizeof *out;
        int found = 0;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j)
                if (subject->sample(wo, {out[i], out[j], out[(i + j) % n]}).valid) ++found;
        EXPECT_GT(found, 0);
    });
}

}  // namespace
