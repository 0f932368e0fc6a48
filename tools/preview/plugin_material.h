// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A material out of a shared object, for the host that it was written for.

#pragma once

#include "bound_material.h"
#include "row.h"

#include <string>
#include <vector>

namespace regain::tools::preview {

struct PluginMaterial
{
    Host host;
    std::string name;  ///< the plug-in's own
    std::unique_ptr<BoundMaterial> material;
};

/// Loads a plug-in as plugin.h of an adapter describes it. `settings` are
/// NAME=NUMBER or NAME=R,G,B; what is not set is as the plug-in has it. BadInput, which names the
/// file or the setting and says what is wrong with it: not there, no shared object, no plug-in, one
/// of another version; a parameter that there is none of, or a value out of its range.
PluginMaterial load_plugin(const std::string& file, const std::vector<std::string>& settings);

}  // namespace regain::tools::preview
