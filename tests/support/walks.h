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

#include <string>
#include <vector>

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

/// f(name, distributions) of each kind: narrow and wide, anisotropic one way and the other.
template <class Real, class F>
void for_each_kind(const F& f)
{
    f("GGX",
      std::vector<GGX<Real>>{GGX<Real>(Real(0.15)), GGX<Real>(Real(0.4)), GGX<Real>(Real(0.7)),
                             GGX<Real>(Real(1)), GGX<Real>(Real(0.25), Real(0.7)),
                             GGX<Real>(Real(0.9), Real(0.3))});
    f("Beckmann", std::vector<Beckmann<Real>>{Beckmann<Real>(Real(0.15)), Beckmann<Real>(Real(0.4)),
                                              Beckmann<Real>(Real(0.7)), Beckmann<Real>(Real(1)),
                                              Beckmann<Real>(Real(0.25), Real(0.7)),
                                              Beckmann<Real>(Real(0.9), Real(0.3))});
    f("GTR", std::vector<GTR<Real>>{GTR<Real>(Real(0.15), Real(1)), GTR<Real>(Real(0.4), Real(1.6)),
                                    GTR<Real>(Real(0.7), Real(3)), GTR<Real>(Real(1), Real(0.5)),
                                    GTR<Real>(Real(0.25), Real(0.7), Real(1.3)),
                                    GTR<Real>(Real(0.9), Real(0.3), Real(2))});
    f("STD",
      std::vector<STD<Real>>{STD<Real>(Real(0.15), Real(1.6)), STD<Real>(Real(0.4), Real(2.5)),
                             STD<Real>(Real(0.7), Real(1.8)), STD<Real>(Real(1), Real(8)),
                             STD<Real>(Real(0.25), Real(0.7), Real(2)),
                             STD<Real>(Real(0.9), Real(0.3), Real(40))});
}

/// For messages.
template <class Distribution>
std::string place(const Distribution& d, double mu)
{
    return "alpha " + std::to_string(d.alpha_x()) + ", " + std::to_string(d.alpha_y()) + ", mu " +
           std::to_string(mu);
}

/// Whether the facet m is tilted towards wo. The quadratures cut their ranges where it is not
/// tilted either way, so that either half has an exact integral, too.
inline bool is_tilted_towards(const Vec3<double>& wo, const Vec3<double>& m)
{
    return m.x * wo.x + m.y * wo.y > 0;
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
