// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The balance of balance.h where a mirror's widths differ: a function of the direction, no longer
/// of its cosine alone,
///
///   g(wo) int rho(wo, wi) g(wi) cos theta_i dwi = 1     for every wo
///
/// that exists, is unique and is found alike. Both axes mirror it, g(x, y, z) = g(|x|, |y|, z), so
/// one quarter of the hemisphere has it all.

#pragma once

#include <regain/closures/vector.h>
#include <regain/luts/balance.h>

#include <string>

REGAIN_NAMESPACE_BEGIN
namespace luts {

class REGAIN_LUTS_API AnisotropicBalance
{
public:
    /// alpha of the wider axis in (0, 1], its ratio to the narrower at least 1; distribution and
    /// gamma as in slope_law.h. `nodes` of the quadrature along each piece: with 20 of them,
    /// furnaces are within 1e-3 for GGX and Beckmann up to 20 : 1, and for GTR, whose tails are
    /// stretched the most, within 1e-2.
    AnisotropicBalance(const std::string& distribution, double wider, double ratio, double gamma,
                       int nodes = 20);

    /// The root mean square R of both widths.
    double root_mean_square() const { return _mean; }

    /// g(w) / g(mu'; R), the latter of the isotropic lobe of width R, at the coordinates of
    /// closures/anisotropic_balance.h: mu' and y, each in [0, 1].
    double change(double mu, double y) const;

    /// The cosine of the direction at those coordinates.
    double cosine(double mu, double y) const;

    /// g of a unit direction, whose x is along the wider axis; w.z in [0, 1].
    double at(const Vec3<double>& w) const;

private:
    struct Place
    {
        double mu, y;
    };
    Place place(const Vec3<double>& w) const;
    Vec3<double> direction(double mu, double y) const;
    double azimuth_place(double y) const;

    double _wider, _narrower, _turn, _mean;
    Balance _isotropic;
    std::vector<double> _change;
};

}  // namespace luts
REGAIN_NAMESPACE_END
