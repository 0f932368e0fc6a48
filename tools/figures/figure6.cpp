// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Figures 6 and 8 of Turquin 2019. 6: a rough GGX conductor without compensation, with energy alone
// (F_ms = 1), and with F_ms. 8: a rough glass object without and with compensation.

#include "measures.h"
#include "scenes.h"

#include <fmt/format.h>

namespace regain::tools::figures {
namespace {

template <class Real>
SampledEnergy energy(shaders::MicrofacetMaterial material, double mu, const Request& request)
{
    material.bind_tables();
    const auto n = static_cast<std::uint64_t>(std::max(4096.0, 65536 * request.precision));
    return material.with_closure_of<GGX>(Real(1), [&](const auto& closure) {
        return sampled_energy(closure.prepare(at_angle<Real>(mu)), n, request.seed);
    });
}

}  // namespace

Figure make_figure6(const Request& request)
{
    constexpr double alpha = 0.8, mu = 0.7;
    Figure figure =
        titled("6",
               "rough gold (alpha 0.8): no compensation, energy alone (normalise), with F_ms "
               "(turquin)");
    Cell cell;
    cell.layout.objects = 3;
    for (const Method method : {Method::none, Method::normalise, Method::turquin})
        cell.objects.push_back(gold(alpha, method));
    write_pictures(request, figure, "figure6",
                   render_cell(request, "figure 6", cell, 960, 400).picture);

    const auto saturation = [&](const shaders::Compensation& method) {
        const auto c = energy<float>(gold(alpha, method), mu, request).reflect;
        return 1 - c.z / c.x;
    };
    const double none = saturation(Method::none), plain = saturation(Method::normalise),
                 tinted = saturation(Method::turquin), walk = saturation(shaders::RandomWalk{});
    figure.findings.push_back(tested(
        "The colour is more saturated when Fresnel is applied.",
        fmt::format("1 - blue / red at mu 0.7: {:.3f} without compensation, {:.3f} with energy "
                    "alone, {:.3f} with F_ms; the random walk has {:.3f}.",
                    none, plain, tinted, walk),
        tinted > plain + 0.01));
    figure.numbers = {{"none", none}, {"normalise", plain}, {"turquin", tinted}, {"walk", walk}};
    return figure;
}

Figure make_figure8(const Request& request)
{
    constexpr double alpha = 0.5;
    Figure figure =
        titled("8", "rough GGX glass (alpha 0.5, index 1.5) without and with compensation");
    Cell cell;
    cell.layout.objects = 2;
    cell.layout.transparent = true;
    for (const Method method : {Method::none, Method::turquin})
        cell.objects.push_back(glass(alpha, method));
    write_pictures(request, figure, "figure8",
                   render_cell(request, "figure 8", cell, 960, 480).picture);

    // What an interface loses in each direction, and what is left of a unit of light after one
    // object: at least two interfaces.
    Table table{"R + T of one interface",
                {"mu", "entering, none", "entering, turquin", "leaving, none", "leaving, turquin"},
                {}};
    double worst = 0, lost = 0;
    for (const double mu : {0.1, 0.3, 0.6, 1.0})
    {
        std::vector<std::string> row{fmt::format("{}", mu)};
        for (const double side : {mu, -mu})
            for (const Method method : {Method::none, Method::turquin})
            {
                const SampledEnergy e = energy<double>(glass(alpha, method), side, request);
                const double total = e.reflect.x + e.transmit.x;
                row.push_back(fmt::format("{:.4f}", total));
                if (method == Method::turquin)
                    worst = std::max(worst, std::abs(total - 1));
                else
                    lost = std::max(lost, 1 - total);
            }
        table.rows.push_back(row);
    }
    figure.tables.push_back(table);
    figure.findings.push_back(tested(
        "The effect of the compensation on glass is quite noticeable, maybe more so than "
        "with conductors.",
        fmt::format("One interface loses up to {:.1f} % without, and light meets two or more "
                    "on its way; compensated, R + T is within {:.4f} of 1.",
                    100 * lost, worst),
        lost > 0.05 && worst < 5e-3));
    figure.numbers = {{"lost_worst", lost}, {"compensated_worst", worst}};
    return figure;
}

}  // namespace regain::tools::figures
