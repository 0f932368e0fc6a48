// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "job_description.h"

#include "loaded_program.h"

#include <regain/closures/version.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <fstream>

namespace regain::tools {

namespace {

const std::string* find(const JobDescription& job, const std::string& name)
{
    const auto entry = std::find_if(job.entries.begin(), job.entries.end(),
                                    [&](const auto& e) { return e.first == name; });
    return entry == job.entries.end() ? nullptr : &entry->second;
}

std::string quoted(const std::string* value) { return value ? "'" + *value + "'" : "nothing"; }

}  // namespace

void JobDescription::add(const std::string& name, const std::string& value)
{
    using Json = nlohmann::json;
    const std::string text = Json(value).dump(-1, ' ', false, Json::error_handler_t::replace);
    entries.emplace_back(name, Json::parse(text).get<std::string>());
}

void JobDescription::add_contents(const std::string& name, const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    std::uint64_t size = 0, all = hash({});
    std::vector<char> piece(1 << 16);
    while (in)
    {
        in.read(piece.data(), static_cast<std::streamsize>(piece.size()));
        const auto read = static_cast<std::size_t>(in.gcount());
        all = hash({piece.data(), read}, all);
        size += read;
    }
    add(name, in.bad() || !in.eof() ? "not readable" : fmt::format("{} bytes, {:016x}", size, all));
}

JobDescription describe_job(const std::string& command)
{
    JobDescription job;
    job.command = command;
    job.add("version", REGAIN_VERSION_STRING);
    job.add("program", loaded_program());
    job.add("instruction set", instruction_set());
    for (const char* variable : {"REGAIN_LUTS", "OCIO"})
        if (const char* value = std::getenv(variable)) job.add(variable, value);
    return job;
}

std::string fingerprint(const JobDescription& job)
{
    std::uint64_t all = hash(job.command);
    // The ends of names and values count, too.
    for (const auto& [name, value] : job.entries)
        for (const std::string& text : {name, value}) all = hash(text + '\0', all);
    return fmt::format("{:016x}", all);
}

std::string difference(const JobDescription& here, const JobDescription& there)
{
    if (here.command != there.command)
        return fmt::format("command: '{}' there, '{}' here", there.command, here.command);
    for (const auto& entry : here.entries)
        if (const std::string* its = find(there, entry.first); !its || *its != entry.second)
            return fmt::format("{}: {} there, '{}' here", entry.first, quoted(its), entry.second);
    for (const auto& entry : there.entries)
        if (!find(here, entry.first))
            return fmt::format("{}: '{}' there, nothing here", entry.first, entry.second);
    return {};
}

std::uint64_t hash(std::string_view bytes, std::uint64_t before)
{
    for (const char c : bytes)
        before = (before ^ static_cast<unsigned char>(c)) * std::uint64_t(0x100000001b3u);
    return before;
}

}  // namespace regain::tools
