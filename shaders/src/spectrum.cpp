// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "spectral_table.h"

#include <regain/shaders/spectrum.h>
#include <regain/shaders/white_adaptation.h>

#include <array>

REGAIN_NAMESPACE_BEGIN
namespace shaders {

namespace {

constexpr std::size_t wavelength_count = last_wavelength - first_wavelength + 1;
using Weights = std::array<C3d, wavelength_count>;

Weights adapted_weights()
{
    const detail::SpectralTable observer("cie1931_2deg_1nm.csv"), illuminant("illuminant_d65.csv");

    Weights weights;
    C3d white(0.0);
    for (int i = 0; i < static_cast<int>(wavelength_count); ++i)
    {
        const double nm = first_wavelength + i, power = illuminant.at(0, nm);
        auto& w = weights[static_cast<std::size_t>(i)];
        w = {power * observer.at(0, nm), power * observer.at(1, nm), power * observer.at(2, nm)};
        white += w;
    }

    const double Y = white.y;
    const Imath::M33d adapt = bradford_adaptation(white / Y, d65_white());
    for (auto& w : weights) w = times_column(adapt, w / Y);
    return weights;
}

const Weights& weights()
{
    static const Weights once = adapted_weights();
    return once;
}

}  // namespace

C3d xyz_d65_weight(int wavelength)
{
    if (wavelength < first_wavelength || wavelength > last_wavelength) return C3d(0.0);
    return weights()[static_cast<std::size_t>(wavelength - first_wavelength)];
}

C3d xyz_d65_of_reflectance(const std::function<double(int)>& reflectance)
{
    C3d xyz(0.0);
    for (int nm = first_wavelength; nm <= last_wavelength; ++nm)
        xyz += xyz_d65_weight(nm) * reflectance(nm);
    return xyz;
}

}  // namespace shaders
REGAIN_NAMESPACE_END
