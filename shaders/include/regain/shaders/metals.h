// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The colours of real metals, from the spectra of their complex index of refraction n + ik. Those
/// are no colours: the reflectance spectrum at each angle is, seen under D65 by the CIE observer
/// (spectrum.h), adapted, and taken to scene_linear by OpenColorIO. Only then are the two artist
/// parameters of Schlick's curve with F82 tint fitted to it.
///
/// n and k are measured between 380 and 780 nm, each 5 nm, and interpolated linearly; beyond the
/// ends the last value holds.

#pragma once

#include <regain/closures/version.h>
#include <regain/shaders/color.h>
#include <regain/shaders/color_config.h>
#include <regain/shaders/export.h>

#include <string>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace shaders {

/// A metal for SchlickFresnel, OpenPBR or MaterialX's generalized_schlick_bsdf, in scene_linear:
///
///   F(mu) = F0 + (1 - F0)(1 - mu)^5 - b mu (1 - mu)^6
///   b     = (F0 + (1 - F0)(6/7)^5)(1 - F82) / ((1/7)(6/7)^6)
///
/// (Kutz et al. 2021; OpenPBR Surface 1.1, "Metal").
struct MetalColor
{
    /// The colour at normal incidence, in [0, 1].
    C3d F0;

    /// What multiplies Schlick's curve at mu = 1/7, in [0, 1]. Chosen so that the integral of
    /// 2 mu (F - coloured curve)^2 over mu in [0, 1] is least for the given F0. The integral is
    /// quadratic in F82, so where the best value is outside [0, 1] the nearer end is the best one
    /// inside.
    C3d F82;

    /// The square root of that least integral, largest over the three channels: the
    /// cosine-weighted rms difference from the coloured curve, clamping included.
    double fit_error = 0;

    /// True if the colour at normal incidence lies outside [0, 1] in a channel of the working
    /// space, and F0 is what limited_to_unit makes of it.
    bool out_of_gamut = false;

    /// True if the best F82 was outside [0, 1] in a channel, and was clamped.
    bool F82_limited = false;
};

/// An index of refraction n + ik per channel of the working space.
///
/// It is not an average of the metal's index, which is no colour: per channel it is that index
/// whose reflectance at normal incidence is the colour's, and over the angle least off it, by the
/// integral that MetalColor says.
struct MetalIndex
{
    C3d n{1.0}, k{0.0};
    double fit_error = 0;       ///< as of MetalColor
    bool out_of_gamut = false;  ///< as of MetalColor
};

/// The metals and alloys there are, in the order of the alphabet: "aluminium" to "zirconium",
/// "brass" and "titanium-nitride" among them.
REGAIN_SHADERS_API std::vector<std::string> metal_names();

/// Where the n and k of a metal come from: the head of the file, one line each.
REGAIN_SHADERS_API std::string metal_source(const std::string& name);

/// The reflectance of a metal in air, unpolarised, by the exact Fresnel equations, at a wavelength
/// in nm and the cosine of the angle of incidence. Wavelengths outside [380, 780] get the n and k
/// of the nearer end; cosines are clamped into [0, 1]; NaN throws std::invalid_argument.
REGAIN_SHADERS_API double metal_reflectance(const std::string& name, double cos_theta,
                                            double wavelength);

/// The colour of the metal in the config's scene_linear, at the cosine of the angle of incidence
/// (clamped into [0, 1]; NaN throws std::invalid_argument). A perfect reflector would be (1, 1, 1)
/// in every config within 1e-4: a config that makes something else of the D65 white has each
/// channel divided by what it makes. Not clamped: a colour that is outside the working space has
/// channels outside [0, 1].
REGAIN_SHADERS_API C3d metal_reflectance(const std::string& name, double cos_theta,
                                         const ColorConfig& config);

/// The metal's parameters in the config's scene_linear.
///
/// All of these take names as metal_names gives them, in any case of letters, formulas as Al and
/// Cu70Zn30, and "aluminum"; any other name throws std::invalid_argument with the list.
/// Configs that cannot colour XYZ throw as ColorConfig::to_scene_linear_from_xyz_d65 says.
REGAIN_SHADERS_API MetalColor metal_color(const std::string& name, const ColorConfig& config);

/// The same as an index, for conductor_bsdf; errors as above.
REGAIN_SHADERS_API MetalIndex metal_index(const std::string& name, const ColorConfig& config);

}  // namespace shaders
REGAIN_NAMESPACE_END
