// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// How far the compensation of anisotropic lobes is off: the tables of docs/methods.md, Anisotropy.
//
//   anisotropy_error [ggx] [beckmann] [std] [gtr] [balanced]
//
// Largest |1 - E| of the white furnace, F = 1, by quadrature through eval, over widths of which the
// wider is 0.01 to 1, cosines from 0.01 to 1, azimuths from the one axis to the other, and either
// axis the wider. Gains are all the same where F = 1, so `turquin` stands for them. Half an hour on
// one core.

#include <regain/closures/balanced_gain.h>
#include <regain/closures/beckmann.h>
#include <regain/closures/compensated.h>
#include <regain/closures/constant_fresnel.h>
#include <regain/closures/fitted_tail.h>
#include <regain/closures/gtr.h>
#include <regain/closures/kulla_conty.h>
#include <regain/closures/std.h>
#include <regain/luts/library.h>
#include <regain/luts/quadrature.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

namespace {

using namespace regain;

const double pi = std::acos(-1.0);

constexpr double widths[] = {0.01, 0.04, 0.1, 0.2, 0.35, 0.5, 0.7, 0.85, 1};
constexpr double ratios[] = {1.5, 2, 4, 10, 20};
constexpr double cosines[] = {0.01, 0.02, 0.06, 0.15, 0.3, 0.5, 0.7, 0.9, 1};
// Of the stretched and of the true azimuth, in quarter turns.
constexpr double azimuths[] = {0, 0.2, 0.4, 0.6, 0.8, 0.9, 1};

// Sums f(wi), the lobe's share given by the closure at wi, over directions: over the stretched
// slopes of the half-vector, with nodes gathered towards grazing wi, across the azimuth of wo, and
// next to the axes; and at slopes of 1, where long tails are.
template <class F>
double integral(const Vec3<double>& wo, double ax, double ay, const F& f)
{
    static const luts::QuadratureRule rule = luts::gauss_legendre(24);
    double sum = 0;
    const auto along = [&](double phi, double dphi) {
        const double p = ax * std::cos(phi), q = ay * std::sin(phi);
        const double a = p * p + q * q, b = (p * wo.x + q * wo.y) / wo.z;
        const double root = std::sqrt(b * b + a);
        const double edge = b > 0 ? (b + root) / a : 1 / (root - b);
        const double bend = std::max({1.0, 1 / std::sqrt(a), 1 / std::sqrt(ax * ay)});
        const auto at = [&](double rho, double drho) {
            const double h_z = 1 / std::sqrt(1 + rho * rho * a);
            const Vec3<double> h(rho * p * h_z, rho * q * h_z, h_z);
            const double facing = wo.dot(h);
            const Vec3<double> wi = h * (2 * facing) - wo;
            if (facing <= 0 || wi.z <= 0) return;
            sum += f(wi) * 4 * facing * h_z * h_z * h_z * ax * ay * dphi * rho * drho;
        };
        for (std::size_t i = 0; i < rule.x.size(); ++i)
        {
            const double y = rule.x[i], y3 = y * y * y, slope = 3 * y * y * rule.weight[i];
            if (edge <= 1)
            {
                at(edge * (1 - y3), edge * slope);
                continue;
            }
            at(y, rule.weight[i]);
            const bool last = edge <= bend;
            const double range = std::log(std::min(edge, bend)),
                         rho = std::exp(range * (last ? 1 - y3 : y));
            at(rho, rho * range * (last ? slope : rule.weight[i]));
            if (last) continue;
            const double outer = bend / edge, w = outer + (1 - outer) * y3;
            at(bend / w, bend / (w * w) * (1 - outer) * slope);
        }
    };
    const double across = std::atan2(wo.y * ay, wo.x * ax) + 0.5 * pi;
    std::vector<double> limits{across, across + pi, 0, 0.5 * pi, pi, 1.5 * pi};
    for (double& phi : limits) phi -= 2 * pi * std::floor(phi / (2 * pi));
    std::sort(limits.begin(), limits.end());
    limits.push_back(limits.front() + 2 * pi);
    for (std::size_t k = 0; k + 1 < limits.size(); ++k)
    {
        const double length = limits[k + 1] - limits[k];
        for (std::size_t j = 0; j < rule.x.size() && length > 1e-7; ++j)
        {
            const double x = rule.x[j];
            along(limits[k] + length * x * x * x * (10 - 15 * x + 6 * x * x),
                  length * 30 * x * x * (1 - x) * (1 - x) * rule.weight[j]);
        }
    }
    return sum;
}

// The same over the hemisphere, for the added lobes: nodes gathered at grazing wi, and ahead of wo.
template <class F>
double hemisphere(const Vec3<double>& wo, const F& f)
{
    static const luts::QuadratureRule rule = luts::gauss_legendre(36);
    const double ahead = std::atan2(-wo.y, -wo.x);
    double sum = 0;
    for (std::size_t i = 0; i < rule.x.size(); ++i)
    {
        const double x = rule.x[i], mu = x * x * x, sine = std::sqrt((1 - mu) * (1 + mu));
        double ring = 0;
        for (std::size_t j = 0; j < rule.x.size(); ++j)
            for (const int side : {-1, 1})
            {
                const double y = rule.x[j], phi = ahead + side * pi * y * y * y;
                ring += f(Vec3<double>(sine * std::cos(phi), sine * std::sin(phi), mu)) * pi * 3 *
                        y * y * rule.weight[j];
            }
        sum += ring * 3 * x * x * rule.weight[i];
    }
    return sum;
}

template <class Distribution>
void report(const std::string& name, const std::string& label,
            const std::function<Distribution(double, double)>& make)
{
    using Lobe = MicrofacetReflection<Distribution, ConstantFresnel<double>>;
    MicrofacetTables tables = luts::microfacet_tables(name);
    luts::add_anisotropy(tables, name);
    bool has_tail = true;
    try
    {
        luts::add_later_bounces(tables, name);
        luts::add_later_shape(tables, name);
    }
    catch (const std::exception&)
    {
        has_tail = false;
    }
    for (const double ratio : ratios)
    {
        double one_width = 0, gain_error = 0, kulla_error = 0, tail_error = 0;
        for (const double width : widths)
            for (const bool turned : {false, true})
            {
                const double ax = turned ? width / ratio : width,
                             ay = turned ? width : width / ratio;
                const Lobe lobe(make(ax, ay), ConstantFresnel<double>());
                const auto gain = compensated(lobe, Method::turquin, tables);
                const auto kulla = kulla_conty(lobe, KullaContyForm::series, tables);
                const auto tail = fitted_tail(lobe, tables);
                const TableAxes<double> axes(lobe.distribution());
                for (const double mu : cosines)
                    for (const double part : azimuths)
                    {
                        if ((mu == 1 && part > 0) || (turned && part != 0.4)) continue;
                        for (const bool stretched : {false, true})
                        {
                            const double phi = 0.5 * pi * part, s = std::sqrt((1 - mu) * (1 + mu));
                            const Vec3<double> way =
                                stretched ? Vec3<double>(std::cos(phi) * ay, std::sin(phi) * ax, 0)
                                          : Vec3<double>(std::cos(phi), std::sin(phi), 0);
                            if (stretched && (part == 0 || part == 1 || mu == 1)) continue;
                            const Vec3<double> flat = way * (s / way.length());
                            const Vec3<double> wo(flat.x, flat.y, mu);

                            const auto white = gain.prepare(wo);
                            const double E = integral(
                                wo, ax, ay, [&](const auto& wi) { return white.eval(wi).x; });
                            gain_error = std::max(gain_error, std::abs(E - 1));
                            const double single = E / gain.gain().at(wo).x;
                            one_width =
                                std::max(one_width, std::abs(single / tables.albedo(axes, mu) - 1));
                            // Quadrature of the added lobes costs more; half of the places do.
                            if (stretched) continue;
                            const auto added = kulla.added_lobe().prepare(wo);
                            kulla_error =
                                std::max(kulla_error,
                                         std::abs(single - 1 + hemisphere(wo, [&](const auto& wi) {
                                                      return added.eval(wi).x;
                                                  })));
                            if (!has_tail) continue;
                            const auto later = tail.added_lobe().prepare(wo);
                            tail_error =
                                std::max(tail_error,
                                         std::abs(single - 1 + hemisphere(wo, [&](const auto& wi) {
                                                      return later.eval(wi).x;
                                                  })));
                        }
                    }
            }
        std::printf("| %s | %g | %.4f | %.4f | %.4f | ", label.c_str(), ratio, one_width,
                    gain_error, kulla_error);
        if (has_tail)
            std::printf("%.4f |\n", tail_error);
        else
            std::printf("- |\n");
        std::fflush(stdout);
    }
}

// The same of `balanced`, whose gain is no factor of wo: without the table that it has for
// anisotropic lobes, and with it.
template <class Distribution>
void report_balance(const std::string& name, const std::string& label,
                    const std::function<Distribution(double, double)>& make)
{
    MicrofacetTables mapped = luts::microfacet_tables(name);
    luts::add_later_bounces(mapped, name);
    luts::add_balance(mapped, name);
    MicrofacetTables tables = mapped;
    luts::add_balance_anisotropy(tables, name);
    for (const double ratio : ratios)
    {
        double without = 0, with = 0;
        for (const double width : widths)
        {
            const double narrow = width / ratio;
            const MicrofacetReflection lobe(make(narrow, width), ConstantFresnel<double>());
            const auto plain = balanced(lobe, mapped), ours = balanced(lobe, tables);
            for (const double mu : cosines)
                for (const double part : azimuths)
                {
                    if (mu == 1 && part > 0) continue;
                    const double phi = 0.5 * pi * part, s = std::sqrt((1 - mu) * (1 + mu));
                    const Vec3<double> wo(s * std::cos(phi), s * std::sin(phi), mu);
                    const auto a = plain.prepare(wo), b = ours.prepare(wo);
                    without = std::max(
                        without, std::abs(integral(wo, narrow, width,
                                                   [&](const auto& wi) { return a.eval(wi).x; }) -
                                          1));
                    with = std::max(
                        with, std::abs(integral(wo, narrow, width,
                                                [&](const auto& wi) { return b.eval(wi).x; }) -
                                       1));
                }
        }
        std::printf("| %s | %g | %.4f | %.4f |\n", label.c_str(), ratio, without, with);
        std::fflush(stdout);
    }
}

}  // namespace

