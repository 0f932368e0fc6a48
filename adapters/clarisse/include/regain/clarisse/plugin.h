// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A material as a shared object for the one-point host, as Clarisse's modules are: a class with
/// attributes, registered by a function of the library [on_register_module, the class file], whose
/// callbacks are a table.
///
///     extern "C" REGAIN_PLUGIN_EXPORT const regain::clarisse::MaterialModule*
///     regain_material_module();
///
/// The host and the module share the classes of host.h, so both are built with the same compiler
/// and version of this library, which the struct says and a host checks before it calls anything.

#pragma once

#include <regain/clarisse/host.h>
#include <regain/closures/parameter_info.h>

/// The name of the function, for whoever loads it.
#define REGAIN_MATERIAL_MODULE "regain_material_module"

REGAIN_NAMESPACE_BEGIN
namespace clarisse {

/// Static storage.
struct MaterialModule
{
    static constexpr int current = 1;

    int version;          ///< of this struct: `current`
    const char* library;  ///< REGAIN_VERSION_STRING
    const char* name;     ///< of the class
    const ParameterInfo* attributes;
    int attribute_count;

    /// An object of the class, for create_module_data. values has attribute_count entries. Null
    /// when it cannot be used, `error` then pointing to a sentence that says why, which lives until
    /// the next call. Nothing is thrown.
    void* (*create_object)(const ParameterValue* values, const char** error);
    void (*destroy_object)(void*);

    material_callbacks<float> callbacks;
};

using MaterialModuleFunction = const MaterialModule* (*)();

}  // namespace clarisse
REGAIN_NAMESPACE_END
