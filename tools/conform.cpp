// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "commands.h"
#include "conform_subjects.h"
#include "errors.h"
#include "preview/interrupt.h"
#include "preview/progress.h"

#include <regain/conformance/run.h>

#include <CLI/CLI.hpp>

#include <iostream>
#include <memory>

namespace regain::tools {
namespace {

struct Arguments
{
    conformance::Options options;
    std::string tier = "commit";
    bool list = false;
};

int run_conform(Arguments& a)
{
    a.options.tier = a.tier == "commit" ? conformance::Tier::commit : conformance::Tier::thorough;
    if (a.list)
    {
        for (const auto* s : built_in_subjects()) std::cout << s->name() << "\n";
        return kDone;
    }
    const InterruptGuard guard;
    constexpr std::uint64_t steps = 1000;
    conformance::Report report;
    {
        Progress progress("conform", steps, Progress::style(false));
        std::uint64_t shown = 0;
        a.options.progress = [&](double done) {
            const auto now = static_cast<std::uint64_t>(done * static_cast<double>(steps));
            progress.advance(now - std::min(shown, now));
            shown = now;
            return !guard.flag();
        };
        report = conformance::run(built_in_subjects(), a.options);
    }
    write_summary(std::cout, report);
    if (report.interrupted) return kInterrupted;
    return report.passed() ? kDone : kCheckFailed;
}

}  // namespace

void add_conform(CLI::App& app, int& exit_code)
{
    CLI::App* command = app.add_subcommand("conform", "hold closures to what they promise");
    auto a = std::make_shared<Arguments>();
    command->add_option("--subject", a->options.subject, "only subjects with this in their name");
    command->add_option("--check", a->options.checks, "only these checks");
    command->add_option("--setting", a->options.setting, "only this setting");
    command->add_option("--tier", a->tier, "commit or thorough")
        ->check(CLI::IsMember({"commit", "thorough"}));
    command->add_flag("--list", a->list, "list the subjects");
    command->callback(
        [a, &exit_code] { exit_code = run_reporting([&] { return run_conform(*a); }); });
}

}  // namespace regain::tools
