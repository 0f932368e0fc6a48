// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What a subject may be called: names go into commands and into names of files as they are.

#pragma once

#include <regain/closures/version.h>

#include <string>

REGAIN_NAMESPACE_BEGIN
namespace conformance {

/// Why not so, or an empty string.
inline std::string why_unusable(const std::string& name)
{
    const char* accepted = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_.";
    const bool usable = !name.empty() && name.size() <= 100 &&
                        name.find_first_not_of(accepted) == std::string::npos && name[0] != '-' &&
                        name[0] != '.';
    return usable ? ""
                  : "the name '" + name +
                        "' cannot be used; accepted: 1 to 100 letters, digits, '-', '_' and '.', "
                        "of which '-' and '.' not first";
}

}  // namespace conformance
REGAIN_NAMESPACE_END
