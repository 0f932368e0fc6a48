// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "rounding.h"

#include <algorithm>
#include <cmath>

REGAIN_NAMESPACE_BEGIN
namespace conformance {

double difference(double a, double b)
{
    const double size = std::max(std::abs(a), std::abs(b));
    if (std::isnan(a) || std::isnan(b)) return 1;
    return size > 1e-12 ? std::abs(a - b) / size : 0;
}

double rounding_of(const TestedClosure& prepared, const Direction& wi, bool in_double)
{
    const double f = prepared.eval(wi, Direction(0.5)).y, pdf = prepared.pdf(wi);
    // A few times, on its way from wo and wi to a facet.
    const double step = in_double ? 0x1p-50 : 0x1p-21;
    double most = 0;
    for (double by : {1 - step, 1 + step})
    {
        const Direction near(wi.x, wi.y, wi.z * by);
        most = std::max({most, difference(prepared.eval(near, Direction(0.5)).y, f),
                         difference(prepared.pdf(near), pdf)});
    }
    return most;
}

}  // namespace conformance
REGAIN_NAMESPACE_END
