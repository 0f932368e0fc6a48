// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Of what costs and errs, what nothing else beats.

#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace regain::tools::cost {

struct Point
{
    std::string method;
    double error = 0, time = 0;
};

/// The places of the points that no other one equals in both and betters in one, by rising time;
/// of equal points the first.
std::vector<std::size_t> pareto_front(const std::vector<Point>&);

}  // namespace regain::tools::cost
