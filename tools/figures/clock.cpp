// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "clock.h"

namespace regain::tools::figures {

Inputs::Inputs(bool both_sides)
{
    RandomNumbers random(7);
    const auto direction = [&] {
        double mu = std::sqrt(random.next<double>());
        if (both_sides && random.next<double>() < 0.5) mu = -mu;
        return at_angle<float>(mu, 6.28 * random.next<double>());
    };
    for (int i = 0; i < count; ++i)
    {
        wo.push_back(direction());
        wi.push_back(direction());
        const float x = random.next<float>(), y = random.next<float>();
        u.emplace_back(x, y, random.next<float>());
    }
}

std::vector<Times> clocked(const std::vector<Clocked>& clocks, int rounds,
                           const std::function<bool()>& stopped)
{
    constexpr int repeats = 9, least_rounds = 3;
    constexpr double slow = 1e4;  // nanoseconds
    struct Turns
    {
        const std::function<double(int)>* work;
        std::vector<double> times;
    };
    std::vector<Turns> all;
    for (const Clocked& c : clocks)
    {
        all.push_back({&c.eval, {}});
        all.push_back({&c.sample, {}});
    }
    for (int round = 0; round < rounds; ++round)
        for (Turns& t : all)
        {
            if (stopped()) throw Stopped();
            const bool is_slow = !t.times.empty() && t.times.front() > slow;
            if (is_slow && round >= least_rounds) continue;
            t.times.push_back((*t.work)(t.times.empty() || is_slow ? 1 : repeats));
        }
    const auto median = [](std::vector<double>& times) {
        const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
        std::nth_element(times.begin(), middle, times.end());
        return *middle;
    };
    std::vector<Times> result;
    for (std::size_t i = 0; i < all.size(); i += 2)
        result.push_back({median(all[i].times), median(all[i + 1].times)});
    return result;
}

std::vector<Times> clocked(const std::vector<Clocked>& clocks, const Request& request)
{
    const int rounds = std::max(3, static_cast<int>(31 * std::min(1.0, request.precision)));
    return clocked(clocks, rounds, [&] { return request.stopped(); });
}

}  // namespace regain::tools::figures
