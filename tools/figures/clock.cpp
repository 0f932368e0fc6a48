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

std::vector<Times> clocked(const std::vector<Clocked>& clocks, const Request& request)
{
    const int rounds = std::max(3, static_cast<int>(31 * std::min(1.0, request.precision)));
    std::vector<std::vector<double>> evals(clocks.size()), samples(clocks.size());
    for (int round = 0; round < rounds; ++round)
    {
        if (request.stopped()) throw Stopped();
        for (std::size_t i = 0; i < clocks.size(); ++i)
        {
            evals[i].push_back(clocks[i].eval(9));
            samples[i].push_back(clocks[i].sample(9));
        }
    }
    const auto median = [](std::vector<double>& times) {
        const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
        std::nth_element(times.begin(), middle, times.end());
        return *middle;
    };
    std::vector<Times> result;
    for (std::size_t i = 0; i < clocks.size(); ++i)
        result.push_back({median(evals[i]), median(samples[i])});
    return result;
}

std::size_t bytes(const TableView& table)
{
    return sizeof(std::uint16_t) * static_cast<std::size_t>(table.width) *
           static_cast<std::size_t>(table.height) * static_cast<std::size_t>(table.depth);
}

}  // namespace regain::tools::figures
