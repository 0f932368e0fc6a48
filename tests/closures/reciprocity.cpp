// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Single scattering is reciprocal: f(wo, wi) = f(wi, wo). A gain of one direction is not, and says
// so.

#include "../support/closures.h"

#include <gtest/gtest.h>

using namespace regain;
using namespace regain::tests;

namespace {

template <class Closure>
double asymmetry(const Closure& closure)
{
    Random random(21);
    double worst = 0;
    for (int i = 0; i < 4000; ++i)
    {
        const auto wo = direction<double>(std::pow(random.unit(), 2), 7 * random.unit());
        const auto wi = direction<double>(random.unit(), 7 * random.unit());
        const double there = closure.eval(wo, wi).y / wi.z, back = closure.eval(wi, wo).y / wo.z;
        worst = std::max(worst, std::abs(there - back) / std::max(there, back));
    }
    return worst;
}

TEST(Reciprocity, single_scattering_is_reciprocal)
{
    for (double alpha : {1e-3, 0.1, 1.0})
    {
        EXPECT_TRUE(gold<double>(alpha, alpha).traits().reciprocal);
        EXPECT_LT(asymmetry(gold<double>(alpha, 0.3 * alpha)), 1e-9);
    }
}

// At alpha 1 the gain of white is 1 / E_ss, from 1 at grazing to 3.26 at normal incidence, so the
// worst pair is that far from symmetric.
TEST(Reciprocity, turquin_is_not_and_says_so)
{
    const auto closure = compensated(white<double>(1, 1), Method::turquin, luts::ggx_tables());
    EXPECT_FALSE(closure.traits().reciprocal);
    EXPECT_NEAR(asymmetry(closure), 1 - 1 / 3.26, 0.05);
}

}  // namespace
