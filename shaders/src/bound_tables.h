// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The tables that materials have bound, by the names of their files.

#pragma once

#include <regain/shaders/planner.h>

#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace shaders::planning {

/// Adds those of a material whose tables are bound that its method reads, or its albedo, where a
/// host asks for it; each is there once.
void add_bound_tables(const MicrofacetMaterial&, bool for_albedo, std::vector<PlannedTable>&);

/// The same.
void add_table(const PlannedTable&, std::vector<PlannedTable>&);

}  // namespace shaders::planning
REGAIN_NAMESPACE_END
