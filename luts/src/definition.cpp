// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "definition.h"

#include "anisotropy.h"
#include "dielectric_anisotropy.h"

#include <regain/closures/anisotropic_balance.h>
#include <regain/closures/anisotropy.h>
#include <regain/closures/dielectric_tables.h>
#include <regain/closures/fresnel_moments.h>
#include <regain/closures/tail.h>
#include <regain/luts/albedo_integral.h>
#include <regain/luts/anisotropic_balance.h>
#include <regain/luts/balance.h>
#include <regain/luts/dielectric_integral.h>
#include <regain/luts/later_bounces.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>

REGAIN_NAMESPACE_BEGIN
namespace luts {
namespace {

constexpr int table_nodes = 32;

// A furnace has the error of the balance twice, once for each end.
constexpr int tailed_balance_nodes = 48, tailed_balance_alphas = 60;

// What light does after the first bounce changes slowly with everything. A node is the mean of
// 2^17 walks, and as exact as these.
constexpr int later_nodes = 12, later_node_accuracy = 128, later_check_accuracy = 32,
              walks_per_accuracy = 1024;
// Of a shape there is one for all cosines.
constexpr int shape_nodes = 24, shape_node_accuracy = 512, shape_check_accuracy = 128;
// Of a dielectric one number is asked for, but over three axes; one gamma is waited for.
constexpr int split_cosines = 16, split_node_accuracy = 16, split_check_accuracy = 8,
              tailed_split_accuracy = 4;
// Along the surface all is reflected, and no light is left for a second bounce.
constexpr double least_later_cosine = 0.01;

// E^S of a dielectric has on one axis what E_ss has and where refraction sets in, and falls
// steeply where eta is near 1. Twice the intervals along the cosine keep the critical one a node.
constexpr int sum_cosines = 2 * (table_nodes - 1) + 1;
// From inside, the place and width of the dip about the critical cosine change with all three.
constexpr int inside_sum_alphas = 48, inside_sum_indices = 63;
// In the beta form the sum falls by powers where the cosine is below alpha. From inside, that of
// STD is as curved there at alpha 1, and nobody ships tables of one gamma.
constexpr int fine_inside_cosines = 3 * (table_nodes - 1) + 1, outside_beta_indices = 48;

// What anisotropy changes is smooth along all five axes; of GTR it is the more, and most where its
// weight moves from long slopes to short ones.
struct AnisotropyNodes
{
    int cosines, azimuths, widths, ratios, tails;
};
constexpr AnisotropyNodes ggx_anisotropy{24, 6, 12, 9, 1}, beckmann_anisotropy{20, 6, 18, 9, 1},
    gtr_anisotropy{16, 6, 10, 11, 22}, std_anisotropy{16, 6, 14, 8, 12};

// The same of the balance, which varies more along the cosine.
constexpr AnisotropyNodes ggx_balance_anisotropy{20, 8, 16, 10, 1},
    beckmann_balance_anisotropy{20, 8, 20, 10, 1}, gtr_balance_anisotropy{22, 10, 10, 20, 24},
    std_balance_anisotropy{16, 7, 14, 7, 7};

// Row 0 is the limit of vanishing alpha at fixed x, which alpha 0 itself does not have.
constexpr double smallest_alpha = 1e-6;

// The argument of a growing function in [lo, hi] where it has the value `wanted`.
template <class F>
double solve(double wanted, double lo, double hi, const F& f)
{
    for (int i = 0; i < 100; ++i)
    {
        const double middle = 0.5 * (lo + hi);
        (f(middle) < wanted ? lo : hi) = middle;
    }
    return 0.5 * (lo + hi);
}

// The inverses of the axes in closures/table.h and closures/dielectric_tables.h.

double alpha_of_root(double y) { return std::max(y * y, smallest_alpha); }
double alpha_of_width(double y, double (*width)(const double&))
{
    return y >= 1 ? 1 : std::max(solve(y, 0, 1, width), smallest_alpha);
}
double mu_of_stretched_cosine(double x, double alpha)
{
    const double r = x * x;
    return r * alpha / (1 - r + r * alpha);
}
double mu_of_plain_cosine(double x, double alpha) { return x * alpha / (1 - x + x * alpha); }
double mu_of_tail_cosine(double x, double alpha)
{
    if (x >= 1) return 1;
    // By angle, since near normal incidence the axis runs evenly in that.
    const double angle = solve(x, 0, 0.5 * std::acos(-1.0),
                               [=](double t) { return tail_cosine(std::sin(t), alpha); });
    return std::sin(angle);
}
double ratio_of_coordinate(double v)
{
    return std::exp(3 * std::expm1(v * std::log1p(std::log(20) / 3)));
}
double eta_of_coordinate(double z, bool inside, bool near_index)
{
    double r = near_index ? std::expm1(z * std::log(201)) / 200 : z * z;
    // From inside, z = 0 is the limit at fixed x, which eta = 1 itself does not have.
    if (inside) r = std::max(r, 1e-4);
    const double q = std::min(r * r, 1.0) * 3 / 5;
    return inside ? (1 - q) / (1 + q) : (1 + q) / (1 - q);
}

using Values = Family::Values;

double first(const Values& v) { return v[0]; }
double second(const Values& v) { return v[1]; }
double third(const Values& v) { return v[2]; }
double log_first(const Values& v) { return std::log(v[0]); }

// Less than this nobody asks for: it is for a surface of alpha 1 below mu 0.03.
constexpr double lowest_logarithm = -15.9;
double correlated_sum(const Values& v) { return v[0] + v[1]; }
double log_beta_sum(const Values& v)
{
    return std::max(lowest_logarithm, std::log(std::max(v[0] + v[2], 1e-300)));
}
double share(double reflected, double transmitted, double smooth)
{
    const double sum = reflected + transmitted;
    return sum > 0 ? reflected / sum - smooth : 0;
}
double correlated_share(const Values& v) { return share(v[0], v[1], v[3]); }
double beta_share(const Values& v) { return share(v[0], v[2], v[3]); }

const char* const distributions[] = {"ggx", "beckmann", "gtr", "std"};
const char* const directional[] = {"E_ss", "E_avg", "falloff", "dip",     "balance",
                                   "q_ms", "mu_ms", "spread",  "forward", "tilt"};
const char* const shadowings[] = {"correlated", "beta"};
const char* const sides[] = {"outside", "inside"};

bool is_tailed(const std::string& distribution)
{
    return distribution == "gtr" || distribution == "std";
}

[[noreturn]] void refuse(const std::string& name, const std::string& why)
{
    throw std::invalid_argument(
        "no table is called '" + name + "'" + why +
        "; there are DISTRIBUTION_QUANTITY with ggx, beckmann, gtr, std and E_ss, E_avg, falloff, "
        "dip, balance, anisotropy, balance_anisotropy, q_ms, mu_ms, spread, forward, tilt, and "
        "DISTRIBUTION_QUANTITY_SHADOWING_SIDE with E_S, R_share; correlated, beta; outside, "
        "inside, and DISTRIBUTION_R_later_SIDE; in the latter two gtr and std take their gamma: "
        "gtr_1.3_E_S_beta_inside; and DISTRIBUTION_anisotropy_SHADOWING_SIDE with ggx, beckmann");
}

}  // namespace

double Family::alpha_of_tailed(double coordinate) const
{
    return alpha_of_width(coordinate,
                          distribution == "gtr" ? gtr_width<double> : std_width<double>);
}

bool Family::operator==(const Family& other) const
{
    return kind == other.kind && distribution == other.distribution && gamma == other.gamma &&
           inside == other.inside && near_index == other.near_index;
}

double Family::mu_of_dielectric(double x, double y, double eta) const
{
    if (x >= 1) return 1;
    const bool tail = has_tail();
    const double alpha = alpha_of_root(y);
    if (!tail && !inside) return mu_of_stretched_cosine(x, alpha);
    const double width = tail ? std::max(alpha, double(detail::tail_least_width)) : alpha;
    return solve(x, 0, 1, [&](double mu) {
        return inside ? detail::critical_cosine_coordinate(mu, width, eta, tail, near_index)
                      : detail::dielectric_cosine(mu, width, tail);
    });
}

double Family::alpha_at(double coordinate) const
{
    return has_tail_axis() ? alpha_of_tailed(coordinate) : alpha_of_root(coordinate);
}

double Family::tail_at(double coordinate) const
{
    if (!has_tail_axis()) return gamma;
    return distribution == "gtr" ? gtr_gamma(coordinate) : std_gamma(coordinate);
}

double Family::mu_at(double x, double alpha) const
{
    return has_tail_axis()              ? mu_of_tail_cosine(x, alpha)
           : distribution == "beckmann" ? mu_of_plain_cosine(x, alpha)
                                        : mu_of_stretched_cosine(x, alpha);
}

SlopeLaw Family::law(double y, double z) const
{
    return SlopeLaw::named(distribution, alpha_at(y), tail_at(z));
}

std::vector<Family::Values> Family::row(const std::vector<double>& xs, double y, double z,
                                        int nodes) const
{
    if (kind != Kind::average && kind != Kind::shape && kind != Kind::split)
        return row(law(y, z), xs, y, z, nodes);
    std::vector<Values> values;
    for (double x : xs)
    {
        if (kind == Kind::split)
        {
            // Of a flat surface the limit; and of grazing angles, where near eta = 1 a walk crosses
            // the surface about alpha / mu times.
            const double near = std::max(y, 0.01), alpha = alpha_of_root(near);
            const double eta = eta_of_coordinate(z, inside, false);
            const double mu = std::max(mu_of_dielectric(x, near, eta), 0.03 * alpha);
            values.push_back({later_reflected_share(distribution, alpha, gamma, eta, mu,
                                                    nodes * walks_per_accuracy),
                              0, 0, 0});
            continue;
        }
        if (kind == Kind::shape)
        {
            const LaterShape shape =
                later_shape(distribution, alpha_at(x), tail_at(y), nodes * walks_per_accuracy);
            values.push_back({std::sqrt(shape.k), shape.m, shape.c, 0});
            continue;
        }
        const SlopeLaw law = SlopeLaw::named(distribution, alpha_at(x), tail_at(y));
        values.push_back({average_albedo(law, {nodes}), 0, 0, 0});
    }
    return values;
}

std::vector<Family::Values> Family::row(const SlopeLaw& law, const std::vector<double>& xs,
                                        double y, double z, int nodes) const
{
    std::vector<Values> values;
    std::optional<Balance> balance;
    if (kind == Kind::balance) balance.emplace(law, nodes);
    const double alpha = alpha_at(y), eta = eta_of_coordinate(z, inside, near_index);
    for (double x : xs)
    {
        if (kind == Kind::dielectric)
        {
            const double mu = std::max(1e-6, mu_of_dielectric(x, y, eta));
            const DielectricAlbedo a = dielectric_albedo(law, mu, eta, nodes);
            values.push_back(
                {a.reflected, a.transmitted_correlated, a.transmitted_beta,
                 detail::fresnel_weight(alpha, eta) * dielectric_reflectance(mu, eta)});
            continue;
        }
        const auto mu_at = [&](double coordinate) { return this->mu_at(coordinate, alpha); };
        if (kind == Kind::later)
        {
            const double mu = std::max(x * x, least_later_cosine);
            const LaterBounces later =
                later_bounces(distribution, alpha, tail_at(z), mu, albedo(law, mu, {}, {24}),
                              nodes * walks_per_accuracy);
            values.push_back({later.q, later.mu, 0, 0});
            continue;
        }
        if (balance)
        {
            values.push_back({balance->at(mu_at(x)), 0, 0, 0});
            continue;
        }
        // At mu = 0 all is reflected, but there is nothing left to take a mean of; next to it the
        // limit can be read off.
        const double mu = mu_at(std::max(x, 1e-3));
        const AlbedoMoments m = albedo_moments(law, mu, {nodes});
        const auto facet = FresnelMoments<double>::at(mu);
        values.push_back({m.E_ss, m.falloff - facet.falloff, m.dip - facet.dip, 0});
        // E_ss of STD is still far from that limit at any angle of note, where gamma is small; its
        // end node is what the first cell runs towards.
        const double first_x = distribution == "std" ? 0.25 / (table_nodes - 1) : 0;
        if (x < 1e-3)
        {
            const double end = std::max(x, first_x);
            values.back()[0] = end > 0 ? albedo(law, mu_at(end), {}, {nodes}) : 1.0;
        }
    }
    return values;
}

Family::Plane Family::plane(const std::vector<double>& xs, const std::vector<double>& ys, double z,
                            double v, double w, int nodes) const
{
    if (kind == Kind::balance_anisotropy) return balance_plane(xs, ys, z, v, w, nodes);
    Plane plane;
    const double wider = alpha_at(z);
    const AnisotropicLobe lobe(distribution, wider, ratio_of_coordinate(v), tail_at(w));
    std::vector<double> mu, isotropic;
    for (double x : xs)
    {
        // At mu = 0 there is no lobe; close by is its limit.
        const double near = std::max(x, 4e-4), R = lobe.root_mean_square();
        mu.push_back(has_tail_axis() ? mu_of_tail_cosine(std::sqrt(near), R)
                                     : mu_of_plain_cosine(near, R));
        isotropic.push_back(lobe.isotropic(mu.back(), nodes));
    }
    for (double y : ys)
        for (std::size_t i = 0; i < xs.size(); ++i)
        {
            const double share = 5 * y / (8 - 3 * y);
            plane.values.push_back(lobe.correction(mu[i], share, nodes, isotropic[i]));
            plane.promised.push_back(wider >= 2e-3 && lobe.cosine(mu[i], share) >= 5e-3);
        }
    return plane;
}

Family::Plane Family::balance_plane(const std::vector<double>& xs, const std::vector<double>& ys,
                                    double z, double v, double w, int nodes) const
{
    Plane plane;
    const double wider = alpha_at(z), root = 1 - v / detail::balance_ratio_scale;
    const AnisotropicBalance g(distribution, wider, 1 / (root * root), tail_at(w), nodes);
    const double share = std::sqrt(1 / root);
    for (double place : ys)
    {
        const double y = place / (share - (share - 1) * place);
        for (double x : xs)
        {
            const double mu = mu_at(x, g.root_mean_square());
            plane.values.push_back(std::log(g.change(mu, y)));
            plane.promised.push_back(wider >= 5e-3 && g.cosine(mu, y) >= 5e-3);
        }
    }
    return plane;
}

bool Family::promised(double x, double y, double z, double share) const
{
    if (kind == Kind::average) return !has_tail_axis() || alpha_of_tailed(x) >= 5e-4;
    if (kind == Kind::shape) return alpha_at(x) >= 0.2;
    if (kind == Kind::dielectric)
        return mu_of_dielectric(x, y, eta_of_coordinate(z, inside, near_index)) >= 0.018 * share;
    if (kind == Kind::split)
        return alpha_of_root(y) >= 0.5 &&
               mu_of_dielectric(x, y, eta_of_coordinate(z, inside, false)) >= 0.05;
    if (kind == Kind::later) return alpha_at(y) >= 0.1 && x * x >= 0.02;
    if (!has_tail_axis()) return true;
    const double alpha = alpha_of_tailed(y);
    return alpha >= 5e-4 && mu_of_tail_cosine(x, alpha) >= 7e-4;
}

Definition Definition::of(const std::string& name)
{
    Definition d;
    d.value = first;
    std::string rest;
    for (const char* known : distributions)
        if (name.rfind(std::string(known) + "_", 0) == 0)
        {
            d.family.distribution = known;
            rest = name.substr(d.family.distribution.size() + 1);
        }
    if (rest.empty()) refuse(name, "");
    const bool tailed = is_tailed(d.family.distribution);

    TableInfo& info = d.info;
    info.distribution = d.family.distribution;
    d.depth = 1;

    for (const char* quantity : directional)
        if (rest == quantity)
        {
            info.quantity = quantity;
            const bool shape = rest == "spread" || rest == "forward" || rest == "tilt";
            const bool average = rest == "E_avg" || shape;
            d.family.kind = average ? Family::Kind::average : Family::Kind::directional;
            d.fitted = rest == "E_avg" || rest == "E_ss";
            d.value = rest == "falloff" ? second : rest == "dip" ? third : first;
            info.method = "Gauss-Legendre over the disc of upward slopes";
            if (d.fitted) info.method += ", nodes levelled for the least largest error";
            info.error_kind = d.fitted ? "relative" : "absolute";
            d.width = table_nodes;
            d.height = average && !tailed ? 1 : table_nodes;
            const std::string mu_axis =
                tailed ? "3/4 (1 + ln((k + s) / (1 + s)) / ln(1 / k)) + 1/4 s / (1 + s), s = cot "
                         "theta, k = 0.004 sqrt(alpha)"
                : info.distribution == "beckmann" ? "mu / (mu + alpha (1 - mu))"
                                                  : "sqrt(mu / (mu + alpha (1 - mu)))";
            const std::string alpha_axis =
                tailed ? info.distribution + "_width(alpha)" : "sqrt(alpha)";
            const std::string tail_axis = tailed ? info.distribution + "_tail(gamma)" : "";
            info.axis_x = average ? alpha_axis : mu_axis;
            info.axis_y = average ? tail_axis : alpha_axis;
            if (tailed)
            {
                if (!average)
                {
                    info.axis_z = tail_axis;
                    d.depth = table_nodes;
                }
                d.rounding = Rounding::half;
                d.node_accuracy = 36;
                d.check_accuracy = 20;
                info.scale = rest == "dip" ? 0x1p-19 : rest == "falloff" ? 0x1p-15 : 0x1p-16;
                info.offset = rest == "dip" ? -0x1p-4 : rest == "falloff" ? -1 : 0x1p-16;
                if (d.fitted && info.distribution == "std")
                {
                    info.transform = "ln";
                    d.value = log_first;
                    d.rounding = Rounding::stored;
                    info.scale = 0x1p-13;
                    info.offset = -65535 * info.scale;
                }
                d.lowest = info.offset;
                d.highest = info.offset + 65535 * info.scale;
            }
            else
            {
                d.node_accuracy = 64;
                d.check_accuracy = 24;  // for the many points between them; good to 1e-6
                // A levelled node of E_ss may lie a little above 1.
                d.lowest = rest == "falloff" ? -1 : rest == "dip" ? -0.06 : 0;
                d.highest = rest == "falloff" ? 0.25
                            : rest == "dip"   ? 0.06
                            : rest == "E_ss"  ? 65535.0 / 65000
                                              : 1;
                info.offset = d.lowest;
                info.scale = (d.highest - d.lowest) / 65535;
            }
            if (shape)
            {
                d.family.kind = Family::Kind::shape;
                d.value = rest == "spread" ? first : rest == "forward" ? second : third;
                d.width = shape_nodes;
                if (tailed) d.height = later_nodes;
                d.node_accuracy = tailed ? later_node_accuracy : shape_node_accuracy;
                d.check_accuracy = tailed ? later_check_accuracy : shape_check_accuracy;
                d.lowest = info.offset = rest == "tilt" ? -4 : 0;
                // All of it may go on ahead.
                info.scale = rest == "tilt" ? 0x1p-12 : rest == "spread" ? 0x1p-14 : 1.0 / 65535;
                d.highest = info.offset + 65535 * info.scale;
                info.method = "random walks, 1024 for each of as many nodes as said";
            }
            if (rest == "balance")
            {
                d.family.kind = Family::Kind::balance;
                d.fitted = true;
                d.value = first;
                d.greatest = std::numeric_limits<double>::infinity();
                if (tailed)
                {
                    d.width = d.depth = tailed_balance_nodes;
                    d.height = tailed_balance_alphas;
                }
                info.transform = "";
                info.method =
                    "Gauss-Legendre over the disc of upward slopes, balanced by Sinkhorn's "
                    "iteration, nodes levelled for the least largest error";
                info.error_kind = "relative";
                d.node_accuracy = tailed ? 24 : 48;
                d.check_accuracy = 24;
                d.lowest = info.offset = 0;
                // It grows to 2.06 of GGX, of STD to 7.6.
                info.scale = tailed ? 0x1p-12 : 0x1p-14;
                d.highest = 65535 * info.scale;
            }
            if (rest == "q_ms" || rest == "mu_ms")
            {
                d.family.kind = Family::Kind::later;
                d.value = rest == "q_ms" ? first : second;
                d.width = d.height = later_nodes;
                if (tailed) d.depth = later_nodes;
                d.node_accuracy = later_node_accuracy;
                d.check_accuracy = later_check_accuracy;
                d.lowest = info.offset = 0;
                info.scale = 0x1p-16;
                d.highest = 65535 * info.scale;
                info.axis_x = "sqrt(mu)";
                info.method = "random walks, 1024 for each of as many nodes as said";
            }
            info.nodes = d.node_accuracy;
            return d;
        }

    if (rest == "balance_anisotropy")
    {
        const AnisotropyNodes n = d.family.distribution == "ggx" ? ggx_balance_anisotropy
                                  : d.family.distribution == "beckmann"
                                      ? beckmann_balance_anisotropy
                                  : d.family.distribution == "gtr" ? gtr_balance_anisotropy
                                                                   : std_balance_anisotropy;
        d.family.kind = Family::Kind::balance_anisotropy;
        d.fitted = true;
        d.greatest = std::numeric_limits<double>::infinity();
        d.width = n.cosines;
        d.height = n.azimuths;
        d.depth = n.widths;
        info.length_4 = n.ratios;
        info.length_5 = n.tails;
        info.quantity = rest;
        const Definition balance = Definition::of(d.family.distribution + "_balance");
        info.axis_x = balance.info.axis_x + ", of mu' and R";
        info.axis_y =
            "s Y^2 / (X^2 + s Y^2), Y along the narrower axis, s = (wider / narrower)^(1/4)";
        info.axis_z = balance.info.axis_y + ", alpha of the wider axis";
        info.axis_4 = "(1 - sqrt(narrower / wider)) / (1 - sqrt(1 / 20))";
        info.axis_5 = balance.info.axis_z;
        info.transform = "ln";
        info.method = balance.info.method;
        info.error_kind = "relative";
        d.node_accuracy = info.nodes = 20;
        d.check_accuracy = 16;
        info.scale = 0x1p-13;
        info.offset = -4;
        d.lowest = info.offset;
        d.highest = info.offset + 65535 * info.scale;
        return d;
    }
    if (rest == "anisotropy")
    {
        const AnisotropyNodes& n = d.family.distribution == "ggx"        ? ggx_anisotropy
                                   : d.family.distribution == "beckmann" ? beckmann_anisotropy
                                   : d.family.distribution == "gtr"      ? gtr_anisotropy
                                                                         : std_anisotropy;
        d.family.kind = Family::Kind::anisotropy;
        d.fitted = true;
        d.value = first;
        d.greatest = std::numeric_limits<double>::infinity();
        d.width = n.cosines;
        d.height = n.azimuths;
        d.depth = n.widths;
        info.length_4 = n.ratios;
        info.length_5 = n.tails;
        info.quantity = rest;
        info.axis_x = tailed ? "(3/4 (1 + ln((k + s) / (1 + s)) / ln(1 / k)) + 1/4 s / (1 + s))^2, "
                               "s = R z / |(X, Y)|, k = 0.004 sqrt(R)"
                             : "mu' / (mu' + R (1 - mu'))";
        info.axis_y = "8 Y^2 / (5 X^2 + 8 Y^2), Y along the narrower axis";
        info.axis_z =
            (tailed ? info.distribution + "_width" : "sqrt") + "(alpha of the wider axis)";
        info.axis_4 = "ln(1 + ln(wider / narrower) / 3) / ln(1 + ln(20) / 3)";
        info.axis_5 = tailed ? info.distribution + "_tail(gamma)" : "";
        info.transform = "ln";
        info.method = "Gauss-Legendre over slopes, nodes levelled for the least largest error";
        info.error_kind = "relative";
        d.node_accuracy = 16;
        d.check_accuracy = 12;
        info.nodes = d.node_accuracy;
        info.scale = 0x1p-11;
        info.offset = -4;
        d.lowest = info.offset;
        d.highest = info.offset + 65535 * info.scale;
        return d;
    }
    if (tailed)
    {
        char* end = nullptr;
        d.family.gamma = std::strtod(rest.c_str(), &end);
        if (end == rest.c_str() || *end != '_') refuse(name, "");
        const bool gtr = d.family.distribution == "gtr";
        const double low = gtr ? gtr_min_gamma : std_min_gamma,
                     high = gtr ? gtr_max_gamma : std_max_gamma;
        if (!(d.family.gamma >= low && d.family.gamma <= high))
            refuse(name, ", its gamma is not within " + std::to_string(low) + " to " +
                             std::to_string(high));
        rest = end + 1;
    }
    info.gamma = d.family.gamma;
    for (const char* side : sides)
    {
        if (rest != std::string("R_later_") + side) continue;
        d.family.kind = Family::Kind::split;
        d.family.inside = side == std::string("inside");
        d.value = first;
        d.fitted = false;
        d.width = d.family.inside ? table_nodes : split_cosines;
        d.height = later_nodes;
        d.depth = split_cosines;
        info.quantity = "R_later";
        info.side = side;
        info.axis_x = d.family.inside ? "critical_cosine_coordinate(mu, alpha, eta)"
                                      : "sqrt(mu / (mu + alpha (1 - mu)))";
        if (tailed) info.axis_x += ", alpha at least 0.05; with a tail";
        info.axis_y = "sqrt(alpha)";
        info.axis_z = "(5/3 |eta - 1| / (eta + 1))^(1/4)";
        info.method = "random walks, 1024 for each of as many nodes as said";
        info.error_kind = "absolute";
        d.node_accuracy = tailed ? tailed_split_accuracy : split_node_accuracy;
        d.check_accuracy = tailed ? tailed_split_accuracy : split_check_accuracy;
        info.nodes = d.node_accuracy;
        d.rounding = Rounding::half;
        d.lowest = info.offset = 0;
        d.highest = 1;
        info.scale = 1.0 / 65535;
        return d;
    }
    for (const char* shadowing : shadowings)
        for (const char* side : sides)
        {
            if (tailed || rest != std::string("anisotropy_") + shadowing + "_" + side) continue;
            d.family.kind = Family::Kind::glass_anisotropy;
            d.family.inside = side == std::string("inside");
            info.quantity = "anisotropy";
            info.transmission_shadowing = shadowing;
            info.side = side;
            const std::array<int, 5> size = glass_anisotropy_size(d.family.inside);
            d.width = size[0];
            d.height = size[1];
            d.depth = size[2] * size[3] * size[4];
            info.length_4 = size[3];
            info.length_5 = size[4];
            info.axis_x = d.family.inside ? "critical_cosine_coordinate(mu, a, eta) of the beta "
                                            "form, kappa at 3/5, spread at low angles"
                                          : "sqrt(mu / (mu + a (1 - mu)))";
            info.axis_y = "3/4 f(tan phi / s) + 1/4 f(tan phi / rho^0.9), f(u) = u^2 / (1 + u^2)";
            info.axis_z = "wider alpha^(3/4)";
            info.axis_4 = "ln(rho) / ln(20)";
            info.axis_5 = "((5/3 |eta - 1| / (eta + 1))^(1/4) - 0.35) / 0.65";
            if (d.family.inside) info.axis_5 = "(3 u - u^2) / 2, u = " + info.axis_5;
            info.method =
                "Gauss-Legendre over stretched slopes, nodes levelled for the least largest error";
            info.error_kind = "relative";
            info.transform = "ln";
            d.fitted = true;
            d.greatest = std::numeric_limits<double>::infinity();
            // Good to 1e-3.
            d.node_accuracy = d.family.distribution == "beckmann" ? 14 : 9;
            d.check_accuracy = d.family.distribution == "beckmann" ? 11 : 8;
            info.nodes = d.node_accuracy;
            d.rounding = Rounding::stored;
            info.scale = 0x1p-10;
            info.offset = d.lowest = -1.5;
            d.highest = 1.5;
            return d;
        }
    for (const char* shadowing : shadowings)
        for (const char* side : sides)
            for (const bool share : {false, true})
            {
                const std::string quantity = share ? "R_share" : "E_S";
                if (rest != quantity + "_" + shadowing + "_" + side) continue;
                const bool beta = shadowing == std::string("beta");
                d.family.kind = Family::Kind::dielectric;
                d.family.inside = side == std::string("inside");
                info.quantity = quantity;
                info.transmission_shadowing = shadowing;
                info.side = side;
                d.width = d.height = d.depth = table_nodes;
                if (!share) d.width = sum_cosines;
                if (!share && d.family.inside)
                {
                    d.height = inside_sum_alphas;
                    d.depth = inside_sum_indices;
                }
                if (!share && d.family.inside && (beta || tailed)) d.width = fine_inside_cosines;
                if (!share && !d.family.inside && beta) d.depth = outside_beta_indices;
                d.family.near_index = !share && d.family.inside && beta;
                d.fitted = !share;
                d.value = share ? (beta ? beta_share : correlated_share)
                                : (beta ? log_beta_sum : correlated_sum);
                info.axis_x = d.family.inside ? "critical_cosine_coordinate(mu, alpha, eta)"
                                              : "sqrt(mu / (mu + alpha (1 - mu)))";
                if (d.family.near_index) info.axis_x += ", of the beta form";
                if (tailed) info.axis_x += ", alpha at least 0.05; with a tail";
                info.axis_y = "sqrt(alpha)";
                info.axis_z = d.family.near_index
                                  ? "ln(1 + 200 (5/3 |eta - 1| / (eta + 1))^(1/2)) / ln(201)"
                                  : "(5/3 |eta - 1| / (eta + 1))^(1/4)";
                info.method = "Gauss-Legendre over facets, polar about wo";
                if (d.fitted) info.method += ", nodes levelled for the least largest error";
                info.error_kind = d.fitted ? "relative" : "absolute";
                // Whom one gamma is baked for waits for it, and sums of the beta form are the
                // largest; fewer nodes are good to 2e-6 there, to 1e-4 of STD below gamma 1.6.
                const bool quick = tailed || (beta && !share);
                d.node_accuracy = quick ? 18 : 24;
                d.check_accuracy = quick ? 14 : 18;
                info.nodes = d.node_accuracy;
                d.rounding = Rounding::half;
                info.scale = share ? 0x1p-14 : 0x1p-16;
                info.offset = share ? -2 : 0x1p-16;
                if (beta && !share)
                {
                    info.transform = "ln";
                    d.smallest_promised = 0.1;
                    d.rounding = Rounding::stored;
                    info.scale = 0x1p-11;
                    info.offset = -65535 * info.scale;
                }
                d.lowest = info.offset;
                d.highest = info.offset + 65535 * info.scale;
                return d;
            }
    refuse(name, "");
}

}  // namespace luts
REGAIN_NAMESPACE_END
