// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "part_options.h"

#include "errors.h"
#include "preview/progress.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

namespace regain::tools {

std::optional<Part> PartOptions::chosen() const
{
    if (!part) return {};
    if (merges())
        throw BadInput("--part does not go with --merge, which takes parts that are done");
    return part_named(*part);
}

const char* PartOptions::given() const
{
    if (merges()) return "--merge";
    return part ? "--part" : "";
}

void declare(PartOptions& o, CLI::App& command)
{
    command
        .add_option("--part", o.part,
                    "only part K of N that the work is divided into, 1 <= K <= N, to a file of "
                    "its own, NAME.part-K-of-N; docs/farm.md")
        ->type_name("K/N");
    command
        .add_option("--merge", o.merged,
                    "what all parts have found, with the options that they were made with: the "
                    "result is that of one run, to the bit")
        ->type_name("FILE ...");
}

void report_part(const Part& part, const std::filesystem::path& file, std::size_t pieces,
                 std::size_t of, const char* kind, double seconds, bool json)
{
    if (json)
        fmt::print("{}\n", nlohmann::ordered_json{{"part", part.number},
                                                  {"parts", part.of},
                                                  {"file", file.string()},
                                                  {"pieces", pieces},
                                                  {"of", of},
                                                  {"kind", kind},
                                                  {"seconds", seconds}}
                               .dump());
    else
        fmt::print("{}: {} of {} {}, {}\n", file.string(), pieces, of, kind,
                   Progress::duration(seconds));
}

}  // namespace regain::tools
