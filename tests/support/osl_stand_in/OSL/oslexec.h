// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#pragma once

#include <OSL/genclosure.h>

#include <OpenImageIO/string_view.h>

#include <string>
#include <vector>

namespace OSL {

class RendererServices;
using PrepareClosureFunc = void (*)(RendererServices*, int id, void* data);
using SetupClosureFunc = void (*)(RendererServices*, int id, void* data);

// Keeps what it is told.
class ShadingSystem
{
public:
    struct Closure
    {
        std::string name;
        int id;
        std::vector<ClosureParam> params;
    };
    std::vector<Closure> closures;

    void register_closure(OIIO::string_view name, int id, const ClosureParam* params,
                          PrepareClosureFunc, SetupClosureFunc)
    {
        Closure c{std::string(name), id, {}};
        for (; params->type != OIIO::TypeDesc(); ++params) c.params.push_back(*params);
        c.params.push_back(*params);
        closures.push_back(c);
    }
};

}  // namespace OSL
