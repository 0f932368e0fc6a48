// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// For hosts that have OSL: tells a shading system of all closures, so that what it leaves in Ci
/// can be handed to ClosureLibrary::flatten as it is. The only header here that includes OSL's.
///
///     osl::register_closures(*shading_system);
///     ...
///     library.flatten(osl::closures_of(sg.Ci), globals, bsdf);

#pragma once

#include <OSL/genclosure.h>
#include <OSL/oslclosure.h>
#include <OSL/oslexec.h>

#include <regain/osl/closure_params.h>

#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace osl {

static_assert(sizeof(ClosureColor) == sizeof(OSL::ClosureColor), "");
static_assert(sizeof(ClosureComponent) == sizeof(OSL::ClosureComponent), "");
static_assert(sizeof(ClosureMul) == sizeof(OSL::ClosureMul), "");
static_assert(sizeof(ClosureAdd) == sizeof(OSL::ClosureAdd), "");
static_assert(int(ClosureColor::mul) == int(OSL::ClosureColor::MUL), "");
static_assert(int(ClosureColor::add) == int(OSL::ClosureColor::ADD), "");

/// The nodes themselves: they have the same layout.
inline const ClosureColor* closures_of(const OSL::ClosureColor* Ci)
{
    return reinterpret_cast<const ClosureColor*>(Ci);
}

namespace detail {

inline OIIO::TypeDesc type_desc(ParamType type)
{
    using T = OIIO::TypeDesc;
    switch (type)
    {
        case ParamType::integer: return T(T::INT);
        case ParamType::real: return T(T::FLOAT);
        case ParamType::color: return T(T::FLOAT, T::VEC3, T::COLOR);
        case ParamType::vector: return T(T::FLOAT, T::VEC3, T::VECTOR);
        case ParamType::string: return T(T::STRING);
        case ParamType::closure: return T(T::PTR);
    }
    return T();
}

}  // namespace detail

/// Once, before shaders are compiled. Identifiers are those of ClosureId; a host's own are others.
template <class ShadingSystem = OSL::ShadingSystem>
void register_closures(ShadingSystem& system)
{
    for (int id = 0; id < closure_ids; ++id)
    {
        const ClosureInfo& closure = closure_info(id);
        std::vector<OSL::ClosureParam> params;
        for (int k = 0; k < closure.count; ++k)
        {
            const ParamInfo& p = closure.params[k];
            params.push_back({detail::type_desc(p.type), p.offset, p.key, p.size});
        }
        // What ends a list says how large and how aligned the struct is.
        params.push_back({OIIO::TypeDesc(), closure.size, nullptr, closure.alignment});
        system.register_closure(closure.name, closure.id, params.data(), nullptr, nullptr);
    }
}

}  // namespace osl
REGAIN_NAMESPACE_END
