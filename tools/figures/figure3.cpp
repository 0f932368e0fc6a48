// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Figure 3 of Turquin 2019: Burley's 2015 sheen from 0 to 1, over a Lambertian base.

#include "../preview/cloth.h"
#include "measures.h"
#include "scenes.h"

#include <regain/luts/albedo_integral.h>

#include <fmt/format.h>

namespace regain::tools::figures {
namespace {

using preview::Cloth;

/// On a dark base sheen shows.
Cloth cloth(double weight)
{
    shaders::SheenSurface sheen;
    sheen.weight = weight;
    return {sheen};
}

}  // namespace

Figure make_figure3(const Request& request)
{
    constexpr int objects = 5;
    Figure figure = titled("3", "sheen 0, 0.25, 0.5, 0.75, 1 over a dark base, as in Burley 2015");
    Cell cell;
    cell.layout.objects = objects;
    cell.object = [](int i) { return preview::bind(cloth(i / double(objects - 1))); };
    write_pictures(request, figure, "figure3",
                   render_cell(request, "figure 3", cell, 1200, 300).picture);

    Table table{"directional albedo", {"mu", "sheen 0", "sheen 0.5", "sheen 1"}, {}};
    const auto n = static_cast<std::uint64_t>(std::max(4096.0, 65536 * request.precision));
    double added_grazing = 0, added_normal = 0;
    for (const double mu : {0.02, 0.1, 0.3, 1.0})
    {
        std::vector<std::string> row{fmt::format("{}", mu)};
        for (const double weight : {0.0, 0.5, 1.0})
        {
            const double E =
                sampled_energy(cloth(weight).closure(1.0).prepare(at_angle<double>(mu)), n,
                               request.seed)
                    .reflect.x;
            row.push_back(fmt::format("{:.4f}", E));
            if (weight == 1.0 && mu == 0.02) added_grazing = E - Cloth::dark;
            if (weight == 1.0 && mu == 1.0) added_normal = E - Cloth::dark;
        }
        table.rows.push_back(row);
    }
    figure.tables.push_back(table);
    figure.findings.push_back(
        tested("Sheen adds grazing reflection, with the Schlick profile.",
               fmt::format("Full sheen adds {:.4f} to the albedo at mu = 0.02 and {:.4f} at normal "
                           "incidence.",
                           added_grazing, added_normal),
               added_grazing > 10 * added_normal));
    const double lost = 1 - luts::ggx_average_albedo(1);
    figure.findings.push_back(shown(
        "It does not follow roughness, so it has to be adjusted whenever that is edited.",
        fmt::format("The lobe has no roughness at all: it adds what it adds, whether the base "
                    "loses nothing or, as a white GGX mirror of alpha 1, {:.2f} on average.",
                    lost)));
    figure.numbers = {{"added_mu_0.02", added_grazing}, {"added_mu_1", added_normal}};
    return figure;
}

}  // namespace regain::tools::figures
