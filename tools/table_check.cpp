// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "table_check.h"

#include "random_numbers.h"

#include <regain/luts/bake.h>
#include <regain/luts/builtin.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

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

// The node of an index; x is fastest.
std::string node(std::size_t i, const luts::Table& table)
{
    const auto width = static_cast<std::size_t>(table.width()),
               height = static_cast<std::size_t>(table.height());
    if (table.depth() == 1) return fmt::format("node ({}, {})", i % width, i / width);
    return fmt::format("node ({}, {}, {})", i % width, i / width % height, i / width / height);
}

std::string size(int width, int height, int depth)
{
    return depth > 1 ? fmt::format("{} x {} x {}", width, height, depth)
                     : fmt::format("{} x {}", width, height);
}

bool same_size(TableCheck& check, int width, int height, int depth, const luts::Table& baked)
{
    if (width == baked.width() && height == baked.height() && depth == baked.depth()) return true;
    check.differing = 1;
    check.worst =
        Mismatch{fmt::format("size {} in place of {}: number of nodes", size(width, height, depth),
                             size(baked.width(), baked.height(), baked.depth())),
                 static_cast<double>(width) * height * depth,
                 static_cast<double>(baked.width()) * baked.height() * baked.depth()};
    return false;
}

// Numbers of a header that have to be equal; an absent name is a text that differs.
void compare_headers(TableCheck& check, const luts::TableInfo& shipped,
                     const luts::TableInfo& baked, double error_tolerance)
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
    text("axis_z", shipped.axis_z, baked.axis_z);
    text("axis_4", shipped.axis_4, baked.axis_4);
    text("axis_5", shipped.axis_5, baked.axis_5);
    text("transmission_shadowing", shipped.transmission_shadowing, baked.transmission_shadowing);
    text("side", shipped.side, baked.side);
    text("transform", shipped.transform, baked.transform);
    text("method", shipped.method, baked.method);
    text("error_kind", shipped.error_kind, baked.error_kind);
    number("gamma", shipped.gamma, baked.gamma, 0);
    number("nodes", shipped.nodes, baked.nodes, 0);
    number("length_4", shipped.length_4, baked.length_4, 0);
    number("length_5", shipped.length_5, baked.length_5, 0);
    number("offset", shipped.offset, baked.offset, 0);
    number("scale", shipped.scale, baked.scale, 0);
    number("error", shipped.error, baked.error, error_tolerance);
}

}  // namespace

TableCheck check_builtin(const luts::Table& baked)
{
    TableCheck check;
    check.table = baked.name();
    check.against = "compiled in";
    const TableView shipped = luts::builtin_table(baked.name()), expected = baked.view();
    if (!same_size(check, shipped.width, shipped.height, shipped.depth, baked)) return check;
    compare(check, "offset", shipped.offset, expected.offset,
            std::abs(shipped.offset - expected.offset), shipped.offset == expected.offset);
    compare(check, "scale", shipped.scale, expected.scale, std::abs(shipped.scale - expected.scale),
            shipped.scale == expected.scale);
    for (std::size_t i = 0; i < baked.stored().size(); ++i)
    {
        const int a = shipped.data[i], b = expected.data[i];
        compare(check, node(i, baked), a, b, std::abs(a - b) * double(expected.scale), a == b);
    }
    return check;
}

TableCheck check_file(const luts::Table& baked, const luts::Table& shipped, const std::string& file)
{
    TableCheck check;
    check.table = baked.name();
    check.against = file;
    if (!same_size(check, shipped.width(), shipped.height(), shipped.depth(), baked)) return check;
    const double largest_step = luts::storage_step(baked, 1);
    compare_headers(check, shipped.info(), baked.info(), std::max(file_tolerance, largest_step));
    const bool rounded = largest_step > 0;
    for (std::size_t i = 0; i < baked.values().size(); ++i)
    {
        const double a = shipped.values()[i], b = baked.values()[i], d = std::abs(a - b);
        const double step = rounded ? luts::storage_step(baked, b) : 0;
        compare(check, node(i, baked), a, b, d, d <= std::max(file_tolerance, 1.01 * step));
    }
    return check;
}

