// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "false_colour.h"

#include "picture_label.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace regain::tools {

using Imath::C3f;

// White in the middle; evenly darker to the eye on both sides, told apart by the colour-blind.
C3f difference_colour(double t)
{
    const float x = static_cast<float>(std::clamp(t, -1.0, 1.0)), a = std::abs(x);
    const C3f end = x > 0 ? C3f(0.70f, 0.02f, 0.10f) : C3f(0.02f, 0.19f, 0.62f),
              middle = x > 0 ? C3f(0.96f, 0.55f, 0.39f) : C3f(0.40f, 0.66f, 0.87f), white(0.97f);
    return a < 0.5f ? white + (middle - white) * (2 * a) : middle + (end - middle) * (2 * a - 1);
}

Difference difference_of(const Picture& a, const Picture& b)
{
    Difference d;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c)
        {
            const double x = std::abs(double(a.pixels[i][c]) - double(b.pixels[i][c]));
            d.most = std::max(d.most, x);
            d.rms += x * x;
        }
    if (!a.pixels.empty()) d.rms = std::sqrt(d.rms / (3.0 * double(a.pixels.size())));
    return d;
}

DisplayPicture false_colour(const Picture& a, const Picture& b, double scale)
{
    const int bar = std::max(18, a.height / 24), text = bar * 3 / 5;
    Picture shown{a.width, a.height + 2 * bar, {}};
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
    {
        const C3f d = a.pixels[i] - b.pixels[i];
        shown.pixels.push_back(difference_colour(double(d.x + d.y + d.z) / 3 / scale));
    }
    for (int y = 0; y < 2 * bar; ++y)
        for (int x = 0; x < a.width; ++x)
            shown.pixels.push_back(y < bar ? difference_colour(2 * (x + 0.5) / a.width - 1)
                                           : C3f(0.97f));
    for (const double t : {-1.0, -0.5, 0.0, 0.5, 1.0})
    {
        const int margin = a.width / 16;
        const int x = std::clamp(static_cast<int>((t + 1) / 2 * a.width), margin, a.width - margin);
        set_label(shown, fmt::format("{:+.3g}", t * scale), x, a.height + 2 * bar - bar / 4, text,
                  0.1f);
    }
    DisplayPicture display{shown.width, shown.height, {}};
    for (const C3f& p : shown.pixels)
        for (int c = 0; c < 3; ++c)
            display.bytes.push_back(
                static_cast<std::uint8_t>(std::lround(255 * std::clamp(p[c], 0.0f, 1.0f))));
    return display;
}

}  // namespace regain::tools
