// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "lattice_bake.h"

#include <Imath/half.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <mutex>
#include <optional>

REGAIN_NAMESPACE_BEGIN
namespace luts {
namespace {

std::size_t index(int i) { return static_cast<std::size_t>(i); }

// A lattice with `between` intervals in every cell of a table, nodes included, and what a family's
// integrals are there: what the tables of the family, and their errors, are made of.
struct Lattice
{
    int between, width, height, depth;
    std::vector<Family::Values> values;  // x fastest

    std::size_t at(int i, int j, int k) const { return index((k * height + j) * width + i); }
    bool is_node(int i, int j, int k) const
    {
        return i % between == 0 && j % between == 0 && k % between == 0;
    }
    // Of three axes the middles of the cells, where most axes err, have to do.
    bool is_used(int i, int j, int k) const
    {
        return depth == 1 || is_node(i, j, k) || (i % 2 && j % 2 && k % 2);
    }
};

double coordinate(int i, int length) { return length > 1 ? i / (length - 1.0) : 0; }
int points(int nodes, int between) { return nodes > 1 ? (nodes - 1) * between + 1 : 1; }

// One without values.
Lattice lattice_of(const Definition& d)
{
    Lattice l;
    // One axis is quick; with two, six checks along a cell see all there is; with three, the
    // middles have to do.
    const bool halves = d.depth > 1 || d.family.kind == Family::Kind::later ||
                        (d.height > 1 && d.family.kind == Family::Kind::average) ||
                        d.family.kind == Family::Kind::shape;
    l.between = halves ? 2 : d.height > 1 ? 6 : 32;
    l.width = points(d.width, l.between);
    l.height = points(d.height, l.between);
    l.depth = points(d.depth, l.between);
    return l;
}

// Laws of dielectrics serve all indices, and may take as long to make as a point to integrate: each
// is made by the first row that needs it.
class Laws
{
public:
    explicit Laws(const Definition& d)
        : _family(d.family),
          _height(lattice_of(d).height),
          _made(index(_height)),
          _laws(index(_height))
    {}

    const SlopeLaw& at(int j)
    {
        std::call_once(_made[index(j)],
                       [&] { _laws[index(j)] = _family.law(coordinate(j, _height), 0); });
        return *_laws[index(j)];
    }

private:
    Family _family;
    int _height;
    std::vector<std::once_flag> _made;
    std::vector<std::optional<SlopeLaw>> _laws;
};

void integrate(const Definition& d, const Lattice& l, Laws* laws, int j, int k,
               Family::Values* values)
{
    // Nodes and the points between them are integrated to their own accuracy.
    for (const bool nodes : {true, false})
    {
        std::vector<double> x;
        std::vector<int> places;
        for (int i = 0; i < l.width; ++i)
            if (l.is_used(i, j, k) && l.is_node(i, j, k) == nodes)
            {
                x.push_back(coordinate(i, l.width));
                places.push_back(i);
            }
        if (x.empty()) continue;
        const double y = coordinate(j, l.height), z = coordinate(k, l.depth);
        const int accuracy = nodes ? d.node_accuracy : d.check_accuracy;
        const std::vector<Family::Values> found =
            laws ? d.family.row(laws->at(j), x, y, z, accuracy) : d.family.row(x, y, z, accuracy);
        for (std::size_t i = 0; i < x.size(); ++i) values[index(places[i])] = found[i];
    }
}

class Fit
{
public:
    Fit(const Definition& definition, const Lattice& lattice)
        : _definition(definition),
          _lattice(lattice),
          _logarithmic(definition.info.transform == "ln")
    {
        const int n = lattice.between;
        for (int k = 0; k < definition.depth; ++k)
            for (int j = 0; j < definition.height; ++j)
                for (int i = 0; i < definition.width; ++i)
                    // Quadrature may end a little above 1.
                    _nodes.push_back(std::clamp(exact(i * n, j * n, k * n), definition.lowest,
                                                definition.highest));
        for (int k = 0; k < lattice.depth; ++k)
            for (int j = 0; j < lattice.height; ++j)
                for (int i = 0; i < lattice.width; ++i)
                    if (lattice.is_used(i, j, k) && counts(i, j, k, levelled_beyond))
                        _checks.push_back(check(i, j, k));
    }

    // Moves each node by half of what its neighbourhood errs on the mean of both sides, until
    // nothing moves.
    void level()
    {
        // In the middle of a cell all its nodes are near.
        const double nearby = _definition.depth > 1 ? 0.12 : 0.2;
        for (int round = 0; round < 200; ++round)
        {
            std::vector<double> above(_nodes.size(), -1), below(_nodes.size(), 1);
            for (const Check& c : _checks)
            {
                const double e = error(c);
                for (std::size_t corner = 0; corner < 8; ++corner)
                {
                    if (c.weight[corner] <= nearby) continue;
                    const std::size_t n = c.node + _offset[corner];
                    above[n] = std::max(above[n], e);
                    below[n] = std::min(below[n], e);
                }
            }
            for (std::size_t n = 0; n < _nodes.size(); ++n)
            {
                if (above[n] < below[n]) continue;  // no point that counts is near
                const double step = 0.2 * (above[n] + below[n]);
                _nodes[n] = std::clamp(_logarithmic ? _nodes[n] - step : _nodes[n] * (1 - step),
                                       _definition.lowest, _definition.highest);
            }
        }
    }

    // To what the file holds.
    void round_to_half()
    {
        for (double& n : _nodes) n = static_cast<double>(Imath::half(static_cast<float>(n)));
    }

