// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Configs that a studio might have, each with another way from XYZ to scene_linear.

#pragma once

#include <regain/shaders/color_config.h>

#include <stdexcept>
#include <string>

namespace test {

/// The text with `from` replaced by `to`, once.
inline std::string replaced(std::string text, const std::string& from, const std::string& to)
{
    const auto at = text.find(from);
    if (at == std::string::npos) throw std::logic_error("no '" + from + "' in the config");
    return text.replace(at, from.size(), to);
}

/// The built-in config with another working space.
inline std::string working_in(const std::string& space)
{
    return replaced(regain::shaders::ColorConfig::builtin().text(), "scene_linear: ACEScg",
                    "scene_linear: " + space);
}

/// Only the display-referred interchange role.
inline std::string without_aces_role()
{
    return replaced(working_in("ACEScg"), "  aces_interchange: ACES2065-1\n", "");
}

/// Before the roles: ACES2065-1 is known by its name alone. In the format of OpenColorIO 1.
constexpr const char* version_1 = R"(ocio_profile_version: 1

search_path: ""
strictparsing: true
luma: [0.2126, 0.7152, 0.0722]

roles:
  default: lin_ap0
  scene_linear: lin_rec709

displays:
  monitor:
    - !<View> {name: plain, colorspace: lin_rec709}

active_displays: []
active_views: []

colorspaces:
  - !<ColorSpace>
    name: lin_ap0
    isdata: false

  - !<ColorSpace>
    name: lin_rec709
    isdata: false
    to_reference: !<MatrixTransform> {matrix: [0.4396, 0.3830, 0.1774, 0, 0.0898, 0.8134, 0.0968, 0, 0.0175, 0.1115, 0.8710, 0, 0, 0, 0, 1]}
)";

/// As version_1, but nothing says where XYZ is.
inline std::string without_a_way()
{
    std::string text = version_1;
    for (std::size_t at; (at = text.find("lin_ap0")) != std::string::npos;)
        text.replace(at, 7, "whatever");
    return text;
}

}  // namespace test
