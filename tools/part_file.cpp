// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "part_file.h"

#include "errors.h"

#include <regain/luts/replace_file.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <optional>

namespace regain::tools {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr const char* first_line = "regain part 1";

[[noreturn]] void refuse_file(const fs::path& file, const std::string& why)
{
    throw BadInput(fmt::format("--merge: '{}' {}", file.string(), why));
}

PartFile read_header(const fs::path& file, const JobDescription& job)
{
    std::ifstream in(file, std::ios::binary);
    if (!in) refuse_file(file, "cannot be read");
    std::string line;
    if (!std::getline(in, line) || line != first_line) refuse_file(file, "is no part");
    PartFile found;
    found.file = file;
    JobDescription its;
    std::string its_fingerprint;
    try
    {
        std::getline(in, line);
        const Json header = Json::parse(line);
        its.command = header.at("command").get<std::string>();
        for (const auto& [name, value] : header.at("job").items())
            its.add(name, value.get<std::string>());
        its_fingerprint = header.at("fingerprint").get<std::string>();
        found.part = part_named(header.at("part").get<std::string>());
        found.payload_size = header.at("bytes").get<std::uint64_t>();
        found.payload_hash = header.at("hash").get<std::uint64_t>();
    }
    catch (const std::exception&)
    {
        refuse_file(file, "is damaged: its header cannot be read");
    }
    // Two of its kind, on different machines, are never of one job: that is what is said first.
    if (const std::string differs = difference(job, its); !differs.empty())
        refuse_file(file, "is of another job: " + differs);
    if (its_fingerprint != fingerprint(its))
        refuse_file(file, "is damaged: its header was changed");
    found.payload_begin = static_cast<std::uint64_t>(in.tellg());
    std::error_code ec;
    const auto size = fs::file_size(file, ec);
    if (ec || size != found.payload_begin + found.payload_size)
        refuse_file(file, fmt::format("is damaged: it is of {} bytes, and should be of {}", size,
                                      found.payload_begin + found.payload_size));
    return found;
}

}  // namespace

void write_part(const fs::path& file, const JobDescription& job, const Part& part,
                std::string_view payload)
{
    Json entries = Json::object();
    for (const auto& [name, value] : job.entries) entries[name] = value;
    const Json header{{"command", job.command},          {"part", part.text()},
                      {"fingerprint", fingerprint(job)}, {"job", entries},
                      {"bytes", payload.size()},         {"hash", hash(payload)}};
    luts::replace_file(file, [&](const fs::path& temporary) {
        std::ofstream out(temporary, std::ios::binary);
        out << first_line << '\n' << header.dump() << '\n' << payload;
        out.close();
        if (!out) throw std::runtime_error(fmt::format("cannot write '{}'", file.string()));
    });
}

std::string PartFile::payload() const
{
    std::string bytes(payload_size, '\0');
    std::ifstream in(file, std::ios::binary);
    in.seekg(static_cast<std::streamoff>(payload_begin));
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!in) refuse_file(file, "cannot be read to its end");
    if (hash(bytes) != payload_hash) refuse_file(file, "is damaged: its numbers were changed");
    return bytes;
}

std::vector<PartFile> all_parts(const std::vector<std::string>& files, const JobDescription& job)
{
    std::vector<std::optional<PartFile>> found;
    for (const std::string& file : files)
    {
        PartFile one = read_header(file, job);
        if (found.empty()) found.resize(one.part.of);
        if (one.part.of != found.size())
            refuse_file(file, fmt::format("is of {} parts, and '{}' of {}", one.part.of,
                                          files.front(), found.size()));
        auto& place = found[one.part.number - 1];
        if (place)
            refuse_file(
                file, fmt::format("is part {}, as is '{}'", one.part.text(), place->file.string()));
        place = std::move(one);
    }
    std::vector<std::size_t> missing;
    for (std::size_t i = 0; i < found.size(); ++i)
        if (!found[i]) missing.push_back(i + 1);
    if (!missing.empty())
    {
        constexpr std::size_t shown = 20;
        const bool more = missing.size() > shown;
        const std::size_t count = missing.size();
        if (more) missing.resize(shown);
        throw BadInput(fmt::format("--merge: of {} parts {} {} not given: {}{}", found.size(),
                                   count, count == 1 ? "is" : "are", fmt::join(missing, ", "),
                                   more ? ", ..." : ""));
    }
    std::vector<PartFile> parts;
    for (auto& one : found) parts.push_back(std::move(*one));
    return parts;
}

void read_parts(const std::vector<std::string>& files, const JobDescription& job,
                const std::function<void(const Part&, PayloadReader&)>& read)
{
    for (const PartFile& file : all_parts(files, job)) try
        {
            const std::string bytes = file.payload();
            PayloadReader payload(bytes);
            read(file.part, payload);
            payload.finish();
        }
        catch (const PayloadReader::Error& e)
        {
            refuse_file(file.file, std::string("is damaged: ") + e.what());
        }
}

}  // namespace regain::tools
