// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Cells of the sphere of directions, small where a lobe is narrow: the bins of a histogram, and
/// the pieces of an integral.
///
/// The sphere is eight charts: four quarter turns, from the azimuth of wo on, of either hemisphere.
/// In a chart (x, y) in [0, 1]^2 a direction has
///     |z| = 1 - x^2,   phi = azimuth + pi / 2 (quarter + y),   dw = pi x dx dy
/// so the horizon, the pole and the plane of incidence are edges. Cells halve both coordinates.

#pragma once

#include <regain/conformance/tested_closure.h>

#include <array>
#include <functional>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace conformance {

/// A place on the sphere in the coordinates above.
struct ChartPoint
{
    int chart = 0;  ///< quarter + 4 below the horizon
    double x = 0, y = 0;
};

class Charts
{
public:
    explicit Charts(const Direction& wo);
    ChartPoint place_of(const Direction& w) const;
    Direction direction_of(const ChartPoint& p) const;

private:
    double _azimuth;
};

/// What is integrated: a density and a value, at one direction.
struct Density
{
    double pdf = 0;
    Color value{0.0};
    double unsure = 0;  ///< of pdf; no cell halves for it

    void add(const Density& other, double weight)
    {
        pdf += other.pdf * weight;
        unsure += other.unsure * weight;
        value += other.value * weight;
    }
};

/// A histogram's bin, and the integrals over it.
struct Bin
{
    ChartPoint corner;      ///< lowest
    double size = 1;        ///< of its sides
    std::size_t drawn = 0;  ///< of the lobe's directions
    Density integral;
    double error = 0;  ///< estimated, of integral.pdf and of the largest channel
};

class SphereCells
{
public:
    enum class Of { all, each_side };
    /// Bins that hold no more than a `share` of the lobe's directions each, of all or of those on
    /// the same side of the horizon, as far as halving goes; 128 at least.
    SphereCells(const Direction& wo, const std::vector<Direction>& lobe, double share,
                Of of = Of::all);

    /// Makes integrals look closely at w, too, wherever samples go. It changes no bin.
    void look_at(const Direction& w);

    /// Integrates over every bin, halving where it pays, until the estimated errors add up to less
    /// than `tolerance` or f was asked `most` times. Returns the sum of the errors.
    double integrate(const std::function<Density(const Direction&)>& f, double tolerance,
                     std::size_t most);

    const Charts& charts() const { return _charts; }
    const std::vector<Bin>& bins() const { return _bins; }
    std::size_t bin_of(const Direction& w) const;

private:
    struct Node
    {
        ChartPoint corner;
        double size;
        int children = -1;  // the first of four, or none
        int bin = -1;
    };

    struct Piece;

    // Where to look closely: at the lobe's directions and their images beyond borders, and at what
    // look_at was told. Apart, since a few narrow ones would not be noticed among many others.
    enum Clue { drawn, looked_at };
    using Clues = std::array<std::vector<ChartPoint>, 2>;

    void grow(std::size_t node, std::vector<ChartPoint> points, std::size_t most, int depth);
    void look_beyond_borders();
    std::size_t bin_of(const ChartPoint& p) const;

    Charts _charts;
    std::vector<Node> _nodes;  // the charts first
    std::vector<Bin> _bins;
    std::vector<Clues> _clues;  // of each bin
};

}  // namespace conformance
REGAIN_NAMESPACE_END
