// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/luts/albedo_integral.h>
#include <regain/luts/quadrature.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

REGAIN_NAMESPACE_BEGIN
namespace luts {
namespace {

const double pi = std::acos(-1.0);

// Rules are asked for again and again in the same few sizes.
const QuadratureRule& rule_of(int n)
{
    static std::mutex mutex;
    static std::map<int, QuadratureRule> rules;
    const std::lock_guard<std::mutex> lock(mutex);
    const auto at = rules.find(n);
    return at != rules.end() ? at->second : rules.emplace(n, gauss_legendre(n)).first->second;
}

// sigma(w) = cos theta (1 + Lambda), finite at grazing angles.
double projected_area(double cos_theta, double alpha)
{
    const double sin2 = std::max(0.0, 1 - cos_theta * cos_theta);
    return 0.5 * (cos_theta + std::sqrt(cos_theta * cos_theta + alpha * alpha * sin2));
}

}  // namespace

double ggx_albedo(double mu, double alpha, const std::function<double(double)>& fresnel,
                  AlbedoAccuracy accuracy)
{
    const QuadratureRule& rule = rule_of(accuracy.nodes);
    const double sin_o = std::sqrt(std::max(0.0, (1 - mu) * (1 + mu)));
    const double tan_o = sin_o / mu, sigma_o = projected_area(mu, alpha);

    // One slope: the integrand over P22 dp dq. The factor 1 / cos theta_o is merged with G2, whose
    // numerator has it too.
    const auto integrand = [&](double p, double rho) {
        const double facing = mu + sin_o * p;  // wo.m sqrt(1 + rho^2)
        const double scale = 1 / (1 + rho * rho);
        const double mu_i = 2 * facing * scale - mu;
        if (facing <= 0 || mu_i <= 0) return 0.0;
        const double sigma_i = projected_area(mu_i, alpha);
        const double value = facing * mu_i / (sigma_o * mu_i + sigma_i * mu - mu * mu_i);
        return fresnel ? value * fresnel(facing * std::sqrt(scale)) : value;
    };

    // Radially, with w = alpha / rho, P22 rho drho = 2 w / (1 + w^2)^2 dw / (2 pi). Inside a slope
    // of alpha the reciprocal of w serves, in which the integrand is smooth at the origin; outside
    // it w itself, in which the tail times the growing wo.m is smooth.
    const auto along = [&](double phi) {
        const double c = std::cos(phi), b = tan_o * c;
        // The far root of rho^2 - 2 b rho - 1 = 0, in the form that does not cancel.
        const double root = std::sqrt(b * b + 1);
        const double rho_max = b > 0 ? b + root : 1 / (root - b);
        const double inner = std::min(rho_max / alpha, 1.0), outer = alpha / rho_max;
        double sum = 0;
        for (std::size_t i = 0; i < rule.x.size(); ++i)
        {
            // Nodes gather at the edge, where light leaves at grazing angles.
            const double x = rule.x[i], near_edge = x * x * x, d_near_edge = 3 * x * x;
            if (outer < 1)
            {
                const double r = x, q = 1 + r * r;
                sum += rule.weight[i] * 2 * r / (q * q) * integrand(alpha * r * c, alpha * r);
                const double w = outer + (1 - outer) * near_edge, k = 1 + w * w;
                sum += rule.weight[i] * (1 - outer) * d_near_edge * 2 * w / (k * k) *
                       integrand(alpha / w * c, alpha / w);
            }
            else
            {
                const double r = inner * (1 - near_edge), q = 1 + r * r;
                sum += rule.weight[i] * inner * d_near_edge * 2 * r / (q * q) *
                       integrand(alpha * r * c, alpha * r);
            }
        }
        return sum;
    };

    // Over the half circle, nodes gathered about pi / 2, where at grazing angles the edge comes in
    // from far away.
    double sum = 0;
    for (int side = 0; side < 2; ++side)
        for (std::size_t j = 0; j < rule.x.size(); ++j)
        {
            const double x = rule.x[j];
            const double offset = 0.5 * pi * x * x * x, dphi = 0.5 * pi * 3 * x * x;
            sum += rule.weight[j] * dphi * along(0.5 * pi + (side == 0 ? -offset : offset));
        }
    // The integrand still lacks the 2 / (2 pi) of the half circle.
    return std::min(1.0, sum / pi);
}

double ggx_average_albedo(double alpha, AlbedoAccuracy accuracy)
{
    // mu = x^3 gathers nodes at grazing angles, where E_ss dips over a width of alpha.
    const QuadratureRule& rule = rule_of(accuracy.nodes);
    double sum = 0;
    for (std::size_t i = 0; i < rule.x.size(); ++i)
    {
        const double x = rule.x[i], mu = x * x * x;
        sum += rule.weight[i] * 3 * x * x * 2 * mu * ggx_albedo(mu, alpha, {}, accuracy);
    }
    return sum;
}

}  // namespace luts
REGAIN_NAMESPACE_END
