// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "sphere_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

REGAIN_NAMESPACE_BEGIN
namespace conformance {
namespace {

const double pi = std::acos(-1.0);

// Halving stops where double no longer tells directions apart by x = sin(theta / 2).
constexpr int deepest = 40;
constexpr double smallest = 0x1p-44;

// The Gauss-Legendre rule of 4 nodes on [0, 1] (Abramowitz and Stegun, Table 25.4).
constexpr std::array<double, 4> nodes{0.06943184420297371, 0.33000947820757187, 0.66999052179242813,
                                      0.93056815579702629};
constexpr std::array<double, 4> weights{0.17392742256872693, 0.32607257743127307,
                                        0.32607257743127307, 0.17392742256872693};

ChartPoint quarter_of(const ChartPoint& corner, double half, int quarter)
{
    return {corner.chart, corner.x + half * (quarter & 1), corner.y + half * (quarter >> 1)};
}

double largest_difference(const Density& a, const Density& b)
{
    double most = std::abs(a.pdf - b.pdf);
    for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(a.value[c] - b.value[c]));
    return most;
}

// A piece of a bin, with the integrals over its quarters and how far they are from one rule over
// the whole.
struct Piece
{
    std::size_t bin;
    ChartPoint corner;
    double size;
    std::array<Density, 4> quarters;
    double error;

    bool operator<(const Piece& other) const { return error < other.error; }
};

}  // namespace

Charts::Charts(const Direction& wo) : _azimuth(std::atan2(wo.y, wo.x)) {}

ChartPoint Charts::place_of(const Direction& w) const
{
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

SphereCells::SphereCells(const Direction& wo, const std::vector<Direction>& lobe, double share)
    : _charts(wo), _lobe_size(static_cast<double>(lobe.size()))
{
    std::vector<std::vector<ChartPoint>> points(8);
    for (const Direction& w : lobe)
    {
        const ChartPoint p = _charts.place_of(w);
        points[static_cast<std::size_t>(p.chart)].push_back(p);
    }
    for (int chart = 0; chart < 8; ++chart) _nodes.push_back({{chart, 0, 0}, 1});
    const auto most = std::max<std::size_t>(
        1, static_cast<std::size_t>(share * static_cast<double>(lobe.size())));
    for (std::size_t chart = 0; chart < 8; ++chart) grow(chart, std::move(points[chart]), most, 0);
}

void SphereCells::grow(std::size_t node, std::vector<ChartPoint> points, std::size_t most,
                       int depth)
{
    if (points.size() <= most || depth == deepest)
    {
        _nodes[node].bin = static_cast<int>(_bins.size());
        _bins.push_back({_nodes[node].corner, _nodes[node].size, {}, 0});
        _lobe.push_back(std::move(points));
        return;
    }
    const ChartPoint corner = _nodes[node].corner;
    const double half = 0.5 * _nodes[node].size;
    std::array<std::vector<ChartPoint>, 4> parts;
    for (const ChartPoint& p : points)
        parts[(p.x >= corner.x + half) + 2 * (p.y >= corner.y + half)].push_back(p);
    points = {};
    const auto first = _nodes.size();
    _nodes[node].children = static_cast<int>(first);
    for (int q = 0; q < 4; ++q) _nodes.push_back({quarter_of(corner, half, q), half});
    for (std::size_t q = 0; q < 4; ++q) grow(first + q, std::move(parts[q]), most, depth + 1);
}

std::size_t SphereCells::bin_of(const Direction& w) const
{
    const ChartPoint p = _charts.place_of(w);
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
    const auto over = [&](const ChartPoint& corner, double size) {
        Density sum;
        for (std::size_t i = 0; i < nodes.size(); ++i)
            for (std::size_t j = 0; j < nodes.size(); ++j)
            {
                const ChartPoint p{corner.chart, corner.x + size * nodes[i],
                                   corner.y + size * nodes[j]};
                sum.add(f(_charts.direction_of(p)), weights[i] * weights[j] * pi * p.x);
            }
        asked += nodes.size() * nodes.size();
        Density scaled;
        scaled.add(sum, size * size);
        return scaled;
    };
    // Of each bin, the lobe's directions where f has a density; found when first asked for.
    std::vector<std::optional<std::vector<ChartPoint>>> alive(_bins.size());
    const auto missed = [&](std::size_t bin, const ChartPoint& corner, double size) {
        if (!alive[bin])
        {
            alive[bin].emplace();
            for (const ChartPoint& p : _lobe[bin])
                if (f(_charts.direction_of(p)).pdf > 0) alive[bin]->push_back(p);
            asked += _lobe[bin].size();
        }
        const auto inside = [&](const ChartPoint& p) {
            return p.x >= corner.x && p.x < corner.x + size && p.y >= corner.y &&
                   p.y < corner.y + size;
        };
        return static_cast<double>(std::count_if(alive[bin]->begin(), alive[bin]->end(), inside)) /
               _lobe_size;
    };
    const auto piece = [&](std::size_t bin, const ChartPoint& corner, double size,
                           const Density& whole) {
        Piece p{bin, corner, size, {}, 0};
        Density sum;
        for (int q = 0; q < 4; ++q)
        {
            p.quarters[static_cast<std::size_t>(q)] =
                over(quarter_of(corner, 0.5 * size, q), 0.5 * size);
            sum.add(p.quarters[static_cast<std::size_t>(q)], 1);
        }
        p.error = largest_difference(sum, whole);
        if (sum.pdf == 0 && whole.pdf == 0) p.error += missed(bin, corner, size);
        return p;
    };

    std::vector<Piece> pieces;  // a heap, the worst first
    std::vector<Piece> done;
    double error = 0;
    for (std::size_t b = 0; b < _bins.size(); ++b)
    {
        pieces.push_back(
            piece(b, _bins[b].corner, _bins[b].size, over(_bins[b].corner, _bins[b].size)));
        error += pieces.back().error;
    }
    std::make_heap(pieces.begin(), pieces.end());
    while (!pieces.empty() && error > tolerance && asked < most)
    {
        std::pop_heap(pieces.begin(), pieces.end());
        const Piece p = pieces.back();
        pieces.pop_back();
        if (p.size < smallest)
        {
            done.push_back(p);
            continue;
        }
        error -= p.error;
        const double half = 0.5 * p.size;
        for (int q = 0; q < 4; ++q)
        {
            pieces.push_back(piece(p.bin, quarter_of(p.corner, half, q), half,
                                   p.quarters[static_cast<std::size_t>(q)]));
            error += pieces.back().error;
            std::push_heap(pieces.begin(), pieces.end());
        }
    }
    done.insert(done.end(), pieces.begin(), pieces.end());

    error = 0;
    for (Bin& bin : _bins) bin.integral = {}, bin.error = 0;
    for (const Piece& p : done)
    {
        for (const Density& quarter : p.quarters) _bins[p.bin].integral.add(quarter, 1);
        _bins[p.bin].error += p.error;
        error += p.error;
    }
    return error;
}

}  // namespace conformance
REGAIN_NAMESPACE_END
