// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "table_check.h"

#include "random_numbers.h"

#include <regain/luts/bake.h>
#include <regain/luts/builtin.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace regain::tools {
namespace {

void compare(TableCheck& check, const std::string& where, double shipped, double expected,
             double difference, bool equal)
{
    ++check.numbers;
    const bool larger = difference > check.largest_difference;
    if (larger) check.largest_difference = difference;
    if (equal) return;
    ++check.differing;
    if (larger || !check.worst) check.worst = Mismatch{where, shipped, expected};
}

std::string node(int x, int y) { return fmt::format("node ({}, {})", x, y); }

bool same_size(TableCheck& check, int width, int height, const luts::Table& baked)
{
    if (width == baked.width() && height == baked.height()) return true;
    check.differing = 1;
    check.worst = Mismatch{fmt::format("size {} x {} in place of {} x {}: number of nodes", width,
                                       height, baked.width(), baked.height()),
                           static_cast<double>(width) * height,
                           static_cast<double>(baked.width()) * baked.height()};
    return false;
}

// Numbers of a header that have to be equal; an absent name is a text that differs.
void compare_headers(TableCheck& check, const luts::TableInfo& shipped,
                     const luts::TableInfo& baked)
{
    const auto number = [&](const char* name, double a, double b, double tolerance) {
        const double d = std::abs(a - b);
        compare(check, fmt::format("header '{}'", name), a, b, d, d <= tolerance);
    };
    const auto text = [&](const char* name, const std::string& a, const std::string& b) {
        if (a != b)
            compare(check, fmt::format("header '{}': '{}' in place of '{}'", name, a, b), 0, 0, 0,
                    false);
    };
    text("quantity", shipped.quantity, baked.quantity);
    text("distribution", shipped.distribution, baked.distribution);
    text("axis_x", shipped.axis_x, baked.axis_x);
    text("axis_y", shipped.axis_y, baked.axis_y);
    text("method", shipped.method, baked.method);
    text("error_kind", shipped.error_kind, baked.error_kind);
    number("gamma", shipped.gamma, baked.gamma, 0);
    number("nodes", shipped.nodes, baked.nodes, 0);
    number("offset", shipped.offset, baked.offset, 0);
    number("scale", shipped.scale, baked.scale, 0);
    number("error", shipped.error, baked.error, file_tolerance);
}

}  // namespace

TableCheck check_builtin(const luts::Table& baked)
{
    TableCheck check;
    check.table = baked.name();
    check.against = "compiled in";
    const TableView shipped = luts::builtin_table(baked.name()), expected = baked.view();
    if (!same_size(check, shipped.width, shipped.height, baked)) return check;
    compare(check, "offset", shipped.offset, expected.offset,
            std::abs(shipped.offset - expected.offset), shipped.offset == expected.offset);
    compare(check, "scale", shipped.scale, expected.scale, std::abs(shipped.scale - expected.scale),
            shipped.scale == expected.scale);
    for (int y = 0; y < shipped.height; ++y)
        for (int x = 0; x < shipped.width; ++x)
        {
            const int i = y * shipped.width + x;
            const int a = shipped.data[i], b = expected.data[i];
            compare(check, node(x, y), a, b, std::abs(a - b) * double(expected.scale), a == b);
        }
    return check;
}

TableCheck check_file(const luts::Table& baked, const luts::Table& shipped, const std::string& file)
{
    TableCheck check;
    check.table = baked.name();
    check.against = file;
    if (!same_size(check, shipped.width(), shipped.height(), baked)) return check;
    compare_headers(check, shipped.info(), baked.info());
    for (int y = 0; y < shipped.height(); ++y)
        for (int x = 0; x < shipped.width(); ++x)
        {
            const std::size_t i = static_cast<std::size_t>(y * shipped.width() + x);
            const double a = shipped.values()[i], b = baked.values()[i], d = std::abs(a - b);
            compare(check, node(x, y), a, b, d, d <= file_tolerance);
        }
    return check;
}

SpotTolerance spot_tolerance(const std::string& table)
{
    const std::string quantity = table.substr(table.find('_') + 1);
    if (quantity == "E_ss" || quantity == "E_avg") return {1e-3, true};
    // The mean of Schlick's falloff bends the most, where all of it is small.
    if (quantity == "falloff") return {6e-3, false};
    return {1e-3, false};
}

TableCheck check_spots(const std::string& name, const TableView& shipped,
                       const std::string& against, int spots)
{
    TableCheck check;
    check.table = name;
    check.against = against;
    const SpotTolerance tolerance = spot_tolerance(name);
    RandomNumbers random(0);
    for (int i = 0; i < spots; ++i)
    {
        const double x = random.next<double>(), y = random.next<double>();
        const double exact = luts::exact_value(name, x, y, 64);
        double value = shipped.height > 1 ? shipped.at(x, y) : shipped.at(x);
        if (tolerance.relative) value = std::min(value, 1.0);  // as look-ups are
        const double off = std::abs(tolerance.relative ? value / exact - 1 : value - exact);
        const std::string place = shipped.height > 1 ? fmt::format("x = {:.4f}, y = {:.4f}", x, y)
                                                     : fmt::format("x = {:.4f}", x);
        compare(check, place, value, exact, off, off <= tolerance.largest);
    }
    return check;
}

}  // namespace regain::tools
