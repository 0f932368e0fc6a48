// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/closures/fresnel_moments.h>
#include <regain/luts/albedo_integral.h>
#include <regain/luts/bake.h>

#include <algorithm>
#include <cmath>

REGAIN_NAMESPACE_BEGIN
namespace luts {
namespace {

constexpr int table_nodes = 32;
constexpr int node_accuracy = 64;   // quadrature nodes for the values at the nodes
constexpr int check_accuracy = 24;  // for the many points between them; good to 1e-6

// Row 0 is the limit of vanishing alpha at fixed x, which alpha 0 itself does not have.
constexpr double smallest_alpha = 1e-6;

// The point (mu, alpha) of coordinates (x, y); the inverse of stretched_cosine.
struct Angle
{
    Angle(double x, double y) : alpha(std::max(y * y, smallest_alpha))
    {
        const double r = x * x;
        mu = r * alpha / (1 - r + r * alpha);
    }
    double mu, alpha;
};

double E_ss(double x, double y, int nodes)
{
    const Angle at(x, y);
    return at.mu > 0 ? ggx_albedo(at.mu, at.alpha, {}, {nodes}) : 1.0;
}

double E_avg(double y, double, int nodes)
{
    return ggx_average_albedo(std::max(y * y, smallest_alpha), {nodes});
}

// The mean of a curve over what is scattered once, less its value at mu.
double shift_of_mean(double (*curve)(double), double x, double y, int nodes)
{
    // At mu = 0 there is nothing left to take a mean of; next to it the limit can be read off.
    const Angle at(std::max(x, 1e-3), y);
    return ggx_albedo(at.mu, at.alpha, curve, {nodes}) / ggx_albedo(at.mu, at.alpha, {}, {nodes}) -
           curve(at.mu);
}

double falloff(double x, double y, int nodes)
{
    return shift_of_mean([](double mu) { return FresnelMoments<double>::at(mu).falloff; }, x, y,
                         nodes);
}

double dip(double x, double y, int nodes)
{
    return shift_of_mean([](double mu) { return FresnelMoments<double>::at(mu).dip; }, x, y, nodes);
}

struct Definition
{
    const char* quantity;
    int height;              // number of nodes along y; 1 for one axis
    bool fitted;             // levelled for the relative error; otherwise exact at the nodes
    double lowest, highest;  // that a node can be: the range of the 16-bit form
    double (*exact)(double x, double y, int nodes);

    std::string name() const { return std::string("ggx_") + quantity; }
    TableInfo info() const;
};

// A levelled node of E_ss may lie a little above 1.
const Definition definitions[] = {
    {"E_ss", table_nodes, true, 0, 65535.0 / 65000, E_ss},
    {"E_avg", 1, true, 0, 1, E_avg},
    {"falloff", table_nodes, false, -1, 0.25, falloff},
    {"dip", table_nodes, false, -0.06, 0.06, dip},
};

TableInfo Definition::info() const
{
    const std::string x = "sqrt(mu / (mu + alpha (1 - mu)))", y = "sqrt(alpha)";
    TableInfo i;
    i.quantity = quantity;
    i.distribution = "ggx";
    i.axis_x = height > 1 ? x : y;
    i.axis_y = height > 1 ? y : "";
    i.method = "Gauss-Legendre over the disc of upward slopes";
    if (fitted) i.method += ", nodes levelled for the least largest error";
    i.nodes = node_accuracy;
    i.error_kind = fitted ? "relative" : "absolute";
    i.offset = lowest;
    i.scale = (highest - lowest) / 65535;
    return i;
}

const Definition& definition_of(const std::string& name)
{
    std::string known;
    for (const Definition& d : definitions)
    {
        if (d.name() == name) return d;
        known += (known.empty() ? "" : ", ") + d.name();
    }
    throw std::invalid_argument("no table is called '" + name + "'; there are " + known);
}

// Points between the nodes, with the exact value there.
struct Check
{
    std::size_t corner;  // index of the node below
    double u, v;         // place in the cell, in [0, 1]
    double exact;
};

class Fit
{
public:
    Fit(const Definition& definition, const BakeProgress& progress)
        : _definition(definition), _width(table_nodes), _height(definition.height)
    {
        const int last = _height > 1 ? 6 : 32;  // checks along the side of a cell
        const int rows = std::max(_height - 1, 1);
        const double dx = 1.0 / (_width - 1), dy = _height > 1 ? 1.0 / (_height - 1) : 0;
        for (int j = 0; j < _height; ++j)
            for (int i = 0; i < _width; ++i)
                _nodes.push_back(definition.exact(i * dx, j * dy, node_accuracy));
        for (int j = 0; j < rows; ++j)
        {
            if (progress && !progress(static_cast<double>(j) / rows)) throw BakeStopped();
            for (int i = 0; i + 1 < _width; ++i)
                for (int b = 0; b <= (_height > 1 ? last : 0); ++b)
                    for (int a = 0; a <= last; ++a)
                    {
                        const double u = static_cast<double>(a) / last,
                                     v = static_cast<double>(b) / last;
                        _checks.push_back(
                            {static_cast<std::size_t>(j * _width + i), u, v,
                             definition.exact((i + u) * dx, (j + v) * dy, check_accuracy)});
                    }
        }
        if (progress) progress(1);
    }

