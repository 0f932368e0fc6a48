// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The closures of the library as subjects of the conformance kit: every lobe, distribution and
/// method that docs/support.md says go together, with what is promised of each.

#pragma once

#include <regain/conformance/subject.h>

namespace regain::tools {

/// Their names are LOBE.DISTRIBUTION.METHOD, "conductor.ggx.turquin", and then, of dielectrics,
/// what is not the default: "dielectric.ggx.turquin.beta", "dielectric.ggx.turquin.R",
/// "sheen.none". They live until the program ends.
const std::vector<const conformance::Subject*>& built_in_subjects();

}  // namespace regain::tools
