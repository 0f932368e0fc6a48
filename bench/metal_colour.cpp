// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// How far from the colour of a metal, integrated over its spectrum at every angle, what a renderer
// of three channels computes is: the table of docs/colour.md.
//
//   metal_colour [OCIO config]
//
// CIEDE2000 by D65, in the mean over the metals and for the worst of them, of
//   averaged index   n and k averaged over the spectrum as if they were colours
//   fitted index     metal_index: per channel the index with the colour's F0 and the nearest curve
//   Schlick          F0 alone
//   F82              metal_color: F0, and the colour at 82 degrees fitted

#include "support/color_difference.h"
#include "support/working_space.h"

#include <regain/closures/conductor_fresnel.h>
#include <regain/closures/schlick_fresnel.h>
#include <regain/shaders/metals.h>
#include <regain/shaders/spectrum.h>

#include <algorithm>
#include <cstdio>

using namespace regain;
using namespace regain::shaders;
using namespace regain::tests;

namespace {

const double pi = std::acos(-1.0);

// n and k of a metal by its reflectance at two angles: the tables are the library's own.
struct Spectrum
{
    double n[401], k[401];
};

// From R at normal incidence and at 60 degrees.
Spectrum spectrum_of(const std::string& metal)
{
    Spectrum s;
    for (int i = 0; i <= 400; ++i)
    {
        const double nm = 380 + i, R = metal_reflectance(metal, 1, nm),
                     R60 = metal_reflectance(metal, 0.5, nm);
        const double root = std::sqrt(R), least = (1 - R) / (1 + R), most = (1 + root) / (1 - root);
        double best = least, best_error = 1e9;
        const auto k_of = [&](double n) {
            return std::sqrt(std::max((R * (n + 1) * (n + 1) - (n - 1) * (n - 1)) / (1 - R), 0.0));
        };
        for (double low = std::log(least), high = std::log(most); high - low > 1e-9;)
        {
            const double step = (high - low) / 64;
            best_error = 1e9;
            for (int j = 0; j <= 64; ++j)
            {
                const double n = std::exp(low + step * j),
                             e = std::abs(ConductorFresnel<double>(C3d(n), C3d(k_of(n))).at(0.5).x -
                                          R60);
                if (e >= best_error) continue;
                best_error = e;
                best = n;
            }
            low = std::max(std::log(least), std::log(best) - step);
            high = std::min(std::log(most), std::log(best) + step);
            if (step < 1e-8) break;
        }
        s.n[i] = best;
        s.k[i] = k_of(best);
    }
    return s;
}

}  // namespace

int main(int argc, char** argv)
{
    const ColorConfig config = argc > 1 ? ColorConfig::from_file(argv[1]) : ColorConfig::builtin();
    const Imath::M33d to_working = to_working_space(config);
    C3d white(0.0);
    const Imath::M33d to_xyz = to_working.inverse();
    for (int nm = first_wavelength; nm <= last_wavelength; ++nm)
        white += times_column(to_working, xyz_d65_weight(nm));
    const auto lab = [&](const C3d& c) { return lab_of_xyz_d65(times_column(to_xyz, c)); };

    const double angles[] = {0, 30, 45, 60, 70, 75, 80, 82, 85, 88};
    const char* names[] = {"averaged index", "fitted index", "Schlick", "F82"};
    constexpr int ways = 4, count = 10;
    double mean[ways][count] = {}, worst[ways][count] = {};
    std::string whose[ways];
    double most[ways] = {};
    const auto metals = metal_names();
    for (const std::string& metal : metals)
    {
        const MetalColor color = metal_color(metal, config);
        const MetalIndex index = metal_index(metal, config);
        const Spectrum spectrum = spectrum_of(metal);
        C3d n(0.0), k(0.0);
        for (int i = 0; i <= 400; ++i)
        {
            const C3d w = times_column(to_working, xyz_d65_weight(380 + i)) / white;
            n += w * spectrum.n[i];
            k += w * spectrum.k[i];
        }
        for (int c = 0; c < 3; ++c)
        {
            n[c] = std::max(n[c], 1e-3);
            k[c] = std::max(k[c], 0.0);
        }
        const ConductorFresnel<double> averaged(n, k), fitted(index.n, index.k);
        const SchlickFresnel<double> schlick(color.F0), f82(color.F0, color.F82);
        for (int a = 0; a < count; ++a)
        {
            const double mu = std::cos(angles[a] * pi / 180);
            const Lab exact = lab(metal_reflectance(metal, mu, config));
            const C3d got[ways] = {averaged.at(mu), fitted.at(mu), schlick.at(mu), f82.at(mu)};
            for (int w = 0; w < ways; ++w)
            {
                const double d = ciede2000(exact, lab(got[w]));
                mean[w][a] += d / double(metals.size());
                worst[w][a] = std::max(worst[w][a], d);
                if (d > most[w]) most[w] = d, whose[w] = metal;
            }
        }
    }
    std::printf("Working space %s, %zu metals.\n\n| way |", config.scene_linear().c_str(),
                metals.size());
    for (const double a : angles) std::printf(" %g |", a);
    std::printf(" worst of |\n|---|");
    for (int a = 0; a < count; ++a) std::printf("---|");
    std::printf("---|\n");
    for (int w = 0; w < ways; ++w)
    {
        std::printf("| %s |", names[w]);
        for (int a = 0; a < count; ++a) std::printf(" %.2f / %.2f |", mean[w][a], worst[w][a]);
        std::printf(" %s |\n", whose[w].c_str());
    }
    return 0;
}
