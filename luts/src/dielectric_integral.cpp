// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/closures/refraction.h>
#include <regain/luts/dielectric_integral.h>

#include "dielectric_facet.h"
#include "rules.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace luts {
namespace {

const double pi = std::acos(-1.0);

// t in [0, 1] with its nodes gathered at both ends.
double smooth_step(double t) { return t * t * (3 - 2 * t); }
double smooth_step_slope(double t) { return 6 * t * (1 - t); }

// Where P22 has fallen to little: the end of its bulk, which has an integrand of its own.
double bulk_of(const SlopeLaw& law)
{
    const double little = 1e-4 * law.density(0);
    double lo = std::log(law.alpha()) - 2, hi = 5;
    for (int i = 0; i < 20; ++i)
    {
        const double middle = 0.5 * (lo + hi);
        (law.density(std::exp(middle)) > little ? lo : hi) = middle;
    }
    return std::exp(lo);
}

// The integral for one wo.
class Interface
{
public:
    Interface(const SlopeLaw& law, double mu, double eta, int nodes)
        : _law(law),
          _nodes(nodes),
          _mu(mu),
          _eta(eta),
          _k((eta - 1) * (eta + 1)),
          _turning(std::sqrt(std::abs(_k))),
          _sin_o(std::sqrt(std::max(0.0, (1 - mu) * (1 + mu)))),
          _wo(_sin_o, 0, mu),
          _theta_o(std::atan2(_sin_o, mu)),
          _sigma_o(law.projected_area(mu)),
          _lambda_o(std::max(0.0, _sigma_o / mu - 1)),
          _log_gamma_o(log_gamma(2 + _lambda_o))
    {}

    DielectricAlbedo integrate()
    {
        // Over the length r of slopes, by the pieces between those where something begins or ends.
        const double longest = _law.longest();
        std::vector<double> ends = slopes_of_note();
        // Farther out nothing happens any more, but the tail goes on.
        const double far =
            std::min(longest, std::max(*std::max_element(ends.begin(), ends.end()),
                                       3 * std::max({1.0, _law.tail_begin(), 1 / _mu})));
        ends.push_back(far);
        std::sort(ends.begin(), ends.end());
        for (std::size_t e = 0; e + 1 < ends.size() && ends[e] < far; ++e)
            piece(ends[e], std::min(ends[e + 1], far));
        if (far < longest) tail(far);
        return _sum;
    }

private:
    // The ends of pieces, 0 among them.
    std::vector<double> slopes_of_note() const
    {
        const double half_pi = 0.5 * pi;
        std::vector<double> slopes{0, bulk_of(_law)};
        const auto note = [&](double theta) {
            if (theta > 0 && theta < half_pi) slopes.push_back(std::tan(theta));
        };
        note(half_pi - _theta_o);          // facets begin to turn away from wo
        note(0.5 * (half_pi - _theta_o));  // wr at the horizon, either side
        note(0.5 * (half_pi + _theta_o));
        if (_turning < 1)
        {
            // Where total reflection begins; for eta > 1 where Fresnel's term rises steeply.
            const double turning = std::acos(_turning);
            note(std::abs(_theta_o - turning));
            note(_theta_o + turning);
            // The same facets send wr along the horizon.
            if (_mu < 2 * _turning) note(std::acos(0.5 * _mu / _turning));
        }
        if (_k < 0 && _mu < _turning)
        {
            // wt at the horizon, and where it cannot come to be there.
            note(std::abs(_theta_o - grazing_angle()));
            note(std::acos(_mu / _turning));
        }
        return slopes;
    }

