// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Dielectric tables of GGX with few nodes along alpha and index, baked for a test that asks at the
/// nodes alone. Along the cosine they have three times the steps of real tables, so that what is
/// off is not theirs.

#pragma once

#include <regain/closures/dielectric_tables.h>
#include <regain/luts/dielectric_integral.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace regain::tests {

class BakedDielectric
{
public:
    static constexpr int rows = 5, layers = 5;

    /// The alpha and index (at least 1) of a node.
    static double alpha(int row) { return std::pow(row / double(rows - 1), 2); }
    static double index(int layer)
    {
        const double z = layer / double(layers - 1), q = 0.6 * z * z;
        return (1 + q) / (1 - q);
    }

    explicit BakedDielectric(bool beta)
    {
        constexpr int width = 3 * 31 + 1;
        for (int side = 0; side < 2; ++side)
        {
            for (int k = 0; k < layers; ++k)
                for (int j = 0; j < rows; ++j)
                    for (int i = 0; i < width; ++i)
                    {
                        double E = 1, R = 0;
                        const double eta = side == 0 ? index(k) : 1 / index(k);
                        const double mu = cosine(side, i / double(width - 1), alpha(j), eta);
                        if (j > 0 && mu > 0)
                        {
                            const auto a =
                                luts::dielectric_albedo(luts::SlopeLaw::ggx(alpha(j)), mu, eta, 12);
                            const double T = beta ? a.transmitted_beta : a.transmitted_correlated;
                            E = a.reflected + T;
                            R = a.reflected / E;
                        }
                        _E[side].push_back(stored(E));
                        _R[side].push_back(stored(R));
                    }
            for (auto* view : {&_tables.E[side], &_tables.R[side]})
            {
                view->data = (view == &_tables.E[side] ? _E : _R)[side].data();
                view->width = width;
                view->height = rows;
                view->depth = layers;
            }
        }
    }
    BakedDielectric(const BakedDielectric&) = delete;
    BakedDielectric& operator=(const BakedDielectric&) = delete;

    const DielectricTables& tables() const { return _tables; }

private:
    static std::uint16_t stored(double v)
    {
        return static_cast<std::uint16_t>(std::lround(65535 * std::min(1.0, std::max(0.0, v))));
    }

    // The cosine at a coordinate, by bisection of the axis itself.
    static double cosine(int side, double x, double alpha, double eta)
    {
        if (alpha == 0) return 0;
        double low = 0, high = 1;
        for (int i = 0; i < 60; ++i)
        {
            const double mu = 0.5 * (low + high);
            const double at = side == 0 || eta >= 1
                                  ? stretched_cosine(mu, alpha)
                                  : regain::detail::critical_cosine_coordinate(mu, alpha, eta);
            (at < x ? low : high) = mu;
        }
        return std::max(1e-9, 0.5 * (low + high));
    }

    std::vector<std::uint16_t> _E[2], _R[2];
    DielectricTables _tables;
};

}  // namespace regain::tests
