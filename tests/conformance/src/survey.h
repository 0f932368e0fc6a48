// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// All that can be seen of a closure along one direction, seen once for all checks: the integrals
/// of pdf and eval over the sphere, and what samples come to. Nothing but the closure's own answers
/// goes in.

#pragma once

#include "sphere_cells.h"
#include "statistics.h"

#include <array>
#include <memory>

REGAIN_NAMESPACE_BEGIN
namespace conformance {

/// How hard to look.
struct Effort
{
    std::size_t samples = 1 << 16;       ///< independent ones, for histograms
    std::size_t even_samples = 1 << 15;  ///< evenly spread ones, for means
    std::size_t evaluations = 1 << 19;   ///< at most, of an integral
    std::size_t estimates = 1 << 15;     ///< of a value that is one
    double tolerance = 1e-4;             ///< of an integral

    Effort times(std::size_t factor) const;
};

/// What one sample's numbers were.
struct Drawn
{
    Direction u{0.0};
    Sample<double> sample{Direction(0, 0, 1), Color(0.0), 0};
};

/// A mean per channel, of what is reflected, transmitted, both.
struct MeanColor
{
    std::array<RunningMean, 3> reflect, transmit, both;

    void scale_by(const Color& factor);
};

struct Survey
{
    Direction wo;
    Traits traits;

    // The integrals: of pdf over the sphere, of eval over either side where it is no estimate.
    // `error` is the estimated error of the worst of them.
    double pdf = 0, error = 0;
    double rounding = 0;    ///< how much of pdf the rounding of wi moves, where it is float's
    bool resolved = false;  ///< the error is small enough to say something
    Color reflect{0.0}, transmit{0.0};

    // The samples.
    RunningMean nothing, delta;              ///< shares; means over groups of evenly spread samples
    MeanColor weight;                        ///< likewise
    std::array<Drawn, 3> heaviest;           ///< in each channel
    std::array<double, 3> weight_squares{};  ///< mean square
    Color delta_reflect{0.0}, delta_transmit{0.0};  ///< mean weight of those without density

    /// Bins that follow the lobe, with the integrals over them.
    std::shared_ptr<const SphereCells> cells;

    /// Integrals of eval, and what has no density.
    Color reflected() const { return reflect + delta_reflect; }
    Color transmitted() const { return transmit + delta_transmit; }
    Color total() const { return reflected() + transmitted(); }

    /// As if every eval and every weight had been multiplied by it.
    void scale_by(const Color& gain);
};

/// `closure` is prepared for wo by this. in_double: what it computes in.
Survey survey(TestedClosure& closure, const Direction& wo, bool in_double, const Effort& effort,
              std::uint64_t seed);

/// The integrals of an eval that is an estimate, by n of them; delta lobes included.
MeanColor estimated_integrals(const TestedClosure& prepared, const Survey& survey, std::size_t n,
                              std::uint64_t seed);

/// How many of n independent samples with a density fall into each bin. The closure is prepared.
std::vector<double> histogram(const TestedClosure& closure, const SphereCells& cells, std::size_t n,
                              std::uint64_t seed);

}  // namespace conformance
REGAIN_NAMESPACE_END
