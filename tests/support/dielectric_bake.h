// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Tables of E^S for a test, of one interface: by quadrature, and constant along all axes but the
/// cosine, where they have three times the nodes of real ones, so that what is off is not theirs.
/// The axis is found by asking the tables themselves.

#pragma once

#include <regain/closures/dielectric_tables.h>
#include <regain/luts/dielectric_integral.h>

#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

namespace regain::tests {

class BakedDielectric
{
public:
    /// index is at least 1; both sides are baked. `tail`: over the axis of distributions that have
    /// one.
    BakedDielectric(const luts::SlopeLaw& law, double index, bool beta, bool tail = false)
    {
        const double alpha = law.alpha();
        _tables.tail = tail;
        for (int side = 0; side < 2; ++side)
        {
            _E[side].resize(4 * width);
            _R[side].resize(4 * width);
            // A ramp, whose look-ups are the coordinate; shares of nothing.
            for (int i = 0; i < 4 * width; ++i)
                _E[side][std::size_t(i)] = stored((i % width) / double(width - 1));
            const auto view = [](const std::vector<std::uint16_t>& data) {
                TableView v;
                v.data = data.data();
                v.width = width;
                v.height = v.depth = 2;
                return v;
            };
            _tables.E[side] = view(_E[side]);
            _tables.R[side] = view(_R[side]);
        }
        for (int side = 0; side < 2; ++side)
        {
            const double eta = side == 0 ? index : 1 / index;
            std::vector<double> mu;
            for (int i = 0; i < width; ++i) mu.push_back(cosine(alpha, eta, i / double(width - 1)));
            std::vector<std::uint16_t> E, R;
            for (double m : mu)
            {
                const auto a = luts::dielectric_albedo(law, m, eta, tail ? 20 : 12);
                const double T = beta ? a.transmitted_beta : a.transmitted_correlated;
                const double share = a.reflected / (a.reflected + T);
                E.push_back(stored(a.reflected + T));
                R.push_back(stored(0.5 + 0.5 * (share - _tables.reflected_share(alpha, eta, m))));
            }
            for (int i = 0; i < 4 * width; ++i)
            {
                _E[side][std::size_t(i)] = E[std::size_t(i % width)];
                _R[side][std::size_t(i)] = R[std::size_t(i % width)];
            }
            _tables.R[side].offset = -1;
            _tables.R[side].scale = 2.0f / 65535;
        }
    }
    BakedDielectric(const BakedDielectric&) = delete;
    BakedDielectric& operator=(const BakedDielectric&) = delete;

    const DielectricTables& tables() const { return _tables; }

private:
    static constexpr int width = 3 * 31 + 1;

    static std::uint16_t stored(double v)
    {
        return static_cast<std::uint16_t>(std::lround(65535 * std::min(1.0, std::max(0.0, v))));
    }

    // By bisection of the ramp.
    double cosine(double alpha, double eta, double x) const
    {
        double low = 0, high = 1;
        for (int i = 0; i < 60; ++i)
        {
            const double mu = 0.5 * (low + high);
            (_tables.albedo(alpha, eta, mu) < x ? low : high) = mu;
        }
        return std::max(1e-9, high);
    }

    std::vector<std::uint16_t> _E[2], _R[2];
    DielectricTables _tables;
};

/// Baked when first asked for; eta above or below 1.
inline const DielectricTables& baked_dielectric(double alpha, double eta, bool beta)
{
    static std::map<std::tuple<double, double, bool>, std::unique_ptr<BakedDielectric>> all;
    const double index = std::max(eta, 1 / eta);
    auto& one = all[{alpha, index, beta}];
    if (!one) one = std::make_unique<BakedDielectric>(luts::SlopeLaw::ggx(alpha), index, beta);
    return one->tables();
}

}  // namespace regain::tests
