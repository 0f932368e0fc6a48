// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// One question to the library: a line of `regain query`, read and checked.

#pragma once

#include "measured_albedo.h"

#include <optional>
#include <string_view>

namespace regain::tools {

enum class Op { eval, pdf, sample, albedo, gain, fresnel, ndf };

struct Query
{
    Op op = Op::eval;
    ClosureSpec closure;
    Imath::V3d wo{0, 0, 1}, wi{0, 0, 1}, wm{0, 0, 1};
    double mu = 1;  ///< fresnel
    /// sample, and eval of stochastic closures: these random numbers, or n times from the seed.
    std::optional<Imath::V3d> u;
    std::uint64_t n = 1, seed = 0;
    AlbedoSettings albedo;
};

/// The most samples that one line may ask to be listed.
constexpr std::uint64_t most_listed_samples = 1000000;

/// The estimates that an eval averages unless told otherwise.
constexpr std::uint64_t default_estimates = 1024;

/// Throws BadInput, which says what was given and what is accepted.
Query read_query(std::string_view line);

}  // namespace regain::tools
