// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "svg_plot.h"

#include "svg_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace regain::tools::figures {
namespace {

using Imath::V2d;

constexpr double line_height = 18;

std::string stroke(const Curve& curve)
{
    return fmt::format("stroke=\"{}\" stroke-width=\"2\" fill=\"none\"{}", curve.color,
                       curve.dashed ? " stroke-dasharray=\"6 4\"" : "");
}

// The points of a curve in pixels, as a line or as dots.
std::string drawn(const Curve& curve, const std::vector<V2d>& pixels)
{
    std::string out;
    if (curve.marks)
    {
        for (const V2d& p : pixels)
            out += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"3.5\" fill=\"{}\"/>\n", p.x,
                               p.y, curve.color);
        return out;
    }
    out = fmt::format("<polyline {} points=\"", stroke(curve));
    for (const V2d& p : pixels) out += fmt::format("{:.2f},{:.2f} ", p.x, p.y);
    return out + "\"/>\n";
}

std::string legend(const std::vector<Curve>& curves, double x, double y)
{
    std::string out;
    for (const Curve& curve : curves)
    {
        const V2d at(x, y - 4);
        out += curve.marks ? drawn(curve, {at + V2d(12, 0)})
                           : svg_line(at, at + V2d(24, 0), stroke(curve));
        out += svg_text(x + 30, y, "start", curve.label);
        y += line_height;
    }
    return out;
}

}  // namespace

std::string svg_plot(const std::string& title, const Axis& x, const Axis& y,
                     const std::vector<Curve>& curves)
{
    constexpr double left = 70, top = 40, width = 420, height = 320, right = 230, bottom = 60;
    const auto pixel = [&](const V2d& p) {
        return V2d(left + width * (p.x - x.low) / (x.high - x.low),
                   top + height * (1 - (p.y - y.low) / (y.high - y.low)));
    };

    std::string out = svg_text(left + width / 2, top - 16, "middle", title);
    const auto ticks = [](const Axis& axis) {
        return static_cast<int>(std::floor((axis.high - axis.low) / axis.step + 1e-9));
    };
    for (int i = 0; i <= ticks(x); ++i)
    {
        const double at = x.low + i * x.step;
        out += svg_line(pixel({at, y.low}), pixel({at, y.high}), "stroke=\"#dddddd\"");
        out += svg_text(pixel({at, 0}).x, top + height + 20, "middle", fmt::format("{:.4g}", at));
    }
    for (int i = 0; i <= ticks(y); ++i)
    {
        const double at = y.low + i * y.step;
        out += svg_line(pixel({x.low, at}), pixel({x.high, at}), "stroke=\"#dddddd\"");
        out += svg_text(left - 8, pixel({0, at}).y + 4, "end", fmt::format("{:.4g}", at));
    }
    out += svg_text(left + width / 2, top + height + 44, "middle", x.label);
    out += fmt::format("<g transform=\"translate(18 {:.0f}) rotate(-90)\">{}</g>\n",
                       top + height / 2, svg_text(0, 0, "middle", y.label));

    // A clip of its own, so that several plots can share a page.
    static int clip = 0;
    const int id = ++clip;
    out += fmt::format(
        "<clipPath id=\"frame{}\"><rect x=\"{}\" y=\"{}\" width=\"{}\" "
        "height=\"{}\"/></clipPath>\n<g clip-path=\"url(#frame{})\">\n",
        id, left - 4, top - 4, width + 8, height + 8, id);
    for (const Curve& curve : curves)
    {
        std::vector<V2d> pixels;
        for (const V2d& p : curve.points) pixels.push_back(pixel(p));
        out += drawn(curve, pixels);
    }
    out += "</g>\n";
    out += fmt::format(
        "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" "
        "stroke=\"black\"/>\n",
        left, top, width, height);
    out += legend(curves, left + width + 16, top + 14);
    return svg_document(left + width + right, top + height + bottom, out);
}

std::string svg_lobes(const std::vector<LobePanel>& panels)
{
    constexpr double radius = 170, margin = 20, top = 34;
    double largest = 1e-12;
    bool lower = false;
    std::size_t most = 0;
    for (const LobePanel& panel : panels)
    {
        lower = lower || panel.lower;
        most = std::max(most, panel.curves.size());
        for (const Curve& curve : panel.curves)
            for (const V2d& p : curve.points) largest = std::max(largest, p.length());
    }
    const double height = lower ? 2 * radius : radius;
    std::string out;
    for (std::size_t i = 0; i < panels.size(); ++i)
    {
        const LobePanel& panel = panels[i];
        const V2d origin(margin + radius + static_cast<double>(i) * 2 * (radius + margin),
                         top + radius);
        const auto pixel = [&](const V2d& p) {
            return origin + V2d(p.x, -p.y) * (radius / largest);
        };
        out += svg_text(origin.x, top - 14, "middle", panel.title);
        out += svg_line(origin - V2d(radius, 0), origin + V2d(radius, 0), "stroke=\"#888888\"");
        if (panel.arrow.length() > 0)
        {
            const V2d from = origin + V2d(panel.arrow.x, -panel.arrow.y) * radius;
            out += svg_line(from, origin, "stroke=\"#888888\" stroke-dasharray=\"3 3\"");
        }
        for (const Curve& curve : panel.curves)
        {
            std::vector<V2d> pixels;
            for (const V2d& p : curve.points) pixels.push_back(pixel(p));
            out += drawn(curve, pixels);
        }
    }
    const double below = top + height + 24;
    if (!panels.empty()) out += legend(panels.front().curves, margin, below);
    return svg_document(static_cast<double>(panels.size()) * 2 * (radius + margin),
                        below + static_cast<double>(most) * line_height, out);
}

}  // namespace regain::tools::figures
