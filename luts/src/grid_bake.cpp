// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "grid_bake.h"

#include "parallel.h"

#include <Imath/half.h>

#include <algorithm>
#include <array>
#include <cmath>

REGAIN_NAMESPACE_BEGIN
namespace luts {
namespace {

constexpr std::size_t axes = 5, corners = 1 << axes;
using Size = std::array<std::size_t, axes>;
using Place = std::array<std::size_t, axes>;

// Along an axis of one node there is one cell, in which all is the same.
std::size_t cells(std::size_t nodes) { return nodes > 1 ? nodes - 1 : 1; }

std::size_t count(const Size& size)
{
    std::size_t n = 1;
    for (const std::size_t length : size) n *= length;
    return n;
}

// The nodes of a table, or the middles of its cells, one fewer along each axis; what is integrated
// there, and whether its error is promised.
struct Lattice
{
    Size size;
    std::vector<double> values;
    std::vector<bool> promised;

    explicit Lattice(const Size& s) : size(s), values(count(s)), promised(count(s)) {}

    std::size_t rows() const { return values.size() / (size[0] * size[1]); }
    Place place(std::size_t i) const
    {
        Place p;
        for (std::size_t a = 0; a < axes; ++a)
        {
            p[a] = i % size[a];
            i /= size[a];
        }
        return p;
    }
};

class GridFit
{
public:
    GridFit(const Definition& definition, const BakeProgress& progress)
        : _definition(definition),
          _size{std::size_t(definition.width), std::size_t(definition.height),
                std::size_t(definition.depth), std::size_t(definition.info.length_4),
                std::size_t(definition.info.length_5)},
          _nodes(_size),
          _middles({_size[0] - 1, _size[1] - 1, _size[2] - 1, _size[3] - 1, cells(_size[4])})
    {
        // Words of packed bools are shared by rows.
        std::vector<std::vector<bool>> promised(_nodes.rows() + _middles.rows());
        parallel_for(promised.size(), progress, [&](std::size_t row) {
            const bool nodes = row < _nodes.rows();
            promised[row] = integrate(
                nodes ? _nodes : _middles, nodes ? 0 : 0.5, nodes ? row : row - _nodes.rows(),
                nodes ? _definition.node_accuracy : _definition.check_accuracy);
        });
        std::size_t row = 0;
        for (Lattice* lattice : {&_nodes, &_middles})
        {
            auto to = lattice->promised.begin();
            for (std::size_t i = 0; i < lattice->rows(); ++i, ++row)
                to = std::copy(promised[row].begin(), promised[row].end(), to);
        }
        _numbers = _nodes.values;
        for (std::size_t corner = 0; corner < corners; ++corner)
        {
            std::size_t stride = 1;
            for (std::size_t a = 0; a < axes; stride *= _size[a++])
                if ((corner >> a & 1) && _size[a] > 1) _offset[corner] += stride;
        }
    }

    // As Fit::level does for three axes. Nodes of equal widths are 0, and stay it; those beyond
    // what is promised stay what they are, with no error of their own to be weighed.
    void level()
    {
        for (int round = 0; round < 100; ++round)
        {
            std::vector<double> above(_numbers.size(), -1), below(_numbers.size(), 1);
            const auto see = [&](std::size_t node, double error) {
                above[node] = std::max(above[node], error);
                below[node] = std::min(below[node], error);
            };
            for_each_error([&](std::size_t node, double error, bool middle) {
                for (std::size_t corner = 0; corner < (middle ? corners : 1); ++corner)
                    see(node + _offset[corner], error);
            });
            for (std::size_t n = 0; n < _numbers.size(); ++n)
                if (_nodes.promised[n] && _nodes.place(n)[3] > 0)
                    _numbers[n] -= 0.2 * (above[n] + below[n]);
        }
    }

    // To what look-ups find and a small file holds.
    void round()
    {
        const TableInfo& info = _definition.info;
        for (double& n : _numbers)
        {
            n = info.offset +
                info.scale * std::clamp(std::round((n - info.offset) / info.scale), 0.0, 65535.0);
            n = static_cast<double>(Imath::half(static_cast<float>(n)));
        }
    }

    double largest_error() const
    {
        double largest = 0;
        for_each_error(
            [&](std::size_t, double error, bool) { largest = std::max(largest, std::abs(error)); });
        return largest;
    }

    std::vector<float> numbers() const { return {_numbers.begin(), _numbers.end()}; }

private:
    std::vector<bool> integrate(Lattice& lattice, double shift, std::size_t row, int accuracy)
    {
        const std::size_t first = row * lattice.size[0] * lattice.size[1];
        const Place p = lattice.place(first);
        const auto coordinate = [&](std::size_t i, std::size_t axis) {
            return (static_cast<double>(i) + shift) / static_cast<double>(cells(_size[axis]));
        };
        std::vector<double> xs, ys;
        for (std::size_t i = 0; i < lattice.size[0]; ++i) xs.push_back(coordinate(i, 0));
        for (std::size_t i = 0; i < lattice.size[1]; ++i) ys.push_back(coordinate(i, 1));
        const Family::Plane plane = _definition.family.plane(
            xs, ys, coordinate(p[2], 2), coordinate(p[3], 3), coordinate(p[4], 4), accuracy);
        std::copy(plane.values.begin(), plane.values.end(),
                  lattice.values.begin() + static_cast<std::ptrdiff_t>(first));
        return plane.promised;
    }

    // visit(lowest node, relative error, is the middle of a cell) wherever errors are promised.
    template <class Visit>
    void for_each_error(const Visit& visit) const
    {
        for (std::size_t n = 0; n < _numbers.size(); ++n)
            if (_nodes.promised[n]) visit(n, std::expm1(_numbers[n] - _nodes.values[n]), false);
        for (std::size_t n = 0; n < _middles.values.size(); ++n)
        {
            if (!_middles.promised[n]) continue;
            const Place p = _middles.place(n);
            std::size_t node = 0;
            for (std::size_t a = axes; a-- > 0;) node = node * _size[a] + p[a];
            double mean = 0;
            for (const std::size_t offset : _offset) mean += _numbers[node + offset] / corners;
            visit(node, std::expm1(mean - _middles.values[n]), true);
        }
    }

    const Definition& _definition;
    Size _size;
    Lattice _nodes, _middles;
    std::vector<double> _numbers;
    std::array<std::size_t, corners> _offset{};
};

}  // namespace

Table bake_grid(const Definition& definition, const BakeProgress& progress)
{
    GridFit fit(definition, progress);
    fit.level();
    fit.round();
    TableInfo info = definition.info;
    info.error = fit.largest_error();
    return Table(info, definition.width, definition.height,
                 definition.depth * info.length_4 * info.length_5, fit.numbers());
}

}  // namespace luts
REGAIN_NAMESPACE_END
