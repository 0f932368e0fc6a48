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
#include <stdexcept>

REGAIN_NAMESPACE_BEGIN
namespace shaders {

namespace {

struct Metal
{
    const char* name;
    std::vector<const char*> aliases;
    detail::SpectralTable table;  // n, k
};

const std::array<Metal, 5>& metals()
{
    static const std::array<Metal, 5> once{
        Metal{"aluminium", {"aluminum", "Al"}, detail::SpectralTable("Al.csv")},
        Metal{"brass", {"Cu70Zn30"}, detail::SpectralTable("Cu70Zn30.csv")},
        Metal{"copper", {"Cu"}, detail::SpectralTable("Cu.csv")},
        Metal{"gold", {"Au"}, detail::SpectralTable("Au.csv")},
        Metal{"silver", {"Ag"}, detail::SpectralTable("Ag.csv")}};
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
        for (std::size_t i = 0; i < count; ++i)
        {
            const int nm = first_wavelength + static_cast<int>(i);
            _weight[i] = config.to_scene_linear_from_xyz_d65(xyz_d65_weight(nm));
            _n[i] = metal.table.at(0, nm);
            _k[i] = metal.table.at(1, nm);
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

}  // namespace

std::vector<std::string> metal_names()
{
    std::vector<std::string> names;
    for (const Metal& metal : metals()) names.emplace_back(metal.name);
    return names;
}

std::string metal_source(const std::string& name) { return find_metal(name).table.head(); }

double metal_reflectance(const std::string& name, double cos_theta, double wavelength)
{
    if (std::isnan(wavelength)) throw std::invalid_argument("the wavelength is NaN");
    const Metal& metal = find_metal(name);
    return conductor_reflectance(checked_cosine(cos_theta), metal.table.at(0, wavelength),
                                 metal.table.at(1, wavelength));
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
    for (int c = 0; c < 3; ++c)
    {
        metal.F0[c] = std::clamp(normal[c], 0.0, 1.0);
        metal.out_of_gamut |= metal.F0[c] != normal[c];
    }

    // With t = mu^2 the weight 2 mu dmu becomes dt: equal steps in t need no weights.
    constexpr int steps = 256;
    std::array<double, steps> cosine;
    std::array<C3d, steps> curve;
    for (std::size_t i = 0; i < steps; ++i)
    {
        cosine[i] = std::sqrt((static_cast<double>(i) + 0.5) / steps);
        curve[i] = coloured.at(cosine[i]);
    }
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

}  // namespace shaders
REGAIN_NAMESPACE_END