    // To what look-ups find.
    void round_to_stored()
    {
        const TableInfo& info = _definition.info;
        for (double& n : _nodes)
            n = info.offset +
                info.scale * std::clamp(std::round((n - info.offset) / info.scale), 0.0, 65535.0);
    }

    double largest_error() const
    {
        double largest = 0;
        for (const Check& c : _checks)
            if (c.promised) largest = std::max(largest, std::abs(error(c)));
        return largest;
    }

    std::vector<float> nodes() const { return {_nodes.begin(), _nodes.end()}; }

private:
    // Nodes of dielectrics are levelled a little beyond what is promised, lest those at its bounds
    // follow points on one side alone.
    static constexpr double levelled_beyond = 0.4;

    // A point of the lattice, with the exact value there and the weights of the nodes about it.
    struct Check
    {
        std::size_t node;  // the one below on every axis
        double weight[8];
        double exact;
        bool promised;
    };

    double exact(int i, int j, int k) const
    {
        return _definition.value(_lattice.values[_lattice.at(i, j, k)]);
    }

    // Whether the error matters at a point, the bounds of what is promised times `share`.
    bool counts(int i, int j, int k, double share) const
    {
        const Family& family = _definition.family;
        return family.promised(coordinate(i, _lattice.width), coordinate(j, _lattice.height),
                               coordinate(k, _lattice.depth), share) &&
               !(_definition.fitted &&
                 quantity(exact(i, j, k)) < share * _definition.smallest_promised);
    }

    double quantity(double value) const { return _logarithmic ? std::exp(value) : value; }

    Check check(int i, int j, int k)
    {
        const int n = _lattice.between, place[] = {i, j, k};
        const int length[] = {_definition.width, _definition.height, _definition.depth};
        int low[3];
        double fraction[3];
        for (int axis = 0; axis < 3; ++axis)
        {
            low[axis] = std::max(0, std::min(place[axis] / n, length[axis] - 2));
            fraction[axis] =
                length[axis] > 1 ? static_cast<double>(place[axis]) / n - low[axis] : 0;
        }
        Check c;
        c.node = index((low[2] * length[1] + low[1]) * length[0] + low[0]);
        c.exact = exact(i, j, k);
        c.promised = counts(i, j, k, 1);
        for (int corner = 0; corner < 8; ++corner)
        {
            double weight = 1;
            int offset = 0;
            for (int axis = 2; axis >= 0; --axis)
            {
                const bool high = corner >> axis & 1;
                weight *= high ? fraction[axis] : 1 - fraction[axis];
                offset = offset * length[axis] + (high && length[axis] > 1);
            }
            c.weight[corner] = weight;
            _offset[corner] = index(offset);
        }
        return c;
    }

    double error(const Check& c) const
    {
        double value = 0;
        for (std::size_t corner = 0; corner < 8; ++corner)
            if (c.weight[corner] > 0) value += c.weight[corner] * _nodes[c.node + _offset[corner]];
        if (_logarithmic) return std::expm1(std::min(value, 0.0) - c.exact);
        return _definition.fitted ? std::min(value, _definition.greatest) / c.exact - 1
                                  : value - c.exact;
    }

    const Definition& _definition;
    const Lattice& _lattice;
    bool _logarithmic;
    std::vector<double> _nodes;
    std::vector<Check> _checks;
    std::size_t _offset[8] = {};
};

}  // namespace

IntegralRows lattice_rows(const Definition& d)
{
    const Lattice l = lattice_of(d);
    std::shared_ptr<Laws> laws;
    if (d.family.kind == Family::Kind::dielectric) laws = std::make_shared<Laws>(d);
    IntegralRows rows;
    const Family& f = d.family;
    char gamma[32];
    std::snprintf(gamma, sizeof gamma, "%a", f.gamma);
    rows.name = f.distribution + " " + gamma + " " + std::to_string(static_cast<int>(f.kind)) +
                (f.inside ? " inside" : "") + (f.near_index ? " near" : "") + " " +
                std::to_string(d.width) + " " + std::to_string(d.height) + " " +
                std::to_string(d.depth);
    rows.count = index(l.height * l.depth);
    rows.across = index(l.height);
    rows.length = index(l.width) * std::tuple_size_v<Family::Values>;
    rows.integrate = [d, l, laws](std::size_t n, double* to) {
        const int row = static_cast<int>(n), j = row % l.height, k = row / l.height;
        std::vector<Family::Values> values(index(l.width));
        integrate(d, l, laws.get(), j, k, values.data());
        for (const Family::Values& v : values) to = std::copy(v.begin(), v.end(), to);
    };
    return rows;
}

Table lattice_table(const Definition& d, const std::vector<double>& integrals)
{
    Lattice lattice = lattice_of(d);
    lattice.values.resize(index(lattice.width * lattice.height * lattice.depth));
    auto from = integrals.begin();
    for (Family::Values& v : lattice.values)
        for (double& number : v) number = *from++;
    Fit fit(d, lattice);
    if (d.fitted) fit.level();

    if (d.rounding == Definition::Rounding::half) fit.round_to_half();
    if (d.rounding == Definition::Rounding::stored) fit.round_to_stored();
    TableInfo info = d.info;
    std::vector<float> nodes = fit.nodes();
    fit.round_to_stored();
    info.error = fit.largest_error();
    return Table(info, d.width, d.height, d.depth, std::move(nodes));
}

}  // namespace luts
REGAIN_NAMESPACE_END
