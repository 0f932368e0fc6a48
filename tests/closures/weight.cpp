// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// eval, sample and pdf tell one story.

#include "../support/closures.h"

#include <gtest/gtest.h>

using namespace regain;
using namespace regain::tests;

namespace {

template <class Closure>
void check_weight(const Closure& closure, double tolerance)
{
    using Real = typename Closure::Real;
    Random random(3);
    for (double mu : {1e-4, 0.01, 0.2, 0.7, 1.0})
    {
        const auto prepared = closure.prepare(direction<Real>(mu, 2.0));
        for (int i = 0; i < 2000; ++i)
        {
            const Sample<Real> s = prepared.sample(random.square<Real>());
            if (!s.valid) continue;
            EXPECT_EQ(s.pdf, prepared.pdf(s.wi)) << "a pdf is computed one way only";
            const Color3<Real> f = prepared.eval(s.wi);
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(s.weight[c] * s.pdf / f[c], 1, tolerance);
        }
    }
}

TEST(Weight, is_eval_over_pdf)
{
    for (double alpha : {1e-4, 0.01, 0.3, 1.0})
    {
        check_weight(white<float>(alpha, alpha), 1e-6);
        check_weight(gold<float>(alpha, 0.5 * alpha), 1e-6);
        check_weight(gold<double>(alpha, alpha), 1e-14);
        check_weight(
            compensated(artists_gold<float>(alpha, alpha), Method::series, luts::ggx_tables()),
            1e-6);
    }
}

// Three estimates of the albedo that share no sampling: by samples of the closure, by uniform
// directions, by the closure's own table.
TEST(Weight, three_albedo_estimators_agree)
{
    constexpr int n = 600;
    for (double alpha : {0.3, 0.7, 1.0})
        for (double mu : {0.2, 0.8})
        {
            const auto closure =
                compensated(gold<double>(alpha, alpha), Method::turquin, luts::ggx_tables());
            const auto prepared = closure.prepare(direction<double>(mu));
            Color3<double> sampled(0.0), uniform(0.0);
            for (int j = 0; j < n; ++j)
                for (int i = 0; i < n; ++i)
                {
                    const double u = (i + 0.5) / n, v = (j + 0.5) / n;
                    sampled += prepared.sample({u, v}).weight * (1.0 / (n * n));
                    uniform += prepared.eval(direction<double>(u, 2 * std::acos(-1.0) * v)) *
                               (2 * std::acos(-1.0) / (n * n));
                }
            const Color3<double> tabulated = prepared.albedo().reflect;
            for (int c = 0; c < 3; ++c)
            {
                EXPECT_NEAR(sampled[c], uniform[c], 2e-4);
                EXPECT_NEAR(sampled[c], tabulated[c], 8e-3) << "alpha " << alpha << ", mu " << mu;
            }
        }
}

}  // namespace
