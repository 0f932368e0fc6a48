// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A table of albedos as data: its numbers, and what is needed to know what they mean and whether
/// they are still true.

#pragma once

#include <regain/closures/grid_view.h>
#include <regain/closures/table.h>
#include <regain/luts/export.h>

#include <stdexcept>
#include <string>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace luts {

/// Counts up whenever the definition of a quantity, an axis or the way of baking changes, so that a
/// table baked before is known to be stale.
constexpr int table_definition = 2;

/// What a table is; written whole into the header of its EXR file.
struct TableInfo
{
    /// "E_ss", "E_avg", "falloff" or "dip", as in MicrofacetTables; "E_S", "R_share", "R_later" or
    /// "anisotropy" as in DielectricTables.
    std::string quantity;
    std::string distribution;            ///< "ggx", "beckmann", "gtr" or "std"
    double gamma = 0;                    ///< tail parameter, 0 where it is an axis or there is none
    std::string transmission_shadowing;  ///< "correlated" or "beta"; empty without transmission,
                                         ///< and of R_later
    std::string side;  ///< "outside", eta_o >= 1, or "inside"; empty without transmission
    std::string axis_x, axis_y, axis_z;  ///< formula of each axis; empty for one that is not there
    std::string axis_4, axis_5;          ///< the same of axes that the files of few tables have
    int length_4 = 1, length_5 = 1;      ///< nodes along these, 1 where they are not there
    std::string transform;   ///< "ln" where the numbers are logarithms of the quantity; else empty
    std::string method;      ///< how the numbers came about, with node counts
    int nodes = 0;           ///< of the quadrature, along each piece
    double error = 0;        ///< largest measured interpolation error, see error_kind
    std::string error_kind;  ///< "relative" or "absolute"
    int definition = table_definition;
    double offset = 0, scale = 1;  ///< of the 16-bit form: value = offset + scale * stored
};

/// "ggx_E_ss", "gtr_1.3_E_S_beta_inside": the name of its file without extension.
REGAIN_LUTS_API std::string table_name(const TableInfo& info);

/// Values at the nodes, x fastest, axis 5 slowest, and their 16-bit form. Axes 4 and 5 make further
/// slices of z: the depth counts those of all three.
class REGAIN_LUTS_API Table
{
public:
    Table() = default;

    /// `values` has width * height * depth entries within the range of the 16-bit form, and the
    /// lengths of axes 4 and 5 divide the depth; throws std::invalid_argument otherwise. An axis
    /// that is not there has length 1.
    Table(TableInfo info, int width, int height, int depth, std::vector<float> values);

    const TableInfo& info() const { return _info; }
    int width() const { return _width; }
    int height() const { return _height; }
    int depth() const { return _depth; }
    const std::vector<float>& values() const { return _values; }
    const std::vector<std::uint16_t>& stored() const { return _stored; }

    /// What closures read; valid as long as the table lives and stays where it is.
    TableView view() const;
    /// The same of a table of 4 or 5 axes, or, with one node along the fifth, of 4 as of 5; throws
    /// std::logic_error if it has others.
    template <int Axes>
    GridView<Axes> grid() const
    {
        static_assert(Axes == 4 || Axes == 5);
        if (axes() < 4 || axes() > Axes)
            throw std::logic_error("table " + name() + " has other axes");
        GridView<Axes> v;
        v.data = _stored.data();
        v.size[0] = _width;
        v.size[1] = _height;
        v.size[2] = _depth / (_info.length_4 * _info.length_5);
        v.size[3] = _info.length_4;
        if constexpr (Axes == 5) v.size[4] = _info.length_5;
        v.offset = static_cast<float>(_info.offset);
        v.scale = static_cast<float>(_info.scale);
        return v;
    }

    std::string name() const { return table_name(_info); }

private:
    int axes() const { return _info.length_5 > 1 ? 5 : _info.length_4 > 1 ? 4 : 3; }

    TableInfo _info;
    int _width = 0, _height = 0, _depth = 0;
    std::vector<float> _values;
    std::vector<std::uint16_t> _stored;
};

/// The step between two numbers that a table may hold about a value: what baking the same table
/// elsewhere may differ by. 0 for floats that were not rounded.
REGAIN_LUTS_API double storage_step(const Table& table, double value);

}  // namespace luts
REGAIN_NAMESPACE_END
