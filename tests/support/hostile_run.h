// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Closures of anything, asked about anything.

#pragma once

#include "hostile.h"

#include <gtest/gtest.h>

namespace regain::tests {

/// eval, sample, pdf and albedo along any directions are finite and not negative, a sample that is
/// valid has a density and a unit direction; with floating-point traps. make(hostile, i) is the
/// closure of call i.
template <class Real, class Make>
void expect_sane_answers(std::uint64_t seed, long calls, const Make& make)
{
    Hostile<Real> hostile(seed + sizeof(Real));
    long failures = 0;
    const Trapped trapped;
    for (long i = 0; i < calls; ++i)
    {
        const auto closure = make(hostile, i);
        const Vec3<Real> wo = hostile.any_direction(), wi = hostile.any_direction();
        const auto prepared = closure.prepare(wo);
        const Real x = hostile.random_number(), y = hostile.random_number();
        const Sample<Real> s = prepared.sample(Vec3<Real>(x, y, hostile.random_number()));
        const Real pdf = prepared.pdf(wi);
        const auto albedo = prepared.albedo();
        const bool good = sane(prepared.eval(wi)) && sane(s.weight) && sane(albedo.reflect) &&
                          sane(albedo.transmit) && std::isfinite(pdf) && pdf >= 0 &&
                          std::isfinite(s.pdf) && s.pdf >= 0 && (!s.valid || s.pdf > 0) &&
                          std::abs(s.wi.length() - 1) < 2e-6;
        if (!good && failures++ < 5)
            ADD_FAILURE() << "call " << i << ", wo " << wo << ", wi " << wi << ": eval "
                          << prepared.eval(wi) << ", pdf " << pdf << ", sample " << s.wi << " "
                          << s.weight << " " << s.pdf;
    }
    EXPECT_EQ(failures, 0);
}

}  // namespace regain::tests
