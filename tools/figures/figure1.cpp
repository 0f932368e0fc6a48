// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Figure 1 of Turquin 2019: increasingly rough GGX conductor widgets, single scattering above, with
// the paper's compensation below.

#include "measures.h"
#include "scenes.h"

#include <fmt/format.h>

namespace regain::tools::figures {
namespace {

constexpr double alphas[] = {0.05, 0.2, 0.4, 0.6, 0.8, 1.0};

// What a material reflects of light from everywhere, over cosine-weighted directions.
Imath::Color3<double> average_albedo(shaders::MicrofacetMaterial material, const Request& request)
{
    const auto n = static_cast<std::uint64_t>(std::max(256.0, 16384 * request.precision));
    material.bind_tables();
    return material.with_closure_of<GGX>(1.0f, [&](const auto& closure) {
        Imath::Color3<double> sum(0.0);
        constexpr int cosines = 16;
        for (int i = 0; i < cosines; ++i)
        {
            const double mu = std::sqrt((i + 0.5) / cosines);
            sum += sampled_energy(closure.prepare(at_angle<float>(mu)), n, request.seed).reflect;
        }
        return sum / cosines;
    });
}

double saturation(const Imath::Color3<double>& c)
{
    return 1 - std::min({c.x, c.y, c.z}) / std::max({c.x, c.y, c.z});
}

}  // namespace

Figure make_figure1(const Request& request)
{
    Figure figure =
        titled("1",
               "increasingly rough GGX gold; single scattering above, method turquin below; "
               "alpha 0.05, 0.2, 0.4, 0.6, 0.8, 1");
    std::vector<Picture> rows;
    for (const Method method : {Method::none, Method::turquin})
    {
        Cell cell;
        cell.layout.objects = static_cast<int>(std::size(alphas));
        for (const double alpha : alphas) cell.objects.push_back(gold(alpha, method));
        rows.push_back(
            render_cell(request, fmt::format("figure 1, {}", name(method)), cell, 1440, 300)
                .picture);
    }
    write_pictures(request, figure, "figure1", tiled(rows, 1));

    Table table{"average albedo (R, G, B) and saturation 1 - min / max",
                {"alpha", "none", "saturation", "turquin", "saturation"},
                {}};
    std::vector<Imath::Color3<double>> none, ours;
    for (const double alpha : alphas)
    {
        none.push_back(average_albedo(gold(alpha, Method::none), request));
        ours.push_back(average_albedo(gold(alpha, Method::turquin), request));
        const auto cell = [](const Imath::Color3<double>& c) {
            return fmt::format("{:.3f} {:.3f} {:.3f}", c.x, c.y, c.z);
        };
        table.rows.push_back({fmt::format("{:.2f}", alpha), cell(none.back()),
                              fmt::format("{:.3f}", saturation(none.back())), cell(ours.back()),
                              fmt::format("{:.3f}", saturation(ours.back()))});
        figure.numbers.push_back({{"alpha", alpha},
                                  {"none", {none.back().x, none.back().y, none.back().z}},
                                  {"turquin", {ours.back().x, ours.back().y, ours.back().z}}});
    }
    figure.tables.push_back(table);
    const auto &dark = none.back(), &bright = ours.back();
    figure.findings.push_back(
        tested("Boosted intensity and saturation as the surface becomes rougher.",
               fmt::format("At alpha = 1 green goes from {:.3f} to {:.3f}, the saturation from "
                           "{:.2f} to {:.2f}.",
                           dark.y, bright.y, saturation(dark), saturation(bright)),
               bright.y > 1.2 * dark.y && saturation(bright) > saturation(dark)));
    figure.findings.push_back(
        tested("A more uniform gradation over roughness.",
               fmt::format("From alpha 0.05 to 1 red falls by {:.0f} % without and {:.0f} % with "
                           "compensation.",
                           100 * (1 - none.back().x / none.front().x),
                           100 * (1 - ours.back().x / ours.front().x)),
               ours.back().x / ours.front().x > none.back().x / none.front().x));
    return figure;
}

}  // namespace regain::tools::figures
