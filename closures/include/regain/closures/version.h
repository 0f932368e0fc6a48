// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The version of Regain, and the inline namespace that keeps two versions in one process apart.

#pragma once

#define REGAIN_VERSION_MAJOR 0
#define REGAIN_VERSION_MINOR 1
#define REGAIN_VERSION_PATCH 0
#define REGAIN_VERSION_STRING "0.1.0"

// Every public name lives in regain::v0_1 and is written regain::name. The inline namespace changes
// with each release that breaks the ABI, so a host and its plug-ins may link different ones.
#ifdef REGAIN_COUNT  // see count.h
#define REGAIN_ABI_NAMESPACE v0_1_counted
#else
#define REGAIN_ABI_NAMESPACE v0_1
#endif
#define REGAIN_NAMESPACE_BEGIN \
    namespace regain {         \
    inline namespace REGAIN_ABI_NAMESPACE {
#define REGAIN_NAMESPACE_END \
    }                        \
    }
