// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Garbage in, sense out: with invalid operations and divisions by zero trapped, nothing that a host
// can pass leads to a result that is not finite, negative or no direction.

#include "../support/closures.h"
#include "../support/hostile.h"

#include <gtest/gtest.h>

using namespace regain;
using namespace regain::tests;

namespace {

template <class Closure, class Real>
void check(const Closure& closure, Hostile<Real>& hostile, long& failures)
{
    const Vec3<Real> wo = hostile.any_direction(), wi = hostile.any_direction();
    const auto prepared = closure.prepare(wo);
    const Color3<Real> f = prepared.eval(wi);
    const Real pdf = prepared.pdf(wi);
    const Real x = hostile.random_number();
    const Sample<Real> s = prepared.sample({x, hostile.random_number()});
    const Color3<Real> albedo = prepared.albedo().reflect;
    const Color3<Real> turned = reversed(closure).eval(wo, wi);
    const bool good = sane(f) && sane(s.weight) && sane(albedo) && sane(turned) &&
                      std::isfinite(pdf) && pdf >= 0 && std::isfinite(s.pdf) && s.pdf >= 0 &&
                      (!s.valid || s.pdf > 0) && std::abs(s.wi.length() - 1) < 2e-6 &&
                      (s.valid || sane(s.weight));
    if (!good && failures++ < 5)
        ADD_FAILURE() << "wo " << wo << ", wi " << wi << ": eval " << f << ", pdf " << pdf
                      << ", sample " << s.wi << " " << s.weight << " " << s.pdf << ", albedo "
                      << albedo << ", reversed " << turned;
}

template <class Real>
void run(long calls)
{
    Hostile<Real> hostile(sizeof(Real));
    long failures = 0;
    const Trapped trapped;
    for (long i = 0; i < calls; ++i)
    {
        const GGX<Real> ggx(hostile.parameter(), hostile.parameter(),
                            i % 2 ? NormalSampling::bounded : NormalSampling::full);
        const Real strength = hostile.parameter();
        const auto tables = luts::ggx_tables();
        check(compensated(Conductor<Real>{ggx, ConductorFresnel<Real>(hostile.color() * Real(4),
                                                                      hostile.color() * Real(9))},
                          hostile.method(), tables, strength),
              hostile, failures);
        check(compensated(
                  GeneralizedSchlick<Real>{
                      ggx, SchlickFresnel<Real>(hostile.color(), hostile.color(), hostile.color(),
                                                hostile.parameter() * Real(10))},
                  hostile.method(), tables, strength),
              hostile, failures);
    }
    EXPECT_EQ(failures, 0);
}

TEST(HostileInputs, float_closures_stay_finite) { run<float>(1000000); }
TEST(HostileInputs, double_closures_stay_finite) { run<double>(300000); }

}  // namespace
