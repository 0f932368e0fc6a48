// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What can be seen of a closure by looking at its numbers.

#pragma once

#include <regain/shaders/planner.h>

#include <string>

REGAIN_NAMESPACE_BEGIN
namespace shaders::planning {

/// All but layering and multiple scattering, which are not the closure's alone.
CalledFor called_for_by(const ClosureTree::Material&);

void add(CalledFor&, const CalledFor&);

/// It scatters nothing, whatever the direction.
bool is_black(const ClosureTree::Material&);

/// The same closure where another name for it costs less.
MicrofacetMaterial simplified(MicrofacetMaterial);

/// MaterialX's name.
std::string closure_name(const ClosureTree::Material&);

}  // namespace shaders::planning
REGAIN_NAMESPACE_END
