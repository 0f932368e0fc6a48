// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#pragma once

#include <regain/luts/bake.h>
#include <regain/luts/slope_law.h>

#include <array>
#include <string>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace luts {

/// What is integrated together: the quantities of one distribution, in one pass over the facets.
struct Family
{
    enum class Kind {
        directional,         // E_ss, falloff, dip
        balance,             // balance
        average,             // E_avg
        later,               // q_ms, mu_ms
        shape,               // spread, forward, tilt
        split,               // R_later
        anisotropy,          // anisotropy, over four or five axes
        balance_anisotropy,  // of balance, over four or five axes
        glass_anisotropy,    // of dielectrics: see dielectric_anisotropy.h
        dielectric           // E^R, correlated E^T, E^T in the beta form, w F(mu)
    };
    using Values = std::array<double, 4>;

    Kind kind = Kind::directional;
    std::string distribution;
    double gamma = 0;  // 0: an axis, or none
    bool inside = false;
    bool near_index = false;  // z of side 1 in the beta form

    bool has_tail() const { return distribution == "gtr" || distribution == "std"; }
    bool has_tail_axis() const { return gamma == 0 && has_tail(); }
    double alpha_of_tailed(double coordinate) const;
    double alpha_at(double coordinate) const;
    double tail_at(double coordinate) const;
    double mu_at(double x, double alpha) const;  // of mirrors
    double mu_of_dielectric(double x, double y, double eta) const;
    bool operator==(const Family& other) const;

    /// The values at (x, y, z) for every x of a row. Averages have their alpha along x, their tail
    /// along y. `nodes` of the quadrature.
    std::vector<Values> row(const std::vector<double>& x, double y, double z, int nodes) const;

    /// The law of the row (y, z), but of averages. Of dielectrics it is the same for all z: it may
    /// take as long to make as a point to integrate, and so can be given to all rows.
    SlopeLaw law(double y, double z) const;
    std::vector<Values> row(const SlopeLaw& law, const std::vector<double>& x, double y, double z,
                            int nodes) const;

    /// Of four or five axes: the values at every x and y of the rest, x fastest, and which are in
    /// the range that the error is promised for.
    struct Plane
    {
        std::vector<double> values;
        std::vector<bool> promised;
    };
    Plane plane(const std::vector<double>& x, const std::vector<double>& y, double z, double v,
                double w, int nodes) const;

    Plane balance_plane(const std::vector<double>& x, const std::vector<double>& y, double z,
                        double v, double w, int nodes) const;

    /// Is (x, y, z) in the range that the error is promised for? Of dielectrics `share` of the
    /// least cosine is the bound.
    bool promised(double x, double y, double z, double share = 1) const;
};

/// One table.
struct Definition
{
    Family family;
    TableInfo info;                // all but the error
    int width, height, depth;      // axes 4 and 5: info
    bool fitted;                   // levelled for the least largest relative error; else exact
    double lowest, highest;        // that a node can be
    double greatest = 1;           // that look-ups answer
    double smallest_promised = 0;  // no error is promised of a quantity below this
    int node_accuracy, check_accuracy;
    // What nodes are rounded to for a small file.
    enum class Rounding { none, half, stored } rounding = Rounding::none;
    double (*value)(const Family::Values&);

    /// Throws std::invalid_argument, which says what names there are.
    static Definition of(const std::string& name);

    bool is_grid() const
    {
        return family.kind == Family::Kind::anisotropy ||
               family.kind == Family::Kind::balance_anisotropy;
    }
};

}  // namespace luts
REGAIN_NAMESPACE_END
