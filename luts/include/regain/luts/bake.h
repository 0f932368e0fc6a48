// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Baking: from a definition to a table, by deterministic quadrature.
///
/// Names of tables are
///     DISTRIBUTION_QUANTITY                   ggx, beckmann, gtr, std; E_ss, E_avg, falloff, dip,
///                                             balance, q_ms, mu_ms, spread, forward, tilt; over
///                                             four or five axes anisotropy, balance_anisotropy
///     DISTRIBUTION_QUANTITY_SHADOWING_SIDE    E_S, R_share; correlated, beta; outside, inside
///     DISTRIBUTION_QUANTITY_SIDE              R_later; outside, inside
///     DISTRIBUTION_anisotropy_SHADOWING_SIDE  of ggx and beckmann: dielectric_anisotropy.h
/// where in the latter kinds gtr and std are followed by one gamma, gtr_1.3_E_S_beta_inside: over
/// gamma, too, the table would have four axes.

#pragma once

#include <regain/luts/export.h>
#include <regain/luts/table.h>

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace luts {

/// Called with the fraction done, in [0, 1], always by the thread that bakes; returns false to
/// stop.
using BakeProgress = std::function<bool(double)>;

/// Thrown by bake when its progress callback said stop.
struct BakeStopped : std::runtime_error
{
    BakeStopped() : std::runtime_error("stopped while baking") {}
};

/// Names of the tables that are compiled in: "ggx_E_ss", "ggx_E_avg", "ggx_falloff", "ggx_dip".
REGAIN_LUTS_API std::vector<std::string> compiled_in_tables();

/// Names of the tables that are shipped, the compiled-in ones first.
REGAIN_LUTS_API std::vector<std::string> shipped_tables();

/// The dielectric tables of one distribution: both quantities and sides of each form of shadowing.
/// gamma is ignored by distributions without a tail.
REGAIN_LUTS_API std::vector<std::string> dielectric_table_names(const std::string& distribution,
                                                                double gamma = 0);

/// Those of the split of its later bounces, R_later from outside and from inside.
REGAIN_LUTS_API std::vector<std::string> later_split_table_names(const std::string& distribution,
                                                                 double gamma = 0);

/// What its anisotropic glass takes besides; none of gtr and std.
REGAIN_LUTS_API std::vector<std::string> dielectric_anisotropy_table_names(
    const std::string& distribution);

/// Throws std::invalid_argument, which says what names there are, unless bake knows this one.
REGAIN_LUTS_API void require_bakeable(const std::string& name);

/// What bake writes into the header of that table, but the error; throws as above.
REGAIN_LUTS_API TableInfo bakeable_info(const std::string& name);

/// The table of that name, on all cores; throws as require_bakeable does.
///
/// Albedos are smooth but curved, and straight lines between exact nodes err to one side. So their
/// nodes are moved until the largest relative errors above and below are equal in each
/// neighbourhood: it halves the error at no cost. Nodes may come to lie a little above 1; look-ups
/// are limited to 1.
///
/// Tables of one size that come out of the same integral, as E_S in either form of shadowing, are
/// quick to bake one after the other: what was integrated last is remembered.
REGAIN_LUTS_API Table bake(const std::string& name, const BakeProgress& progress = {});

/// Coordinates in [0, 1] of a table's axes; those of axes that are not there are ignored.
struct TablePoint
{
    double x = 0, y = 0, z = 0;
    double v = 0, w = 0;  ///< axes 4 and 5
};

/// Exact value of what the table holds at a point, by quadrature of `nodes` nodes a piece.
REGAIN_LUTS_API double exact_value(const std::string& name, const TablePoint& at, int nodes);

/// Whether the table's error is promised at a point: of q_ms and mu_ms from alpha 0.1 and mu 0.02
/// on, of R_later from alpha 0.5 and mu 0.05 on, of anisotropy where the wider alpha is 2e-3 and mu
/// 5e-3 or more, of the anisotropy of balances where both are 5e-3 or more, of that of glass from
/// mu 0.03 on where E^S is above 0.1, else of distributions with a tail from alpha 5e-4 and mu 7e-4
/// on, of dielectrics from mu 0.018 on, of anything else everywhere.
REGAIN_LUTS_API bool is_error_promised(const std::string& name, const TablePoint& at);

/// No error is promised where the quantity itself is below this: 0.1 of E_S in the beta form, which
/// falls to nothing at grazing angles.
REGAIN_LUTS_API double smallest_promised(const std::string& name);

/// What look-ups of that table answer at most: 1 of albedos, infinity where nothing limits them.
REGAIN_LUTS_API double greatest_answer(const std::string& name);

/// Whether the table of that name holds natural logarithms.
REGAIN_LUTS_API bool is_logarithmic(const std::string& name);

/// The number of a table at a point, bilinear, as look-ups find it but for the limit to 1.
REGAIN_LUTS_API double interpolated(const TableView& table, const TablePoint& at);
/// The same of a table with any number of axes.
REGAIN_LUTS_API double interpolated(const Table& table, const TablePoint& at);

}  // namespace luts
REGAIN_NAMESPACE_END
