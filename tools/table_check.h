// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Are the tables that are shipped still what their definition says? A table that was baked again
/// is compared node by node; or, in a second instead of ten, the shipped numbers are compared
/// with exact values at a few places.

#pragma once

#include <regain/luts/table.h>

#include <optional>
#include <string>

namespace regain::tools {

/// Where a shipped number is not what it should be.
struct Mismatch
{
    std::string where;  ///< "node (3, 5)" or what else differs
    double shipped = 0, expected = 0;
};

struct TableCheck
{
    std::string table;    ///< "ggx_E_ss"
    std::string against;  ///< "compiled in" or the name of a file
    int numbers = 0;      ///< that were compared
    int differing = 0;
    double largest_difference = 0;
    std::optional<Mismatch> worst;  ///< the one with the largest difference

    bool passed() const { return !worst; }
};

/// Every stored 16-bit number must be equal; the difference is in values.
TableCheck check_builtin(const luts::Table& baked);

/// Of a file: values within this, whatever compiler and processor baked them.
constexpr double file_tolerance = 1e-6;

/// Values within file_tolerance, or the step of their rounding where they are rounded, and a header
/// that says the same.
TableCheck check_file(const luts::Table& baked, const luts::Table& shipped,
                      const std::string& file);

/// How far interpolation between the shipped nodes may be from the exact value.
struct SpotTolerance
{
    double largest;
    bool relative;
};

/// A little more than the error that the compiled-in table was baked with: what a damaged or stale
/// table shows is far larger.
SpotTolerance spot_tolerance(const std::string& table);
/// Twice the error that the file says: that of three axes and more is taken in the middle of cells
/// only.
SpotTolerance spot_tolerance(const luts::Table& table);

/// At `spots` places spread over the part of the table that its error is promised for; at most 10
/// where an exact number takes random walks, or a lobe's whole balance.
TableCheck check_spots(const std::string& name, const TableView& shipped,
                       const SpotTolerance& tolerance, const std::string& against, int spots);
/// The same of a file, with any number of axes and its own tolerance.
TableCheck check_spots(const luts::Table& shipped, const std::string& file, int spots);

}  // namespace regain::tools
