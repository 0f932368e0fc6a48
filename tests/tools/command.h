// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Runs the program as a user does, in a folder that is gone afterwards.

#pragma once

#include "../support/temporary_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace test {

struct Outcome
{
    int code;
    std::string out, err;

    std::vector<std::string> lines() const
    {
        std::vector<std::string> all;
        std::istringstream text(out);
        for (std::string line; std::getline(text, line);) all.push_back(line);
        return all;
    }
    nlohmann::json json() const { return nlohmann::json::parse(out); }
};

inline bool says(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

class Command : public testing::Test
{
protected:
    /// Arguments are shell text; `FOLDER` in them stands for the temporary one.
    Outcome run(std::string arguments, const std::string& input = "") const
    {
        for (std::size_t at; (at = arguments.find("FOLDER")) != std::string::npos;)
            arguments.replace(at, 6, folder.string());
        write("stdin", input);
        const std::string line = fmt::format("'{0}' {1} <'{2}/stdin' >'{2}/stdout' 2>'{2}/stderr'",
                                             REGAIN_BINARY, arguments, folder.string());
        const int status = std::system(line.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read("stdout"), read("stderr")};
    }

    void write(const std::string& name, const std::string& text) const
    {
        std::ofstream(folder / name, std::ios::binary) << text;
    }
    std::string read(const std::string& name) const
    {
        std::ostringstream text;
        text << std::ifstream(folder / name, std::ios::binary).rdbuf();
        return text.str();
    }

    const TemporaryFolder temporary;
    const std::filesystem::path folder = temporary.path();
};

}  // namespace test
