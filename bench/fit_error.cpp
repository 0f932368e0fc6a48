// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// How far the formulas of regain/closures/analytic_albedo.h are from quadrature. What depends on
// walks is measured by `albedo_error WALKS fits` and `shape_error SAMPLES fits`.
//
//   fit_error [places]
//
// Places are drawn at random: mu and alpha each uniform in [0, 1] or log-uniform from 1e-6, in all
// four combinations; and as many with alpha and mu log-uniform about each other, where the dip of
// E_ss is. 20000, the default, take half a minute.

#include <regain/closures/analytic_tables.h>
#include <regain/luts/albedo_integral.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

namespace {

using namespace regain;

struct Range
{
    double low = 1e9, high = -1e9;
    double at[2][2] = {};  // alpha and mu of either

    void add(double value, double alpha, double mu)
    {
        if (value < low) low = value, at[0][0] = alpha, at[0][1] = mu;
        if (value > high) high = value, at[1][0] = alpha, at[1][1] = mu;
    }
    void print(const char* what) const
    {
        std::printf("  %-26s %10.6f (alpha %.3g, mu %.3g) to %.6f (alpha %.3g, mu %.3g)\n", what,
                    low, at[0][0], at[0][1], high, at[1][0], at[1][1]);
    }
};

void measure(const std::string& name, const MicrofacetFits& fits, int places)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit;
    const auto even = [&] { return std::max(unit(random), 1e-6); };
    const auto logarithmic = [&] { return std::exp(std::log(1e-6) * unit(random)); };
    Range furnace, absolute, falloff, dip, rounding;
    for (int i = 0; i < places; ++i)
    {
        const double alpha = i % 2 ? even() : logarithmic();
        double mu = i % 4 < 2 ? even() : logarithmic();
        if (i % 8 == 7) mu = std::min(1.0, alpha * std::exp(4 * unit(random) - 2));
        const luts::AlbedoMoments exact =
            luts::albedo_moments(luts::SlopeLaw::named(name, alpha, 0), mu);
        const double E = fits.E_ss(mu, alpha);
        furnace.add(exact.E_ss / E, alpha, mu);
        absolute.add(E - exact.E_ss, alpha, mu);
        rounding.add(double(fits.E_ss(float(mu), float(alpha))) -
                         fits.E_ss(double(float(mu)), double(float(alpha))),
                     alpha, mu);
        const FresnelMoments<double> m = fits.moments(mu, alpha);
        falloff.add((m.falloff - exact.falloff) * exact.E_ss, alpha, mu);
        dip.add((m.dip - exact.dip) * exact.E_ss, alpha, mu);
    }
    Range average;
    for (int i = 0; i <= 200; ++i)
    {
        const double alpha = std::max(i * i / 4e4, 1e-6);
        average.add(fits.E_avg(alpha) - luts::average_albedo(luts::SlopeLaw::named(name, alpha, 0)),
                    alpha, 0);
    }
    std::printf("%s\n", name.c_str());
    furnace.print("furnace, E_ss / fit");
    absolute.print("E_ss, fit - exact");
    rounding.print("E_ss, float - double");
    average.print("E_avg, fit - exact");
    falloff.print("falloff E_ss, fit - exact");
    dip.print("dip E_ss, fit - exact");
}

}  // namespace

int main(int argc, char** argv)
{
    const int places = argc > 1 ? std::atoi(argv[1]) : 20000;
    if (places < 1)
    {
        std::fprintf(stderr, "places is '%s'; accepted: 1 to %d\n", argv[1], 1 << 30);
        return 2;
    }
    measure("ggx", ggx_fits, places);
    measure("beckmann", beckmann_fits, places);
    return 0;
}
