// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "dielectric_anisotropy.h"

#include <regain/closures/dielectric_anisotropy.h>
#include <regain/luts/anisotropic_dielectric.h>

#include <algorithm>
#include <cmath>
#include <memory>

REGAIN_NAMESPACE_BEGIN
namespace luts {
namespace {

const double pi = std::acos(-1.0);

// What a place in the table means.
struct Seen
{
    double alpha_x, alpha_y, eta, alpha;
    Vec3<double> w;
};

using Place = AnisotropicGlassPlace<double>;

// The argument of a growing function in [lo, hi] where it has the value `wanted`.
template <class F>
double solve(double wanted, double lo, double hi, const F& f)
{
    for (int i = 0; i < 40; ++i)
    {
        const double middle = 0.5 * (lo + hi);
        (f(middle) < wanted ? lo : hi) = middle;
    }
    return 0.5 * (lo + hi);
}

// The inverse of the axes. The azimuth is known for each cosine, which is searched for.
Seen seen_at(const TablePoint& at, bool inside)
{
    Seen s;
    const double u = inside ? 1.5 - std::sqrt(2.25 - 2 * at.w) : at.w, z = 0.35 + 0.65 * u;
    s.alpha_x = std::max(1e-4, std::cbrt(at.z * at.z * at.z * at.z));
    s.alpha_y = s.alpha_x * std::exp(-2.995732273553991 * at.v);
    const double q = 0.6 * z * z * z * z;
    s.eta = inside ? (1 - q) / (1 + q) : (1 + q) / (1 - q);

    const auto direction = [](double mu, double phi) {
        const double sine = std::sqrt((1 - mu) * (1 + mu));
        return Vec3<double>(sine * std::cos(phi), sine * std::sin(phi), mu);
    };
    const auto place = [&](double mu, double phi) {
        return Place(s.alpha_x, s.alpha_y, direction(mu, phi), s.eta);
    };
    const auto azimuth = [&](double mu) {
        if (at.y <= 0 || at.y >= 1 || mu >= 1) return at.y <= 0 ? 0.0 : 0.5 * pi;
        // y is a quotient of quadratics in the square of the tangent.
        const double y = at.y, rho = s.alpha_x / s.alpha_y, r2 = std::pow(rho, 1.8),
                     s2 = Place::critical_tangent2(mu, rho, s.eta),
                     b = 0.75 * r2 + 0.25 * s2 - y * (r2 + s2);
        const double root = std::sqrt(b * b + 4 * (1 - y) * y * r2 * s2),
                     t2 = b > 0 ? 2 * y * r2 * s2 / (b + root) : (root - b) / (2 * (1 - y));
        return std::atan(std::sqrt(t2));
    };
    double mu = 1;
    if (at.x < 1) mu = solve(at.x, 0, 1, [&](double m) { return place(m, azimuth(m)).x[0]; });
    // Along the surface nothing leaves in the beta form; next to it the limit can be read off.
    mu = std::max(mu, 0.003 * place(mu, azimuth(mu)).alpha);
    const double phi = azimuth(mu);
    s.w = direction(mu, phi);
    s.alpha = place(mu, phi).alpha;
    return s;
}

// Less than this is lost in the sum of a quadrature.
double logarithm(double sum) { return std::log(std::max(sum, 1e-7)); }

struct Lattice
{
    std::vector<GlassAnisotropy::Values> nodes, middles;  // x fastest
};

// Calls f(point, index of the node or of the lowest node of the cell).
template <class F>
void for_each(const std::array<int, 5>& size, bool middles, const F& f)
{
    const int less = middles ? 1 : 0;
    int i[5];
    for (i[4] = 0; i[4] < size[4] - less; ++i[4])
        for (i[3] = 0; i[3] < size[3] - less; ++i[3])
            for (i[2] = 0; i[2] < size[2] - less; ++i[2])
                for (i[1] = 0; i[1] < size[1] - less; ++i[1])
                    for (i[0] = 0; i[0] < size[0] - less; ++i[0])
                    {
                        std::size_t node = 0;
                        double x[5];
                        for (int axis = 4; axis >= 0; --axis)
                        {
                            const auto length = size[static_cast<std::size_t>(axis)];
                            node = node * static_cast<std::size_t>(length) +
                                   static_cast<std::size_t>(i[axis]);
                            x[axis] = (i[axis] + 0.5 * less) / (length - 1);
                        }
                        f(TablePoint{x[0], x[1], x[2], x[3], x[4]}, node);
                    }
}

// Rows are so many points, whatever of the table they are of; the middles begin with a row.
constexpr std::size_t points_of_row = 256, numbers_of_point = 5;

std::size_t rows_of_points(std::size_t points)
{
    return (points + points_of_row - 1) / points_of_row;
}

std::size_t points_of(const std::array<int, 5>& size, bool middles)
{
    std::size_t points = 1;
    for (const int length : size) points *= static_cast<std::size_t>(length - (middles ? 1 : 0));
    return points;
}

Lattice lattice_of(const std::array<int, 5>& size, const std::vector<double>& integrals)
{
    Lattice lattice;
    const double* row = integrals.data();
    for (const bool middles : {false, true})
    {
        auto& values = middles ? lattice.middles : lattice.nodes;
        const std::size_t points = points_of(size, middles);
        for (std::size_t i = 0; i < points; ++i)
        {
            const double* v = row + i * numbers_of_point;
            values.push_back({v[0], v[1], v[2], v[3], v[4]});
        }
        row += rows_of_points(points) * points_of_row * numbers_of_point;
    }
    return lattice;
}

}  // namespace

std::array<int, 5> glass_anisotropy_size(bool inside)
{
    if (inside) return {39, 22, 8, 10, 13};
    return {25, 13, 7, 7, 7};
}

GlassAnisotropy::Values GlassAnisotropy::at(const TablePoint& point, int nodes) const
{
    const Seen s = seen_at(point, inside);
    const SlopeLaw unit = SlopeLaw::named(distribution, 1, 0);
    const DielectricAlbedo two =
        anisotropic_dielectric_albedo(unit, s.alpha_x, s.alpha_y, s.w, s.eta, nodes);
    Values v{0, 0, two.reflected + two.transmitted_correlated, two.reflected + two.transmitted_beta,
             s.w.z};
    if (point.v <= 0) return v;
    const DielectricAlbedo one =
        anisotropic_dielectric_albedo(unit, s.alpha, s.alpha, s.w, s.eta, nodes);
    v.correlated =
        logarithm(v.correlated_sum) - logarithm(one.reflected + one.transmitted_correlated);
    v.beta = logarithm(v.beta_sum) - logarithm(one.reflected + one.transmitted_beta);
    return v;
}

// Both forms of shadowing come out of the same.
IntegralRows glass_anisotropy_rows(const Definition& d)
{
    const GlassAnisotropy glass{d.info.distribution, d.family.inside};
    const std::array<int, 5> size = glass_anisotropy_size(d.family.inside);
    struct Points
    {
        std::vector<TablePoint> nodes, middles;
    };
    const auto points = std::make_shared<Points>();
    for_each(size, false, [&](const TablePoint& p, std::size_t) { points->nodes.push_back(p); });
    for_each(size, true, [&](const TablePoint& p, std::size_t) { points->middles.push_back(p); });
    const std::size_t of_nodes = rows_of_points(points->nodes.size());

    IntegralRows rows;
    rows.name = d.info.distribution + " glass anisotropy " + d.info.side;
    rows.count = of_nodes + rows_of_points(points->middles.size());
    rows.length = points_of_row * numbers_of_point;
    rows.integrate = [d, glass, points, of_nodes](std::size_t row, double* to) {
        const bool middles = row >= of_nodes;
        const std::vector<TablePoint>& all = middles ? points->middles : points->nodes;
        const std::size_t first = (middles ? row - of_nodes : row) * points_of_row;
        const std::size_t end = std::min(all.size(), first + points_of_row);
        for (std::size_t i = first; i < end; ++i)
        {
            const GlassAnisotropy::Values v =
                glass.at(all[i], middles ? d.check_accuracy : d.node_accuracy);
            for (const double number : {v.correlated, v.beta, v.correlated_sum, v.beta_sum, v.mu})
                *to++ = number;
        }
    };
    return rows;
}

Table glass_anisotropy_table(const Definition& d, const std::vector<double>& integrals)
{
    const bool beta = d.info.transmission_shadowing == "beta";
    const std::array<int, 5> size = glass_anisotropy_size(d.family.inside);
    const Lattice lattice = lattice_of(size, integrals);

    struct Check
    {
        std::size_t node;
        double exact;
        bool promised;
    };
    std::vector<double> nodes;
    for (const GlassAnisotropy::Values& v : lattice.nodes)
        nodes.push_back(std::clamp(beta ? v.beta : v.correlated, d.lowest, d.highest));
    std::vector<Check> checks;
    std::size_t cell = 0;
    for_each(size, true, [&](const TablePoint&, std::size_t node) {
        const GlassAnisotropy::Values& v = lattice.middles[cell++];
        const double sum = beta ? v.beta_sum : v.correlated_sum;
        // Levelled a little beyond what is promised, lest nodes at its bounds follow one side.
        if (!GlassAnisotropy::promised(v.mu, sum, 0.4)) return;
        checks.push_back(
            {node, beta ? v.beta : v.correlated, GlassAnisotropy::promised(v.mu, sum)});
    });
    std::size_t corner[32];
    for (unsigned bits = 0; bits < 32; ++bits)
    {
        std::size_t offset = 0;
        for (unsigned axis = 5; axis-- > 0;)
            offset = offset * static_cast<std::size_t>(size[axis]) + (bits >> axis & 1U);
        corner[bits] = offset;
    }
    const auto error = [&](const Check& c) {
        double mean = 0;
        for (const std::size_t k : corner) mean += nodes[c.node + k] / 32;
        return mean - c.exact;
    };

    // Moves each node by a part of what the middles about it err on the mean of both sides. It is
    // itself such a place. Where the widths are the same nothing is moved.
    const std::vector<double> exact = nodes;
    for (int round = 0; round < 60; ++round)
    {
        std::vector<double> above(nodes.size()), below(nodes.size());
        for (std::size_t n = 0; n < nodes.size(); ++n) above[n] = below[n] = nodes[n] - exact[n];
        for (const Check& c : checks)
        {
            const double e = error(c);
            for (const std::size_t k : corner)
            {
                above[c.node + k] = std::max(above[c.node + k], e);
                below[c.node + k] = std::min(below[c.node + k], e);
            }
        }
        std::size_t n = 0;
        for_each(size, false, [&](const TablePoint& p, std::size_t) {
            if (p.v > 0)
                nodes[n] = std::clamp(nodes[n] - 0.2 * (above[n] + below[n]), d.lowest, d.highest);
            ++n;
        });
    }

    for (double& n : nodes)
        n = d.info.offset + d.info.scale * std::round((n - d.info.offset) / d.info.scale);
    double largest = 0;
    for (const Check& c : checks)
        if (c.promised) largest = std::max(largest, std::abs(std::expm1(error(c))));
    TableInfo info = d.info;
    info.error = largest;
    return Table(info, d.width, d.height, d.depth, {nodes.begin(), nodes.end()});
}

}  // namespace luts
REGAIN_NAMESPACE_END
