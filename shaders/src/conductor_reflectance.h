// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Fresnel reflectance of a conductor in air, unpolarised, at one wavelength:
///   F = (R_s + R_p) / 2,  r_s = (mu - p) / (mu + p),  r_p = (m^2 mu - p) / (m^2 mu + p),
///   m = n + ik,  p = sqrt(m^2 - 1 + mu^2)        (Born and Wolf, Principles of Optics, 14.2).

#pragma once

#include <regain/closures/version.h>

#include <complex>

REGAIN_NAMESPACE_BEGIN
namespace detail {

/// mu, the cosine of the angle of incidence, in [0, 1]; n > 0, k >= 0.
inline double conductor_reflectance(double mu, double n, double k)
{
    const std::complex<double> m2 = std::complex<double>(n, k) * std::complex<double>(n, k);
    const std::complex<double> p = std::sqrt(m2 - 1.0 + mu * mu);
    return 0.5 * (std::norm((mu - p) / (mu + p)) + std::norm((m2 * mu - p) / (m2 * mu + p)));
}

}  // namespace detail
REGAIN_NAMESPACE_END
