// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Names that a user types, and lists of those that are accepted.

#pragma once

#include <regain/closures/version.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace shaders::detail {

/// True if both are the same but for the case of ASCII letters.
inline bool same_letters(std::string_view a, std::string_view b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char x, unsigned char y) {
        return std::tolower(x) == std::tolower(y);
    });
}

/// "a, b, c"; "none" if there are none.
inline std::string listed(const std::vector<std::string>& names)
{
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
    return list.empty() ? "none" : list;
}

}  // namespace shaders::detail
REGAIN_NAMESPACE_END
