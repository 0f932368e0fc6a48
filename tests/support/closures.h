// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The closures and directions that the property tests run over.

#pragma once

#include <regain/closures/compensated.h>
#include <regain/closures/conductor.h>
#include <regain/closures/constant_fresnel.h>
#include <regain/closures/generalized_schlick.h>
#include <regain/luts/builtin.h>

#include <cmath>
#include <cstdint>

namespace regain::tests {

constexpr double alphas[] = {1e-3, 0.01, 0.04, 0.1, 0.25, 0.5, 0.75, 1};
constexpr double cosines[] = {1e-3, 0.01, 0.05, 0.1, 0.3, 0.5, 0.7, 0.9, 1};

template <class Real>
using WhiteMirror = MicrofacetReflection<GGX<Real>, ConstantFresnel<Real>>;

template <class Real>
WhiteMirror<Real> white(double alpha_x, double alpha_y,
                        NormalSampling sampling = NormalSampling::bounded)
{
    return {GGX<Real>(Real(alpha_x), Real(alpha_y), sampling), ConstantFresnel<Real>()};
}

/// n, k of gold at 650, 550 and 450 nm (Johnson and Christy 1972).
template <class Real>
Conductor<Real> gold(double alpha_x, double alpha_y)
{
    return {GGX<Real>(Real(alpha_x), Real(alpha_y)),
            ConductorFresnel<Real>(Color3<Real>(Real(0.16), Real(0.42), Real(1.5)),
                                   Color3<Real>(Real(3.46), Real(2.35), Real(1.88)))};
}

template <class Real>
GeneralizedSchlick<Real> artists_gold(double alpha_x, double alpha_y)
{
    return {GGX<Real>(Real(alpha_x), Real(alpha_y)),
            SchlickFresnel<Real>(Color3<Real>(Real(0.94), Real(0.77), Real(0.37)),
                                 Color3<Real>(Real(0.98), Real(0.95), Real(0.75)))};
}

template <class Real>
Vec3<Real> direction(double mu, double azimuth = 0)
{
    const double s = std::sqrt((1 - mu) * (1 + mu));
    return {Real(s * std::cos(azimuth)), Real(s * std::sin(azimuth)), Real(mu)};
}

/// A small generator for tests: SplitMix64 (Steele et al. 2014).
class Random
{
public:
    explicit Random(std::uint64_t seed) : _state(seed) {}

    std::uint64_t bits()
    {
        std::uint64_t z = (_state += 0x9E3779B97F4A7C15ull);
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
        return z ^ (z >> 31);
    }
    /// In [0, 1).
    double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    template <class Real>
    Real unit()
    {
        // 24 bits, so that a float stays below 1.
        return static_cast<Real>(static_cast<double>(bits() >> 40) * 0x1p-24);
    }
    template <class Real>
    Vec2<Real> square()
    {
        const Real x = unit<Real>();
        return {x, unit<Real>()};
    }
    template <class Real>
    Vec3<Real> cube()
    {
        const Real x = unit<Real>(), y = unit<Real>();
        return {x, y, unit<Real>()};
    }

private:
    std::uint64_t _state;
};

}  // namespace regain::tests
