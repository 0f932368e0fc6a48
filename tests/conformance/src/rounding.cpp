// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "rounding.h"

#include <algorithm>
#include <cmath>
#include <limits>

REGAIN_NAMESPACE_BEGIN
namespace conformance {

double difference(double a, double b)
{
    const double size = std::max(std::abs(a), std::abs(b));
    if (std::isnan(a) || std::isnan(b)) return 1;
    return size > 1e-12 ? std::abs(a - b) / size : 0;
}

Direction turned_by_rounding(const Direction& wi, bool in_double, int sign)
{
    // A few times, on its way from wo and wi to a facet.
    const double step = in_double ? 0x1p-50 : 0x1p-21;
    const double z = wi.z * (1 + sign * step);
    // Turned, since closures correct lengths.
    const double tangential2 = wi.x * wi.x + wi.y * wi.y;
    const double scale = std::sqrt(std::max(0.0, 1 - z * z) /
                                   std::max(tangential2, std::numeric_limits<double>::min()));
    return {wi.x * scale, wi.y * scale, z};
}

double rounding_of(const TestedClosure& prepared, const Direction& wi, bool in_double)
{
    const double f = prepared.eval(wi, Direction(0.5)).y, pdf = prepared.pdf(wi);
    double most = 0;
    for (int sign : {-1, 1})
    {
        const Direction near = turned_by_rounding(wi, in_double, sign);
        most = std::max({most, difference(prepared.eval(near, Direction(0.5)).y, f),
                         difference(prepared.pdf(near), pdf)});
    }
    return most;
}

}  // namespace conformance
REGAIN_NAMESPACE_END
