// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// A plug-in that forgot its functions.

#include <regain/renderman/plugin.h>

extern "C" REGAIN_PLUGIN_EXPORT const regain::renderman::BxdfPlugin* regain_bxdf_plugin()
{
    using Plugin = regain::renderman::BxdfPlugin;
    static constexpr Plugin plugin{
        Plugin::current, REGAIN_VERSION_STRING, "null", nullptr, 0, nullptr, nullptr, nullptr,
        nullptr};
    return &plugin;
}
