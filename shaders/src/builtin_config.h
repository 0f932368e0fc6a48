// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#pragma once

#include <regain/closures/version.h>

#include <OpenColorIO/OpenColorIO.h>

REGAIN_NAMESPACE_BEGIN
namespace shaders::detail {

/// Regain's own config, made anew from transforms that OpenColorIO has had since 2.1.
OCIO_NAMESPACE::ConstConfigRcPtr make_builtin_config();

}  // namespace shaders::detail
REGAIN_NAMESPACE_END
