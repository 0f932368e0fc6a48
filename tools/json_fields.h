// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// One JSON object, read field by field: whatever is wrong with a field is said together with what
/// is accepted, and a field that nobody asked for is an error, because it is a misspelt one.

#pragma once

#include <Imath/ImathColor.h>
#include <Imath/ImathVec.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace regain::tools {

using Json = nlohmann::json;
using ColorD = Imath::Color3<double>;

/// The numbers from lo to hi; hi itself belongs to them unless `half_open`.
struct Range
{
    double lo, hi;
    bool half_open = false;

    bool contains(double x) const { return lo <= x && (half_open ? x < hi : x <= hi); }
    std::string text() const;
};

constexpr Range unit_range{0, 1};

/// How far from 1 the length of a direction may be.
constexpr double direction_tolerance = 1e-3;

/// Every reader throws BadInput for a value of the wrong kind or out of range, and answers nothing
/// for a field that is not there. Ask for a field once only.
class Fields
{
public:
    /// The object outlives the Fields; anything but an object is BadInput. `what` names it in
    /// messages.
    Fields(const Json& object, std::string_view what);

    bool has(std::string_view name) const { return _object.contains(name); }

    std::optional<double> number(std::string_view name, Range range);
    std::optional<std::uint64_t> count(std::string_view name, std::uint64_t lo, std::uint64_t hi);
    std::optional<ColorD> color(std::string_view name, Range range);
    /// A number for all channels, or a list of three.
    std::optional<ColorD> grey_or_color(std::string_view name, Range range);
    /// A number for both, or a list of two.
    std::optional<Imath::V2d> one_or_two(std::string_view name, Range range);
    /// A list of exactly two numbers.
    std::optional<Imath::V2d> two(std::string_view name, Range range);
    /// A list of exactly `size` numbers, 2 or 3; what is not given is 0.
    std::optional<Imath::V3d> numbers(std::string_view name, std::size_t size, Range range);
    /// true or false.
    std::optional<bool> flag(std::string_view name);
    /// A unit vector, as given: it is not normalised.
    std::optional<Imath::V3d> direction(std::string_view name);
    std::optional<std::string_view> text(std::string_view name);
    /// Another object.
    const Json* object(std::string_view name);

    /// Throws if the field is there, with `why` it cannot be used.
    void reject(std::string_view name, std::string_view why) const;
    /// Throws: the field is needed. `name` may say how it is spelt and what may stand for it.
    [[noreturn]] void missing(std::string_view name) const;
    /// Throws if there is a field that nobody asked for.
    void finish() const;

private:
    const Json* find(std::string_view name);

    const Json& _object;
    std::string_view _what;
    std::array<std::string_view, 32> _asked;
    std::size_t _asked_count = 0, _found = 0;
};

/// One of `accepted`, as an index. Throws BadInput: "there is no distribution 'beckman'; accepted:
/// ggx, beckmann".
std::size_t choose(std::string_view kind, std::string_view given, const std::string_view* accepted,
                   std::size_t accepted_count);

template <std::size_t N>
std::size_t choose(std::string_view kind, std::string_view given,
                   const std::array<std::string_view, N>& accepted)
{
    return choose(kind, given, accepted.data(), N);
}

/// A value as it may stand in a message: short, whatever was given.
std::string shown(const Json& value);
std::string excerpt(std::string_view text);

}  // namespace regain::tools
