// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// `regain figures`: the figures and the table of Turquin 2019, made with this library alone, each
// beside what the paper says of it.

#include "commands.h"
#include "errors.h"
#include "figures/figure.h"
#include "figures/page.h"
#include "preview/interrupt.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>

namespace regain::tools {
namespace {

namespace fs = std::filesystem;
using namespace figures;

struct Options
{
    std::vector<std::string> wanted;
    std::string folder = "figures";
    std::int64_t samples = 64, seed = 1, threads = 0;
    double size = 1, precision = 1;
    bool quiet = false, json = false;
};

std::vector<Maker> chosen(const std::vector<std::string>& wanted)
{
    if (wanted.empty()) return makers();
    std::string names;
    for (const Maker& m : makers()) names += (names.empty() ? "" : ", ") + std::string(m.name);
    std::vector<Maker> all;
    for (const std::string& name : wanted)
    {
        const auto known = std::find_if(makers().begin(), makers().end(),
                                        [&](const Maker& m) { return m.name == name; });
        if (known == makers().end())
            throw BadInput(fmt::format("there is no figure '{}'; there are {}", name, names));
        all.push_back(*known);
    }
    return all;
}

Request request_of(const Options& o)
{
    const auto check = [](const char* option, double value, double least, double most) {
        if (!(value >= least && value <= most))
            throw BadInput(fmt::format("{} {}: takes {} to {}", option, value, least, most));
    };
    check("--spp", static_cast<double>(o.samples), 1, 65536);
    check("--size", o.size, 0.05, 8);
    check("--precision", o.precision, 1e-3, 100);
    check("--seed", static_cast<double>(o.seed), 0, 4294967295.0);
    check("--threads", static_cast<double>(o.threads), 0, 1024);

    Request request;
    request.folder = o.folder;
    request.samples = static_cast<int>(o.samples);
    request.size = o.size;
    request.precision = o.precision;
    request.seed = static_cast<std::uint32_t>(o.seed);
    request.threads = static_cast<int>(o.threads);
    request.progress = Progress::style(o.quiet);
    return request;
}

void make_folder(const fs::path& folder)
{
    std::error_code error;
    fs::create_directories(folder, error);
    if (error || !fs::is_directory(folder))
        throw BadInput(fmt::format("cannot make the folder '{}': {}", folder.string(),
                                   error ? error.message() : "a file of that name is there"));
}

int figures_command(const Options& options)
{
    const std::vector<Maker> wanted = chosen(options.wanted);
    Request request = request_of(options);
    make_folder(request.folder);

    const InterruptGuard interrupt;
    request.stop = &interrupt.flag();
    std::vector<Figure> made;
    nlohmann::ordered_json numbers = nlohmann::ordered_json::array();
    // After each figure the page holds all that there is, so nothing is lost to an interruption.
    const auto write_pages = [&] {
        write_text(request.folder / "index.html", html_page(made));
        write_text(request.folder / "figures.json", numbers.dump(1) + "\n");
    };
    try
    {
        for (const Maker& maker : wanted)
        {
            made.push_back(maker.make(request));
            numbers.push_back(as_json(made.back()));
            write_pages();
            if (!options.quiet && !options.json)
            {
                fmt::print("{}\n", as_text(made.back()));
                std::fflush(stdout);
            }
        }
    }
    catch (const Stopped&)
    {
        if (!options.quiet)
            fmt::print(stderr, "regain: interrupted; {} of {} figures are in '{}'\n", made.size(),
                       wanted.size(), request.folder.string());
        return kInterrupted;
    }
    if (options.json) fmt::print("{}\n", numbers.dump());
    if (!options.quiet && !options.json)
        fmt::print("{}\n", (request.folder / "index.html").string());
    return kDone;
}

}  // namespace

void add_figures(CLI::App& app, int& exit_code)
{
    auto options = std::make_shared<Options>();
    CLI::App* command =
        app.add_subcommand("figures", "The paper's figures and table, measured beside its claims");
    std::string known;
    for (const Maker& m : makers()) known += fmt::format("  {:8}{}\n", m.name, m.summary);
    command->footer(
        "Each figure of Turquin 2019, made again with this library alone: pictures, "
        "plots and\nnumbers, and whether what the paper says is what was measured.\n\n" +
        known + R"(
Everything goes into one folder, with index.html for people and figures.json for
machines. What a picture or plot was made from stands there, too.

Examples:
  regain figures                     all of them; a quarter of an hour on two cores
  regain figures 2 7 -o /tmp/paper
  regain figures --size 0.25 --spp 8 --precision 0.05      a quick look
  regain figures table1 --json)");
    Options& o = *options;
    command->add_option("figure", o.wanted, "which ones [all]");
    command->add_option("-o,--output", o.folder, "folder to write, made if it is not there")
        ->capture_default_str();
    command->add_option("--spp", o.samples, "samples per pixel of the pictures, 1 to 65536")
        ->capture_default_str();
    command->add_option("--size", o.size, "scale of the pictures, 0.05 to 8")
        ->capture_default_str();
    command
        ->add_option("--precision", o.precision,
                     "scale of the number of samples behind the numbers, 0.001 to 100")
        ->capture_default_str();
    command->add_option("--seed", o.seed, "of the random numbers")->capture_default_str();
    command->add_option("--threads", o.threads, "0: one per core; never changes a result but times")
        ->capture_default_str();
    command->add_flag("--quiet", o.quiet, "no progress, no summary");
    command->add_flag("--json", o.json, "figures.json on standard output, too");
    command->callback([options, &exit_code] {
        exit_code = run_reporting([&] { return figures_command(*options); });
    });
}

}  // namespace regain::tools
