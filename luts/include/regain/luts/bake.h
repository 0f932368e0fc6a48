// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Baking: from a definition to a table, by deterministic quadrature.

#pragma once

#include <regain/luts/export.h>
#include <regain/luts/table.h>

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace luts {

/// Called with the fraction done, in [0, 1]; returns false to stop.
using BakeProgress = std::function<bool(double)>;

/// Thrown by bake when its progress callback said stop.
struct BakeStopped : std::runtime_error
{
    BakeStopped() : std::runtime_error("stopped while baking") {}
};

/// Names of the tables that bake knows: "ggx_E_ss", "ggx_E_avg", "ggx_falloff", "ggx_dip".
REGAIN_LUTS_API std::vector<std::string> bakeable_tables();

/// The table of that name; throws std::invalid_argument, which lists the names, for any other.
///
/// E_ss and E_avg are smooth but curved, and straight lines between exact nodes err to one side. So
/// their nodes are moved until the largest relative errors above and below are equal in each
/// neighbourhood: it halves the error at no cost. Nodes of E_ss may come to lie a little above 1;
/// look-ups are limited to 1.
REGAIN_LUTS_API Table bake(const std::string& name, const BakeProgress& progress = {});

/// Exact value of what the table holds, at coordinates x, y in [0, 1] of its axes (y is ignored
/// with one axis); by quadrature of `nodes` nodes a piece.
REGAIN_LUTS_API double exact_value(const std::string& name, double x, double y, int nodes);

}  // namespace luts
REGAIN_NAMESPACE_END
