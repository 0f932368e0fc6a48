// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// What registration.h takes of OSL 1.12 to 1.14, for machines without OSL: the layouts and
// signatures that its headers document, and nothing else.

#pragma once

#include <Imath/ImathColor.h>
#include <Imath/ImathVec.h>

namespace OSL {

struct ClosureColor
{
    enum ClosureID { COMPONENT_BASE_ID = 0, MUL = -1, ADD = -2 };
    int id;
};
struct alignas(16) ClosureComponent : ClosureColor
{
    Imath::V3f w;
};
struct ClosureMul : ClosureColor
{
    Imath::C3f weight;
    const ClosureColor* closure;
};
struct ClosureAdd : ClosureColor
{
    const ClosureColor* closureA;
    const ClosureColor* closureB;
};

}  // namespace OSL
