// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The directional albedo of a closure, and its average 2 int_0^1 E(mu) mu dmu, measured in three
/// ways: by the closure's own look-up; by quadrature of its `eval`; by the mean weight of its
/// `sample`. The last two use no table but what the closure's gain does.

#pragma once

#include "closure_spec.h"

#include <cstdint>
#include <optional>

namespace regain::tools {

enum class AlbedoMethod { table, quadrature, monte_carlo };

constexpr std::array<std::string_view, 3> albedo_methods{"table", "quadrature", "monte-carlo"};

/// The most samples that may be asked for: some ten seconds' worth.
constexpr std::uint64_t most_averaged_samples = 100000000;

struct AlbedoSettings
{
    AlbedoMethod how = AlbedoMethod::quadrature;
    std::uint64_t samples = 65536, seed = 0;  ///< of Monte Carlo
};

struct MeasuredAlbedo
{
    ColorD reflect{0.0}, transmit{0.0};
    /// Quadrature: the difference from one of half the nodes. Monte Carlo: the standard error. The
    /// largest of the channels. A look-up cannot tell its error.
    std::optional<double> error;
};

/// wo is unit.
MeasuredAlbedo measured_albedo(const ClosureSpec& spec, const Imath::V3d& wo,
                               const AlbedoSettings& settings);

/// Over the upper hemisphere, all azimuths.
MeasuredAlbedo measured_average_albedo(const ClosureSpec& spec, const AlbedoSettings& settings);

/// wo at the cosine mu in [-1, 1] and the azimuth phi.
Imath::V3d direction_at(double mu, double phi = 0);

}  // namespace regain::tools
