// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Numbers, colours and directions from everywhere they can come from: parameters out of textures,
/// directions out of interpolation, random numbers at the ends of their range.

#pragma once

#include "random.h"

#include <regain/conformance/subject.h>

#include <cmath>
#include <limits>

REGAIN_NAMESPACE_BEGIN
namespace conformance {

class Hostile
{
public:
    /// single: numbers that are extreme as floats.
    Hostile(Random random, bool single) : _random(random), _single(single) {}

    void set_single(bool single) { _single = single; }
    bool coin() { return _random.bits() & 1; }

    double number()
    {
        const std::uint64_t pick = _random.bits() % 24;
        if (pick < 16) return _single ? extreme<float>(pick) : extreme<double>(pick);
        if (pick < 20) return _random.unit();
        return std::ldexp(_random.unit() - 0.5, static_cast<int>(_random.bits() % 120) - 60);
    }

    /// Often within its range.
    double parameter(double lo, double hi)
    {
        const std::uint64_t pick = _random.bits() % 8;
        if (pick < 2) return number();
        if (pick == 2) return lo;
        if (pick == 3) return hi;
        return lo + (hi - lo) * _random.unit();
    }
    Color color(double hi) { return {parameter(0, hi), parameter(0, hi), parameter(0, hi)}; }

    double random_number()
    {
        const double last = _single ? 1 - 0x1p-24 : 1 - 0x1p-53;
        const double special[] = {0, _single ? denormal<float>() : denormal<double>(), 0.5, last,
                                  1};
        const std::uint64_t pick = _random.bits() % 8;
        if (pick < 5) return special[pick];
        return pick < 7 ? _random.unit() : number();
    }
    Direction random_numbers()
    {
        const double x = random_number(), y = random_number();
        return {x, y, random_number()};
    }

    /// Mostly directions, many of them grazing or off by an ulp; sometimes anything at all.
    Direction direction()
    {
        const std::uint64_t pick = _random.bits() % 12;
        if (pick == 0)
        {
            const double x = number(), y = number();
            return {x, y, number()};
        }
        if (pick == 1) return {0, 0, 1 + (_single ? 0x1p-23 : 0x1p-52)};
        if (pick == 2) return {0, -1, 0};
        if (pick == 3) return {0, 0, _random.bits() % 2 ? 1.0 : -1.0};
        double mu = 2 * _random.unit() - 1;
        if (pick < 8) mu = std::ldexp(mu, -static_cast<int>(_random.bits() % 50));
        const double r = std::sqrt((1 - mu) * (1 + mu)), phi = 7 * _random.unit();
        Direction w(r * std::cos(phi), r * std::sin(phi), mu);
        // A little, and too much, off unit length.
        if (pick == 11) w *= _random.bits() % 2 ? 1 + 1e-6 : 1.1;
        return w;
    }

    Parameters parameters(const Reads& reads)
    {
        Parameters p;
        p.in_double = reads.twice && (!reads.single || coin());
        set_single(!p.in_double);
        p.alpha_x = parameter(0, 1);
        p.alpha_y = coin() ? p.alpha_x : parameter(0, 1);
        p.gamma = parameter(reads.lowest_gamma, reads.highest_gamma);
        p.eta = _random.bits() % 4 ? parameter(0.25, 4) : 1 + 1e-6 * number();
        p.F0 = color(1);
        p.F82 = color(1);
        p.n = color(4);
        p.k = color(6);
        if (reads.schlick && coin()) p.reflectance = Reflectance::schlick;
        if (reads.conductor && coin()) p.reflectance = Reflectance::conductor;
        return p;
    }

private:
    template <class Real>
    static double denormal()
    {
        return static_cast<double>(std::numeric_limits<Real>::denorm_min());
    }
    template <class Real>
    static double extreme(std::uint64_t pick)
    {
        using Limits = std::numeric_limits<Real>;
        const Real all[] = {Real(0),
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
        return static_cast<double>(all[pick]);
    }

    Random _random;
    bool _single;
};

}  // namespace conformance
REGAIN_NAMESPACE_END
