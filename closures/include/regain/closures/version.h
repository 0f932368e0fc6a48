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
#define REGAIN_NAMESPACE_BEGIN \
    namespace regain {         \
    inline namespace v0_1 {
#define REGAIN_NAMESPACE_END \
    }                        \
    }
