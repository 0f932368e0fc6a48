// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "commands.h"
#include "errors.h"
#include "json_fields.h"
#include "preview/interrupt.h"
#include "preview/progress.h"
#include "table_check.h"

#include <regain/luts/bake.h>
#include <regain/luts/builtin.h>
#include <regain/luts/embed.h>
#include <regain/luts/exr.h>
#include <regain/luts/replace_file.h>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>

namespace regain::tools {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

constexpr const char* help_footer = R"help(
Tables are baked by deterministic quadrature and written when all of them are done: after Ctrl-C
nothing has changed. The error that is reported is the largest of interpolation between the nodes.

--verify bakes again and compares: the tables compiled into this program must hold the very same
16-bit numbers, EXR files values within 1e-6. Exit code 1 where they do not. With --spot it does
not bake but compares with exact values at K places, which takes a second.

examples:
  regain bake -o tables                         all tables, as EXR files
  regain bake ggx_E_avg -o tables --json
  regain bake --verify                          the compiled-in tables
  regain bake --verify luts/data/*.exr          the files, too
  regain bake --verify --spot 20
  regain bake --embed luts/src/builtin          the text that is compiled in
)help";

struct Arguments
{
    Names given;  // names of tables; for --verify files, too
    std::string output, embed;
    int spots = 0;
    bool verify = false, json = false;
};

luts::Table bake_showing(const std::string& name, const InterruptGuard& guard)
{
    constexpr std::uint64_t steps = 1000;
    Progress progress("baking " + name, steps, Progress::style(false));
    std::uint64_t shown = 0;
    luts::Table table = luts::bake(name, [&](double done) {
        const auto now = static_cast<std::uint64_t>(done * static_cast<double>(steps));
        progress.advance(now - std::min(shown, now));
        shown = now;
        return !guard.flag();
    });
    // A table may be too small to ask often.
    if (guard.flag()) throw luts::BakeStopped();
    return table;
}

bool is_table(const std::string& name)
{
    const Names known = luts::bakeable_tables();
    return std::find(known.begin(), known.end(), name) != known.end();
}

void make_folder(const std::string& folder)
{
    std::error_code ec;
    fs::create_directories(folder, ec);
    if (!fs::is_directory(folder))
        throw BadInput(fmt::format("cannot write to the folder '{}': {}", folder,
                                   ec ? ec.message() : "it is none"));
    if (::access(folder.c_str(), W_OK) != 0)
        throw BadInput(fmt::format("cannot write to the folder '{}': not permitted", folder));
}

void write_embedded(const fs::path& file, const luts::Table& table)
{
    luts::replace_file(file, [&](const fs::path& temporary) {
        std::ofstream out(temporary);
        out << luts::embedded(table);
        out.close();
        if (!out) throw std::runtime_error(fmt::format("cannot write '{}'", file.string()));
    });
}

int run_bake(const Arguments& a, const InterruptGuard& guard)
{
    if (a.output.empty() && a.embed.empty())
        throw BadInput("nothing to do: give -o FOLDER, --embed FOLDER or --verify");
    if (a.spots > 0) throw BadInput("--spot belongs to --verify");
    for (const std::string& name : a.given)
        if (!is_table(name))
            throw BadInput(fmt::format("there is no table '{}'; accepted: {}", name,
                                       fmt::join(luts::bakeable_tables(), ", ")));
    if (!a.output.empty()) make_folder(a.output);
    if (!a.embed.empty()) make_folder(a.embed);

    std::vector<luts::Table> tables;
    for (const std::string& name : a.given.empty() ? luts::bakeable_tables() : a.given)
        tables.push_back(bake_showing(name, guard));

    Json report = Json::array();
    if (!a.json)
        fmt::print("{:<18} {:>8}  {:>18}  {}\n", "table", "nodes", "largest error", "method");
    for (const luts::Table& table : tables)
    {
        const luts::TableInfo& info = table.info();
        Json files = Json::array();
        if (!a.output.empty())
        {
            const fs::path file = fs::path(a.output) / (table.name() + ".exr");
            luts::write_table(file, table);
            files.push_back(file.string());
        }
        if (!a.embed.empty())
        {
            const fs::path file = fs::path(a.embed) / (table.name() + ".inc");
            write_embedded(file, table);
            files.push_back(file.string());
        }
        report.push_back({{"table", table.name()},
                          {"width", table.width()},
                          {"height", table.height()},
                          {"method", info.method},
                          {"quadrature_nodes", info.nodes},
                          {"error", info.error},
                          {"error_kind", info.error_kind},
                          {"files", files}});
        if (!a.json)
            fmt::print("{:<18} {:>8}  {:.2e} {:>9}  {}, {} nodes\n", table.name(),
                       fmt::format("{} x {}", table.width(), table.height()), info.error,
                       info.error_kind, info.method, info.nodes);
    }
    if (a.json) fmt::print("{}\n", report.dump());
    return kDone;
}

struct ShippedFile
{
    std::string file;
    luts::Table table;
};

std::vector<TableCheck> check_table(const std::string& name, const std::vector<ShippedFile>& files,
                                    int spots, const InterruptGuard& guard)
{
    std::vector<TableCheck> checks;
    if (spots > 0)
    {
        checks.push_back(check_spots(name, luts::builtin_table(name), "compiled in", spots));
        for (const ShippedFile& f : files)
            if (f.table.name() == name)
                checks.push_back(check_spots(name, f.table.view(), f.file, spots));
        return checks;
    }
    const luts::Table baked = bake_showing(name, guard);
    checks.push_back(check_builtin(baked));
    for (const ShippedFile& f : files)
        if (f.table.name() == name) checks.push_back(check_file(baked, f.table, f.file));
    return checks;
}

Json as_json(const TableCheck& c)
{
    Json json{{"table", c.table},         {"against", c.against},
              {"passed", c.passed()},     {"numbers", c.numbers},
              {"differing", c.differing}, {"largest_difference", c.largest_difference}};
    if (c.worst)
        json["worst"] = {{"where", c.worst->where},
                         {"shipped", c.worst->shipped},
                         {"expected", c.worst->expected}};
    return json;
}

void print(const TableCheck& c)
{
    fmt::print("{:<6} {:<18} {}: {} numbers, largest difference {:.1e}\n",
               c.passed() ? "same" : "DIFFER", c.table, c.against, c.numbers, c.largest_difference);
    if (c.worst)
        fmt::print("       {} differ, most at {}: shipped {}, expected {}\n", c.differing,
                   c.worst->where, c.worst->shipped, c.worst->expected);
}

int run_verify(const Arguments& a, const InterruptGuard& guard)
{
    if (!a.output.empty() || !a.embed.empty())
        throw BadInput("--verify writes nothing: leave out -o and --embed");
    Names names;
    std::vector<ShippedFile> files;
    for (const std::string& given : a.given)
    {
        std::string name = given;
        if (!is_table(given))
        {
            files.push_back({given, luts::read_table(given)});
            name = files.back().table.name();
            if (!is_table(name))
                throw BadInput(fmt::format("'{}' holds the table '{}'; known are {}", given, name,
                                           fmt::join(luts::bakeable_tables(), ", ")));
        }
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }

    Json report = Json::array();
    int failed = 0;
    for (const std::string& name : names.empty() ? luts::bakeable_tables() : names)
        for (const TableCheck& check : check_table(name, files, a.spots, guard))
        {
            if (!a.json) print(check);
            report.push_back(as_json(check));
            failed += !check.passed();
        }
    if (a.json) fmt::print("{}\n", report.dump());
    if (failed > 0)
        throw CheckFailed(
            fmt::format("{} of {} tables are not what their definition says: bake "
                        "them again",
                        failed, report.size()));
    return kDone;
}

int run(const Arguments& a)
{
    const InterruptGuard guard;
    try
    {
        return a.verify ? run_verify(a, guard) : run_bake(a, guard);
    }
    catch (const luts::BakeStopped&)
    {
        fmt::print(stderr, "regain: stopped, nothing was written\n");
        return kInterrupted;
    }
}

}  // namespace

void add_bake(CLI::App& app, int& exit_code)
{
    CLI::App* command =
        app.add_subcommand("bake", "albedo tables to EXR; compare the shipped ones");
    command->footer(help_footer);
    auto a = std::make_shared<Arguments>();
    command->add_option("TABLE", a->given,
                        "names of tables (default: all); with --verify EXR files, too");
    command->add_option("-o,--output", a->output, "folder for EXR files");
    command->add_option("--embed", a->embed, "folder for the text that is compiled in");
    command->add_flag("--verify", a->verify, "compare with the shipped tables; writes nothing");
    command->add_option("--spot", a->spots, "with --verify: K places only")
        ->type_name("K")
        ->check(CLI::Range(1, 1000000));
    command->add_flag("--json", a->json, "the report as JSON");
    command->callback([a, &exit_code] { exit_code = run_reporting([&] { return run(*a); }); });
}

}  // namespace regain::tools
