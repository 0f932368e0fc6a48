// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "hemisphere.h"

#include <map>
#include <mutex>

namespace regain::tools {

const luts::QuadratureRule& gauss_rule(int n)
{
    static std::mutex mutex;
    static std::map<int, luts::QuadratureRule> rules;
    const std::lock_guard<std::mutex> lock(mutex);
    const auto at = rules.find(n);
    return at != rules.end() ? at->second : rules.emplace(n, luts::gauss_legendre(n)).first->second;
}

std::vector<double> slope_sectors(const Imath::V2d& t, double alpha_x, double alpha_y)
{
    const double quarter = std::acos(0.0), full = 4 * quarter;
    const double along_t =
        t.x == 0 && t.y == 0 ? 0 : std::atan2(t.y * alpha_y, t.x * alpha_x) + full;

    std::vector<double> sides;
    for (int k = 0; k < 4; ++k)
    {
        sides.push_back(std::fmod(along_t + k * quarter, full));
        if (alpha_x != alpha_y) sides.push_back(k * quarter);
    }
    std::sort(sides.begin(), sides.end());
    // Slivers cost as much as real sectors.
    const auto same = [](double a, double b) { return b - a < 1e-6; };
    sides.erase(std::unique(sides.begin(), sides.end(), same), sides.end());
    sides.push_back(sides.front() + full);
    return sides;
}

}  // namespace regain::tools
