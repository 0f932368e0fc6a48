// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The tables that are part of the library: nothing is read at run time, and nothing but the pages
/// of a table that a material asks for is touched.

#pragma once

#include <regain/luts/export.h>
#include <regain/luts/table.h>

REGAIN_NAMESPACE_BEGIN
namespace luts {

/// E_ss, E_avg and the Fresnel moments of GGX.
REGAIN_LUTS_API MicrofacetTables ggx_tables();

/// The built-in table of that name ("ggx_E_ss", ...), an empty view for any other.
REGAIN_LUTS_API TableView builtin_table(const std::string& name);

}  // namespace luts
REGAIN_NAMESPACE_END
