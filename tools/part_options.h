// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// --part and --merge, the same for every command that can do its work in parts.

#pragma once

#include "part.h"

#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace regain::tools {

struct PartOptions
{
    std::optional<std::string> part;
    std::vector<std::string> merged;  ///< files

    /// Nothing where it is not given; throws as part_named does, and where --merge is given, too.
    std::optional<Part> chosen() const;
    bool merges() const { return !merged.empty(); }
    /// Whichever is given, for messages; empty: neither.
    const char* given() const;
};

/// Adds them to the command. The options outlive the parsing.
void declare(PartOptions&, CLI::App& command);

/// What a command says of a part that is written: one line, or an object of JSON.
void report_part(const Part& part, const std::filesystem::path& file, std::size_t pieces,
                 std::size_t of, const char* kind, double seconds, bool json);

}  // namespace regain::tools
