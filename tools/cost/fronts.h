// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Which methods are on the front of error and time, for each class, distribution and roughness,
/// in numbers and in words.

#pragma once

#include "pareto.h"
#include "results.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace regain::tools::cost {

struct Band
{
    std::string_view name, words;
    double low, high;  ///< alpha
};
constexpr std::array<Band, 3> bands{{{"low", "alpha to 0.2", 0, 0.2},
                                     {"middle", "alpha between 0.2 and 0.7", 0.2001, 0.6999},
                                     {"high", "alpha from 0.7", 0.7, 1}}};

/// Times are rounded to this: of what differs by less, the nearer method is on the front.
constexpr double time_step = 0.05;

struct Front
{
    Class kind = Class::metal;
    Law law;
    Band band;
    /// error: the largest of the band and class, at least `floor`. time: of an eval and a sample
    /// over those of the same closure without compensation, mean over the band; over those of the
    /// white GGX where `none` was left out.
    std::vector<Point> points;
    std::vector<std::size_t> front;
    /// Smaller errors drown in the noise of this run: twice what one walk is off another, or, where
    /// none was asked for, three sigma.
    double floor = 0;
    std::string sentence;
};

/// Those of which there is a number, in the order of the rows.
std::vector<Front> fronts_of(const Results&);

}  // namespace regain::tools::cost
