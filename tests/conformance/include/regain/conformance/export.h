// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Marks what the conformance library shows to those who link it; everything else is hidden.

#pragma once

#if defined(__GNUC__)
#define REGAIN_CONFORMANCE_API __attribute__((visibility("default")))
#else
#define REGAIN_CONFORMANCE_API
#endif
