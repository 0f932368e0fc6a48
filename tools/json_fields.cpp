// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "json_fields.h"

#include "errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cfloat>
#include <cmath>

namespace regain::tools {
namespace {

constexpr std::size_t longest_shown = 60;

std::string kind(const Json& value)
{
    switch (value.type())
    {
        case Json::value_t::null: return "null";
        case Json::value_t::boolean: return value.get<bool>() ? "true" : "false";
        case Json::value_t::string: return "the text " + shown(value);
        case Json::value_t::object: return "an object";
        case Json::value_t::array: return "a list of " + std::to_string(value.size());
        default: return shown(value);
    }
}

[[noreturn]] void not_accepted(std::string_view name, const std::string& given,
                               const std::string& accepted)
{
    throw BadInput(fmt::format("'{}' is {}; accepted: {}", name, given, accepted));
}

double number_in(std::string_view name, const Json& value, Range range, std::string_view what)
{
    // A number may be written as an integer of any size.
    if (value.is_number())
    {
        const double x = value.get<double>();
        if (range.contains(x)) return x;
    }
    not_accepted(name, kind(value), fmt::format("{} {}", what, range.text()));
}

void list_of(std::string_view name, const Json& value, std::size_t size, Range range)
{
    if (!value.is_array() || value.size() != size)
        not_accepted(name, kind(value), fmt::format("a list of {} numbers {}", size, range.text()));
}

template <class Names>
std::string joined(const Names& begin, std::size_t count)
{
    std::vector<std::string_view> sorted(begin, begin + count);
    return fmt::format("{}", fmt::join(sorted, ", "));
}

}  // namespace

std::string Range::text() const
{
    if (half_open) return fmt::format("from {} to below {}", lo, hi);
    return fmt::format("from {} to {}", lo, hi);
}

std::string excerpt(std::string_view text)
{
    if (text.size() <= longest_shown) return fmt::format("'{}'", text);
    return fmt::format("'{}...'", text.substr(0, longest_shown));
}

std::string shown(const Json& value)
{
    if (value.is_string()) return excerpt(value.get_ref<const std::string&>());
    // Lists may be deep, and writing them out would recurse.
    return value.is_structured() ? kind(value) : value.dump();
}

Fields::Fields(const Json& object, std::string_view what) : _object(object), _what(what)
{
    if (!object.is_object())
        throw BadInput(fmt::format("{} is {}; accepted: an object", what, kind(object)));
}

const Json* Fields::find(std::string_view name)
{
    if (_asked_count < _asked.size()) _asked[_asked_count++] = name;
    const auto at = _object.find(name);
    if (at == _object.end()) return nullptr;
    ++_found;
    return &*at;
}

std::optional<double> Fields::number(std::string_view name, Range range)
{
    const Json* value = find(name);
    if (!value) return std::nullopt;
    return number_in(name, *value, range, "a number");
}

std::optional<std::uint64_t> Fields::count(std::string_view name, std::uint64_t lo,
                                           std::uint64_t hi)
{
    const Json* value = find(name);
    if (!value) return std::nullopt;
    if (value->is_number_unsigned())
    {
        const std::uint64_t n = value->get<std::uint64_t>();
        if (lo <= n && n <= hi) return n;
    }
    not_accepted(name, kind(*value), fmt::format("a whole number from {} to {}", lo, hi));
}

std::optional<ColorD> Fields::color(std::string_view name, Range range)
{
    const Json* value = find(name);
    if (!value) return std::nullopt;
    list_of(name, *value, 3, range);
    constexpr std::string_view what = "three numbers";
    return ColorD(number_in(name, (*value)[0], range, what),
                  number_in(name, (*value)[1], range, what),
                  number_in(name, (*value)[2], range, what));
}

std::optional<ColorD> Fields::grey_or_color(std::string_view name, Range range)
{
    const auto at = _object.find(name);
    if (at != _object.end() && at->is_array()) return color(name, range);
    const auto grey = number(name, range);
    if (!grey) return std::nullopt;
    return ColorD(*grey);
}

std::optional<Imath::V2d> Fields::one_or_two(std::string_view name, Range range)
{
    const auto at = _object.find(name);
    if (at != _object.end() && at->is_array()) return two(name, range);
    const std::optional<double> both = number(name, range);
    if (!both) return std::nullopt;
    return Imath::V2d(*both);
}

std::optional<Imath::V2d> Fields::two(std::string_view name, Range range)
{
    const Json* value = find(name);
    if (!value) return std::nullopt;
    list_of(name, *value, 2, range);
    constexpr std::string_view what = "two numbers";
    return Imath::V2d(number_in(name, (*value)[0], range, what),
                      number_in(name, (*value)[1], range, what));
}

std::optional<Imath::V3d> Fields::numbers(std::string_view name, std::size_t size, Range range)
{
    const Json* value = find(name);
    if (!value) return std::nullopt;
    list_of(name, *value, size, range);
    Imath::V3d list(0.0);
    for (unsigned i = 0; i < size; ++i)
        list[static_cast<int>(i)] =
            number_in(name, (*value)[i], range, size == 2 ? "two numbers" : "three numbers");
    return list;
}

std::optional<bool> Fields::flag(std::string_view name)
{
    const Json* value = find(name);
    if (!value) return std::nullopt;
    if (!value->is_boolean()) not_accepted(name, kind(*value), "true or false");
    return value->get<bool>();
}

std::optional<Imath::V3d> Fields::direction(std::string_view name)
{
    const Json* value = find(name);
    if (!value) return std::nullopt;
    // A component that is too large shows in the length.
    constexpr Range component{-DBL_MAX, DBL_MAX};
    if (!value->is_array() || value->size() != 3)
        not_accepted(name, kind(*value), "a list of three numbers");
    Imath::V3d w;
    for (unsigned i = 0; i < 3; ++i)
        w[static_cast<int>(i)] = number_in(name, (*value)[i], component, "three numbers");
    const double length = std::sqrt(w.dot(w));
    if (!(std::abs(length - 1) <= direction_tolerance))
        not_accepted(
            name, fmt::format("a vector of length {:.6g}", length),
            fmt::format("a unit vector, of length 1 within {}: normalise it", direction_tolerance));
    return w;
}

std::optional<std::string_view> Fields::text(std::string_view name)
{
    const Json* value = find(name);
    if (!value) return std::nullopt;
    if (!value->is_string()) not_accepted(name, kind(*value), "a text");
    return std::string_view(value->get_ref<const std::string&>());
}

const Json* Fields::object(std::string_view name)
{
    const Json* value = find(name);
    if (value && !value->is_object()) not_accepted(name, kind(*value), "an object");
    return value;
}

void Fields::reject(std::string_view name, std::string_view why) const
{
    if (has(name)) throw BadInput(fmt::format("'{}' cannot be used: {}", name, why));
}

void Fields::missing(std::string_view name) const
{
    std::string given;
    for (const auto& item : _object.items())
        if (given.size() < longest_shown) given += (given.empty() ? "" : ", ") + item.key();
    if (given.size() > 2 * longest_shown) given = given.substr(0, 2 * longest_shown) + "...";
    throw BadInput(fmt::format("{} is missing in {}; given: {}", name, _what,
                               given.empty() ? "nothing" : given));
}

void Fields::finish() const
{
    if (_found == _object.size()) return;
    const auto begin = _asked.begin(), end = begin + static_cast<std::ptrdiff_t>(_asked_count);
    for (const auto& item : _object.items())
        if (std::find(begin, end, item.key()) == end)
            throw BadInput(fmt::format("{} has no field {}; accepted: {}", _what,
                                       excerpt(item.key()), joined(_asked.data(), _asked_count)));
}

std::size_t choose(std::string_view kind, std::string_view given, const std::string_view* accepted,
                   std::size_t accepted_count)
{
    const std::string_view* end = accepted + accepted_count;
    const std::string_view* at = std::find(accepted, end, given);
    if (at != end) return static_cast<std::size_t>(at - accepted);

    throw BadInput(fmt::format("there is no {} {}; accepted: {}", kind, excerpt(given),
                               joined(accepted, accepted_count)));
}

}  // namespace regain::tools
