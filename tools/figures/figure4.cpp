// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Figure 4 of Turquin 2019 (after Heitz et al. 2016, Figure 15): the lobes of the first, the second
// and the later bounces, from the random walk. The paper builds on their likeness, so it is
// measured, too: against the primary lobe, and against the lobe of Kulla and Conty.

#include "figure.h"
#include "measures.h"
#include "svg_plot.h"

#include <regain/closures/beckmann.h>
#include <regain/closures/constant_fresnel.h>
#include <regain/closures/ggx.h>
#include <regain/closures/kulla_conty.h>
#include <regain/closures/walk.h>
#include <regain/luts/library.h>

#include <fmt/format.h>

#include <array>

namespace regain::tools::figures {
namespace {

using Imath::V2d;

constexpr int orders = 3;  // the last is "third and later"
constexpr int directions = 60;
constexpr double slab = 0.1;  // |y| of the directions that count as in the plane of incidence

struct Lobes
{
    std::array<std::vector<double>, orders> slice;  // per steradian, by polar angle
    std::array<Histogram, orders> histogram;
};

template <class Distribution>
Lobes walked(const Distribution& distribution, double mu, std::uint64_t n, std::uint32_t seed)
{
    const double pi = std::acos(-1.0);
    const Walk<Distribution, ConstantFresnel<float>> walk(distribution, ConstantFresnel<float>());
    const auto prepared = walk.prepare(at_angle<float>(mu));
    Lobes lobes;
    for (auto& slice : lobes.slice) slice.resize(directions);
    for (auto& histogram : lobes.histogram) histogram.resize(histogram_bins);
    RandomNumbers random(seed);
    const Imath::V3d shift(random.next<double>(), random.next<double>(), random.next<double>());
    for (std::uint64_t i = 0; i < n; ++i)
    {
        const auto path = prepared.path(Imath::V3f(lattice_point(i, shift)));
        const auto order =
            static_cast<std::size_t>(std::min(static_cast<int>(path.bounces), orders) - 1);
        const auto& w = path.wi;
        lobes.histogram[order][histogram_bin(Imath::V3d(w))] += 1 / double(n);
        if (std::abs(double(w.y)) > slab) continue;
        // About the y axis: solid angle is dy dtheta.
        const double theta = std::atan2(double(w.z), double(w.x));
        const auto bin =
            static_cast<std::size_t>(std::min(theta / pi * directions, directions - 1.0));
        lobes.slice[order][bin] += directions / (double(n) * 2 * slab * pi);
    }
    return lobes;
}

Histogram normalised(Histogram h)
{
    double sum = 0;
    for (const double x : h) sum += x;
    for (double& x : h) x /= std::max(sum, 1e-30);
    return h;
}

LobePanel panel_of(const std::string& title, const Lobes& lobes, double mu)
{
    static constexpr const char* labels[] = {"first bounce", "second", "third and later"};
    static constexpr const char* colors[] = {"#2050b0", "#2e8b57", "#b02020"};
    LobePanel panel;
    panel.title = title;
    panel.arrow = V2d(std::sqrt(1 - mu * mu), mu);
    for (std::size_t k = 0; k < orders; ++k)
    {
        Curve curve{labels[k], colors[k], {{0, 0}}};
        for (std::size_t i = 0; i < directions; ++i)
        {
            const double theta = std::acos(-1.0) * (double(i) + 0.5) / directions;
            curve.points.push_back(V2d(std::cos(theta), std::sin(theta)) * lobes.slice[k][i]);
        }
        curve.points.emplace_back(0, 0);
        panel.curves.push_back(curve);
    }
    return panel;
}

template <class Distribution>
LobePanel add_case(const Request& request, Figure& figure, Table& table, const char* name,
                   const Distribution& distribution, double mu, const MicrofacetTables& tables)
{
    if (request.stopped()) throw Stopped();
    const auto n = static_cast<std::uint64_t>(std::max(4096.0, 4e6 * request.precision));
    const Lobes lobes = walked(distribution, mu, n, request.seed);
    Histogram later(histogram_bins);
    for (std::size_t i = 0; i < later.size(); ++i)
        later[i] = lobes.histogram[1][i] + lobes.histogram[2][i];
    const MissingEnergyLobe<float> added(distribution, tables);
    const Histogram kulla_conty =
        normalised(reflected_histogram(added.prepare(at_angle<float>(mu)), 1 << 20, request.seed));
    const Histogram first = normalised(lobes.histogram[0]);
    later = normalised(later);
    const double to_first = shape_error(first, later), to_added = shape_error(kulla_conty, later);
    const auto alpha = static_cast<double>(distribution.alpha_x());
    table.rows.push_back({name, fmt::format("{:.2g}", alpha), fmt::format("{:.2g}", mu),
                          fmt::format("{:.3f}", to_first), fmt::format("{:.3f}", to_added)});
    figure.numbers.push_back({{"distribution", name},
                              {"alpha", alpha},
                              {"mu", mu},
                              {"L1_to_primary", to_first},
                              {"L1_to_kulla_conty", to_added}});
    return panel_of(fmt::format("{}, alpha {:.2g}", name, alpha), lobes, mu);
}

}  // namespace

Figure make_figure4(const Request& request)
{
    Figure figure = titled("4", "lobes of the first, second and later bounces");
    figure.numbers = nlohmann::ordered_json::array();
    const MicrofacetTables ggx = luts::microfacet_tables("ggx"),
                           beckmann = luts::microfacet_tables("beckmann");

    Table table{
        "Distance of the lobe of all later bounces (L1 over 512 directions, each lobe "
        "scaled to energy 1; 0 the same, 2 nothing in common)",
        {"distribution", "alpha", "mu", "to the primary lobe", "to Kulla and Conty's"},
        {}};
    std::vector<LobePanel> panels;
    for (const float alpha : {0.5f, 1.0f})
        panels.push_back(
            add_case(request, figure, table, "Beckmann", Beckmann<float>(alpha), 0.5, beckmann));
    for (const float alpha : {0.5f, 1.0f})
        panels.push_back(add_case(request, figure, table, "GGX", GGX<float>(alpha), 0.5, ggx));

    const auto file = request.folder / "figure4.svg";
    write_text(file, svg_lobes(panels));
    figure.pictures.push_back(file);
    const auto distance = [&](std::size_t row, const char* to) {
        return figure.numbers[row][to].get<double>();
    };
    figure.findings.push_back(tested(
        "Secondary lobes do not look diffuse but like scaled-down versions of the primary one "
        "(shown "
        "for Beckmann).",
        fmt::format("Beckmann at alpha 0.5: the later bounces are {:.2f} from the primary lobe and "
                    "{:.2f} from Kulla and Conty's.",
                    distance(0, "L1_to_primary"), distance(0, "L1_to_kulla_conty")),
        distance(0, "L1_to_primary") < distance(0, "L1_to_kulla_conty")));
    const bool ggx_too = distance(2, "L1_to_primary") < distance(2, "L1_to_kulla_conty");
    figure.findings.push_back(
        tested("The same is assumed of GGX, which the paper's method is used with.",
               fmt::format(
                   "GGX at alpha 0.5: {:.2f} from the primary lobe, {:.2f} from Kulla and Conty's.",
                   distance(2, "L1_to_primary"), distance(2, "L1_to_kulla_conty")),
               ggx_too));
    figure.tables.push_back(table);
    return figure;
}

}  // namespace regain::tools::figures
