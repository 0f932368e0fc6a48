// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// How far the compensation of anisotropic glass is off: the tables of docs/methods.md, Anisotropy.
//
//   anisotropic_glass_error [ggx] [beckmann]
//
// Largest errors over widths of which the wider is 0.05 to 1, cosines from 0.03 to 1, azimuths from
// the one axis to the other: of R + T with a gain, where E^S is above 0.1, and with added lobes,
// which is E^S less what is looked up, anywhere; with the table of anisotropy and without. What
// single scattering returns is by the quadrature that the tables are baked from; the tests compare
// that with eval. A few minutes on one core.

#include <regain/closures/beckmann.h>
#include <regain/closures/dielectric.h>
#include <regain/luts/anisotropic_dielectric.h>
#include <regain/luts/library.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace {

using namespace regain;

const double pi = std::acos(-1.0);

constexpr double indices[] = {1.05, 1.1, 1.33, 1.5, 2, 3};
constexpr double ratios[] = {2, 4, 10, 20};
constexpr double widths[] = {0.05, 0.2, 0.4, 0.65, 0.9, 1};
constexpr double cosines[] = {0.03, 0.06, 0.12, 0.25, 0.45, 0.7, 0.9, 1};
// Of the true and of the stretched azimuth, in quarter turns.
constexpr double azimuths[] = {0, 0.25, 0.5, 0.7, 0.85, 1};

struct Worst
{
    double gain = 0, added = 0, gain_without = 0, added_without = 0, share = 0;
};

template <class Distribution>
void report(const std::string& name, const std::string& label)
{
    const bool ggx = name == "ggx";
    const luts::SlopeLaw unit = ggx ? luts::SlopeLaw::ggx(1) : luts::SlopeLaw::beckmann(1);
    DielectricTables with[2], without[2];
    for (const int form : {0, 1})
    {
        const auto shadowing =
            form ? TransmissionShadowing::beta : TransmissionShadowing::correlated;
        with[form] = without[form] = luts::dielectric_tables(name, shadowing);
        luts::add_anisotropy(with[form], name, shadowing);
    }
    for (const bool inside : {false, true})
        for (const double index : indices)
            for (const double ratio : ratios)
            {
                Worst worst[2];
                const double eta = inside ? 1 / index : index;
                for (const double width : widths)
                    for (const double mu : cosines)
                        for (const double part : azimuths)
                            for (const bool stretched : {false, true})
                            {
                                if (mu == 1 && part > 0) continue;
                                if (stretched && (part == 0 || part == 1)) continue;
                                const Distribution normals(width, width / ratio);
                                const double way = 0.5 * pi * part,
                                             phi =
                                                 stretched ? std::atan(ratio * std::tan(way)) : way,
                                             s = std::sqrt((1 - mu) * (1 + mu));
                                const Vec3<double> wo(s * std::cos(phi), s * std::sin(phi), mu);
                                const auto a = luts::anisotropic_dielectric_albedo(
                                    unit, width, width / ratio, wo, eta, 24);
                                for (const int form : {0, 1})
                                {
                                    const double E =
                                        a.reflected +
                                        (form ? a.transmitted_beta : a.transmitted_correlated);
                                    const double on = with[form].albedo(normals, eta, wo),
                                                 off = without[form].albedo(normals, eta, wo);
                                    const double share =
                                        with[form].reflected_share(normals, eta, wo);
                                    Worst& w = worst[form];
                                    const auto raise = [](double& most, double error) {
                                        most = std::max(most, std::abs(error));
                                    };
                                    raise(w.added, E - on);
                                    raise(w.added_without, E - off);
                                    if (E < 0.1) continue;
                                    raise(w.gain, E / on - 1);
                                    raise(w.gain_without, E / off - 1);
                                    raise(w.share, a.reflected / E - share);
                                }
                            }
                for (const int form : {0, 1})
                    std::printf("| %s, %s | %.2f | %g | %.3f | %.4f | %.3f | %.4f | %.3f |\n",
                                label.c_str(), form ? "beta" : "correlated", eta, ratio,
                                worst[form].gain_without, worst[form].gain,
                                worst[form].added_without, worst[form].added, worst[form].share);
                std::fflush(stdout);
            }
}

}  // namespace

int main(int argc, char** argv)
{
    const auto wanted = [&](const std::string& what) {
        return argc == 1 || std::find(argv + 1, argv + argc, what) != argv + argc;
    };
    std::printf(
        "| glass | eta_o | ratio | gain without | gain | added without | added | share |\n");
    std::printf("|---|---|---|---|---|---|---|---|\n");
    if (wanted("ggx")) report<GGX<double>>("ggx", "GGX");
    if (wanted("beckmann")) report<Beckmann<double>>("beckmann", "Beckmann");
    return 0;
}
