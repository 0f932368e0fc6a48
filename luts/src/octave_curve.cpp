// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "octave_curve.h"

#include <cmath>

REGAIN_NAMESPACE_BEGIN
namespace luts {

OctaveCurve::OctaveCurve(const std::function<double(double)>& f, double lo, double hi)
    : _lowest(lo), _highest(hi), _first(bits_of(lo) >> shift)
{
    const double pi = std::acos(-1.0);
    const auto number = [](std::uint64_t bits) {
        double x;
        std::memcpy(&x, &bits, sizeof x);
        return x;
    };
    const std::uint64_t last = bits_of(hi) >> shift;
    for (std::uint64_t cell = _first; cell <= last; ++cell)
    {
        const double from = number(cell << shift), to = number((cell + 1) << shift);
        // Chebyshev's nodes, then his polynomials as powers.
        std::array<double, terms> values, c;
        for (std::size_t k = 0; k < terms; ++k)
        {
            const double t = std::cos(pi * (static_cast<double>(k) + 0.5) / terms);
            values[k] = f(0.5 * (from + to) + 0.5 * (to - from) * t);
        }
        for (std::size_t j = 0; j < terms; ++j)
        {
            c[j] = 0;
            for (std::size_t k = 0; k < terms; ++k)
                c[j] +=
                    values[k] *
                    std::cos(pi * static_cast<double>(j) * (static_cast<double>(k) + 0.5) / terms) *
                    (j == 0 ? 1.0 : 2.0) / terms;
        }
        _cells.push_back({c[0] - c[2] + c[4], c[1] - 3 * c[3] + 5 * c[5], 2 * c[2] - 8 * c[4],
                          4 * c[3] - 20 * c[5], 8 * c[4], 16 * c[5]});
    }
}

}  // namespace luts
REGAIN_NAMESPACE_END
