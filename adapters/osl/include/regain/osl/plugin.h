// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A shader as a shared object for the OSL-shaped host, in the place of a compiled .oso: it leaves
/// a tree of closures in Ci, and knows nothing of what a renderer makes of them.
///
///     extern "C" REGAIN_PLUGIN_EXPORT const regain::osl::ShaderPlugin* regain_shader_plugin();
///
/// The host and the plug-in share nodes, parameters and globals, so both are built with the same
/// version of this library, which the struct says and a host checks before it calls anything.

#pragma once

#include <regain/closures/parameter_info.h>
#include <regain/osl/closure_params.h>
#include <regain/osl/shader_globals.h>

/// The name of the function, for whoever loads it.
#define REGAIN_SHADER_PLUGIN "regain_shader_plugin"

REGAIN_NAMESPACE_BEGIN
namespace osl {

/// Static storage.
struct ShaderPlugin
{
    static constexpr int current = 1;

    int version;          ///< of this struct: `current`
    const char* library;  ///< REGAIN_VERSION_STRING
    const char* name;
    const ParameterInfo* parameters;
    int parameter_count;

    /// A shader with these values, parameter_count of them. Null when it cannot be made, `error`
    /// then pointing to a sentence that says why, which lives until the next call. Nothing is
    /// thrown.
    void* (*create_shader)(const ParameterValue* values, const char** error);
    void (*destroy_shader)(void*);

    /// Ci at a point; null is black. From any thread; nothing is allocated but in the pool.
    const ClosureColor* (*shade)(const void* shader, const ShaderGlobals&, NodePool&);
};

using ShaderPluginFunction = const ShaderPlugin* (*)();

}  // namespace osl
REGAIN_NAMESPACE_END
