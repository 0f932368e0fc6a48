// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "histogram_picture.h"

#include "picture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace regain::tools {
namespace {

using Rgb = std::array<double, 3>;  // of the display, in [0, 1]

// Nine even steps of matplotlib's viridis (Smith and van der Walt 2015; dedicated to the public
// domain), whose lightness rises evenly.
constexpr std::array<Rgb, 9> viridis{{{0.267, 0.005, 0.329},
                                      {0.279, 0.175, 0.483},
                                      {0.230, 0.322, 0.546},
                                      {0.173, 0.449, 0.558},
                                      {0.128, 0.567, 0.551},
                                      {0.158, 0.684, 0.502},
                                      {0.369, 0.789, 0.383},
                                      {0.678, 0.864, 0.190},
                                      {0.993, 0.906, 0.144}}};

// Five steps of ColorBrewer's RdBu (Brewer 2002), blue first.
constexpr std::array<Rgb, 5> blue_to_red{{{0.020, 0.188, 0.380},
                                          {0.573, 0.773, 0.871},
                                          {0.969, 0.969, 0.969},
                                          {0.957, 0.647, 0.510},
                                          {0.404, 0.000, 0.122}}};

constexpr double most_deviations = 5;
constexpr int pixels_per_cell = 3, gap = 6;

template <std::size_t N>
Rgb at(const std::array<Rgb, N>& map, double x)
{
    const double place = (x > 0 ? std::min(x, 1.0) : 0) * static_cast<double>(N - 1);
    const auto i = std::min(N - 2, static_cast<std::size_t>(place));
    const double t = place - static_cast<double>(i);
    Rgb color{};
    for (std::size_t c = 0; c < 3; ++c) color[c] = (1 - t) * map[i][c] + t * map[i + 1][c];
    return color;
}

}  // namespace

void write_histogram_picture(const std::filesystem::path& file, const conformance::Histogram& h)
{
    double most = 1;
    for (const auto* counts : {&h.found, &h.expected})
        for (float n : *counts)
            if (std::isfinite(n)) most = std::max(most, static_cast<double>(n));

    const int panel = h.width * pixels_per_cell;
    DisplayPicture picture;
    picture.width = 3 * panel + 2 * gap;
    picture.height = h.height * pixels_per_cell;
    picture.bytes.assign(3 * static_cast<std::size_t>(picture.width * picture.height), 255);
    const auto paint = [&](int which, int x, int y, const Rgb& color) {
        for (int j = 0; j < pixels_per_cell; ++j)
            for (int i = 0; i < pixels_per_cell; ++i)
            {
                const int row = y * pixels_per_cell + j;
                const int column = which * (panel + gap) + x * pixels_per_cell + i;
                for (int c = 0; c < 3; ++c)
                    picture
                        .bytes[static_cast<std::size_t>(3 * (row * picture.width + column) + c)] =
                        static_cast<std::uint8_t>(color[static_cast<std::size_t>(c)] * 255 + 0.5);
            }
    };
    for (int y = 0; y < h.height; ++y)
        for (int x = 0; x < h.width; ++x)
        {
            const auto i = static_cast<std::size_t>(y * h.width + x);
            const double found = h.found[i], expected = h.expected[i];
            paint(0, x, y, at(viridis, std::sqrt(found / most)));
            paint(1, x, y, at(viridis, std::sqrt(expected / most)));
            const double off = (found - expected) / std::sqrt(std::max(expected, 1.0));
            paint(2, x, y, at(blue_to_red, 0.5 + 0.5 * off / most_deviations));
        }
    write_png(file, picture);
}

}  // namespace regain::tools
