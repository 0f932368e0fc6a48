// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Garbage in, sense out: with invalid operations and divisions by zero trapped, nothing that a host
// can pass leads to a result that is not finite, negative or no direction.

#include "../support/closures.h"
#include "../support/trapped.h"

#include <gtest/gtest.h>

#include <limits>

using namespace regain;
using namespace regain::tests;

namespace {

template <class Real>
class Hostile
{
public:
    explicit Hostile(std::uint64_t seed) : _random(seed) {}

    // A number from everywhere a number can come from.
    Real number()
    {
        using Limits = std::numeric_limits<Real>;
        const Real extremes[] = {Real(0),
                                 -Real(0),
                                 Real(1),
                                 -Real(1),
                                 Limits::min(),
                                 Limits::denorm_min(),
                                 Limits::max(),
                                 -Limits::max(),
                                 Limits::infinity(),
                                 -Limits::infinity(),
                                 Limits::quiet_NaN(),
                                 Limits::epsilon(),
                                 Real(1) - Limits::epsilon(),
                                 Real(1) + Limits::epsilon(),
                                 Real(1e-5),
                                 Real(1e-30)};
        const int pick = int(_random.bits() % 24);
        if (pick < 16) return extremes[pick];
        if (pick < 20) return Real(_random.unit());
        return Real(std::ldexp(_random.unit() - 0.5, int(_random.bits() % 120) - 60));
    }

    Real parameter() { return _random.bits() % 3 ? Real(_random.unit()) : number(); }
    Color3<Real> color() { return {parameter(), parameter(), parameter()}; }

    Real random_number()
    {
        const Real special[] = {Real(0), std::numeric_limits<Real>::denorm_min(), Real(0.5),
                                Real(1) - std::numeric_limits<Real>::epsilon() / 2, Real(1)};
        const int pick = int(_random.bits() % 8);
        if (pick < 5) return special[pick];
        return pick < 7 ? _random.template unit<Real>() : number();
    }

    // Mostly directions, many of them grazing or off by an ulp; sometimes anything at all.
    Vec3<Real> any_direction()
    {
        const int pick = int(_random.bits() % 10);
        if (pick == 0) return {number(), number(), number()};
        if (pick == 1) return {0, 0, Real(1) + std::numeric_limits<Real>::epsilon()};
        if (pick == 2) return {0, Real(-1), 0};
        double mu = 2 * _random.unit() - 1;
        if (pick < 6) mu = std::ldexp(_random.unit(), -int(_random.bits() % 50));
        return direction<Real>(mu, 7 * _random.unit());
    }

    Method method() { return all_methods[_random.bits() % std::size(all_methods)]; }

private:
    Random _random;
};

// Not part of the closures, so it may look at what it is given.
template <class Real>
bool sane(const Color3<Real>& c)
{
    return std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z) && c.x >= 0 && c.y >= 0 &&
           c.z >= 0;
}

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
