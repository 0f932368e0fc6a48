// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The directional albedo of a closure, and its average 2 int_0^1 E(mu) mu dmu, measured in three
/// ways: by the closure's own look-up; by quadrature of its `eval`; by the mean weight of its
/// `sample`. The last two use no table but what the closure's compensation does.

#pragma once

#include "any_closure.h"
#include "random_numbers.h"

#include <cstdint>
#include <optional>

namespace regain::tools {

enum class AlbedoMethod { table, quadrature, monte_carlo };

constexpr std::array<std::string_view, 3> albedo_methods{"table", "quadrature", "monte-carlo"};

/// The most samples that may be asked for: some ten seconds' worth.
constexpr std::uint64_t most_averaged_samples = 100000000;

/// The most bounces of a walk that may be asked for alone.
constexpr std::uint64_t most_bounces = 1000;

struct AlbedoSettings
{
    AlbedoMethod how = AlbedoMethod::quadrature;
    std::uint64_t samples = 65536, seed = 0;  ///< of Monte Carlo
    std::optional<int> order;                 ///< of a walk: only light of so many bounces
};

/// What there is for a closure where nothing is said: quadrature, and Monte Carlo for estimates.
AlbedoMethod default_albedo_method(const ClosureSpec& spec);

/// Throws BadInput where the albedo cannot be measured in this way.
void require_possible(const ClosureSpec& spec, const AlbedoSettings& settings);

struct MeasuredAlbedo
{
    ColorD reflect{0.0}, transmit{0.0};
    /// Quadrature: the difference from a coarser one. Monte Carlo: the standard error. The largest
    /// of the channels. A look-up cannot tell its error.
    std::optional<double> error;
};

/// wo is unit. The closure is the specification's, and is prepared for wo afterwards.
MeasuredAlbedo measured_albedo(AnyClosure& closure, const ClosureSpec& spec, const Imath::V3d& wo,
                               const AlbedoSettings& settings);
MeasuredAlbedo measured_albedo(const ClosureSpec& spec, const Imath::V3d& wo,
                               const AlbedoSettings& settings);

/// Over the hemisphere above the surface, or the one below, all azimuths.
MeasuredAlbedo measured_average_albedo(const ClosureSpec& spec, const AlbedoSettings& settings,
                                       bool below = false);

/// wo at the cosine mu in [-1, 1] and the azimuth phi.
Imath::V3d direction_at(double mu, double phi = 0);

/// The random numbers of samples: as many of RandomNumbers as the closure reads, in its precision.
class SampleNumbers
{
public:
    SampleNumbers(const ClosureSpec& spec, std::uint64_t seed)
        : _random(seed),
          _three(spec.random_numbers() > 2),
          _single(spec.precision == Precision::single)
    {}
    Imath::V3d next()
    {
        const double x = one(), y = one();
        return {x, y, _three ? one() : 0.0};
    }
    /// Independent of the closure.
    double number() { return _random.next<double>(); }

private:
    double one()
    {
        return _single ? static_cast<double>(_random.next<float>()) : _random.next<double>();
    }
    RandomNumbers _random;
    bool _three, _single;
};

/// The mean of n estimates of eval and its standard error.
struct MeasuredValue
{
    ColorD mean{0.0};
    double error = 0;
};
MeasuredValue measured_value(const AnyClosure& prepared, const ClosureSpec& spec,
                             const Imath::V3d& wi, std::uint64_t n, std::uint64_t seed);

}  // namespace regain::tools
