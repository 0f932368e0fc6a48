// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A table of albedos as data: its numbers, and what is needed to know what they mean and whether
/// they are still true.

#pragma once

#include <regain/closures/table.h>
#include <regain/luts/export.h>

#include <string>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace luts {

/// Counts up whenever the definition of a quantity, an axis or the way of baking changes, so that a
/// table baked before is known to be stale.
constexpr int table_definition = 1;

/// What a table is; written whole into the header of its EXR file.
struct TableInfo
{
    std::string quantity;        ///< "E_ss", "E_avg", "falloff" or "dip", as in MicrofacetTables
    std::string distribution;    ///< "ggx"
    double gamma = 0;            ///< tail parameter, 0 where the distribution has none
    std::string axis_x, axis_y;  ///< formula of each axis; axis_y empty for one axis
    std::string method;          ///< how the numbers came about, with node counts
    int nodes = 0;               ///< of the quadrature, along each piece
    double error = 0;            ///< largest measured interpolation error, see error_kind
    std::string error_kind;      ///< "relative" or "absolute"
    int definition = table_definition;
    double offset = 0, scale = 1;  ///< of the 16-bit form: value = offset + scale * stored
};

/// Values at the nodes, x fastest, and their 16-bit form.
class REGAIN_LUTS_API Table
{
public:
    Table() = default;

    /// `values` has width * height entries within the range of the 16-bit form; throws
    /// std::invalid_argument otherwise.
    Table(TableInfo info, int width, int height, std::vector<float> values);

    const TableInfo& info() const { return _info; }
    int width() const { return _width; }
    int height() const { return _height; }
    const std::vector<float>& values() const { return _values; }
    const std::vector<std::uint16_t>& stored() const { return _stored; }

    /// What closures read; valid as long as the table lives and stays where it is.
    TableView view() const;

    /// "ggx_E_ss": the name of its file without extension.
    std::string name() const { return _info.distribution + "_" + _info.quantity; }

private:
    TableInfo _info;
    int _width = 0, _height = 0;
    std::vector<float> _values;
    std::vector<std::uint16_t> _stored;
};

}  // namespace luts
REGAIN_NAMESPACE_END
