// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// `generalized_schlick`: a rough reflector with Schlick's curve and a tint at 82 degrees, the
/// artist's metal. MaterialX's and OSL's generalized_schlick_bsdf, scatter mode R.

#pragma once

#include <regain/closures/ggx.h>
#include <regain/closures/microfacet_reflection.h>
#include <regain/closures/schlick_fresnel.h>

REGAIN_NAMESPACE_BEGIN

template <class Real, class Distribution = GGX<Real>>
using GeneralizedSchlick = MicrofacetReflection<Distribution, SchlickFresnel<Real>>;

REGAIN_NAMESPACE_END
