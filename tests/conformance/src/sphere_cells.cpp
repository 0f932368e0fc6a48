// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "sphere_cells.h"

#include <algorithm>
#include <array>
#include <cmath>

REGAIN_NAMESPACE_BEGIN
namespace conformance {
namespace {

const double pi = std::acos(-1.0);

// Halving stops where double no longer tells directions apart by x = sin(theta / 2).
constexpr int deepest = 40;
// No part of the sphere is one bin, lobe or not.
constexpr int shallowest = 2;
constexpr double smallest = 0x1p-44;

// A rule of 4 nodes on [0, 1], exact for polynomials up to the fifth degree: all but Lobatto's
// (Abramowitz and Stegun, 25.4.32), whose outer nodes are the ends. A peak that begins shortly
// before the end of a cell, and is nothing up to there, is seen by them and by no inner ones; at
// the very end, lobes jump.
constexpr double to_end = 1e-4;
constexpr std::array<double, 4> nodes{to_end, 0.2764379504584964, 0.7235620495415036, 1 - to_end};
constexpr std::array<double, 4> weights{0.08341671668833976, 0.4165832833116602, 0.4165832833116602,
                                        0.08341671668833976};

// Where a peak is missed by the whole and by its halves alike, they agree by accident, along an
// edge in all its cells at once. A half of a piece is not believed to be better than this, and
// looked at again; of what is smooth it would be a 128th.
constexpr double believed = 1.0 / 16;

ChartPoint quarter_of(const ChartPoint& corner, double half, int quarter)
{
    return {corner.chart, corner.x + half * (quarter & 1), corner.y + half * (quarter >> 1)};
}

// A place over the edge of a chart, in the one that lies there: of the next quarter turn, or beyond
// the horizon.
ChartPoint wrapped(ChartPoint p)
{
    if (p.x > 1)
    {
        p.x = 2 - p.x;
        p.chart ^= 4;
    }
    const int turn = p.y < 0 ? -1 : p.y > 1 ? 1 : 0;
    p.y -= turn;
    p.chart = (p.chart & 4) | ((p.chart + turn) & 3);
    return p;
}

double largest_difference(const Density& a, const Density& b)
{
    double most = std::abs(a.pdf - b.pdf);
    for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(a.value[c] - b.value[c]));
    return most;
}

// How far two halves are from the whole.
double off(const std::array<Density, 2>& halves, const Density& whole)
{
    Density sum = halves[0];
    sum.add(halves[1], 1);
    return largest_difference(sum, whole);
}

// A part of a chart.
struct Cell
{
    ChartPoint corner;
    double width, height;

    Cell half(bool across_x, int which) const
    {
        Cell c = *this;
        (across_x ? c.width : c.height) *= 0.5;
        if (which == 1) (across_x ? c.corner.x : c.corner.y) += across_x ? c.width : c.height;
        return c;
    }
};

// Points that are not spread over a cell but gathered in a part of it, where a rule of few nodes
// may see nothing.
bool gathered(const std::vector<ChartPoint>& points, const Cell& cell)
{
    if (points.size() < 2) return false;
    std::array<double, 16> held{};
    const auto place = [](double x, double from, double size) {
        return static_cast<std::size_t>(std::clamp(4 * (x - from) / size, 0.0, 3.0));
    };
    for (const ChartPoint& p : points)
        ++held[4 * place(p.x, cell.corner.x, cell.width) + place(p.y, cell.corner.y, cell.height)];
    const auto n = static_cast<double>(points.size());
    const auto found = static_cast<double>(
        std::count_if(held.begin(), held.end(), [](double in_box) { return in_box > 0; }));
    // Of 16 boxes, points that fall anywhere leave this many empty.
    const double expected = 16 * (1 - std::pow(15.0 / 16, n));
    if (found < 0.6 * expected) return true;
    // Among others that fall anywhere.
    return *std::max_element(held.begin(), held.end()) > 8 + 0.25 * n;
}

// Across which they take less of the cell.
bool gathered_across_x(const std::vector<ChartPoint>& points, const Cell& cell)
{
    const auto by_x = [](const ChartPoint& a, const ChartPoint& b) { return a.x < b.x; };
    const auto by_y = [](const ChartPoint& a, const ChartPoint& b) { return a.y < b.y; };
    const auto x = std::minmax_element(points.begin(), points.end(), by_x);
    const auto y = std::minmax_element(points.begin(), points.end(), by_y);
    return (x.second->x - x.first->x) / cell.width <= (y.second->y - y.first->y) / cell.height;
}

std::array<std::vector<ChartPoint>, 4> quartered(const std::vector<ChartPoint>& points,
                                                 const ChartPoint& corner, double half)
{
    std::array<std::vector<ChartPoint>, 4> parts;
    for (const ChartPoint& p : points)
        parts[(p.x >= corner.x + half) + 2 * (p.y >= corner.y + half)].push_back(p);
    return parts;
}

}  // namespace

