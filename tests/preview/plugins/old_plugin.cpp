// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// A plug-in of a version that no host knows.

#include <regain/renderman/plugin.h>

extern "C" REGAIN_PLUGIN_EXPORT const regain::renderman::BxdfPlugin* regain_bxdf_plugin()
{
    static constexpr regain::renderman::BxdfPlugin plugin{99,      "",      "old",   nullptr, 0,
                                                          nullptr, nullptr, nullptr, nullptr};
    return &plugin;
}
