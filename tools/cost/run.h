// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A run of `regain cost`: errors on all threads, then times on one, then pictures. Errors depend
/// on nothing but the choice, samples and seed, and can be measured in parts.

#pragma once

#include "results.h"

#include <optional>

namespace regain::tools::cost {

struct RunOptions
{
    Choice choice;
    bool quick = false;
    std::uint64_t samples = 32768;  ///< of each direction; the walk takes four times as many
    double seconds_per_picture = 4;
    /// Seed, threads, progress and stop. Errors are the same for any number of threads.
    figures::Request request;
};

struct MethodErrors
{
    std::string method, refused;
    std::vector<Errors> errors;  ///< by part of the case; none where it is refused
    std::size_t table_bytes = 0;
};

struct CaseErrors
{
    std::vector<MethodErrors> methods;
    std::optional<LobeSet> lobes;  ///< of a case that is shown
};

/// Of these cases, which are some of the choice's. Throws figures::Stopped.
std::vector<CaseErrors> errors_of(const std::vector<Case>&, const RunOptions&);

/// Times and pictures besides; all of the choice's cases, in their order. Throws figures::Stopped.
Results results_of(const std::vector<Case>&, std::vector<CaseErrors>, const RunOptions&);

}  // namespace regain::tools::cost
