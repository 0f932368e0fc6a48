// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What hard cases are held against: textbook formulas in long double, none of them written the way
/// the closures write theirs.

#pragma once

#include "subject.h"

#include <complex>

namespace regain::tests {

using Exact = long double;

constexpr Exact pi = 3.14159265358979323846264338327950288L;

/// (|r_s|^2 + |r_p|^2) / 2 at an interface whose index ahead over index behind is n + ik.
inline Exact fresnel(Exact n, Exact k, Exact mu)
{
    using Complex = std::complex<Exact>;
    if (n == 0 && k == 0) return 1;  // nothing goes where light has no speed
    const Complex index(n, k), square = index * index;
    const Complex beyond = std::sqrt(square - Complex((1 - mu) * (1 + mu)));
    const Complex s = (mu - beyond) / (mu + beyond);
    const Complex p = (square * mu - beyond) / (square * mu + beyond);
    return (std::norm(s) + std::norm(p)) / 2;
}

/// Schlick's curve with the tint at 1/7, one channel, as OpenPBR states it.
inline Exact schlick(Exact F0, Exact F82, Exact F90, Exact exponent, Exact mu)
{
    const auto curve = [&](Exact c) { return F0 + (F90 - F0) * std::pow(1 - c, exponent); };
    const Exact at = Exact(1) / 7;
    const Exact dip = curve(at) * (1 - F82) / (at * std::pow(1 - at, Exact(6)));
    return std::max(curve(mu) - dip * mu * std::pow(1 - mu, Exact(6)), Exact(0));
}

/// What a facet of a kind reflects at the cosine mu; eta is the index ahead over the one behind.
template <class Real>
Color3<double> facet_reflectance(const Kind<Real>& kind, const Parameters& s, double eta, double mu)
{
    Color3<double> F;
    for (int c = 0; c < 3; ++c) switch (kind.lobe)
        {
            case Lobe::schlick:
                F[c] = double(schlick(s.color0[c], s.color82[c], s.color90[c], s.exponent, mu));
                break;
            case Lobe::dielectric: F[c] = double(fresnel(eta, 0, mu)); break;
            case Lobe::sheet:
                F[c] = double(fresnel(eta, 0, mu));
                F[c] = 2 * F[c] / (1 + F[c]);
                break;
            default: F[c] = double(fresnel(s.n[c], s.k[c], mu)); break;
        }
    return F;
}

/// D of the normal (0, 0, 1).
inline double peak(const std::string& distribution, double alpha_x, double alpha_y, double gamma)
{
    const double a2 = alpha_x * alpha_y, pi_ = double(pi);
    if (distribution != "gtr" || gamma == 2) return 1 / (pi_ * a2);
    // Burley 2012, appendix B.2, at cos theta = 1.
    if (a2 == 1) return 1 / pi_;
    if (gamma == 1) return (a2 - 1) / (pi_ * std::log(a2)) / a2;
    return (gamma - 1) * (a2 - 1) / (pi_ * (1 - std::pow(a2, 1 - gamma))) * std::pow(a2, -gamma);
}

/// D and Lambda of an isotropic surface as Walter et al. 2007 (Eqs. 25, 33) and Heitz 2014 print
/// them, in tan theta.
struct Surface
{
    bool gaussian;  // Beckmann, or else GGX
    Exact alpha;

    static Exact tan2(Exact z) { return (1 - z) * (1 + z) / (z * z); }
    Exact D(Exact tan2_m) const
    {
        const Exact a2 = alpha * alpha, inv_cos2 = 1 + tan2_m;
        if (gaussian) return std::exp(-tan2_m / a2) * inv_cos2 * inv_cos2 / (pi * a2);
        const Exact sum = a2 + tan2_m;
        return a2 * inv_cos2 * inv_cos2 / (pi * sum * sum);
    }
    Exact lambda(Exact z) const
    {
        const Exact t = alpha * std::sqrt(tan2(z)), a = 1 / t;
        if (t == 0) return 0;
        if (!gaussian) return (t * t / (std::sqrt(1 + t * t) + 1)) / 2;
        return (std::exp(-a * a) / (a * std::sqrt(pi)) - std::erfc(a)) / 2;
    }
    /// lim z lambda(z) as z goes to 0: half the mean |slope|.
    Exact grazing_area() const { return gaussian ? alpha / (2 * std::sqrt(pi)) : alpha / 2; }
};

/// A direction of a number type as the unit vector that it stands for.
template <class Real>
Vec3<Exact> exactly(const Vec3<Real>& w)
{
    const Vec3<Exact> v{Exact(w.x), Exact(w.y), Exact(w.z)};
    return v * (1 / std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z));
}

/// What one facet makes of two directions: tan^2 of its normal, and the cosine about it.
struct Half
{
    Exact tan2, cosine;

    Half(const Vec3<Exact>& o, const Vec3<Exact>& i)
    {
        const Vec3<Exact> h = o + i;
        const Exact tangential2 = h.x * h.x + h.y * h.y;
        tan2 = tangential2 / (h.z * h.z);
        cosine = std::sqrt(tangential2 + h.z * h.z) / 2;
    }
};

/// D G2 / (4 cos_o), Turquin 2019, Eq. 1, with F = 1, times cos_i.
inline Exact single_scattering(const Surface& surface, const Vec3<Exact>& o, const Vec3<Exact>& i)
{
    const Half facet(o, i);
    return surface.D(facet.tan2) / (4 * o.z * (1 + surface.lambda(o.z) + surface.lambda(i.z)));
}

}  // namespace regain::tests
