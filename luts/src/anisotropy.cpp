// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "anisotropy.h"

#include <regain/luts/anisotropic_albedo.h>

#include <algorithm>
#include <cmath>

REGAIN_NAMESPACE_BEGIN
namespace luts {
namespace {

double square(double x) { return x * x; }

}  // namespace

AnisotropicLobe::AnisotropicLobe(const std::string& distribution, double wider, double ratio,
                                 double gamma)
    : _wider(wider),
      _narrower(wider / ratio),
      _ratio(ratio),
      // The anisotropic form of GTR: see closures/gtr.h. Of STD it is any.
      _stretched(SlopeLaw::named(distribution, std::sqrt(_wider * _narrower), gamma)),
      _isotropic(SlopeLaw::named(distribution,
                                 std::sqrt(0.5 * (square(_wider) + square(_narrower))), gamma))
{}

AnisotropicLobe::Direction AnisotropicLobe::direction(double mu, double share) const
{
    const double tangent = _isotropic.alpha() * std::sqrt(std::max(0.0, (1 - mu) * (1 + mu))) / mu;
    const double along_wider = tangent * std::sqrt(1 - share) / _wider,
                 along_narrower = tangent * std::sqrt(share) / _narrower;
    const double z = 1 / std::sqrt(1 + square(along_wider) + square(along_narrower));
    return {along_wider * z, along_narrower * z, z};
}

double AnisotropicLobe::cosine(double mu, double share) const { return direction(mu, share).z; }

double AnisotropicLobe::isotropic(double mu, int nodes) const
{
    const double sine = std::sqrt(std::max(0.0, (1 - mu) * (1 + mu)));
    return anisotropic_albedo(_isotropic, 1, 1, {sine, 0, mu}, nodes);
}

double AnisotropicLobe::correction(double mu, double share, int nodes, double isotropic) const
{
    if (_ratio == 1) return 0;
    const Direction w = direction(mu, share);
    const double stretch = std::sqrt(_ratio);
    return std::log(anisotropic_albedo(_stretched, stretch, 1 / stretch, {w.x, w.y, w.z}, nodes) /
                    isotropic);
}

}  // namespace luts
REGAIN_NAMESPACE_END
