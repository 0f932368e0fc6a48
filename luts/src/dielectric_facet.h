// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#pragma once

#include <regain/closures/version.h>

#include <algorithm>
#include <cmath>

REGAIN_NAMESPACE_BEGIN
namespace luts {

/// Fresnel reflectance at the cosine c, g = eta |cos theta_t| (Walter et al. 2007, Eq. 22).
inline double fresnel(double c, double g)
{
    const double a = (g - c) / (g + c), b = (c * (g + c) - 1) / (c * (g - c) + 1);
    return 0.5 * a * a * (1 + b * b);
}

/// ln Gamma(x) for x >= 1 by Stirling's series; std::lgamma is slower and need not be thread-safe.
inline double log_gamma(double x)
{
    double shift = 1;
    for (; x < 9; x += 1) shift *= x;
    const double r = 1 / x, r2 = r * r;
    return (x - 0.5) * std::log(x) - x + 0.91893853320467274178 - std::log(shift) +
           r * (1.0 / 12 - r2 * (1.0 / 360 - r2 * (1.0 / 1260 - r2 * (1.0 / 1680 - r2 / 1188))));
}

/// G2 / G1(wo) of wo with the cosine mu_o and the projected area sigma_o = mu_o (1 + Lambda_o), for
/// a wi of mu_i and sigma_i, in either form.
struct Masking
{
    Masking() = default;
    Masking(double sigma, double mu)
        : sigma_o(sigma),
          mu_o(mu),
          lambda_o(std::max(0.0, sigma / mu - 1)),
          log_gamma_o(log_gamma(2 + lambda_o))
    {}

    double correlated(double mu_i, double sigma_i) const
    {
        return sigma_o * mu_i / (sigma_o * mu_i + sigma_i * mu_o - mu_i * mu_o);
    }
    double beta(double mu_i, double sigma_i) const
    {
        const double lambda_i = std::max(0.0, sigma_i / mu_i - 1);
        return std::exp(log_gamma_o + log_gamma(1 + lambda_i) - log_gamma(2 + lambda_o + lambda_i));
    }

    double sigma_o = 1, mu_o = 1, lambda_o = 0, log_gamma_o = 0;
};

}  // namespace luts
REGAIN_NAMESPACE_END
