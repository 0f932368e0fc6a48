// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What a host passes to a closure, whatever the closure is: each reads the parameters that it has.
/// All are ordinary unless a hard case sets them.

#pragma once

#include <regain/closures/vector.h>

#include <limits>

namespace regain::tests {

struct Parameters
{
    using Color = Color3<double>;

    double alpha_x = 0.5, alpha_y = 0.4, gamma = 1.8, eta = 1.5, strength = 1;
    /// Gold at 650, 550 and 450 nm (Johnson and Christy 1972), exactly and to an artist's eye.
    Color n{0.16, 0.42, 1.5}, k{3.46, 2.35, 1.88};
    Color color0{0.94, 0.77, 0.37}, color82{0.98, 0.95, 0.75}, color90{1, 1, 1};
    double exponent = 5;
    Color reflection_tint{1, 0.75, 0.5}, transmission_tint{0.25, 0.75, 1};
    Color albedo{0.8, 0.5, 0.2};
    double sheen_weight = 0.5;
    Color sheen_color{1, 0.9, 0.8};

    static Parameters isotropic(double alpha)
    {
        Parameters s;
        s.alpha_x = s.alpha_y = alpha;
        return s;
    }
    /// Nothing absorbs.
    static Parameters white(double alpha)
    {
        Parameters s = isotropic(alpha);
        s.color0 = s.color82 = s.color90 = Color(1.0);
        s.reflection_tint = s.transmission_tint = s.albedo = Color(1.0);
        return s;
    }
};

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace regain::tests
