// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Marks what the luts library shows to those who link it; everything else is hidden.

#pragma once

#if defined(__GNUC__)
#define REGAIN_LUTS_API __attribute__((visibility("default")))
#else
#define REGAIN_LUTS_API
#endif
