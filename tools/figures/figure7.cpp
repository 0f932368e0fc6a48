// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Figure 7 of Turquin 2019. Left: F_ms as printed in Eq. 7 for E_avg = 0.4, near F_ss^2. Right: the
// average depth of the random walk on a GGX surface over alpha, and the fit 1 + alpha sqrt(alpha).

#include "figure.h"
#include "measures.h"
#include "svg_plot.h"

#include <regain/closures/constant_fresnel.h>
#include <regain/closures/ggx.h>
#include <regain/closures/kulla_conty.h>
#include <regain/closures/walk.h>
#include <regain/luts/albedo_integral.h>
#include <regain/luts/quadrature.h>

#include <fmt/format.h>

namespace regain::tools::figures {
namespace {

using Imath::V2d;

// Left: how far Eq. 7 and the corrected series are from F_ss^2.
void plot_tint(const Request& request, Figure& figure)
{
    const double E_avg = luts::ggx_average_albedo(1);
    Curve printed{"F_ms of Eq. 7", "#2050b0", {}}, square{"F_ss^2", "#888888", {}, false, true},
        series{"Eq. 7 times F_ss (series)", "#b02020", {}};
    double off_printed = 0, off_series = 0, crossing = 0;
    for (int i = 0; i <= 100; ++i)
    {
        const double F = i / 100.0;
        const Color3<double> F_ss(F);
        const double p = kulla_conty_tint(KullaContyForm::printed, F_ss, 0.4).x,
                     s = kulla_conty_tint(KullaContyForm::series, F_ss, 0.4).x;
        printed.points.emplace_back(F, p);
        series.points.emplace_back(F, s);
        square.points.emplace_back(F, F * F);
        if (p > F * F) crossing = F;
        off_printed = std::max(off_printed, std::abs(p - F * F));
        off_series = std::max(off_series, std::abs(s - F * F));
    }
    const auto file = request.folder / "figure7-left.svg";
    write_text(file,
               svg_plot("F_ms for E_avg = 0.4", {"F_ss"}, {"F_ms"}, {printed, square, series}));
    figure.pictures.push_back(file);
    figure.findings.push_back(tested("E_avg is close to 0.4 at alpha = 1.",
                                     fmt::format("E_avg = {:.5f}.", E_avg),
                                     std::abs(E_avg - 0.4) < 0.02));
    figure.findings.push_back(tested(
        "F_ms of Eq. 7 gets close to F_ss^2; F_ss^2 would be slightly more saturated.",
        fmt::format(
            "The two differ by up to {:.3f}; the square is the darker of the two, so the more "
            "saturated, up to F_ss = {:.2f}. The series that gives k bounces k factors of "
            "F_ss stays below both, {:.3f} from the square at most.",
            off_printed, crossing, off_series),
        off_printed < 0.15));
    figure.numbers["left"] = {{"E_avg_alpha_1", E_avg},
                              {"largest_distance_eq7", off_printed},
                              {"largest_distance_series", off_series}};
}

// Mean number of facets met along one direction, F = 1.
double depth_along(double mu, double alpha, std::uint64_t walks, RandomNumbers& random)
{
    const Walk<GGX<double>, ConstantFresnel<double>> walk(GGX<double>{alpha},
                                                          ConstantFresnel<double>());
    const auto prepared = walk.prepare(at_angle<double>(mu));
    const double a = random.next<double>(), b = random.next<double>(), c = random.next<double>();
    double sum = 0;
    for (std::uint64_t i = 0; i < walks; ++i)
        sum += prepared.path(lattice_point(i, {a, b, c})).bounces;
    return sum / static_cast<double>(walks);
}

// The same over cosine-weighted directions: Gauss-Legendre over mu, weight 2 mu.
double average_depth(double alpha, std::uint64_t walks, RandomNumbers& random)
{
    const auto rule = luts::gauss_legendre(16);
    double mean = 0;
    for (std::size_t k = 0; k < rule.x.size(); ++k)
        mean += rule.weight[k] * 2 * rule.x[k] * depth_along(rule.x[k], alpha, walks, random);
    return mean;
}

void plot_depth(const Request& request, Figure& figure)
{
    const auto walks = static_cast<std::uint64_t>(std::max(64.0, 20000 * request.precision));
    Curve measured{"random walk", "#2050b0", {}, true}, fit{"1 + alpha sqrt(alpha)", "#b02020", {}};
    RandomNumbers random(request.seed);
    double worst = 0, at_worst = 0, last = 0;
    nlohmann::ordered_json numbers = nlohmann::ordered_json::array();
    for (int i = 0; i <= 20; ++i)
    {
        if (request.stopped()) throw Stopped();
        const double alpha = std::max(i / 20.0, 1e-3), claim = 1 + alpha * std::sqrt(alpha);
        const double depth = average_depth(alpha, walks, random);
        measured.points.emplace_back(alpha, depth);
        numbers.push_back({{"alpha", alpha}, {"depth", depth}, {"fit", claim}});
        last = depth;
        if (std::abs(depth - claim) > worst)
        {
            worst = std::abs(depth - claim);
            at_worst = alpha;
        }
    }
    for (int i = 0; i <= 100; ++i) fit.points.emplace_back(i / 100.0, 1 + std::pow(i / 100.0, 1.5));
    const auto file = request.folder / "figure7-right.svg";
    write_text(file, svg_plot("Average depth of the random walk, GGX", {"alpha"},
                              {"facets met", 1, 2.2, 0.2}, {fit, measured}));
    figure.pictures.push_back(file);
    figure.findings.push_back(tested(
        "The average depth goes from 1 to almost 2 and is fitted by 1 + alpha sqrt(alpha).",
        fmt::format("Averaged over cosine-weighted directions it is {:.4f} at alpha = 1 and within "
                    "{:.3f} of the fit everywhere (largest at alpha = {:.2f}). Along single "
                    "directions it is not: at normal incidence it reaches {:.2f}.",
                    last, worst, at_worst, depth_along(1, 1, 16 * walks, random)),
        worst < 0.04));
    figure.numbers["right"] = numbers;
}

}  // namespace

Figure make_figure7(const Request& request)
{
    Figure figure = titled("7", "F_ms of Eq. 7 over F_ss; the depth of the random walk over alpha");
    plot_tint(request, figure);
    plot_depth(request, figure);
    return figure;
}

}  // namespace regain::tools::figures
