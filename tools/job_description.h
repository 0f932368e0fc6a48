// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What a run was of: all that decides its result, so that parts of different runs are never put
/// together.

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace regain::tools {

struct JobDescription
{
    std::string command;
    std::vector<std::pair<std::string, std::string>> entries;  ///< names and values, in order

    /// What is no UTF-8 in a value is replaced: it goes into a header of JSON.
    void add(const std::string& name, const std::string& value);
    /// The contents of a file by their size and a hash; of what cannot be read, that.
    void add_contents(const std::string& name, const std::filesystem::path& file);
};

/// Of a command, with what every one depends on: the program and all libraries as they are loaded,
/// the instructions of the processor, and what the environment says of tables and colour.
JobDescription describe_job(const std::string& command);

/// Sixteen hexadecimal digits.
std::string fingerprint(const JobDescription& job);

/// "seed: 2 there, 1 here"; empty of jobs that are the same.
std::string difference(const JobDescription& here, const JobDescription& there);

/// FNV-1a, of 64 bits: tells accidents, not forgeries. To go on from the hash of what came before.
std::uint64_t hash(std::string_view bytes, std::uint64_t before = 0xcbf29ce484222325u);

}  // namespace regain::tools
