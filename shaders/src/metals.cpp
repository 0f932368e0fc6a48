// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "names.h"
#include "spectral_table.h"

#include <regain/closures/conductor_fresnel.h>
#include <regain/closures/schlick_fresnel.h>
#include <regain/shaders/metals.h>
#include <regain/shaders/spectrum.h>
#include <regain/shaders/white_adaptation.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <stdexcept>

REGAIN_NAMESPACE_BEGIN
namespace shaders {

namespace {

struct Metal
{
    const char* name;
    std::vector<const char*> aliases;
    const char* file;  // of n and k
};

const std::vector<Metal>& metals()
{
    static const std::vector<Metal> once{Metal{"aluminium", {"aluminum", "Al"}, "Al.csv"},
                                         Metal{"beryllium", {"Be"}, "Be.csv"},
                                         Metal{"bismuth", {"Bi"}, "Bi.csv"},
                                         Metal{"brass", {"Cu70Zn30"}, "Cu70Zn30.csv"},
                                         Metal{"chromium", {"Cr"}, "Cr.csv"},
                                         Metal{"cobalt", {"Co"}, "Co.csv"},
                                         Metal{"copper", {"Cu"}, "Cu.csv"},
                                         Metal{"electrum", {"Au50Ag50"}, "Au50Ag50.csv"},
                                         Metal{"gilding-metal", {"Cu90Zn10"}, "Cu90Zn10.csv"},
                                         Metal{"gold", {"Au"}, "Au.csv"},
                                         Metal{"gold-silver", {"Au80Ag20"}, "Au80Ag20.csv"},
                                         Metal{"iridium", {"Ir"}, "Ir.csv"},
                                         Metal{"iron", {"Fe"}, "Fe.csv"},
                                         Metal{"lead", {"Pb"}, "Pb.csv"},
                                         Metal{"manganese", {"Mn"}, "Mn.csv"},
                                         Metal{"mercury", {"Hg"}, "Hg.csv"},
                                         Metal{"molybdenum", {"Mo"}, "Mo.csv"},
                                         Metal{"nickel", {"Ni"}, "Ni.csv"},
                                         Metal{"niobium", {"Nb"}, "Nb.csv"},
                                         Metal{"osmium", {"Os"}, "Os.csv"},
                                         Metal{"palladium", {"Pd"}, "Pd.csv"},
                                         Metal{"platinum", {"Pt"}, "Pt.csv"},
                                         Metal{"red-brass", {"Cu85Zn15"}, "Cu85Zn15.csv"},
                                         Metal{"rhodium", {"Rh"}, "Rh.csv"},
                                         Metal{"silver", {"Ag"}, "Ag.csv"},
                                         Metal{"titanium", {"Ti"}, "Ti.csv"},
                                         Metal{"titanium-nitride", {"TiN"}, "TiN.csv"},
                                         Metal{"tungsten", {"W"}, "W.csv"},
                                         Metal{"vanadium", {"V"}, "V.csv"},
                                         Metal{"zirconium", {"Zr"}, "Zr.csv"}};
    return once;
}

const Metal& find_metal(const std::string& name)
{
    const auto is = [&](const char* s) { return detail::same_letters(name, s); };
    for (const Metal& metal : metals())
        if (is(metal.name) || std::any_of(metal.aliases.begin(), metal.aliases.end(), is))
            return metal;
    throw std::invalid_argument("no metal is called '" + name +
                                "'; there are: " + detail::listed(metal_names()));
}

// Read when a metal is first asked for: most programs ask for few.
const detail::SpectralTable& table_of(const Metal& metal)
{
    static std::mutex mutex;
    static std::map<std::string, detail::SpectralTable> read;
    const std::lock_guard<std::mutex> lock(mutex);
    const auto known = read.find(metal.file);
    if (known != read.end()) return known->second;
    return read.emplace(metal.file, detail::SpectralTable(metal.file)).first->second;
}

double checked_cosine(double cos_theta)
{
    if (std::isnan(cos_theta)) throw std::invalid_argument("the cosine of the angle is NaN");
    return std::clamp(cos_theta, 0.0, 1.0);
}

double conductor_reflectance(double mu, double n, double k)
{
    return ConductorFresnel<double>(C3d(n), C3d(k)).at(mu).x;
}

// The colour of a metal in a working space. The way there is linear in the reflectance, so it is
// reduced to one weight per wavelength and channel.
class Colouring
{
public:
    Colouring(const Metal& metal, const ColorConfig& config)
    {
        C3d white(0.0);
        const detail::SpectralTable& table = table_of(metal);
        for (std::size_t i = 0; i < count; ++i)
        {
            const int nm = first_wavelength + static_cast<int>(i);
            _weight[i] = config.to_scene_linear_from_xyz_d65(xyz_d65_weight(nm));
            _n[i] = table.at(0, nm);
            _k[i] = table.at(1, nm);
            white += _weight[i];
        }
        for (int c = 0; c < 3; ++c)
            if (!(white[c] > 0))
                throw std::runtime_error("the colour config '" + config.name() +
                                         "' does not give white a positive value in each channel "
                                         "of '" +
                                         config.scene_linear() +
                                         "': its role scene_linear cannot be used for colours");
        // Keeps white at 1, also where a config's matrices are rounded or do not adapt.
        for (auto& w : _weight) w /= white;
    }

