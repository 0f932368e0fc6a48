// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#pragma once

#include "graph_closures.h"

REGAIN_NAMESPACE_BEGIN
namespace shaders {

/// Notes inputs of a closure or shader that its specification does not have: misspelt, or of
/// another version, they would have no effect in silence.
void note_unknown_inputs(const NodeInputs&);

}  // namespace shaders
REGAIN_NAMESPACE_END
