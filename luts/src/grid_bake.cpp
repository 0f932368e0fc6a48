// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "grid_bake.h"

#include <Imath/half.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

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

    std::ptrdiff_t plane() const { return static_cast<std::ptrdiff_t>(size[0] * size[1]); }
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

Size size_of(const Definition& d)
{
    return {std::size_t(d.width), std::size_t(d.height), std::size_t(d.depth),
            std::size_t(d.info.length_4), std::size_t(d.info.length_5)};
}

Size middles(const Size& size)
{
    return {size[0] - 1, size[1] - 1, size[2] - 1, size[3] - 1, cells(size[4])};
}

// Of a row, a plane of the nodes: each number, and 1 where its error is promised. One of middles is
// shorter.
std::ptrdiff_t row_length(const Size& size)
{
    return static_cast<std::ptrdiff_t>(2 * size[0] * size[1]);
}

void integrate(const Definition& d, const Size& size, const Lattice& lattice, double shift,
               std::size_t row, int accuracy, double* to)
{
    const Place p = lattice.place(row * lattice.size[0] * lattice.size[1]);
    const auto coordinate = [&](std::size_t i, std::size_t axis) {
        return (static_cast<double>(i) + shift) / static_cast<double>(cells(size[axis]));
    };
    std::vector<double> xs, ys;
    for (std::size_t i = 0; i < lattice.size[0]; ++i) xs.push_back(coordinate(i, 0));
    for (std::size_t i = 0; i < lattice.size[1]; ++i) ys.push_back(coordinate(i, 1));
    const Family::Plane plane = d.family.plane(xs, ys, coordinate(p[2], 2), coordinate(p[3], 3),
                                               coordinate(p[4], 4), accuracy);
    for (std::size_t i = 0; i < plane.values.size(); ++i)
    {
        *to++ = plane.values[i];
        *to++ = plane.promised[i] ? 1 : 0;
    }
}

class GridFit
{
public:
    GridFit(const Definition& definition, const std::vector<double>& integrals)
        : _definition(definition),
          _size(size_of(definition)),
          _nodes(_size),
          _middles(middles(_size))
    {
        auto row = integrals.begin();
        for (Lattice* lattice : {&_nodes, &_middles})
            for (std::size_t i = 0; i < lattice->values.size(); row += row_length(_size))
                for (std::ptrdiff_t n = 0; n < lattice->plane(); ++n, ++i)
                {
                    lattice->values[i] = row[2 * n];
                    lattice->promised[i] = row[2 * n + 1] > 0;
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

IntegralRows grid_rows(const Definition& d)
{
    const Size size = size_of(d);
    const auto nodes = std::make_shared<const Lattice>(size);
    const auto between = std::make_shared<const Lattice>(middles(size));
    IntegralRows rows;
    rows.name = d.info.distribution + " " + d.info.quantity;
    rows.count = nodes->rows() + between->rows();
    rows.across = size[2];
    rows.length = static_cast<std::size_t>(row_length(size));
    rows.integrate = [d, size, nodes, between](std::size_t row, double* to) {
        if (row < nodes->rows())
            integrate(d, size, *nodes, 0, row, d.node_accuracy, to);
        else
            integrate(d, size, *between, 0.5, row - nodes->rows(), d.check_accuracy, to);
    };
    return rows;
}

Table grid_table(const Definition& definition, const std::vector<double>& integrals)
{
    GridFit fit(definition, integrals);
    fit.level();
    fit.round();
    TableInfo info = definition.info;
    info.error = fit.largest_error();
    return Table(info, definition.width, definition.height,
                 definition.depth * info.length_4 * info.length_5, fit.numbers());
}

}  // namespace luts
REGAIN_NAMESPACE_END
