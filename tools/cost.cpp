// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// `regain cost`: what accuracy costs in time, for every method and class of material.

#include "commands.h"
#include "cost/fronts_page.h"
#include "cost/page.h"
#include "cost/planner_data.h"
#include "cost/run.h"
#include "cost_parts.h"
#include "errors.h"
#include "part_options.h"
#include "preview/interrupt.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <chrono>
#include <memory>

namespace regain::tools {
namespace {

namespace fs = std::filesystem;

struct Options
{
    std::vector<std::string> classes, distributions, methods;
    std::string folder = "cost", planner_file;
    std::int64_t samples = 0, seed = 1, threads = 0;
    double seconds = -1;
    bool quick = false, quiet = false, json = false;
    PartOptions parts;
};

cost::RunOptions run_options(const Options& o)
{
    const auto check = [](const char* option, double value, double least, double most) {
        if (!(value >= least && value <= most))
            throw BadInput(fmt::format("{} {}: takes {} to {}", option, value, least, most));
    };
    cost::RunOptions run;
    run.quick = o.quick;
    run.samples = o.quick ? 8192 : 32768;
    run.seconds_per_picture = o.quick ? 0.5 : 4;
    if (o.samples != 0)
    {
        check("--samples", static_cast<double>(o.samples), 64, 1e9);
        // Whole lattices.
        run.samples = (static_cast<std::uint64_t>(o.samples) + cost::lattices - 1) /
                      cost::lattices * cost::lattices;
    }
    if (o.seconds != -1)
    {
        check("--seconds-per-picture", o.seconds, 0, 86400);
        run.seconds_per_picture = o.seconds;
    }
    check("--seed", static_cast<double>(o.seed), 0, 4294967295.0);
    check("--threads", static_cast<double>(o.threads), 0, 1024);
    run.request.seed = static_cast<std::uint32_t>(o.seed);
    run.request.threads = static_cast<int>(o.threads);
    run.request.progress = Progress::style(o.quiet);
    run.choice = cost::everything(o.quick);
    cost::keep_classes(run.choice, o.classes);
    cost::keep_distributions(run.choice, o.distributions);
    cost::keep_methods(run.choice, o.methods);
    return run;
}

// Asked before hours are spent, not after.
void check_file(const std::string& file)
{
    if (file.empty()) return;
    const fs::path folder = fs::absolute(file).parent_path();
    if (!fs::is_directory(folder) || fs::is_directory(file))
        throw BadInput(
            fmt::format("--planner-data {}: takes a file in a folder that is there", file));
}

void make_folder(const fs::path& folder)
{
    std::error_code error;
    fs::create_directories(folder, error);
    if (error || !fs::is_directory(folder))
        throw BadInput(fmt::format("cannot make the folder '{}': {}", folder.string(),
                                   error ? error.message() : "a file of that name is there"));
}

int run_part(const Options& options, const cost::RunOptions& run,
             const std::vector<cost::Case>& cases, const Part& part)
{
    const auto start = std::chrono::steady_clock::now();
    const fs::path file = part_file_name(fs::path(options.folder) / "cost", part);
    write_cost_part(file, cases, run, part);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (!options.quiet || options.json)
        report_part(part, file, cases_of(cases, part).size(), cases.size(), "cases", seconds,
                    options.json);
    return kDone;
}

int cost_command(const Options& options)
{
    cost::RunOptions run = run_options(options);
    const std::optional<Part> part = options.parts.chosen();
    if (part && !options.planner_file.empty())
        throw BadInput("--planner-data does not go with --part: give it to --merge");
    check_file(options.planner_file);
    const std::vector<cost::Case> cases = cases_of(run.choice);
    std::vector<cost::CaseErrors> errors;
    if (options.parts.merges()) errors = merge_cost_parts(options.parts.merged, cases, run);
    const fs::path folder = options.folder;
    make_folder(folder);
    const InterruptGuard interrupt;
    run.request.stop = &interrupt.flag();
    try
    {
        if (part) return run_part(options, run, cases, *part);
        if (!options.parts.merges()) errors = errors_of(cases, run);
        const cost::Results results = results_of(cases, std::move(errors), run);
        const std::vector<cost::Front> fronts = cost::fronts_of(results);
        const std::string json = cost::as_json(results).dump(1);
        figures::write_text(folder / "cost.csv", cost::as_csv(results));
        figures::write_text(folder / "cost.json", json + "\n");
        figures::write_text(folder / "cost.html", cost::html_page(results, fronts));
        figures::write_text(folder / "cost-fronts.md", cost::fronts_page(results, fronts));
        for (const auto& [file, svg] : cost::plots(fronts)) figures::write_text(folder / file, svg);
        if (!options.planner_file.empty())
            figures::write_text(options.planner_file, cost::planner_data(results));
        if (options.json)
            fmt::print("{}\n", json);
        else if (!options.quiet)
        {
            for (const cost::Front& f : fronts)
                if (f.law.label() == run.choice.laws.front().label())
                    fmt::print("{}\n", f.sentence);
            fmt::print("{}\n", (folder / "cost.html").string());
        }
    }
    catch (const figures::Stopped&)
    {
        if (!options.quiet) fmt::print(stderr, "regain: interrupted; nothing was written\n");
        return kInterrupted;
    }
    return kDone;
}

}  // namespace

void add_cost(CLI::App& app, int& exit_code)
{
    auto options = std::make_shared<Options>();
    CLI::App* command =
        app.add_subcommand("cost", "What accuracy costs in time: every method, every material");
    command->footer(R"(
Every method of compensation, for metals, coloured metals, glass from either side and
plastic, by every distribution and at widths from 0.05 to 1: how far albedo, colour and
lobe are from the random walk's, how noisy samples are, how long an eval and a sample
take, and which methods nothing else beats in both. docs/cost.md explains the numbers.

Into the folder go cost.csv and cost.json for machines, cost.html for people, which needs
no other file, its plots as SVG, and its sentences with a table as cost-fronts.md. Errors are measured on all threads,
times on one: leave the machine alone meanwhile. --part K/N measures the errors of every
N-th case; --merge takes them, measures the times, and writes everything.

Examples:
  regain cost --quick                          a minute on two cores
  regain cost -o /tmp/cost                     all; half an hour
  regain cost --quick --class metal --distribution ggx --method none,turquin,walk
  regain cost --planner-data method_costs.json what a renderer plans by
  regain cost -o /tmp/cost --part 3/7          on one of seven machines
  regain cost -o /tmp/cost --merge /tmp/cost/cost.part-*-of-7)");
    Options& o = *options;
    command->add_option("--class", o.classes, "of materials, several by commas [all]")
        ->delimiter(',');
    command->add_option("--distribution", o.distributions, "several by commas [all]")
        ->delimiter(',');
    command->add_option("--method", o.methods, "of compensation, several by commas [all]")
        ->delimiter(',');
    command->add_flag("--quick", o.quick, "three widths, one eta, fewer samples");
    command->add_option("--samples", o.samples,
                        "for each direction, 64 to 1e9; the walk takes four times as many "
                        "[32768; quick: 8192]");
    command->add_option("--seconds-per-picture", o.seconds,
                        "of the pictures in equal time, 0 for none [4; quick: 0.5]");
    command->add_option("--seed", o.seed, "of the random numbers")->capture_default_str();
    command->add_option("--threads", o.threads, "0: one per core; never changes an error")
        ->capture_default_str();
    command->add_option("-o,--output", o.folder, "folder to write, made if it is not there")
        ->capture_default_str();
    declare(o.parts, *command);
    command->add_option("--planner-data", o.planner_file,
                        "file to write with errors and time ratios alone, as JSON");
    command->add_flag("--quiet", o.quiet, "no progress, no summary");
    command->add_flag("--json", o.json, "cost.json on standard output, too");
    command->callback([options, &exit_code] {
        exit_code = run_reporting([&] { return cost_command(*options); });
    });
}

}  // namespace regain::tools
