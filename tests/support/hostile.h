// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Numbers, colours and directions from everywhere they can come from.

#pragma once

#include "closures.h"
#include "trapped.h"

#include <limits>

namespace regain::tests {

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

}  // namespace regain::tests
