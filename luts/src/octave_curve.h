// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#pragma once

#include <regain/closures/version.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <functional>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace luts {

/// A function of a positive number that is smooth in its logarithm, as polynomials between numbers
/// that a double tells by its leading bits, eight to an octave: nobody has to take the logarithm.
/// Good to 1e-11 of a function that changes over a factor of e.
class OctaveCurve
{
public:
    /// f over [lo, hi], finite and positive.
    OctaveCurve(const std::function<double(double)>& f, double lo, double hi);

    double lowest() const { return _lowest; }
    double highest() const { return _highest; }

    /// x in [lowest, highest].
    double operator()(double x) const
    {
        const std::uint64_t bits = bits_of(x);
        const std::size_t cell = (bits >> shift) - _first;
        const auto rest = static_cast<std::int64_t>(bits & ((std::uint64_t{1} << shift) - 1));
        const double t = static_cast<double>(rest) * (2.0 / (std::uint64_t{1} << shift)) - 1;
        const std::array<double, terms>& c = _cells[cell];
        double value = c[terms - 1];
        for (std::size_t i = terms - 1; i > 0; --i) value = value * t + c[i - 1];
        return value;
    }

private:
    static constexpr int shift = 52 - 3;
    static constexpr std::size_t terms = 6;

    static std::uint64_t bits_of(double x)
    {
        std::uint64_t bits;
        std::memcpy(&bits, &x, sizeof bits);
        return bits;
    }

    double _lowest, _highest;
    std::uint64_t _first;                           // leading bits of the first cell
    std::vector<std::array<double, terms>> _cells;  // coefficients of powers of t in [-1, 1]
};

}  // namespace luts
REGAIN_NAMESPACE_END
