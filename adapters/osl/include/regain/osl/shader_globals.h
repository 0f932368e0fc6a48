// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Where a shader runs.

#pragma once

#include <Imath/ImathVec.h>

#include <regain/closures/version.h>

REGAIN_NAMESPACE_BEGIN
namespace osl {

/// Of OSL's shader globals what closures need, in world space. As renderers hand them to shaders:
/// N and Ng are unit and face the viewer; `backfacing` where the surface itself faces away, so that
/// an interface is seen from inside.
struct ShaderGlobals
{
    Imath::V3f I{0.0f, 0.0f, -1.0f};  ///< unit, towards the surface; wo is -I
    Imath::V3f N{0.0f, 0.0f, 1.0f}, Ng{0.0f, 0.0f, 1.0f};
    Imath::V3f dPdu{1.0f, 0.0f, 0.0f};  ///< any length; stands in for a U of no length
    bool backfacing = false;
    float u = 0, v = 0;  ///< texture coordinates, v upwards
    Imath::V3f P{0.0f};  ///< position, in the object's space
};

}  // namespace osl
REGAIN_NAMESPACE_END
