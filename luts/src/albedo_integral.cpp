// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/luts/albedo_integral.h>

#include "upward_slopes.h"

#include <algorithm>
#include <cmath>

REGAIN_NAMESPACE_BEGIN
namespace luts {

double albedo(const SlopeLaw& law, double mu, const std::function<double(double)>& fresnel,
              AlbedoAccuracy accuracy)
{
    double sum = 0;
    integrate_upward_slopes(law, mu, accuracy.nodes, [&](double weight, double cosine, double) {
        sum += fresnel ? weight * fresnel(cosine) : weight;
    });
    return std::min(1.0, sum);
}

AlbedoMoments albedo_moments(const SlopeLaw& law, double mu, AlbedoAccuracy accuracy)
{
    AlbedoMoments sum{0, 0, 0};
    integrate_upward_slopes(law, mu, accuracy.nodes, [&](double weight, double cosine, double) {
        const double x = 1 - cosine, x2 = x * x, x4 = x2 * x2;
        sum.E_ss += weight;
        sum.falloff += weight * x4 * x;
        sum.dip += weight * x4 * x2 * cosine;
    });
    return {std::min(1.0, sum.E_ss), sum.falloff / sum.E_ss, sum.dip / sum.E_ss};
}

double average_albedo(const SlopeLaw& law, AlbedoAccuracy accuracy)
{
    // mu = x^3 gathers nodes at grazing angles, where E_ss dips over a width of alpha.
    const QuadratureRule& rule = rule_of(accuracy.nodes);
    double sum = 0;
    for (std::size_t i = 0; i < rule.x.size(); ++i)
    {
        const double x = rule.x[i], mu = x * x * x;
        sum += rule.weight[i] * 3 * x * x * 2 * mu * albedo(law, mu, {}, accuracy);
    }
    return sum;
}

double ggx_albedo(double mu, double alpha, const std::function<double(double)>& fresnel,
                  AlbedoAccuracy accuracy)
{
    return albedo(SlopeLaw::ggx(alpha), mu, fresnel, accuracy);
}

double ggx_average_albedo(double alpha, AlbedoAccuracy accuracy)
{
    return average_albedo(SlopeLaw::ggx(alpha), accuracy);
}

}  // namespace luts
REGAIN_NAMESPACE_END
