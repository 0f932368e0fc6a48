// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What a user can ask of `regain render`, as given.

#pragma once

#include "part_options.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace regain::tools {

/// What goes with some materials only is optional, or empty: where it does not go it has to be
/// known whether it was given.
struct RenderOptions
{
    std::string output = "regain.exr";
    std::string method;
    std::optional<double> tolerance;
    std::string costs;
    std::string material = "metal";

    std::optional<std::string> metal;
    std::optional<double> ior;
    bool thin_walled = false;
    std::optional<std::string> scatter_mode, transmission_shadowing;
    std::vector<double> weights;  // of sheen
    std::optional<double> base;

    std::optional<std::string> distribution;
    std::optional<double> gamma;
    std::vector<double> alphas;
    std::optional<double> alpha_ratio;

    std::vector<std::string> documents, selected;
    std::string wedge;
    std::int64_t columns = 6;
    bool labels = false;

    std::string plugin;
    std::vector<std::string> settings;  // of it

    std::string object = "widget";
    std::optional<std::string> host;  // renderman, or that of the plug-in
    std::string environment;
    double rotate = 0, turn = 0;
    std::int64_t turntable = 0;
    bool watch = false;
    bool furnace = false;
    std::string aovs;
    bool resume = false;
    PartOptions parts;
    std::string difference;
    std::optional<double> scale;
    std::int64_t samples = 64;
    std::int64_t seed = 1;
    std::string size;
    std::int64_t threads = 0;
    std::int64_t bounces = 0;
    std::string display, view;
    bool quiet = false, json = false;
};

/// Adds them to the command, with their help and the examples. The options outlive the parsing.
void declare(RenderOptions&, CLI::App& command);

}  // namespace regain::tools
