// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "pareto_plot.h"

#include "../figures/html.h"
#include "../figures/svg_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace regain::tools::cost {
namespace {

using figures::svg_line;
using figures::svg_text;
using Imath::V2d;

constexpr double width = 330, height = 320, left = 64, top = 58, between = 22, bottom = 54;
constexpr double letter = 5.9, line_height = 12;  // of labels, generous

struct Range
{
    double low, high;
    double at(double value) const
    {
        return (std::log(value) - std::log(low)) / (std::log(high) - std::log(low));
    }
};

struct Box
{
    double x0, y0, x1, y1;
    bool meets(const Box& b) const { return x0 < b.x1 && b.x0 < x1 && y0 < b.y1 && b.y0 < y1; }
    double overlap(const Box& b) const
    {
        return std::max(0.0, std::min(x1, b.x1) - std::max(x0, b.x0)) *
               std::max(0.0, std::min(y1, b.y1) - std::max(y0, b.y0));
    }
};

Box box_of(const V2d& p, double r) { return {p.x - r, p.y - r, p.x + r, p.y + r}; }

std::vector<double> ticks(const Range& range, const std::vector<double>& steps)
{
    std::vector<double> all;
    for (int power = -9; power <= 9; ++power)
        for (const double step : steps)
        {
            const double t = step * std::pow(10.0, power);
            if (t >= range.low * 0.999 && t <= range.high * 1.001) all.push_back(t);
        }
    return all;
}

// Places labels about their dots, nearest first, so that none covers another, a dot or the frame;
// where there is no such place, where it covers least.
class Labels
{
public:
    Labels(const Box& frame, const std::vector<V2d>& dots) : _frame(frame)
    {
        for (const V2d& d : dots) _taken.push_back(box_of(d, 4));
    }

    void keep_off(const Box& box) { _taken.push_back(box); }

    std::string place(const V2d& dot, const std::string& words)
    {
        const double w = letter * static_cast<double>(words.size()), h = line_height;
        Box best{0, 0, 0, 0};
        double least = std::numeric_limits<double>::infinity();
        for (double radius = 7; radius < 150 && least > 0; radius += 6)
            for (int k = 0; k < 16 && least > 0; ++k)
            {
                const double angle = k * std::acos(-1.0) / 8;
                const V2d c = dot + V2d(std::cos(angle), std::sin(angle)) * radius;
                // The side of the box that is turned to the dot is at c.
                const double x0 = c.x - w * (1 - std::cos(angle)) / 2,
                             y0 = c.y - h * (1 - std::sin(angle)) / 2;
                const Box box{x0, y0, x0 + w, y0 + h};
                const double cost = covered(box);
                if (cost < least)
                {
                    least = cost;
                    best = box;
                }
            }
        _taken.push_back(best);
        std::string out;
        const V2d near(std::clamp(dot.x, best.x0, best.x1), std::clamp(dot.y, best.y0, best.y1));
        if ((near - dot).length() > 10)
            out += svg_line(dot, near, "stroke=\"#999999\" stroke-width=\"0.7\"");
        return out + svg_text((best.x0 + best.x1) / 2, best.y1 - 2.5, "middle", words);
    }

private:
    double covered(const Box& box) const
    {
        double sum =
            box.x0 < _frame.x0 || box.x1 > _frame.x1 || box.y0 < _frame.y0 || box.y1 > _frame.y1
                ? 1e4
                : 0;
        for (const Box& other : _taken) sum += box.overlap(other);
        return sum;
    }

