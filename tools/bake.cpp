// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "bake_parts.h"
#include "bake_table.h"
#include "bake_verify.h"
#include "commands.h"
#include "errors.h"
#include "export_fits.h"
#include "json_fields.h"
#include "part_options.h"
#include "preview/interrupt.h"

#include <regain/luts/bake.h>
#include <regain/luts/embed.h>
#include <regain/luts/exr.h>
#include <regain/luts/replace_file.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>

namespace regain::tools {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

constexpr const char* help_footer = R"help(
TABLE is DISTRIBUTION_QUANTITY: ggx, beckmann, gtr or std; E_ss, E_avg, falloff, dip, balance,
anisotropy, balance_anisotropy, q_ms, mu_ms, spread, forward or tilt. Those of dielectrics are
DISTRIBUTION_QUANTITY_SHADOWING_SIDE: E_S or R_share; correlated or beta; outside or inside, and
DISTRIBUTION_R_later_SIDE; there gtr and std take one gamma, gtr_1.3_E_S_beta_inside. Anisotropic
glass of ggx and beckmann has DISTRIBUTION_anisotropy_SHADOWING_SIDE. Without names those of ggx are
baked that are compiled in. They take twenty seconds; on two cores the mirror tables of gtr or std take
some minutes, and so do the ten of dielectrics of a distribution, or of one gamma of it, and the four of
its anisotropic glass.

Tables are baked by deterministic quadrature on all cores, one after the other, and each is written,
whole, as soon as it is done: after Ctrl-C those that are listed are there, all others are as they
were. The error that is reported is the largest of interpolation between the nodes, in the range it
is promised for: alpha from 5e-4 and mu from 7e-4 on of gtr and std, of their anisotropy from 2e-3
and 5e-3 on, mu from 0.018 on of dielectrics.

--verify bakes again and compares: the tables compiled into this program must hold the very same
16-bit numbers, EXR files values within 1e-6, or one step where they are rounded. Exit code 1 where
they do not. With --spot it does not bake but compares with exact values at K places, which takes a
second.

--part K/N integrates at every N-th place, for all that is asked for; --merge makes the tables of what
all parts have found. A part's file has the name of the first table, in the folder that the tables go
to. One that was stopped leaves nothing, and is run again.

--export writes no table but the formulas that can stand in for those of ggx and beckmann mirrors, as
functions in GLSL or OSL (E_ss, E_avg, q_ms and mu_ms; see docs/methods.md, Without tables). The
extension of FILE says which.

examples:
  regain bake -o tables                         the tables of ggx mirrors, as EXR files
  regain bake ggx_E_avg -o tables --json
  regain bake --all -o luts/data                all tables that are shipped
  regain bake --distribution beckmann -o tables its tables of mirrors and dielectrics
  regain bake --distribution gtr --gamma 1.3 2 -o tables
                                                those of dielectrics at each gamma;
                                                REGAIN_LUTS=tables finds them
  regain bake --all -o tables --part 3/7        on one of seven machines
  regain bake --all -o tables --merge tables/ggx_E_ss.part-*-of-7
  regain bake --verify                          the compiled-in tables
  regain bake --verify luts/data/*.exr          the files, too
  regain bake --verify --all --spot 20          all tables that are shipped, at some places
  regain bake --embed luts/src/builtin          the text that is compiled in
  regain bake --export regain_fits.glsl         formulas in place of tables, for shaders
)help";

struct Arguments
{
    Names given;  // names of tables; for --verify files, too
    std::string output, embed, exported, distribution;
    std::vector<double> gammas;
    int spots = 0;
    bool all = false, verify = false, json = false;
    PartOptions parts;
};

// What was asked for; nothing if that is the default.
Names asked_for(const Arguments& a)
{
    Names names = a.given;
    const auto add = [&](const Names& more) {
        for (const std::string& name : more)
            if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    };
    if (a.all) add(luts::shipped_tables());
    if (a.distribution.empty())
    {
        if (!a.gammas.empty()) throw BadInput("--gamma belongs to --distribution gtr or std");
        return names;
    }
    const bool tailed = a.distribution == "gtr" || a.distribution == "std";
    if (!a.gammas.empty() && !tailed)
        throw BadInput(fmt::format("{} has no gamma; gtr and std have", a.distribution));
    if (a.gammas.empty())
        for (const char* quantity : {"E_ss", "falloff", "dip", "E_avg"})
            add({a.distribution + "_" + quantity});
    const auto add_glass = [&](double gamma) {
        add(luts::dielectric_table_names(a.distribution, gamma));
        add(luts::later_split_table_names(a.distribution, gamma));
    };
    if (!tailed)
    {
        add_glass(0);
        add(luts::dielectric_anisotropy_table_names(a.distribution));
    }
    for (double gamma : a.gammas) add_glass(gamma);
    return names;
}

void require_tables(const Names& names)
{
    for (const std::string& name : names) try
        {
            luts::require_bakeable(name);
        }
        catch (const std::invalid_argument& e)
        {
            throw BadInput(e.what());
        }
}

void make_folder(const std::string& folder)
{
    std::error_code ec;
    fs::create_directories(folder, ec);
    if (!fs::is_directory(folder))
        throw BadInput(fmt::format("cannot write to the folder '{}': {}", folder,
                                   ec ? ec.message() : "it is none"));
    luts::require_replaceable(fs::path(folder) / "table.exr");
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

Json::array_t write(const luts::Table& table, const Arguments& a)
{
    Json::array_t files;
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
    return files;
}

void print(const luts::Table& table)
{
    const luts::TableInfo& info = table.info();
    fmt::print("{:<34} {:>12}  {:.2e} {:>9}  {}, {} nodes\n", table.name(),
               table.depth() > 1
                   ? fmt::format("{} x {} x {}", table.width(), table.height(), table.depth())
                   : fmt::format("{} x {}", table.width(), table.height()),
               info.error, info.error_kind, info.method, info.nodes);
    std::fflush(stdout);  // where it is no terminal, a long bake is followed, too
}

int run_export(const Arguments& a)
{
    if (!a.output.empty() || !a.embed.empty() || a.verify || a.spots > 0 || !asked_for(a).empty())
        throw BadInput("--export writes formulas and no table: give it alone, or with --json");
    const std::string language = export_language(a.exported);
    export_fits(a.exported);
    if (a.json)
        fmt::print(
            "{}\n",
            Json{{"file", a.exported}, {"language", language}, {"functions", exported_functions()}}
                .dump());
    else
        fmt::print("{}: {} functions\n", a.exported, exported_functions().size());
    return kDone;
}

JobDescription job_of(const Names& names)
{
    JobDescription job = describe_job("bake");
    job.add("definition", std::to_string(luts::table_definition));
    job.add("tables", fmt::format("{}", fmt::join(names, " ")));
    return job;
}

int run_part(const Arguments& a, const Names& names, const Part& part, const InterruptGuard& guard)
{
    const auto start = std::chrono::steady_clock::now();
    const fs::path folder = a.output.empty() ? a.embed : a.output;
    const fs::path file = part_file_name(folder / names.front(), part);
    const BakeParts parts(names);
    try
    {
        parts.write(file, job_of(names), part, guard);
    }
    catch (const luts::BakeStopped&)
    {
        fmt::print(stderr, "regain: stopped, '{}' was not written: run the part again\n",
                   file.string());
        return kInterrupted;
    }
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    report_part(part, file, parts.rows_of(part), parts.rows(), "rows of integrals", seconds,
                a.json);
    return kDone;
}

int run_bake(const Arguments& a, const InterruptGuard& guard)
{
    if (a.output.empty() && a.embed.empty())
        throw BadInput("nothing to do: give -o FOLDER, --embed FOLDER, --verify or --export FILE");
    if (a.spots > 0) throw BadInput("--spot belongs to --verify");
    const Names asked = asked_for(a);
    require_tables(asked);
    if (!a.output.empty()) make_folder(a.output);
    if (!a.embed.empty()) make_folder(a.embed);

    const Names names = asked.empty() ? luts::compiled_in_tables() : asked;
    if (const std::optional<Part> part = a.parts.chosen()) return run_part(a, names, *part, guard);
    std::optional<BakeParts> parts;
    if (a.parts.merges()) parts.emplace(names).merge(a.parts.merged, job_of(names));
    Json report = Json::array();
    int code = kDone;
    if (!a.json)
        fmt::print("{:<34} {:>12}  {:>18}  {}\n", "table", "nodes", "largest error", "method");
    for (const std::string& name : names)
    {
        luts::Table table;
        try
        {
            table = parts ? parts->table(name) : bake_showing(name, guard);
        }
        catch (const luts::BakeStopped&)
        {
            fmt::print(stderr, "regain: stopped, {} of {} tables were written\n", report.size(),
                       names.size());
            code = kInterrupted;
            break;
        }
        const luts::TableInfo& info = table.info();
        report.push_back({{"table", table.name()},
                          {"width", table.width()},
                          {"height", table.height()},
                          {"depth", table.depth()},
                          {"method", info.method},
                          {"quadrature_nodes", info.nodes},
                          {"error", info.error},
                          {"error_kind", info.error_kind},
                          {"files", write(table, a)}});
        if (!a.json) print(table);
    }
    if (a.json) fmt::print("{}\n", report.dump());
    return code;
}

int run_verify(const Arguments& a, const InterruptGuard& guard)
{
    if (!a.output.empty() || !a.embed.empty())
        throw BadInput("--verify writes nothing: leave out -o and --embed");
    return verify_tables(asked_for(a), a.spots, a.json, guard);
}

int run(const Arguments& a)
{
    if (const std::string with = a.parts.given();
        !with.empty() && (a.verify || !a.exported.empty()))
        throw BadInput(fmt::format("{} does not go with --verify and --export", with));
    if (!a.exported.empty()) return run_export(a);
    const InterruptGuard guard;
    try
    {
        return a.verify ? run_verify(a, guard) : run_bake(a, guard);
    }
    catch (const luts::BakeStopped&)
    {
        fmt::print(stderr, "regain: stopped, not all tables were verified\n");
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
                        "names of tables (default: those of ggx mirrors); with --verify EXR "
                        "files, too");
    command->add_flag("--all", a->all, "all tables that are shipped");
    command->add_option("--distribution", a->distribution, "all tables of ggx, beckmann, gtr, std")
        ->type_name("NAME")
        ->check(CLI::IsMember({"ggx", "beckmann", "gtr", "std"}));
    command->add_option("--gamma", a->gammas, "of gtr or std: dielectrics with these tails")
        ->type_name("G ...");
    command->add_option("-o,--output", a->output, "folder for EXR files");
    declare(a->parts, *command);
    command->add_option("--embed", a->embed, "folder for the text that is compiled in");
    command
        ->add_option("--export", a->exported, "file for formulas in place of tables, .glsl or .osl")
        ->type_name("FILE");
    command->add_flag("--verify", a->verify, "compare with the shipped tables; writes nothing");
    command->add_option("--spot", a->spots, "with --verify: K places only")
        ->type_name("K")
        ->check(CLI::Range(1, 1000000));
    command->add_flag("--json", a->json, "the report as JSON");
    command->callback([a, &exit_code] { exit_code = run_reporting([&] { return run(*a); }); });
}

}  // namespace regain::tools