    C3d at(double mu) const
    {
        C3d color(0.0);
        for (std::size_t i = 0; i < count; ++i)
            color += _weight[i] * conductor_reflectance(mu, _n[i], _k[i]);
        return color;
    }

private:
    static constexpr std::size_t count = last_wavelength - first_wavelength + 1;
    std::array<C3d, count> _weight;
    std::array<double, count> _n, _k;
};

// A metal's colour over the angle. With t = mu^2 the weight 2 mu dmu becomes dt: equal steps in t
// need no weights.
struct Curve
{
    static constexpr std::size_t steps = 256;
    std::array<double, steps> cosine;
    std::array<C3d, steps> color;

    static Curve of(const Colouring& coloured)
    {
        Curve curve;
        for (std::size_t i = 0; i < steps; ++i)
        {
            curve.cosine[i] = std::sqrt((static_cast<double>(i) + 0.5) / steps);
            curve.color[i] = coloured.at(curve.cosine[i]);
        }
        return curve;
    }
};

// k^2 of an index with that n whose reflectance at normal incidence is F0.
double squared_extinction(double n, double F0)
{
    return (F0 * (n + 1) * (n + 1) - (n - 1) * (n - 1)) / (1 - F0);
}

}  // namespace

std::vector<std::string> metal_names()
{
    std::vector<std::string> names;
    for (const Metal& metal : metals()) names.emplace_back(metal.name);
    return names;
}

std::string metal_source(const std::string& name) { return table_of(find_metal(name)).head(); }

double metal_reflectance(const std::string& name, double cos_theta, double wavelength)
{
    if (std::isnan(wavelength)) throw std::invalid_argument("the wavelength is NaN");
    const detail::SpectralTable& table = table_of(find_metal(name));
    return conductor_reflectance(checked_cosine(cos_theta), table.at(0, wavelength),
                                 table.at(1, wavelength));
}

C3d metal_reflectance(const std::string& name, double cos_theta, const ColorConfig& config)
{
    return Colouring(find_metal(name), config).at(checked_cosine(cos_theta));
}

MetalColor metal_color(const std::string& name, const ColorConfig& config)
{
    const Colouring coloured(find_metal(name), config);
    MetalColor metal;

    // The colour at normal incidence is F0, not fitted: it is what most of the lobe shows.
    const C3d normal = coloured.at(1.0);
    metal.F0 = limited_to_unit(normal);
    metal.out_of_gamut = metal.F0 != normal;

    const auto [cosine, curve] = Curve::of(coloured);
    constexpr std::size_t steps = Curve::steps;
    const auto schlick = [](double F0, double mu) { return F0 + (1 - F0) * std::pow(1 - mu, 5); };
    const auto dip = [](double mu) { return mu * std::pow(1 - mu, 6); };

    for (int c = 0; c < 3; ++c)
    {
        // F = schlick - b dip is linear in b.
        double product = 0, square = 0;
        for (std::size_t i = 0; i < steps; ++i)
        {
            const double d = dip(cosine[i]);
            product += (schlick(metal.F0[c], cosine[i]) - curve[i][c]) * d;
            square += d * d;
        }
        const double b_of_black = schlick(metal.F0[c], 1.0 / 7) / dip(1.0 / 7);
        const double best = 1 - product / square / b_of_black;
        metal.F82[c] = std::clamp(best, 0.0, 1.0);
        metal.F82_limited |= metal.F82[c] != best;
    }

    const SchlickFresnel<double> fitted(metal.F0, metal.F82);
    C3d square_error(0.0);
    for (std::size_t i = 0; i < steps; ++i)
    {
        const C3d error = fitted.at(cosine[i]) - curve[i];
        square_error += error * error / steps;
    }
    for (int c = 0; c < 3; ++c)
        metal.fit_error = std::max(metal.fit_error, std::sqrt(square_error[c]));
    return metal;
}

MetalIndex metal_index(const std::string& name, const ColorConfig& config)
{
    const Colouring coloured(find_metal(name), config);
    const C3d color = coloured.at(1.0), normal = limited_to_unit(color);
    const Curve curve = Curve::of(coloured);
    MetalIndex index;
    index.out_of_gamut = normal != color;
    for (int c = 0; c < 3; ++c)
    {
        const double F0 = std::clamp(normal[c], 1e-4, 0.999), root = std::sqrt(F0);
        const double least = (1 - F0) / (1 + F0), most = (1 + root) / (1 - root);
        const auto k_of = [&](double n) {
            return std::sqrt(std::max(squared_extinction(n, F0), 0.0));
        };
        const auto error = [&](double n) {
            double sum = 0;
            for (std::size_t i = 0; i < Curve::steps; ++i)
            {
                const double e =
                    conductor_reflectance(curve.cosine[i], n, k_of(n)) - curve.color[i][c];
                sum += e * e / Curve::steps;
            }
            return sum;
        };
        // By the logarithm of n, first coarsely, then between the neighbours of the best.
        double low = std::log(least), high = std::log(most);
        for (int pass = 0; pass < 6; ++pass)
        {
            constexpr int parts = 16;
            double best = low, best_error = error(std::exp(low));
            for (int i = 1; i <= parts; ++i)
            {
                const double at = low + (high - low) * i / parts, e = error(std::exp(at));
                if (e >= best_error) continue;
                best = at;
                best_error = e;
            }
            const double step = (high - low) / parts;
            low = std::max(std::log(least), best - step);
            high = std::min(std::log(most), best + step);
            index.n[c] = std::exp(best);
        }
        index.k[c] = k_of(index.n[c]);
        index.fit_error = std::max(index.fit_error, std::sqrt(error(index.n[c])));
    }
    return index;
}

}  // namespace shaders
REGAIN_NAMESPACE_END
