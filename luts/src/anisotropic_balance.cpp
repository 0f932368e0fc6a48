// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/luts/anisotropic_balance.h>

#include "balance_nodes.h"
#include "stretched_slopes.h"

#include <algorithm>
#include <cmath>

REGAIN_NAMESPACE_BEGIN
namespace luts {
namespace {

// What is solved for is the change, of which few nodes see everything.
constexpr int cosine_cells = 24, azimuth_cells = 8, most_rounds = 500;
constexpr std::size_t columns = azimuth_cells + 1, size = (cosine_cells + 1) * columns;

const double half_pi = 0.5 * std::acos(-1.0);

double root_mean_square(double a, double b) { return std::sqrt(0.5 * (a * a + b * b)); }

}  // namespace

AnisotropicBalance::AnisotropicBalance(const std::string& distribution, double wider, double ratio,
                                       double gamma, int nodes)
    : _wider(wider),
      _narrower(wider / ratio),
      _turn(std::pow(ratio, 0.25)),
      _mean(luts::root_mean_square(_wider, _narrower)),
      _isotropic(SlopeLaw::named(distribution, _mean, gamma), 2 * nodes),
      _change(size, 1.0)
{
    if (ratio == 1) return;
    // The anisotropic form of GTR, see closures/gtr.h; of the others any alpha serves.
    const StretchedLaw law{SlopeLaw::named(distribution, std::sqrt(_wider * _narrower), gamma),
                           std::sqrt(ratio)};
    const CosineNodes cosines(_mean, cosine_cells);
    std::vector<double> kernel(size * size), isotropic(size);
    for (std::size_t o = 0; o < size; ++o)
    {
        // At mu = 0 there is no lobe; close by is its limit.
        const double row = std::max(static_cast<double>(o / columns), 0.1);
        const double angle = static_cast<double>(o % columns) / azimuth_cells * half_pi;
        // The inverse of azimuth_place.
        const double c = std::cos(angle), s = std::sin(angle) / _turn;
        const Vec3<double> wo = direction(cosines.cosine(row), s * s / (s * s + c * c));
        isotropic[o] = _isotropic.at(place(wo).mu);
        integrate_stretched_slopes(law, wo, nodes, [&](double weight, const Vec3<double>& wi) {
            const Place p = place(wi);
            const CubicStencil a(cosines.place(p.mu), cosine_cells),
                b(azimuth_place(p.y), azimuth_cells, true);
            weight *= _isotropic.at(p.mu);
            for (std::size_t i = 0; i < 4; ++i)
                for (std::size_t j = 0; j < 4; ++j)
                    kernel[o * size + a.node[i] * columns + b.node[j]] +=
                        weight * a.weight[i] * b.weight[j];
        });
    }
    std::vector<double> next(size);
    for (int round = 0; round < most_rounds; ++round)
    {
        double moved = 0;
        for (std::size_t o = 0; o < size; ++o)
        {
            double sum = 0;
            for (std::size_t i = 0; i < size; ++i) sum += kernel[o * size + i] * _change[i];
            next[o] = std::sqrt(_change[o] / (isotropic[o] * sum));
            moved = std::max(moved, std::abs(next[o] / _change[o] - 1));
        }
        _change = next;
        if (moved < 1e-9) break;
    }
}

// By an angle between the true azimuth and that before stretching, which spreads what changes.
double AnisotropicBalance::azimuth_place(double y) const
{
    return azimuth_cells / half_pi *
           std::atan2(_turn * std::sqrt(y), std::sqrt(std::max(0.0, 1 - y)));
}

AnisotropicBalance::Place AnisotropicBalance::place(const Vec3<double>& w) const
{
    const double X = _wider * w.x, Y = _narrower * w.y, tangential = X * X + Y * Y;
    return {_mean * w.z / std::max(std::sqrt(_mean * _mean * w.z * w.z + tangential), 1e-300),
            tangential > 0 ? Y * Y / tangential : 0};
}

Vec3<double> AnisotropicBalance::direction(double mu, double y) const
{
    const double sine = _mean * std::sqrt(std::max(0.0, (1 - mu) * (1 + mu)));
    const Vec3<double> w(sine * std::sqrt(1 - y) / _wider, sine * std::sqrt(y) / _narrower, mu);
    return w / w.length();
}

double AnisotropicBalance::cosine(double mu, double y) const { return direction(mu, y).z; }

double AnisotropicBalance::change(double mu, double y) const
{
    const CubicStencil a(CosineNodes(_mean, cosine_cells).place(mu), cosine_cells),
        b(azimuth_place(y), azimuth_cells, true);
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
            sum += a.weight[i] * b.weight[j] * _change[a.node[i] * columns + b.node[j]];
    return sum;
}

double AnisotropicBalance::at(const Vec3<double>& w) const
{
    const Place p = place(w);
    return _isotropic.at(p.mu) * change(p.mu, p.y);
}

}  // namespace luts
REGAIN_NAMESPACE_END
