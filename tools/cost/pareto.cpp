// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "pareto.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace regain::tools::cost {

std::vector<std::size_t> pareto_front(const std::vector<Point>& points)
{
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        if (points[a].time != points[b].time) return points[a].time < points[b].time;
        return points[a].error < points[b].error;
    });
    std::vector<std::size_t> front;
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t i : order)
        if (points[i].error < least)
        {
            least = points[i].error;
            front.push_back(i);
        }
    return front;
}

}  // namespace regain::tools::cost
