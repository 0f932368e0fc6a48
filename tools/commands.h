// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The commands, one file each. A command adds its subcommand to the application and, as the
/// subcommand's callback, runs itself through `run_reporting` and leaves the exit code.

#pragma once

namespace CLI {
class App;
}

namespace regain::tools {

// Add each command here and in main.cpp, in the order in which --help should list them.
void add_render(CLI::App& app, int& exit_code);
void add_figures(CLI::App& app, int& exit_code);
void add_albedo(CLI::App& app, int& exit_code);
void add_query(CLI::App& app, int& exit_code);
void add_bake(CLI::App& app, int& exit_code);
void add_conform(CLI::App& app, int& exit_code);
void add_cost(CLI::App& app, int& exit_code);
void add_plan(CLI::App& app, int& exit_code);
void add_presets(CLI::App& app, int& exit_code);

struct RenderOptions;
/// What `regain render` does with these options; throws what run_reporting reports.
int render(const RenderOptions&);

}  // namespace regain::tools
