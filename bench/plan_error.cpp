// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// How often a planned material is further from the walk than was predicted.
//
//   plan_error [COSTS.json [materials [samples [seed]]]]
//
// COSTS.json is what `regain cost --planner-data` writes; `-`, the default, what is compiled in.
// Without more, 200 materials by 65536 samples, which takes some minutes. Exit code 1 where more
// than 5 % are worse.

#include "plan_check.h"
#include "plan_report.h"

#include <cstdio>
#include <cstdlib>
#include <exception>

int main(int argc, char** argv)
try
{
    using namespace regain::tools;
    const std::string file = argc > 1 && std::string(argv[1]) != "-" ? argv[1] : "";
    const auto costs = method_costs(file);
    if (costs.empty())
    {
        std::fprintf(stderr, "plan_error: no costs are compiled in; name a file of them\n");
        return 2;
    }
    PlanCheck settings;
    if (argc > 2) settings.materials = std::atoi(argv[2]);
    if (argc > 3) settings.samples = std::strtoull(argv[3], nullptr, 10);
    if (argc > 4) settings.seed = static_cast<std::uint32_t>(std::strtoul(argv[4], nullptr, 10));

    int n = 0;
    const auto checks = checked_plans(
        costs, settings, [&] { std::fprintf(stderr, "\r%d of %d", ++n, settings.materials); });
    std::printf("\n%-9s %-9s %-9s %-8s  methods; material\n", "predicted", "measured", "tolerance",
                "noise");
    int worse = 0, beyond = 0;
    double ratios = 0;
    for (const CheckedPlan& c : checks)
    {
        std::printf("%9.5f %9.5f %9.4f %8.5f %c %s; %s\n", c.predicted, c.measured, c.tolerance,
                    c.noise, c.is_worse() ? '!' : ' ', c.methods.c_str(), c.material.c_str());
        worse += c.is_worse();
        beyond += c.measured > c.tolerance && c.predicted <= c.tolerance;
        ratios += c.measured / std::max(c.predicted, 1e-9);
    }
    const int count = static_cast<int>(checks.size());
    std::printf(
        "%d of %d worse than predicted; %d beyond a tolerance that was to be kept; measured "
        "over predicted %.2f on average\n",
        worse, count, beyond, ratios / std::max(count, 1));
    return 20 * worse <= count ? 0 : 1;
}
catch (const std::exception& e)
{
    std::fprintf(stderr, "plan_error: %s\n", e.what());
    return 2;
}
