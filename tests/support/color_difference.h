// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// How different two colours look: CIE L*a*b* by D65 (CIE 15), and the difference CIEDE2000
/// (Sharma, Wu, Dalal: The CIEDE2000 color-difference formula, Color Res. Appl. 30, 2005).

#pragma once

#include <regain/shaders/color.h>
#include <regain/shaders/white_adaptation.h>

#include <cmath>

namespace regain::tests {

struct Lab
{
    double L, a, b;
};

/// XYZ with the Y of the D65 white 1.
inline Lab lab_of_xyz_d65(const shaders::C3d& xyz)
{
    const auto f = [](double t) {
        return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116;
    };
    const shaders::C3d white = shaders::d65_white();
    const double x = f(xyz.x / white.x), y = f(xyz.y / white.y), z = f(xyz.z / white.z);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

inline double ciede2000(const Lab& one, const Lab& other)
{
    const double pi = std::acos(-1.0), degree = pi / 180;
    const auto seventh = [](double c) {
        const double p = std::pow(c, 7);
        return std::sqrt(p / (p + std::pow(25.0, 7)));
    };
    const double mean_c = 0.5 * (std::hypot(one.a, one.b) + std::hypot(other.a, other.b)),
                 G = 0.5 * (1 - seventh(mean_c));
    const double a1 = one.a * (1 + G), a2 = other.a * (1 + G), C1 = std::hypot(a1, one.b),
                 C2 = std::hypot(a2, other.b);
    const auto hue = [&](double a, double b) {
        if (a == 0 && b == 0) return 0.0;
        const double h = std::atan2(b, a);
        return h < 0 ? h + 2 * pi : h;
    };
    const double h1 = hue(a1, one.b), h2 = hue(a2, other.b);
    double dh = C1 * C2 == 0 ? 0 : h2 - h1;
    if (dh > pi) dh -= 2 * pi;
    if (dh < -pi) dh += 2 * pi;
    const double dL = other.L - one.L, dC = C2 - C1, dH = 2 * std::sqrt(C1 * C2) * std::sin(dh / 2);
    const double L = 0.5 * (one.L + other.L), C = 0.5 * (C1 + C2);
    double h = h1 + h2;
    if (C1 * C2 != 0)
    {
        if (std::abs(h1 - h2) > pi) h += h < 2 * pi ? 2 * pi : -2 * pi;
        h /= 2;
    }
    const double T = 1 - 0.17 * std::cos(h - 30 * degree) + 0.24 * std::cos(2 * h) +
                     0.32 * std::cos(3 * h + 6 * degree) - 0.20 * std::cos(4 * h - 63 * degree);
    const double turn = 30 * degree * std::exp(-std::pow((h / degree - 275) / 25, 2));
    const double S_L = 1 + 0.015 * (L - 50) * (L - 50) / std::sqrt(20 + (L - 50) * (L - 50)),
                 S_C = 1 + 0.045 * C, S_H = 1 + 0.015 * C * T;
    const double R = -std::sin(2 * turn) * 2 * seventh(C);
    const double l = dL / S_L, c = dC / S_C, H = dH / S_H;
    return std::sqrt(l * l + c * c + H * H + R * c * H);
}

}  // namespace regain::tests
