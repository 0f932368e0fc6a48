// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/closures/refraction.h>
#include <regain/luts/dielectric_integral.h>

#include "rules.h"

#include <algorithm>
#include <array>
#include <cmath>

REGAIN_NAMESPACE_BEGIN
namespace luts {
namespace {

const double pi = std::acos(-1.0);

// ln Gamma(x) for x >= 1 by Stirling's series; std::lgamma is slower and need not be thread-safe.
double log_gamma(double x)
{
    double shift = 1;
    for (; x < 9; x += 1) shift *= x;
    const double r = 1 / x, r2 = r * r;
    return (x - 0.5) * std::log(x) - x + 0.91893853320467274178 - std::log(shift) +
           r * (1.0 / 12 - r2 * (1.0 / 360 - r2 * (1.0 / 1260 - r2 * (1.0 / 1680 - r2 / 1188))));
}

// Fresnel reflectance at the cosine c, g = eta |cos theta_t| (Walter et al. 2007, Eq. 22).
double fresnel(double c, double g)
{
    const double a = (g - c) / (g + c), b = (c * (g + c) - 1) / (c * (g - c) + 1);
    return 0.5 * a * a * (1 + b * b);
}

// t in [0, 1] with its nodes gathered at both ends.
double smooth_step(double t) { return t * t * t * (10 - t * (15 - 6 * t)); }
double smooth_step_slope(double t) { return 30 * t * t * (1 - t) * (1 - t); }

// The integral for one wo.
class Interface
{
public:
    Interface(const SlopeLaw& law, double mu, double eta, int nodes)
        : _law(law),
          _rule(rule_of(nodes)),
          _mu(mu),
          _eta(eta),
          _k((eta - 1) * (eta + 1)),
          _sin_o(std::sqrt(std::max(0.0, (1 - mu) * (1 + mu)))),
          _wo(_sin_o, 0, mu),
          _theta_o(std::atan2(_sin_o, mu)),
          _sigma_o(law.projected_area(mu)),
          _lambda_o(std::max(0.0, _sigma_o / mu - 1)),
          _log_gamma_o(log_gamma(2 + _lambda_o)),
          _lowest_z(std::cos(std::atan(law.longest())))
    {}

    DielectricAlbedo integrate()
    {
        // Over theta, the angle between wo and m, by the pieces between the angles where something
        // begins or ends. D peaks at theta_o with a width of alpha, so theta_o + alpha sinh(y) is
        // what runs evenly.
        const double half_pi = 0.5 * pi;
        std::array<double, 8> ends{0,
                                   half_pi,
                                   _theta_o,
                                   half_pi - _theta_o,          // m at the horizon
                                   0.5 * (half_pi - _theta_o),  // wr at the horizon, either side
                                   0.5 * (half_pi + _theta_o),
                                   turning_angle(),   // of Fresnel's term
                                   grazing_angle()};  // wt at the horizon
        std::sort(ends.begin(), ends.end());
        const double alpha = _law.alpha();
        const double reach = std::atan(_law.longest());  // D ends there
        const double lowest = std::asinh(-reach / alpha), highest = -lowest;
        const auto even = [&](double theta) {
            return std::min(highest, std::max(lowest, std::asinh((theta - _theta_o) / alpha)));
        };
        for (std::size_t e = 0; e + 1 < ends.size(); ++e)
        {
            const double from = even(ends[e]), range = even(ends[e + 1]) - from;
            if (range < 1e-12) continue;
            for (std::size_t i = 0; i < _rule.x.size(); ++i)
            {
                const double t = _rule.x[i], y = from + range * smooth_step(t);
                const double theta = _theta_o + alpha * std::sinh(y);
                const double dtheta =
                    _rule.weight[i] * range * smooth_step_slope(t) * alpha * std::cosh(y);
                if (theta > 0 && theta < half_pi) arc(theta, dtheta);
            }
        }
        return _sum;
    }

private:
    // Where total reflection begins; for eta > 1 where Fresnel's term rises steeply.
    double turning_angle() const { return std::acos(std::min(1.0, std::sqrt(std::abs(_k)))); }

    // The angle at which light refracted in the plane of wo and n leaves along the surface:
    // theta_t - theta = pi / 2 - theta_o. Only for eta < 1, and beyond the critical angle; else 0.
    double grazing_angle() const
    {
        if (_eta >= 1 || _mu * _mu > -_k) return 0;
        double lo = 0, hi = std::asin(_eta);
        for (int i = 0; i < 60; ++i)
        {
            const double mid = 0.5 * (lo + hi);
            const bool past =
                std::asin(std::min(1.0, std::sin(mid) / _eta)) - mid > 0.5 * pi - _theta_o;
            (past ? hi : lo) = mid;
        }
        return lo;
    }

