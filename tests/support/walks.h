// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The distributions that the tests of the walks run over, and a mean with its error.

#pragma once

#include "closures.h"

#include <regain/closures/beckmann.h>
#include <regain/closures/gtr.h>
#include <regain/closures/std.h>
#include <regain/closures/walk.h>

namespace regain::tests {

/// f(distribution, name) of all four, isotropic and anisotropic.
template <class Real, class F>
void for_each_distribution(const F& f)
{
    const Real a(0.7), b(0.25), gamma(1.6), tail(2.5);
    f(GGX<Real>(a), "GGX");
    f(GGX<Real>(b, a), "GGX, anisotropic");
    f(Beckmann<Real>(a), "Beckmann");
    f(Beckmann<Real>(a, b), "Beckmann, anisotropic");
    f(GTR<Real>(b, Real(1)), "GTR");
    f(GTR<Real>(a, b, gamma), "GTR, anisotropic");
    f(STD<Real>(a, tail), "STD");
    f(STD<Real>(b, a, gamma), "STD, anisotropic");
}

template <class Distribution>
Walk<Distribution, ConstantFresnel<typename Distribution::Real>> white_walk(
    const Distribution& distribution)
{
    return {distribution, ConstantFresnel<typename Distribution::Real>()};
}

/// A mean and its standard error.
class Mean
{
public:
    void add(double x)
    {
        ++_n;
        _sum += x;
        _squares += x * x;
    }
    double value() const { return _sum / _n; }
    double error() const
    {
        return std::sqrt(std::max(_squares / _n - value() * value(), 0.0) / _n);
    }

private:
    double _n = 0, _sum = 0, _squares = 0;
};

}  // namespace regain::tests
