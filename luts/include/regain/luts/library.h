// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The tables of every distribution, each loaded when it is first asked for, once per process, and
/// kept until its end. Those of GGX mirrors are compiled in; no file is opened for them. Any thread
/// may call anything here.
///
/// Files are named TABLE.exr, see bake.h, and looked for in this order:
///   1. the folders of set_table_folders
///   2. those of the environment variable REGAIN_LUTS, a list separated by colons
///   3. share/regain/luts of the installation that this library, or a program that holds it, is
///      part of, wherever that has been moved to
///   4. the folder they were installed to
///   5. the source tree the library was built from
/// The first file of the name counts, stale or not.

#pragma once

#include <regain/closures/dielectric.h>
#include <regain/luts/table.h>

#include <filesystem>
#include <string>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace luts {

/// Folders to look in before all others. What is loaded already stays.
REGAIN_LUTS_API void set_table_folders(std::vector<std::filesystem::path> folders);

/// All folders that are looked in, in order.
REGAIN_LUTS_API std::vector<std::filesystem::path> table_folders();

/// E_ss, E_avg and the Fresnel moments of a distribution: "ggx", "beckmann", "gtr" or "std". Throws
/// std::invalid_argument for any other, std::runtime_error where a file is missing, broken or
/// stale; it names the file, the places that were looked in and the command that bakes it.
REGAIN_LUTS_API MicrofacetTables microfacet_tables(const std::string& distribution);

/// Adds q_ms and mu_ms of that distribution, which the method `directional` takes; errors as above.
REGAIN_LUTS_API void add_later_bounces(MicrofacetTables& tables, const std::string& distribution);

/// Adds the balance of single scattering, which the method `balanced` takes besides; errors as
/// above.
REGAIN_LUTS_API void add_balance(MicrofacetTables& tables, const std::string& distribution);

/// Adds what the balance lacks of an anisotropic lobe, in a table that no other needs; errors as
/// above.
REGAIN_LUTS_API void add_balance_anisotropy(MicrofacetTables& tables,
                                            const std::string& distribution);

/// Adds what the tables of isotropic lobes lack of anisotropic ones, in a table that no other lobe
/// needs. Errors as above.
REGAIN_LUTS_API void add_anisotropy(MicrofacetTables& tables, const std::string& distribution);

/// Adds spread, forward and tilt, which the method `tail` takes besides; errors as above.
REGAIN_LUTS_API void add_later_shape(MicrofacetTables& tables, const std::string& distribution);

/// The dielectric tables of a distribution; errors as above. gtr and std have tables for one gamma
/// each, none of which is shipped: bake them.
REGAIN_LUTS_API DielectricTables dielectric_tables(const std::string& distribution,
                                                   TransmissionShadowing shadowing,
                                                   double gamma = 0);

/// Adds R_later of that distribution, which the method `tail` takes of a dielectric besides the
/// tables of the beta form; errors as above.
REGAIN_LUTS_API void add_later_split(DielectricTables& tables, const std::string& distribution,
                                     double gamma = 0);

/// Adds what anisotropic lobes of ggx and beckmann take of the tables of that form of transmission
/// shadowing, see regain/closures/dielectric_anisotropy.h, and of gtr and std nothing; errors as
/// above. It stays where it is until the process ends.
REGAIN_LUTS_API void add_anisotropy(DielectricTables& tables, const std::string& distribution,
                                    TransmissionShadowing shadowing);

/// One table by its name, compiled in or loaded; errors as above.
REGAIN_LUTS_API TableView table_named(const std::string& name);

/// Files that have been opened and read so far by this process, in order.
REGAIN_LUTS_API std::vector<std::filesystem::path> loaded_files();

}  // namespace luts
REGAIN_NAMESPACE_END