    Box _frame;
    std::vector<Box> _taken;
};

std::string panel(const Front& f, const Range& x, const Range& y, double origin, bool labelled)
{
    const auto pixel = [&](const Point& p) {
        return V2d(origin + width * x.at(p.time), top + height * (1 - y.at(p.error)));
    };
    std::string out = svg_text(origin + width / 2, top - 10, "middle", std::string(f.band.words));
    for (const double t : ticks(x, {1, 1.2, 1.5, 2, 3, 5}))
    {
        const double at = origin + width * x.at(t);
        out += svg_line({at, top}, {at, top + height}, "stroke=\"#e3e3e3\"");
        out += svg_text(at, top + height + 16, "middle", fmt::format("{:.3g}", t));
    }
    for (const double t : ticks(y, {1, 3}))
    {
        const double at = top + height * (1 - y.at(t));
        out += svg_line({origin, at}, {origin + width, at}, "stroke=\"#e3e3e3\"");
        if (labelled) out += svg_text(origin - 6, at + 4, "end", fmt::format("{:.3g}", t));
    }
    // What is below cannot be told from nothing.
    const double floor = top + height * (1 - y.at(f.floor));
    out += svg_line({origin, floor}, {origin + width, floor},
                    "stroke=\"#aaaaaa\" stroke-dasharray=\"3 3\"");
    out += fmt::format(
        "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" "
        "stroke=\"black\"/>\n",
        origin, top, width, height);

    std::vector<V2d> dots;
    for (const Point& p : f.points) dots.push_back(pixel(p));
    // A stair: what takes no longer than a step's foot is as far off as its tread.
    out +=
        "<polyline class=\"front\" fill=\"none\" stroke=\"#b3261e\" stroke-width=\"1.5\" "
        "points=\"";
    for (std::size_t i = 0; i < f.front.size(); ++i)
    {
        const V2d p = dots[f.front[i]];
        if (i > 0) out += fmt::format("{:.1f},{:.1f} ", p.x, dots[f.front[i - 1]].y);
        out += fmt::format("{:.1f},{:.1f} ", p.x, p.y);
    }
    out += "\"/>\n";
    Labels labels({origin, top, origin + width, top + height}, dots);
    labels.keep_off({origin, floor - 1, origin + width, floor + 1});
    for (std::size_t i = 1; i < f.front.size(); ++i)
    {
        const V2d a = dots[f.front[i - 1]], b = dots[f.front[i]];
        labels.keep_off({a.x, a.y - 1.5, b.x, a.y + 1.5});
        labels.keep_off({b.x - 1.5, a.y, b.x + 1.5, b.y});
    }
    std::vector<std::size_t> order = f.front;
    for (std::size_t i = 0; i < dots.size(); ++i)
        if (std::find(f.front.begin(), f.front.end(), i) == f.front.end()) order.push_back(i);
    std::string words;
    for (std::size_t n = 0; n < order.size(); ++n)
    {
        const bool on = n < f.front.size();
        const std::size_t i = order[n];
        out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\"/>\n",
                           dots[i].x, dots[i].y, on ? "#b3261e" : "#777777");
        words += fmt::format("<g fill=\"{}\">{}</g>\n", on ? "#b3261e" : "#444444",
                             labels.place(dots[i], f.points[i].method));
    }
    return out + "<g font-size=\"11\">" + words + "</g>\n";
}

}  // namespace

std::string pareto_plot(const std::string& title, const std::vector<Front>& fronts)
{
    Range x{1, 1}, y{1, 1};
    bool first = true;
    for (const Front& f : fronts)
        for (const Point& p : f.points)
        {
            if (first) x = {p.time, p.time}, y = {p.error, p.error};
            first = false;
            x = {std::min(x.low, p.time), std::max(x.high, p.time)};
            y = {std::min({y.low, p.error, f.floor}), std::max(y.high, p.error)};
        }
    // Room for the dots at the ends and their names.
    x = {x.low / 1.12, std::max(x.high * 1.25, x.low * 1.5)};
    y = {y.low / 2, y.high * 1.6};

    std::string body;
    double origin = left;
    for (std::size_t i = 0; i < fronts.size(); ++i, origin += width + between)
        body += panel(fronts[i], x, y, origin, i == 0);
    const double right = origin - between + 16;
    body +=
        fmt::format("<g font-weight=\"bold\">{}</g>\n", svg_text(right / 2, 22, "middle", title));
    body += svg_text((left + right) / 2, top + height + 40, "middle",
                     "time of an eval and a sample, over that without compensation");
    body +=
        fmt::format("<g transform=\"translate(16 {:.0f}) rotate(-90)\">{}</g>\n", top + height / 2,
                    svg_text(0, 0, "middle", "largest error of the directional albedo"));
    return figures::svg_document(right, top + height + bottom, body);
}

}  // namespace regain::tools::cost
