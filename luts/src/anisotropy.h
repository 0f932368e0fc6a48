// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#pragma once

#include <regain/luts/slope_law.h>

#include <string>

REGAIN_NAMESPACE_BEGIN
namespace luts {

/// The correction c of closures/anisotropy.h for lobes of two widths and a gamma. A direction is
/// given by mu' there and by its share Y^2 / (X^2 + Y^2), Y along the narrower axis.
class AnisotropicLobe
{
public:
    /// alpha of the wider axis in (0, 1], its ratio to the narrower at least 1.
    AnisotropicLobe(const std::string& distribution, double wider, double ratio, double gamma);

    double root_mean_square() const { return _isotropic.alpha(); }

    /// E_ss(mu'; R), which all shares have in common; mu' in (0, 1].
    double isotropic(double mu, int nodes) const;
    /// c; share in [0, 1].
    double correction(double mu, double share, int nodes, double isotropic) const;
    /// w.z of that direction.
    double cosine(double mu, double share) const;

private:
    struct Direction
    {
        double x, y, z;
    };
    // Whose x axis is the wider.
    Direction direction(double mu, double share) const;

    double _wider, _narrower, _ratio;
    SlopeLaw _stretched, _isotropic;
};

}  // namespace luts
REGAIN_NAMESPACE_END
