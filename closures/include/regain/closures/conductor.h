// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// `conductor`: a rough metal with exact Fresnel reflectance from n and k per channel. MaterialX's
/// conductor_bsdf, OSL's conductor_bsdf.

#pragma once

#include <regain/closures/conductor_fresnel.h>
#include <regain/closures/ggx.h>
#include <regain/closures/microfacet_reflection.h>

REGAIN_NAMESPACE_BEGIN

template <class Real, class Distribution = GGX<Real>>
using Conductor = MicrofacetReflection<Distribution, ConductorFresnel<Real>>;

REGAIN_NAMESPACE_END
