// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#pragma once

#include "definition.h"

REGAIN_NAMESPACE_BEGIN
namespace luts {

/// What bake() does for tables of five axes.
Table bake_grid(const Definition& definition, const BakeProgress& progress);

}  // namespace luts
REGAIN_NAMESPACE_END
