// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "fronts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace regain::tools::cost {
namespace {

bool same(const Law& a, const Law& b) { return a.label() == b.label(); }

struct Sum
{
    std::string method;
    double error = 0, time = 0;
    int times = 0;
};

// Points of the rows that belong to the front.
void gather(const Results& results, Front& f)
{
    std::vector<Sum> sums;
    double sigma = 0, chance = 0;
    for (const Row& row : results.rows)
    {
        if (!row.refused.empty() || row.kind != f.kind || !same(row.law, f.law) ||
            row.alpha < f.band.low || row.alpha > f.band.high)
            continue;
        auto sum = std::find_if(sums.begin(), sums.end(),
                                [&](const Sum& s) { return s.method == row.method; });
        if (sum == sums.end()) sum = sums.insert(sums.end(), Sum{row.method});
        sum->error = std::max(sum->error, row.errors.worst);
        sigma = std::max(sigma, row.errors.standard_error);
        if (row.method == "walk") chance = std::max(chance, row.errors.worst);
        const figures::Times& t = row.to_none.eval > 0 ? row.to_none : row.to_white;
        sum->time += (t.eval + t.sample) / 2;
        ++sum->times;
    }
    const double more =
        static_cast<double>(results.walk_samples) / static_cast<double>(results.samples);
    constexpr double of_float = 1e-4;
    f.floor = std::max(chance > 0 ? 2 * chance : 3 * sigma * std::sqrt(1 + more), of_float);
    // Less is noise of the clock.
    const auto rounded = [](double time) { return std::round(time / time_step) * time_step; };
    for (const Sum& s : sums)
        f.points.push_back({s.method, std::max(s.error, f.floor), rounded(s.time / s.times)});
}

std::string named(const Point& p, double floor)
{
    const std::string error = p.error > floor ? fmt::format("off by up to {:.2g}", p.error)
                                              : fmt::format("no error above {:.2g} seen", floor);
    return fmt::format("{} ({}, {:.2f} times)", p.method, error, p.time);
}

std::string listed(const std::vector<std::string>& all)
{
    std::string out;
    for (std::size_t i = 0; i < all.size(); ++i)
        out += (i == 0 ? "" : i + 1 == all.size() ? " and " : ", ") + all[i];
    return out;
}

std::string sentence(const Front& f)
{
    std::vector<std::string> on, off;
    for (const std::size_t i : f.front) on.push_back(named(f.points[i], f.floor));
    for (std::size_t i = 0; i < f.points.size(); ++i)
        if (std::find(f.front.begin(), f.front.end(), i) == f.front.end())
            off.push_back(f.points[i].method);
    std::string words_of(words(f.kind));
    words_of[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(words_of[0])));
    std::string out =
        fmt::format("{}, {}, {}: from cheap to near, {} {} on the front.", words_of, f.law.label(),
                    f.band.words, listed(on), on.size() == 1 ? "is" : "are");
    if (!off.empty())
        out += fmt::format(" Something faster is at least as near as {}.", listed(off));
    return out;
}

}  // namespace

std::vector<Front> fronts_of(const Results& results)
{
    std::vector<Front> all;
    for (const Class kind : results.choice.classes)
        for (const Law& law : results.choice.laws)
            for (const Band& band : bands)
            {
                Front f;
                f.kind = kind;
                f.law = law;
                f.band = band;
                gather(results, f);
                if (f.points.empty()) continue;
                f.front = pareto_front(f.points);
                f.sentence = sentence(f);
                all.push_back(std::move(f));
            }
    return all;
}

}  // namespace regain::tools::cost
