// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/luts/quadrature.h>

#include <cmath>
#include <cstddef>

REGAIN_NAMESPACE_BEGIN
namespace luts {

QuadratureRule gauss_legendre(int n)
{
    QuadratureRule rule;
    rule.x.resize(static_cast<std::size_t>(n));
    rule.weight.resize(static_cast<std::size_t>(n));
    const double pi = std::acos(-1.0);
    for (int i = 0; i < n; ++i)
    {
        // Newton's iteration on the Legendre polynomial from Tricomi's estimate of its root.
        double x = std::cos(pi * (i + 0.75) / (n + 0.5)), slope = 1;
        for (int step = 0; step < 20; ++step)
        {
            double p = 1, previous = 0;
            for (int k = 1; k <= n; ++k)
            {
                const double next = ((2 * k - 1) * x * p - (k - 1) * previous) / k;
                previous = p;
                p = next;
            }
            slope = n * (x * p - previous) / (x * x - 1);
            const double change = p / slope;
            x -= change;
            if (std::abs(change) < 1e-16) break;
        }
        const auto at = static_cast<std::size_t>(n - 1 - i);
        rule.x[at] = 0.5 * (1 + x);
        rule.weight[at] = 1 / ((1 - x * x) * slope * slope);
    }
    return rule;
}

}  // namespace luts
REGAIN_NAMESPACE_END