int main(int argc, char** argv)
{
    const auto wanted = [&](const std::string& what) {
        return argc == 1 || std::find(argv + 1, argv + argc, what) != argv + argc;
    };
    std::printf("| lobe | ratio | one width | gains | `kulla-conty` | `tail` |\n");
    std::printf("|---|---|---|---|---|---|\n");
    if (wanted("ggx"))
        report<GGX<double>>("ggx", "GGX", [](double x, double y) { return GGX<double>(x, y); });
    if (wanted("beckmann"))
        report<Beckmann<double>>("beckmann", "Beckmann",
                                 [](double x, double y) { return Beckmann<double>(x, y); });
    for (const double gamma : {1.55, 1.7, 3.0, 10.0})
        if (wanted("std"))
            report<STD<double>>("std", "STD " + std::to_string(gamma).substr(0, 4),
                                [=](double x, double y) { return STD<double>(x, y, gamma); });
    for (const double gamma : {0.3, 1.0, 1.7, 3.0, 8.0})
        if (wanted("gtr"))
            report<GTR<double>>("gtr", "GTR " + std::to_string(gamma).substr(0, 3),
                                [=](double x, double y) { return GTR<double>(x, y, gamma); });

    if (wanted("balanced"))
    {
        std::printf("\n| `balanced` | ratio | without its table | with it |\n|---|---|---|---|\n");
        report_balance<GGX<double>>("ggx", "GGX",
                                    [](double x, double y) { return GGX<double>(x, y); });
        report_balance<Beckmann<double>>("beckmann", "Beckmann",
                                         [](double x, double y) { return Beckmann<double>(x, y); });
        for (const double gamma : {1.55, 1.7, 3.0, 10.0})
            report_balance<STD<double>>(
                "std", "STD " + std::to_string(gamma).substr(0, 4),
                [=](double x, double y) { return STD<double>(x, y, gamma); });
        for (const double gamma : {0.1, 0.3, 1.0, 1.7, 3.0, 8.0})
            report_balance<GTR<double>>(
                "gtr", "GTR " + std::to_string(gamma).substr(0, 3),
                [=](double x, double y) { return GTR<double>(x, y, gamma); });
    }
    return 0;
}
