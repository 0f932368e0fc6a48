// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/luts/table.h>

#include <Imath/half.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

REGAIN_NAMESPACE_BEGIN
namespace luts {

std::string table_name(const TableInfo& info)
{
    std::ostringstream name;
    name << info.distribution;
    if (info.gamma != 0) name << "_" << info.gamma;
    name << "_" << info.quantity;
    if (!info.transmission_shadowing.empty()) name << "_" << info.transmission_shadowing;
    if (!info.side.empty()) name << "_" << info.side;
    return name.str();
}

Table::Table(TableInfo info, int width, int height, int depth, std::vector<float> values)
    : _info(std::move(info)),
      _width(width),
      _height(height),
      _depth(depth),
      _values(std::move(values))
{
    if (width < 2 || height < 1 || depth < 1 ||
        _values.size() != static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                              static_cast<std::size_t>(depth))
        throw std::invalid_argument("table " + name() + ": " + std::to_string(_values.size()) +
                                    " values do not fill " + std::to_string(width) + " x " +
                                    std::to_string(height) + " x " + std::to_string(depth) +
                                    " nodes (at least 2 x 1 x 1)");
    // Look-ups want two nodes along each axis that is there.
    const auto fits = [](int length, const std::string& axis) {
        return axis.empty() ? length == 1 : length >= 2 && length <= 4096;
    };
    if (!fits(_info.length_4, _info.axis_4) || !fits(_info.length_5, _info.axis_5) ||
        (!_info.axis_5.empty() && _info.axis_4.empty()) ||
        depth % (_info.length_4 * _info.length_5) != 0 ||
        (!_info.axis_4.empty() && (height < 2 || depth < 2 * _info.length_4 * _info.length_5)))
        throw std::invalid_argument("table " + name() + ": " + std::to_string(depth) +
                                    " slices are not those of axes 4 and 5, of " +
                                    std::to_string(_info.length_4) + " and " +
                                    std::to_string(_info.length_5) + " nodes");
    _stored.reserve(_values.size());
    for (float v : _values)
    {
        const double s = std::round((static_cast<double>(v) - _info.offset) / _info.scale);
        if (!(s >= 0 && s <= 65535))
            throw std::invalid_argument("table " + name() + ": value " + std::to_string(v) +
                                        " is outside the range of its 16-bit form, " +
                                        std::to_string(_info.offset) + " to " +
                                        std::to_string(_info.offset + 65535 * _info.scale));
        _stored.push_back(static_cast<std::uint16_t>(s));
    }
}

TableView Table::view() const
{
    TableView v;
    v.data = _stored.data();
    v.width = _width;
    v.height = _height;
    v.depth = _depth;
    v.offset = static_cast<float>(_info.offset);
    v.scale = static_cast<float>(_info.scale);
    return v;
}

double storage_step(const Table& table, double value)
{
    const auto all = [&](const auto& holds) {
        return std::all_of(table.values().begin(), table.values().end(), holds);
    };
    if (all([](float v) { return static_cast<float>(Imath::half(v)) == v; }))
        return std::ldexp(1.0, std::max(std::ilogb(value), -14) - 10);
    const TableInfo& info = table.info();
    const bool on_grid = all([&](float v) {
        const double s = (static_cast<double>(v) - info.offset) / info.scale;
        return s == std::round(s);
    });
    return on_grid ? info.scale : 0;
}

}  // namespace luts
REGAIN_NAMESPACE_END