    // Moves each node by half of what its neighbourhood errs on the mean of both sides, until
    // nothing moves.
    void level()
    {
        for (int round = 0; round < 200; ++round)
        {
            std::vector<double> above(_nodes.size(), -1), below(_nodes.size(), 1);
            for (const Check& c : _checks)
            {
                const double e = error(c);
                for (int k = 0; k < 4; ++k)
                {
                    if (weight(c, k) <= 0.2) continue;
                    const std::size_t n = node(c, k);
                    above[n] = std::max(above[n], e);
                    below[n] = std::min(below[n], e);
                }
            }
            for (std::size_t n = 0; n < _nodes.size(); ++n)
                _nodes[n] =
                    std::min(_definition.highest, _nodes[n] * (1 - 0.2 * (above[n] + below[n])));
        }
    }

    // Of what look-ups find: with the nodes in their 16-bit form.
    double largest_error()
    {
        const TableInfo info = _definition.info();
        const std::vector<double> exact = _nodes;
        for (double& n : _nodes)
            n = info.offset + info.scale * std::round((n - info.offset) / info.scale);
        double largest = 0;
        for (const Check& c : _checks) largest = std::max(largest, std::abs(error(c)));
        _nodes = exact;
        return largest;
    }

    const std::vector<double>& nodes() const { return _nodes; }

private:
    static double weight(const Check& c, int k)
    {
        return ((k & 1) ? c.u : 1 - c.u) * ((k & 2) ? c.v : 1 - c.v);
    }
    std::size_t node(const Check& c, int k) const
    {
        return c.corner + ((k & 1) ? 1u : 0u) +
               ((k & 2) && _height > 1 ? static_cast<std::size_t>(_width) : 0u);
    }
    double error(const Check& c) const
    {
        double value = 0;
        for (int k = 0; k < 4; ++k) value += weight(c, k) * _nodes[node(c, k)];
        if (!_definition.fitted) return value - c.exact;
        return std::min(value, 1.0) / c.exact - 1;
    }

    Definition _definition;
    int _width, _height;
    std::vector<double> _nodes;
    std::vector<Check> _checks;
};

}  // namespace

std::vector<std::string> bakeable_tables()
{
    std::vector<std::string> names;
    for (const Definition& d : definitions) names.push_back(d.name());
    return names;
}

double exact_value(const std::string& name, double x, double y, int nodes)
{
    return definition_of(name).exact(x, y, nodes);
}

Table bake(const std::string& name, const BakeProgress& progress)
{
    const Definition& d = definition_of(name);
    Fit fit(d, progress);
    if (d.fitted) fit.level();

    TableInfo info = d.info();
    info.error = fit.largest_error();
    return Table(info, table_nodes, d.height,
                 std::vector<float>(fit.nodes().begin(), fit.nodes().end()));
}

}  // namespace luts
REGAIN_NAMESPACE_END