SpotTolerance spot_tolerance(const std::string& table)
{
    const std::string quantity = table.substr(table.find('_') + 1);
    if (quantity == "E_ss" || quantity == "E_avg" || quantity == "balance") return {1e-3, true};
    // The mean of Schlick's falloff bends the most, where all of it is small.
    if (quantity == "falloff") return {6e-3, false};
    // Of walks, and of the few of them that meet a second facet.
    if (quantity == "q_ms") return {0.02, false};
    if (quantity == "mu_ms") return {0.08, false};
    // The spread of what hardly goes on ahead is anybody's guess.
    if (quantity == "spread" || quantity == "tilt") return {0.4, false};
    if (quantity == "forward") return {0.08, false};
    return {1e-3, false};
}

SpotTolerance spot_tolerance(const luts::Table& table)
{
    return {2 * table.info().error + 1e-4, table.info().error_kind == "relative"};
}

namespace {

// `axes` are 1 to 5; `look_up` answers the table's number at a place.
TableCheck compare_spots(const std::string& name, int axes,
                         const std::function<double(const luts::TablePoint&)>& look_up,
                         const SpotTolerance& tolerance, const std::string& against, int spots)
{
    TableCheck check;
    check.table = name;
    check.against = against;
    const bool logarithm = luts::is_logarithmic(name);
    // Of walks it takes as many as for a node, and a while, and so does a balance.
    const luts::TableInfo info = luts::bakeable_info(name);
    const bool walked = info.method.find("walks") != std::string::npos;
    const int accuracy = walked ? info.nodes : axes > 3 ? 16 : axes == 3 ? 32 : 64;
    if (walked || info.quantity == "balance_anisotropy") spots = std::min(spots, 10);
    RandomNumbers random(0);
    while (check.numbers < spots)
    {
        luts::TablePoint at;
        at.x = random.next<double>();
        at.y = random.next<double>();
        if (axes > 2) at.z = random.next<double>();
        if (axes > 3) at.v = random.next<double>();
        if (axes > 4) at.w = random.next<double>();
        if (!luts::is_error_promised(name, at)) continue;
        double exact = luts::exact_value(name, at, accuracy);
        double value = look_up(at);
        if (logarithm) exact = std::exp(exact), value = std::exp(value);
        if (tolerance.relative && exact < luts::smallest_promised(name)) continue;
        if (tolerance.relative) value = std::min(value, luts::greatest_answer(name));
        const double off = std::abs(tolerance.relative ? value / exact - 1 : value - exact);
        std::string place = fmt::format("x = {:.4f}", at.x);
        if (axes > 1) place += fmt::format(", y = {:.4f}", at.y);
        if (axes > 2) place += fmt::format(", z = {:.4f}", at.z);
        if (axes > 3) place += fmt::format(", v = {:.4f}", at.v);
        if (axes > 4) place += fmt::format(", w = {:.4f}", at.w);
        compare(check, place, value, exact, off, off <= tolerance.largest);
    }
    return check;
}

}  // namespace

TableCheck check_spots(const std::string& name, const TableView& shipped,
                       const SpotTolerance& tolerance, const std::string& against, int spots)
{
    return compare_spots(
        name,
        shipped.depth > 1    ? 3
        : shipped.height > 1 ? 2
                             : 1,
        [&](const luts::TablePoint& at) { return luts::interpolated(shipped, at); }, tolerance,
        against, spots);
}

TableCheck check_spots(const luts::Table& shipped, const std::string& against, int spots)
{
    const SpotTolerance tolerance = spot_tolerance(shipped);
    if (shipped.info().axis_4.empty())
        return check_spots(shipped.name(), shipped.view(), tolerance, against, spots);
    return compare_spots(
        shipped.name(), shipped.info().axis_5.empty() ? 4 : 5,
        [&](const luts::TablePoint& at) { return luts::interpolated(shipped, at); }, tolerance,
        against, spots);
}

}  // namespace regain::tools
