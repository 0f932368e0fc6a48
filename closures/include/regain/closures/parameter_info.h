// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// How a material in a shared object tells its host what it can be set to. Plain data with static
/// storage, so that it crosses from one compiler to another.

#pragma once

#include <regain/closures/version.h>

/// Before a function that a host looks up by its name.
#if defined(_WIN32)
#define REGAIN_PLUGIN_EXPORT __declspec(dllexport)
#else
#define REGAIN_PLUGIN_EXPORT __attribute__((visibility("default")))
#endif

REGAIN_NAMESPACE_BEGIN

/// A number, or a linear colour of three. A host hands values over that are finite and within
/// [least, most] in every component.
struct ParameterInfo
{
    const char* name;
    int components;  ///< 1 or 3
    float initial[3];
    float least, most;
    const char* help;  ///< one line
};

/// The value of one parameter; of a number the first is read.
struct ParameterValue
{
    float v[3];
};

REGAIN_NAMESPACE_END