    // The angle between wo and the facet in the plane of wo and n that refracts along the surface:
    // theta_t - theta = pi / 2 - theta_o. Only for eta < 1, and beyond the critical angle.
    double grazing_angle() const
    {
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

    // At most what facets of the slope r are worth, per ln r.
    double worth(double r) const { return 2 * pi * _law.density(r) * r * r * (_mu + r) / _sigma_o; }

    // Slopes from r0 to r1. P22 runs evenly in y, r = alpha sinh(y).
    void piece(double r0, double r1)
    {
        const double alpha = _law.alpha(), first = std::asinh(r0 / alpha);
        const double range = std::asinh(r1 / alpha) - first;
        if (range < 1e-10) return;
        // What is worth little needs fewer digits. The bulk, at slope 0, always counts.
        double digits = 1;
        if (r0 > 0)
        {
            const double most = range * std::max({worth(r0), worth(std::sqrt(r0 * r1)), worth(r1)});
            if (most < 1e-9) return;
            digits = std::min(1.0, std::max(0.3, 1 + std::log10(most) / 8));
        }
        const QuadratureRule& rule = rule_for(digits * std::min(3.0, 0.5 + 0.2 * range));
        for (std::size_t i = 0; i < rule.x.size(); ++i)
        {
            const double t = rule.x[i], y = first + range * smooth_step(t);
            const double r = alpha * std::sinh(y), m_z = 1 / std::sqrt(1 + r * r);
            const double dr = rule.weight[i] * range * smooth_step_slope(t) * alpha * std::cosh(y);
            ring(m_z, r * m_z, _law.density(r) * r * dr / m_z);
        }
    }

    // Slopes from r0 on. The mean slope runs evenly in t, r = r0 t^(-1/p); where p is small, most
    // of it is where facets all but stand upright.
    void tail(double r0)
    {
        const double p = _law.tail_power(), log_r0 = std::log(r0);
        if (worth(r0) < 1e-10 * p) return;
        const QuadratureRule& rule = rule_for(1);
        for (std::size_t i = 0; i < rule.x.size(); ++i)
        {
            const double t = smooth_step(rule.x[i]), log_r = log_r0 - std::log(t) / p;
            const double dlog_r = rule.weight[i] * smooth_step_slope(rule.x[i]) / (p * t);
            const double m_z =
                log_r > 40 ? std::exp(-log_r) : 1 / std::sqrt(1 + std::exp(2 * log_r));
            const double s_m = std::sqrt((1 - m_z) * (1 + m_z));
            ring(m_z, s_m, _law.lever(log_r) * dlog_r / s_m);
        }
    }

    // The facets of one m_z, over their azimuth psi from wo; area is P22 dp dq / m_z without dpsi.
    void ring(double m_z, double s_m, double area)
    {
        const double middle = _mu * m_z, swing = _sin_o * s_m;  // wo.m = middle + swing cos(psi)
        const auto psi_at = [&](double c) {
            return c - middle >= swing    ? 0
                   : c - middle <= -swing ? pi
                                          : std::acos((c - middle) / swing);
        };
        // wr is above the surface where wo.m exceeds this, wt below it where wo.m exceeds that, or
        // where there is no total reflection.
        const double reflects = 0.5 * _mu / m_z, b = _mu / m_z;
        const double refracts =
            _k < 0 && b < _turning ? 0.5 * (b + _turning * (_turning / b)) : _turning;
        std::array<double, 6> ends{
            0, pi, psi_at(0), psi_at(reflects), psi_at(_turning), psi_at(refracts)};
        std::sort(ends.begin(), ends.end());
        for (std::size_t e = 0; e + 1 < ends.size(); ++e)
        {
            const double first = ends[e], range = ends[e + 1] - first;
            if (range < 1e-10) continue;
            const double c = middle + swing * std::cos(first + 0.5 * range);
            if (c <= 0) return;
            const bool reflected = c > reflects, refracted = _k >= 0 || c > refracts;
            if (!reflected && !refracted) continue;
            const QuadratureRule& rule = rule_for(std::min(1.0, 0.4 + 0.6 / pi * range));
            const double scale = 2 * area * range / _sigma_o;
            for (std::size_t i = 0; i < rule.x.size(); ++i)
            {
                const double t = rule.x[i], dpsi = rule.weight[i] * smooth_step_slope(t);
                facet(std::cos(first + range * smooth_step(t)), m_z, s_m, scale * dpsi, reflected,
                      refracted);
            }
        }
    }

    void facet(double cos_psi, double m_z, double s_m, double area, bool reflected, bool refracted)
    {
        const double c = _mu * m_z + _sin_o * s_m * cos_psi;
        if (c <= 0) return;
        const double g2 = _k + c * c, g = std::sqrt(std::max(0.0, g2));
        const double F = g2 > 0 ? fresnel(c, g) : 1, weight = area * c;
        const Vec3<double> m(s_m * cos_psi, s_m * std::sqrt((1 - cos_psi) * (1 + cos_psi)), m_z);
        if (reflected && is_reflection(_wo, m * (2 * c) - _wo, m))
        {
            const double mu_r = std::min(1.0, 2 * c * m_z - _mu);
            _sum.reflected += weight * F * correlated(mu_r, _law.projected_area(mu_r));
        }
        if (!refracted || g2 <= 0) return;
        const double bend = -_k / (c + g);  // c - g
        const Vec3<double> wt = (m * bend - _wo) * (1 / _eta);
        if (!is_transmission(_wo, wt, m)) return;
        const double mu_t = std::min(1.0, (_mu - bend * m_z) / _eta);
        const double sigma_t = _law.projected_area(mu_t);
        _sum.transmitted_correlated += weight * (1 - F) * correlated(mu_t, sigma_t);
        _sum.transmitted_beta += weight * (1 - F) * beta(mu_t, sigma_t);
    }

    // A rule of a share of the nodes.
    const QuadratureRule& rule_for(double share) const
    {
        return rule_of(std::max(6, static_cast<int>(std::ceil(_nodes * share))));
    }

    // G2 / G1.
    double correlated(double mu_i, double sigma_i) const
    {
        return _sigma_o * mu_i / (_sigma_o * mu_i + sigma_i * _mu - mu_i * _mu);
    }
    double beta(double mu_i, double sigma_i) const
    {
        const double lambda_i = std::max(0.0, sigma_i / mu_i - 1);
        return std::exp(_log_gamma_o + log_gamma(1 + lambda_i) -
                        log_gamma(2 + _lambda_o + lambda_i));
    }

    const SlopeLaw& _law;
    int _nodes;
    double _mu, _eta;
    double _k;        // g^2 - c^2
    double _turning;  // the cosine about a facet where Fresnel's term does
    double _sin_o;
    Vec3<double> _wo;
    double _theta_o, _sigma_o, _lambda_o, _log_gamma_o;
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
