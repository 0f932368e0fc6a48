// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#pragma once

#include <OpenImageIO/typedesc.h>

namespace OSL {

struct ClosureParam
{
    OIIO::TypeDesc type;
    int offset;
    const char* key;
    int field_size;
};

}  // namespace OSL
