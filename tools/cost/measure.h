// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What a closure reflects and lets through, in which direction and with how much noise, by its
/// samples alone; and how far that is from the walk's.

#pragma once

#include "cases.h"

#include <Imath/ImathColor.h>

#include <array>
#include <cstdint>
#include <functional>

namespace regain::tools::cost {

/// Seen along one direction, per channel.
struct Seen
{
    std::array<double, 3> reflect{}, transmit{};  ///< mean weight
    std::array<double, 3> variance{};             ///< of the weight, over its squared mean
    std::array<double, 3> standard_error{};       ///< of the side where it is larger
};

/// The reflected bins of measures.h, then those of what is transmitted, mirrored in the surface.
using Shape = std::array<figures::Histogram, 3>;

struct Lobe
{
    std::array<Seen, cosines.size()> seen;
    std::array<Shape, shape_cosines.size()> shapes;
};

/// Samples for each direction, as several lattices that are shifted at random: how far their means
/// lie apart says how far all is off.
constexpr std::uint64_t lattices = 8;

struct Effort
{
    std::uint64_t samples = 0;        ///< for each direction; a multiple of `lattices`
    std::uint64_t shape_samples = 0;  ///< for each of shape_cosines, where eval is an estimate
    int cells = 16;                   ///< squared, by which eval is integrated in each bin
};

/// What is seen along each direction, wo.z of the sign of `side`. The shape is integrated from
/// eval; where that is an estimate, it is that of samples. Throws Stopped as soon as `stopped` says
/// so.
Lobe measured(const Subject&, double side, const Effort&, std::uint64_t seed,
              const std::function<bool()>& stopped);

/// Adds a diffuse base that reflects `base` of what the lobe leaves, exactly.
void add_base(Lobe&, double base);

struct Errors
{
    double worst = 0;  ///< largest difference of the albedo, over cosines, channels and sides
    double mean = 0;
    double tint = -1;     ///< the same of the colour, channels over their mean; -1 of one channel
    double shape = 0;     ///< L1 distance of the lobe over the walk's energy, mean over cosines
    double variance = 0;  ///< of the weight, relative, mean over cosines and channels
    double standard_error = 0;  ///< of the walk's albedo, largest
    double noise = 0;           ///< of both albedos: what `worst` may be from chance, one sigma
};

/// Of the channels of the part.
Errors compared(const Lobe&, const Lobe& walk, const Part&);

}  // namespace regain::tools::cost
