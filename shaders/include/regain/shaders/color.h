// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The colour type of the colour computations, which are done in double; Imath names none.

#pragma once

#include <regain/closures/version.h>

#include <Imath/ImathColor.h>

REGAIN_NAMESPACE_BEGIN
namespace shaders {

using C3d = Imath::Color3<double>;

}  // namespace shaders
REGAIN_NAMESPACE_END