// A piece of a bin, with the integrals over its halves, across x or across y, whichever are further
// from one rule over the whole: along an edge, or a long lobe, cells then grow long, too.
struct SphereCells::Piece
{
    std::size_t bin;
    ChartPoint corner;
    double width, height;
    bool across_x;
    std::array<Density, 2> halves;
    double error;

    bool operator<(const Piece& other) const { return error < other.error; }
};

Charts::Charts(const Direction& wo) : _azimuth(std::atan2(wo.y, wo.x)) {}

ChartPoint Charts::place_of(const Direction& w) const
{
    // What is no direction is counted somewhere; other checks reject it.
    if (!std::isfinite(w.x) || !std::isfinite(w.y) || !std::isfinite(w.z)) return {};
    // 1 - |z| without cancellation at the pole.
    const double sine2 = w.x * w.x + w.y * w.y;
    ChartPoint p;
    p.x = std::min(1.0, std::sqrt(sine2 / (1 + std::abs(w.z))));
    double turns = (std::atan2(w.y, w.x) - _azimuth) / (2 * pi);
    turns -= std::floor(turns);
    const int quarter = std::min(3, static_cast<int>(4 * turns));
    p.y = std::clamp(4 * turns - quarter, 0.0, 1.0);
    p.chart = quarter + (w.z < 0 ? 4 : 0);
    return p;
}

Direction Charts::direction_of(const ChartPoint& p) const
{
    const double z = (1 - p.x) * (1 + p.x), sine = p.x * std::sqrt(1 + z);
    const double phi = _azimuth + 0.5 * pi * (p.chart % 4 + p.y);
    return {sine * std::cos(phi), sine * std::sin(phi), p.chart < 4 ? z : -z};
}

SphereCells::SphereCells(const Direction& wo, const std::vector<Direction>& lobe, double share,
                         Of of)
    : _charts(wo)
{
    std::vector<std::vector<ChartPoint>> points(8);
    for (const Direction& w : lobe)
    {
        const ChartPoint p = _charts.place_of(w);
        points[static_cast<std::size_t>(p.chart)].push_back(p);
    }
    for (int chart = 0; chart < 8; ++chart) _nodes.push_back({{chart, 0, 0}, 1});
    for (std::size_t side = 0; side < 8; side += 4)
    {
        std::size_t counted = lobe.size();
        if (of == Of::each_side)
            counted = points[side].size() + points[side + 1].size() + points[side + 2].size() +
                      points[side + 3].size();
        const auto most = std::max<std::size_t>(
            1, static_cast<std::size_t>(share * static_cast<double>(counted)));
        for (std::size_t chart = side; chart < side + 4; ++chart)
            grow(chart, std::move(points[chart]), most, 0);
    }
    look_beyond_borders();
}

// The flank of a lobe that ends in a corner of a large bin has few directions there, or none, and a
// rule of few nodes would not see it. So each direction counts as far behind each border, too.
void SphereCells::look_beyond_borders()
{
    std::vector<ChartPoint> mirrored;
    for (std::size_t b = 0; b < _bins.size(); ++b)
        for (const ChartPoint& p : _clues[b][drawn])
            for (int border = 0; border < 4; ++border)
            {
                const double far = border & 1 ? _bins[b].size : 0;
                ChartPoint q = p;
                if (border & 2)
                    q.x = 2 * (_bins[b].corner.x + far) - p.x;
                else
                    q.y = 2 * (_bins[b].corner.y + far) - p.y;
                if (q.x >= 0) mirrored.push_back(wrapped(q));
            }
    for (const ChartPoint& q : mirrored) _clues[bin_of(q)][drawn].push_back(q);
}

void SphereCells::look_at(const Direction& w)
{
    const ChartPoint p = _charts.place_of(w);
    _clues[bin_of(p)][looked_at].push_back(p);
}

void SphereCells::grow(std::size_t node, std::vector<ChartPoint> points, std::size_t most,
                       int depth)
{
    if (depth >= shallowest && (points.size() <= most || depth == deepest))
    {
        _nodes[node].bin = static_cast<int>(_bins.size());
        _bins.push_back({_nodes[node].corner, _nodes[node].size, points.size(), {}, 0});
        _clues.push_back({std::move(points), {}});
        return;
    }
    const ChartPoint corner = _nodes[node].corner;
    const double half = 0.5 * _nodes[node].size;
    std::array<std::vector<ChartPoint>, 4> parts = quartered(points, corner, half);
    points = {};
    const auto first = _nodes.size();
    _nodes[node].children = static_cast<int>(first);
    for (int q = 0; q < 4; ++q) _nodes.push_back({quarter_of(corner, half, q), half});
    for (std::size_t q = 0; q < 4; ++q) grow(first + q, std::move(parts[q]), most, depth + 1);
}

std::size_t SphereCells::bin_of(const Direction& w) const { return bin_of(_charts.place_of(w)); }