    // All m at the angle theta from wo: m_z = A + B cos psi.
    void arc(double theta, double dtheta)
    {
        const double c = std::cos(theta), s = std::sin(theta), g2 = _k + c * c;
        const double A = _mu * c, B = _sin_o * s;
        const double g = std::sqrt(std::max(0.0, g2)), F = g2 > 0 ? fresnel(c, g) : 1;
        // The psi at which m_z falls to z.
        const auto psi_at = [&](double z) {
            return z <= A - B ? pi : z >= A + B ? 0.0 : std::acos((z - A) / B);
        };

        // In psi, too, D peaks at 0, with a width that grows with the distance from theta_o.
        const double miss = 2 * std::sin(0.5 * (theta - _theta_o)), alpha = _law.alpha();
        const double width =
            std::min(10.0, std::sqrt((alpha * alpha + miss * miss) / std::max(B, 1e-12)));
        const double common = 2 * dtheta * s * c / _sigma_o;

        const auto over = [&](double from, double to, const auto& f) {
            if (to - from < 1e-14) return;
            const double first = std::asinh(from / width), range = std::asinh(to / width) - first;
            for (std::size_t i = 0; i < _rule.x.size(); ++i)
            {
                const double t = _rule.x[i], y = first + range * t * t * (3 - 2 * t);
                const double psi = width * std::sinh(y);
                const double dpsi =
                    _rule.weight[i] * range * 6 * t * (1 - t) * width * std::cosh(y);
                const double h = std::sin(0.5 * psi);
                // 1 - m_z, which does not cancel, unlike m_z itself at small slopes.
                const double q = 0.5 * miss * miss + 2 * B * h * h, m_z = 1 - q;
                if (m_z <= 0) continue;
                const double slope = std::sqrt(q * (2 - q)) / m_z, m_z2 = m_z * m_z;
                f(m_z, facet(c, s, psi, m_z), common * dpsi * _law.density(slope) / (m_z2 * m_z2));
            }
        };

        const double last = psi_at(_lowest_z);  // where D ends
        over(0, std::min(last, psi_at(_mu / (2 * c))),
             [&](double m_z, const Vec3<double>& m, double weight) {
                 if (!is_reflection(_wo, m * (2 * c) - _wo, m)) return;
                 _sum.reflected += weight * F * correlated(2 * c * m_z - _mu);
             });
        if (g2 <= 0) return;
        // wt.z eta = (c - g) m_z - mu has to be negative.
        const double bend = -_k / (c + g);
        const double first = bend > 0 ? psi_at(_mu / bend) : 0;
        over(first, last, [&](double m_z, const Vec3<double>& m, double weight) {
            const Vec3<double> wt = (m * bend - _wo) * (1 / _eta);
            if (!is_transmission(_wo, wt, m)) return;
            const double mu_t = std::min(1.0, (_mu - bend * m_z) / _eta);
            _sum.transmitted_correlated += weight * (1 - F) * correlated(mu_t);
            _sum.transmitted_beta += weight * (1 - F) * beta(mu_t);
        });
    }

    // The normal at the angle theta from wo and psi about it; m_z is known better than a sum gives
    // it.
    Vec3<double> facet(double c, double s, double psi, double m_z) const
    {
        return {c * _sin_o - s * _mu * std::cos(psi), s * std::sin(psi), m_z};
    }

    // G2 / G1.
    double correlated(double mu_i) const
    {
        if (mu_i <= 0) return 0;
        const double sigma_i = _law.projected_area(std::min(1.0, mu_i));
        return _sigma_o * mu_i / (_sigma_o * mu_i + sigma_i * _mu - mu_i * _mu);
    }
    double beta(double mu_i) const
    {
        const double lambda_i = std::max(0.0, _law.projected_area(mu_i) / mu_i - 1);
        return std::exp(_log_gamma_o + log_gamma(1 + lambda_i) -
                        log_gamma(2 + _lambda_o + lambda_i));
    }

    const SlopeLaw& _law;
    const QuadratureRule& _rule;
    double _mu, _eta, _k, _sin_o;
    Vec3<double> _wo;
    double _theta_o, _sigma_o, _lambda_o, _log_gamma_o;
    double _lowest_z;  // of a facet's normal
    DielectricAlbedo _sum{0, 0, 0};
};

}  // namespace

double dielectric_reflectance(double c, double eta_o)
{
    const double g2 = (eta_o - 1) * (eta_o + 1) + c * c;
    return g2 > 0 ? fresnel(c, std::sqrt(g2)) : 1;
}

DielectricAlbedo dielectric_albedo(const SlopeLaw& law, double mu, double eta_o, int nodes)
{
    return Interface(law, mu, eta_o, nodes).integrate();
}

}  // namespace luts
REGAIN_NAMESPACE_END
