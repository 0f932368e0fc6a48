// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Baking in parts: some of the integrals that tables are made of, and tables of all of them.

#pragma once

#include "part_file.h"
#include "preview/interrupt.h"

#include <regain/luts/table.h>
#include <regain/luts/table_integrals.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace regain::tools {

/// The integrals of several tables; what tables share is there once.
class BakeParts
{
public:
    explicit BakeParts(const std::vector<std::string>& tables);

    /// Rows of integrals, which are what parts are divided into.
    std::size_t rows() const;
    std::size_t rows_of(const Part& part) const;

    /// Integrates a part, with progress on standard error. Throws luts::BakeStopped after an
    /// interrupt, and then writes nothing.
    void write(const std::filesystem::path& file, const JobDescription& job, const Part& part,
               const InterruptGuard& guard) const;

    /// Takes what all parts have found; throws as all_parts does.
    void merge(const std::vector<std::string>& files, const JobDescription& job);
    /// After that, one of the tables.
    luts::Table table(const std::string& name) const;

private:
    struct Shared
    {
        std::string table;  ///< one that they are of
        luts::TableIntegrals integrals;
        std::size_t place;  ///< of the first row, among all
        std::vector<double> values;
    };
    static std::vector<std::size_t> rows_of(const Shared& shared, const Part& part);

    std::vector<Shared> _shared;
    std::map<std::string, std::size_t> _shared_of;  ///< of a table
};

}  // namespace regain::tools
