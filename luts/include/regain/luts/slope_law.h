// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Isotropic laws of microfacet slopes, in double precision and without any of the closures' code,
/// so that each can be checked against the other. With r the length of a slope, P22 its density per
/// area of slopes, and s = cot theta:
///
///   GGX       P22 = 1 / (pi a^2 (1 + r^2/a^2)^2)
///   Beckmann  P22 = exp(-r^2/a^2) / (pi a^2)
///   GTR       P22 = c (1 + r^2)^(g-2) (a^2 + r^2)^-g        Burley 2012, B.2, as slopes: GGX at g
///   = 2,
///             and at a = 1 for every g
///   STD       P22 = (1 + r^2/k^2)^-g / (pi a^2), k^2 = (g - 1) a^2      Ribardiere et al. 2017:
///   GGX
///             at g = 2, Beckmann as g grows
///
///   sigma(w) = cos theta (1 + Lambda) = int P22 max(0, cos theta + p sin theta) dp dq
///            = sin theta (s + 2 int_s^inf P22(r) r (sqrt(r^2 - s^2) - s acos(s / r)) dr)
///
/// (Heitz 2014, Eqs. 13 and 23). GGX, Beckmann and STD have it in closed form; of GTR the integral
/// is taken once, when the law is built, and interpolated.

#pragma once

#include <regain/closures/version.h>
#include <regain/luts/export.h>

#include <memory>
#include <string>

REGAIN_NAMESPACE_BEGIN
namespace luts {

class REGAIN_LUTS_API SlopeLaw
{
public:
    /// alpha in (0, 1].
    static SlopeLaw ggx(double alpha);
    static SlopeLaw beckmann(double alpha);
    /// gamma in [0, 100].
    static SlopeLaw gtr(double alpha, double gamma);
    /// gamma > 1.5, where the mean slope begins to exist; from 1e5 on it is Beckmann.
    static SlopeLaw std(double alpha, double gamma);

    /// By name: "ggx", "beckmann", "gtr", "std"; gamma is ignored by the first two. Throws
    /// std::invalid_argument, which lists them, for any other.
    static SlopeLaw named(const std::string& distribution, double alpha, double gamma);

    double alpha() const { return _alpha; }

    /// P22 at the slope length r >= 0.
    double density(double r) const;

    /// P22 r^3 at r = exp(log_r): the share in the mean slope per ln r. At any r, also where its
    /// square is no number any more: where the tail is long, such slopes still count.
    double lever(double log_r) const;

    /// Far beyond tail_begin, P22 goes like r^-(3 + tail_power); infinite without a tail.
    double tail_power() const;
    double tail_begin() const;

    /// sigma(w) of a unit w with cos theta in [0, 1], finite at grazing angles.
    double projected_area(double cos_theta) const;

    /// Slopes longer than this do not exist to double precision; infinite for laws with a tail.
    double longest() const;

    /// The tail beyond slopes of 1 matters even where alpha is small.
    bool heavy_tailed() const { return _kind == Kind::gtr || _kind == Kind::std; }

private:
    enum class Kind { ggx, beckmann, gtr, std };
    class Curve;

    SlopeLaw(Kind kind, double alpha, double gamma);

    Kind _kind;
    double _alpha, _gamma;
    double _peak;  // P22 at 0
    std::shared_ptr<const Curve> _curve;
};

}  // namespace luts
REGAIN_NAMESPACE_END
