// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What a plan is, for people and for machines; and where its numbers are from.

#pragma once

#include <regain/shaders/planner.h>

#include <nlohmann/json.hpp>

#include <string>

namespace regain::tools {

/// Those of a file that `regain cost --planner-data` wrote; of no name the compiled-in ones. Throws
/// BadInput, which names the option --costs.
shaders::MethodCosts method_costs(const std::string& file);

/// Throws BadInput unless it is in [0, 1].
void check_tolerance(double);

nlohmann::ordered_json as_json(const shaders::ScenePlan&, double tolerance);

/// Lines for a terminal.
std::string as_text(const shaders::ScenePlan&, double tolerance);

/// "metal directional, diffuse none": what was chosen of each closure, for metadata.
std::string chosen_methods(const shaders::MaterialPlan&);

}  // namespace regain::tools
