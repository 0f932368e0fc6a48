// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "part.h"

#include "errors.h"

#include <fmt/format.h>

#include <charconv>
#include <numeric>

namespace regain::tools {

bool Part::holds(std::size_t i, std::size_t across) const
{
    // Where rows repeat, the next ones begin with another part.
    const std::size_t shift = across > 1 ? i / std::lcm(across, of) : 0;
    return (i + shift) % of == number - 1;
}

std::string Part::text() const { return fmt::format("{}/{}", number, of); }

Part part_named(const std::string& text)
{
    Part part;
    const char* const end = text.data() + text.size();
    const auto k = std::from_chars(text.data(), end, part.number);
    const bool divided = k.ec == std::errc() && k.ptr != end && *k.ptr == '/';
    const auto n =
        divided ? std::from_chars(k.ptr + 1, end, part.of) : std::from_chars_result{end, k.ec};
    if (!divided || n.ec != std::errc() || n.ptr != end || part.number < 1 ||
        part.number > part.of || part.of > Part::most)
        throw BadInput(
            fmt::format("--part: '{}' is no part: takes K/N, 1 <= K <= N <= {}, for example 3/7",
                        text, Part::most));
    return part;
}

std::filesystem::path part_file_name(const std::filesystem::path& stem, const Part& part)
{
    return stem.parent_path() /
           fmt::format("{}.part-{}-of-{}", stem.filename().string(), part.number, part.of);
}

}  // namespace regain::tools