std::size_t SphereCells::bin_of(const ChartPoint& p) const
{
    std::size_t node = static_cast<std::size_t>(p.chart);
    while (_nodes[node].children >= 0)
    {
        const Node& n = _nodes[node];
        const double half = 0.5 * n.size;
        node = static_cast<std::size_t>(n.children + (p.x >= n.corner.x + half) +
                                        2 * (p.y >= n.corner.y + half));
    }
    return static_cast<std::size_t>(_nodes[node].bin);
}

double SphereCells::integrate(const std::function<Density(const Direction&)>& f, double tolerance,
                              std::size_t most)
{
    std::size_t asked = 0;
    const auto over = [&](const ChartPoint& corner, double width, double height) {
        Density sum;
        for (std::size_t i = 0; i < nodes.size(); ++i)
            for (std::size_t j = 0; j < nodes.size(); ++j)
            {
                const ChartPoint p{corner.chart, corner.x + width * nodes[i],
                                   corner.y + height * nodes[j]};
                sum.add(f(_charts.direction_of(p)), weights[i] * weights[j] * pi * p.x);
            }
        asked += nodes.size() * nodes.size();
        Density scaled;
        scaled.add(sum, width * height);
        return scaled;
    };
    const auto piece = [&](std::size_t bin, const ChartPoint& corner, double width, double height,
                           const Density& whole) {
        Piece p{bin, corner, width, height, true, {}, 0};
        std::array<Density, 2> others;
        for (int half = 0; half < 2; ++half)
        {
            const auto h = static_cast<std::size_t>(half);
            p.halves[h] =
                over({corner.chart, corner.x + 0.5 * width * half, corner.y}, 0.5 * width, height);
            others[h] =
                over({corner.chart, corner.x, corner.y + 0.5 * height * half}, width, 0.5 * height);
        }
        p.error = off(p.halves, whole);
        if (const double other = off(others, whole); other > p.error)
        {
            p.error = other;
            p.across_x = false;
            p.halves = others;
        }
        return p;
    };

    std::vector<Piece> pieces;  // a heap, the worst first
    std::vector<Piece> done;
    double error = 0;
    const std::function<void(std::size_t, const Cell&, const Clues&)> begin =
        [&](std::size_t bin, const Cell& cell, const Clues& clues) {
            const auto found = std::find_if(clues.begin(), clues.end(), [&](const auto& points) {
                return gathered(points, cell);
            });
            if (found == clues.end() || std::min(cell.width, cell.height) < smallest)
            {
                pieces.push_back(piece(bin, cell.corner, cell.width, cell.height,
                                       over(cell.corner, cell.width, cell.height)));
                error += pieces.back().error;
                return;
            }
            const bool across_x = gathered_across_x(*found, cell);
            const Cell low = cell.half(across_x, 0), high = cell.half(across_x, 1);
            std::array<Clues, 2> parts;
            for (std::size_t clue = 0; clue < clues.size(); ++clue)
                for (const ChartPoint& p : clues[clue])
                    parts[across_x ? p.x >= high.corner.x : p.y >= high.corner.y][clue].push_back(
                        p);
            begin(bin, low, parts[0]);
            begin(bin, high, parts[1]);
        };
    for (std::size_t b = 0; b < _bins.size(); ++b)
        begin(b, {_bins[b].corner, _bins[b].size, _bins[b].size}, _clues[b]);
    std::make_heap(pieces.begin(), pieces.end());
    while (!pieces.empty() && error > tolerance && asked < most)
    {
        std::pop_heap(pieces.begin(), pieces.end());
        const Piece p = pieces.back();
        pieces.pop_back();
        const double width = p.across_x ? 0.5 * p.width : p.width;
        const double height = p.across_x ? p.height : 0.5 * p.height;
        if (std::min(width, height) < smallest)
        {
            done.push_back(p);
            continue;
        }
        error -= p.error;
        for (int half = 0; half < 2; ++half)
        {
            const ChartPoint corner{p.corner.chart, p.corner.x + (p.across_x ? width * half : 0),
                                    p.corner.y + (p.across_x ? 0 : height * half)};
            pieces.push_back(
                piece(p.bin, corner, width, height, p.halves[static_cast<std::size_t>(half)]));
            pieces.back().error = std::max(pieces.back().error, believed * p.error);
            error += pieces.back().error;
            std::push_heap(pieces.begin(), pieces.end());
        }
    }
    done.insert(done.end(), pieces.begin(), pieces.end());

    error = 0;
    for (Bin& bin : _bins) bin.integral = {}, bin.error = 0;
    for (const Piece& p : done)
    {
        for (const Density& half : p.halves) _bins[p.bin].integral.add(half, 1);
        _bins[p.bin].error += p.error;
        error += p.error;
    }
    return error;
}

}  // namespace conformance
REGAIN_NAMESPACE_END
