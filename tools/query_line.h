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
    double mu = 1;                  ///< fresnel
    std::optional<Imath::V2d> u;    ///< sample: these random numbers, or n from the seed
    std::uint64_t n = 1, seed = 0;  ///< sample
    AlbedoSettings albedo;
};

/// The most samples that one line may ask to be listed.
constexpr std::uint64_t most_listed_samples = 1000000;

/// Throws BadInput, which says what was given and what is accepted.
Query read_query(std::string_view line);

}  // namespace regain::tools
