// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "wide_makers.h"

REGAIN_NAMESPACE_BEGIN
namespace shaders { namespace wide {

const WideMaker REGAIN_WIDE(ggx) = Makes<WithDistribution<GGX>>::maker;

}}  // namespace shaders::wide
REGAIN_NAMESPACE_END
