// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Plots as SVG: curves over two axes, or lobes about a point. Text stays text, so that a page can
/// be searched and a plot be read at any size.

#pragma once

#include <Imath/ImathVec.h>

#include <string>
#include <vector>

namespace regain::tools::figures {

struct Curve
{
    std::string label;
    std::string color;  ///< as in SVG, "#c0392b"
    std::vector<Imath::V2d> points;
    bool marks = false;  ///< a dot at each point instead of a line
    bool dashed = false;
};

struct Axis
{
    std::string label;
    double low = 0, high = 1;
    double step = 0.2;  ///< between labelled ticks, from `low` on
};

/// Curves over x and y. Points outside the axes are clipped.
std::string svg_plot(const std::string& title, const Axis& x, const Axis& y,
                     const std::vector<Curve>& curves);

/// Lobes over a half or, where `lower` is set, a whole plane of directions: a point (x, y) is the
/// end of an arrow from the origin, y along the surface normal. The largest radius fills the plot.
/// `arrow` is drawn towards the origin: where the light comes from.
struct LobePanel
{
    std::string title;
    std::vector<Curve> curves;
    Imath::V2d arrow{0, 0};
    bool lower = false;
};

/// Panels side by side, all at one scale.
std::string svg_lobes(const std::vector<LobePanel>& panels);

}  // namespace regain::tools::figures
