// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// How likely a deviation is if nothing is wrong. Probabilities are of one more extreme.

#pragma once

#include <regain/closures/version.h>

#include <cstddef>

REGAIN_NAMESPACE_BEGIN
namespace conformance {

/// Of a sum of chi squared above x, with this many degrees of freedom: the regularised upper gamma
/// function Q(degrees / 2, x / 2).
double chi_squared_tail(double x, double degrees);

/// Of Student's |t| above t: the regularised incomplete beta function
/// I(degrees / (degrees + t^2); degrees / 2, 1 / 2).
double student_tail(double t, double degrees);

/// Of a count of at least `found` where `expected` are expected (Poisson).
double count_tail(double found, double expected);

/// The level of each of `tests` independent tests at which all of them together raise a false alarm
/// with probability `family` (Sidak 1967).
double sidak_level(double family, std::size_t tests);

/// Mean, variance and number of values, as they come (Welford 1962).
class RunningMean
{
public:
    void add(double x)
    {
        ++_n;
        const double d = x - _mean;
        _mean += d / static_cast<double>(_n);
        _squares += d * (x - _mean);
    }
    void scale_by(double factor)
    {
        _mean *= factor;
        _squares *= factor * factor;
    }
    std::size_t count() const { return _n; }
    double mean() const { return _mean; }
    double variance() const { return _n > 1 ? _squares / static_cast<double>(_n - 1) : 0; }
    /// Of the mean.
    double standard_error() const;

private:
    std::size_t _n = 0;
    double _mean = 0, _squares = 0;
};

/// Of a mean that is further than `bound` from `expected`, if it is within.
double tail_beyond(const RunningMean& mean, double expected, double bound);

}  // namespace conformance
REGAIN_NAMESPACE_END
