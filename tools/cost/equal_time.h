// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The same scene by every method in the same time. How many samples fit depends on the machine
/// and on what else it does, so these pictures differ from run to run, unlike all others.

#pragma once

#include "cases.h"

#include "../figures/scenes.h"

#include <string>
#include <vector>

namespace regain::tools::cost {

struct TimedPicture
{
    std::string method;
    Picture picture;
    double seconds = 0;     ///< that it took, on the threads of the request
    double samples = 0;     ///< per pixel, mean
    double rmse = 0;        ///< from the reference, over pixels and channels
    double block_rmse = 0;  ///< the same over means of 16 x 16 pixels: less noise, the same bias
};

struct EqualTimeScene
{
    std::string name, words;
    Picture reference;
    double reference_seconds = 0, reference_samples = 0;
    std::vector<TimedPicture> pictures;
};

/// Gold where a class of metals is chosen, glass where one of glass is; by the methods that go with
/// it, each for `seconds`, against a walk of ten times that. Throws Stopped.
std::vector<EqualTimeScene> equal_time_scenes(const Choice&, double seconds,
                                              const figures::Request&);

}  // namespace regain::tools::cost
