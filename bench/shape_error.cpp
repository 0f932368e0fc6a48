// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// How far each method's lobe is from the random walk's in shape, with F = 1: the table of
// docs/methods.md.
//
//   shape_error [samples] [fits]
//
// With `fits` the methods take the formulas of analytic_tables.h in place of tables.
//
// L1 distance over 512 cells of equal solid angle, in the half that is like the other, of all that
// is reflected. Both sides are histograms of samples; two of the walk, from numbers that have
// nothing to do with each other, tell the noise. 2^23 samples, the default, bring that below 0.003
// in some minutes.

#include <regain/closures/analytic_tables.h>
#include <regain/closures/balanced_gain.h>
#include <regain/closures/beckmann.h>
#include <regain/closures/compensated.h>
#include <regain/closures/constant_fresnel.h>
#include <regain/closures/fitted_tail.h>
#include <regain/closures/ggx.h>
#include <regain/closures/kulla_conty.h>
#include <regain/closures/walk.h>
#include <regain/luts/library.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace regain;
using White = ConstantFresnel<double>;

constexpr double alphas[] = {0.25, 0.5, 0.75, 1}, cosines[] = {0.2, 0.5, 0.9};
constexpr const char* columns[] = {
    "`none`", "`turquin` and all gains(wo)", "`balanced`", "`kulla-conty`", "`tail`", "noise"};

using Cells = std::array<double, 512>;
using Row = std::array<double, std::size(columns)>;

template <class Prepared>
Cells cells_of(const Prepared& prepared, int samples, double seed)
{
    Cells cells{};
    const Vec3<double> start = RandomStream<double>({seed, 0.5, 0.25}).next3();
    for (int i = 0; i < samples; ++i)
    {
        const Sample<double> s = prepared.sample(regain::detail::shifted_numbers(start, i));
        if (!s.valid) continue;
        const double turn = std::atan2(std::abs(s.wi.y), s.wi.x) / std::acos(-1.0);
        const auto row = std::min(15, static_cast<int>(s.wi.z * 16)),
                   column = std::min(31, static_cast<int>(turn * 32));
        cells[static_cast<std::size_t>(row * 32 + column)] += s.weight.x / samples;
    }
    return cells;
}

double distance(const Cells& a, const Cells& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
    return sum;
}

template <class Distribution>
Row measured(const Distribution& distribution, const MicrofacetTables& tables, double mu,
             int samples)
{
    const Vec3<double> wo(std::sqrt((1 - mu) * (1 + mu)), 0, mu);
    const MicrofacetReflection<Distribution, White> lobe(distribution, White(), tables);
    const auto walk = Walk<Distribution, White>(distribution, White()).prepare(wo);
    const Cells truth = cells_of(walk, samples, 0.1);
    const auto off = [&](const auto& closure) {
        return distance(truth, cells_of(closure.prepare(wo), samples, 0.6));
    };
    return {off(lobe),
            off(compensated(lobe, Method::normalise, tables)),
            off(balanced(lobe, tables)),
            off(kulla_conty(lobe, KullaContyForm::printed, tables)),
            off(fitted_tail(lobe, tables)),
            distance(truth, cells_of(walk, samples, 0.9))};
}

template <class Distribution>
void print(const std::string& name, int samples, bool fits)
{
    MicrofacetTables tables = luts::microfacet_tables(name);
    luts::add_later_bounces(tables, name);
    luts::add_later_shape(tables, name);
    if (fits) tables = analytic_tables<Distribution>();
    luts::add_balance(tables, name);
    for (const double alpha : alphas)
    {
        std::array<Row, std::size(cosines)> rows;
        std::vector<std::thread> threads;
        for (std::size_t i = 0; i < rows.size(); ++i)
            threads.emplace_back(
                [&, i] { rows[i] = measured(Distribution(alpha), tables, cosines[i], samples); });
        for (std::thread& thread : threads) thread.join();
        std::printf("| %s, alpha %g |", name.c_str(), alpha);
        for (std::size_t column = 0; column < std::size(columns); ++column)
            std::printf(" %.3f / %.3f / %.3f |", rows[0][column], rows[1][column], rows[2][column]);
        std::printf("\n");
        std::fflush(stdout);
    }
}

}  // namespace

int main(int argc, char** argv)
{
    const int samples = argc > 1 ? std::atoi(argv[1]) : 1 << 23;
    if (samples < 1)
    {
        std::fprintf(stderr, "samples is '%s'; accepted: 1 to %d\n", argv[1], 1 << 30);
        return 2;
    }
    const bool fits = argc > 2 && argv[2] == std::string("fits");
    std::printf("| mu 0.2 / 0.5 / 0.9 |");
    for (const char* column : columns) std::printf(" %s |", column);
    std::printf("\n|---|---|---|---|---|---|---|\n");
    print<GGX<double>>("ggx", samples, fits);
    print<Beckmann<double>>("beckmann", samples, fits);
    return 0;
}
