// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A material as a shared object for the batched host, as RenderMan's are: a factory made once, and
/// data for each instance of the material [RixBxdfFactory, CreateRixBxdfFactory, GetParamTable,
/// CreateInstanceData].
///
///     extern "C" REGAIN_PLUGIN_EXPORT const regain::renderman::BxdfPlugin* regain_bxdf_plugin();
///
/// The host and the plug-in share the classes of host.h, so both are built with the same compiler
/// and version of this library, which the struct says and a host checks before it calls anything.

#pragma once

#include <regain/closures/parameter_info.h>
#include <regain/renderman/host.h>

/// The name of the function, for whoever loads it.
#define REGAIN_BXDF_PLUGIN "regain_bxdf_plugin"

REGAIN_NAMESPACE_BEGIN
namespace renderman {

/// Static storage.
struct BxdfPlugin
{
    static constexpr int current = 1;

    int version;          ///< of this struct: `current`
    const char* library;  ///< REGAIN_VERSION_STRING
    const char* name;
    const ParameterInfo* parameters;
    int parameter_count;

    /// Once; null when it cannot be made.
    Factory* (*create_factory)();
    void (*destroy_factory)(Factory*);

    /// values has parameter_count entries. Null when it cannot be used, `error` then pointing to a
    /// sentence that says why, which lives until the next call. Nothing is thrown.
    void* (*create_instance_data)(const ParameterValue* values, const char** error);
    void (*destroy_instance_data)(void*);
};

using BxdfPluginFunction = const BxdfPlugin* (*)();

}  // namespace renderman
REGAIN_NAMESPACE_END
