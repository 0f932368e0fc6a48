// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "commands.h"
#include "conform_parts.h"
#include "conform_repeat.h"
#include "conform_report.h"
#include "conform_subjects.h"
#include "errors.h"
#include "part_options.h"
#include "preview/interrupt.h"
#include "preview/progress.h"

#include <regain/conformance/run.h>
#include <regain/conformance/shared_object.h>
#include <regain/luts/replace_file.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <iostream>
#include <memory>

namespace regain::tools {
namespace {

constexpr const char* help_footer = R"help(
A subject is a closure with its parameters still open; checks hold it to what it promises, at
settings all over the range of what it reads. Without SHARED_OBJECT the subjects are the library's
own; with some, theirs alone. docs/conformance-kit.md says what a shared object exports, what each
check states, and how to read a failure.

Every random number comes from the name of the case: a run always says the same, on any number of
threads, and the command below a failure shows that failure again. Where chance has a part, all tests
of a run together raise a false alarm once in 1000 runs. --repeat tests just that: it runs the checks
decided by chance N times with other random numbers, and fails where alarms are too many for chance.

--part K/N runs every N-th subject; --merge reports on all of them as one run would, and it alone says
whether a check failed. A part that was stopped leaves nothing, and is run again. Its file has the name
of the first report that is asked for, or conform: conform.part-3-of-7.

After Ctrl-C what was found so far is reported, marked as interrupted (exit code 130).
Exit codes: 0 all passed, 1 a check failed, 2 bad input.

examples:
  regain conform                                    everything, tier commit
  regain conform --subject conductor.ggx            the subjects with this in their names
  regain conform --subject dielectric.ggx.turquin --check C4 C5
  regain conform ./my_closure.so                    a closure from elsewhere
  regain conform ./my_closure.so --junit conform.xml --histograms histograms
  regain conform --tier thorough --json=report.json --markdown report.md
  regain conform --json | jq .failed
  regain conform --subject sheen --repeat 1000      false alarms of the kit itself
  regain conform --tier thorough --part 3/7         on one of seven machines
  regain conform --tier thorough --merge conform.part-*-of-7
  regain conform --list                             the subjects
  regain conform --list-checks                      the checks, and what each states
)help";

// What CLI11 makes of a flag without a value.
constexpr const char* json_to_output = "true";

struct Arguments
{
    std::vector<std::string> objects;
    conformance::Options options;
    ReportFiles files;
    PartOptions parts;
    std::string tier = "commit";
    std::size_t repetitions = 0;
    bool list = false, list_checks = false;

    bool json_on_output() const { return files.json == json_to_output; }
};

// What the arguments speak of: those of shared objects, or the library's own.
class Subjects
{
public:
    explicit Subjects(const std::vector<std::string>& objects)
    {
        for (const std::string& object : objects)
        {
            const std::string end = object.size() > 5 ? object.substr(object.size() - 5) : "";
            if (end == ".json")
                throw BadInput(fmt::format(
                    "'{0}' is taken for a shared object; a report is written by --json={0}",
                    object));
            for (auto& subject : conformance::load_shared_object(object))
                _owned.push_back(std::move(subject));
        }
        for (const auto& subject : _owned) _all.push_back(subject.get());
        if (objects.empty()) _all = built_in_subjects();
    }
    const std::vector<const conformance::Subject*>& all() const { return _all; }

private:
    std::vector<std::unique_ptr<conformance::Subject>> _owned;
    std::vector<const conformance::Subject*> _all;
};

// As a shell takes it.
std::string quoted(const std::string& text)
{
    const auto plain = [](unsigned char c) {
        return std::isalnum(c) ||
               std::string("-_./+,:@%").find(static_cast<char>(c)) != std::string::npos;
    };
    if (!text.empty() && std::all_of(text.begin(), text.end(), plain)) return text;
    std::string out = "'";
    for (char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

// Shows the fraction done until it goes out of scope; false asks to stop.
class Watch
{
public:
    Watch() : _progress("conform", steps, Progress::style(false)) {}

    bool operator()(double done)
    {
        const auto now = static_cast<std::uint64_t>(done * static_cast<double>(steps));
        _progress.advance(now - std::min(_shown, now));
        _shown = std::max(_shown, now);
        return !_guard.flag();
    }

private:
    static constexpr std::uint64_t steps = 1000;
    InterruptGuard _guard;
    Progress _progress;
    std::uint64_t _shown = 0;
};

// All that decides the report.
JobDescription job_of(const Arguments& a)
{
    const conformance::Options& o = a.options;
    JobDescription job = describe_job("conform");
    job.add("tier", a.tier);
    job.add("subject", o.subject);
    job.add("check", fmt::format("{}", fmt::join(o.checks, " ")));
    job.add("setting", o.setting);
    job.add("seed-salt", std::to_string(o.salt));
    job.add("shared objects", fmt::format("{}", fmt::join(a.objects, " ")));
    for (const std::string& object : a.objects) job.add_contents("contents of " + object, object);
    return job;
}

int exit_code_of(bool interrupted, bool passed)
{
    if (interrupted) return kInterrupted;
    return passed ? kDone : kCheckFailed;
}

int run_repeatedly(const Arguments& a, const Subjects& subjects)
{
    const ReportFiles& f = a.files;
    if (!f.junit.empty() || !f.markdown.empty() || !f.histograms.empty() ||
        (!f.json.empty() && !a.json_on_output()))
        throw BadInput(
            "--repeat writes no files: leave out --junit, --json=FILE, --markdown and "
            "--histograms");
    if (a.options.salt) throw BadInput("--repeat chooses the salts 1 to N: leave out --seed-salt");
    Repetition r;
    {
        Watch watch;
        r = repeat(subjects.all(), a.options, a.repetitions, std::ref(watch));
    }
    fmt::print("{}", a.json_on_output() ? json(r) + "\n" : text(r));
    return exit_code_of(r.interrupted, r.passed());
}

int report_on(const conformance::Report& report, const ReportFiles& files, bool json_on_output)
{
    const std::vector<std::string> written = write_reports(files, report);
    if (json_on_output)
        write_json(std::cout, report);
    else
        write_summary(std::cout, report);
    std::cout.flush();
    if (!std::cout) throw BadInput("the report could not be written to standard output");
    for (const std::string& file : written) fmt::print(stderr, "regain: wrote {}\n", file);
    return exit_code_of(report.interrupted, report.passed());
}

conformance::Report run_watched(const Subjects& subjects, conformance::Options options)
{
    Watch watch;
    options.progress = std::ref(watch);
    return conformance::run(subjects.all(), options);
}

int run_part(const Arguments& a, const Subjects& subjects, const Part& part,
             const JobDescription& job)
{
    std::filesystem::path stem = "conform";
    for (const std::string& file : {a.files.markdown, a.files.json, a.files.junit})
        if (!file.empty() && file != json_to_output)
            stem = std::filesystem::path(file).replace_extension();
    const std::filesystem::path file = part_file_name(stem, part);
    luts::require_replaceable(file);
    std::size_t wanted = 0, chosen = 0;
    conformance::Options options = a.options;
    options.chosen = [&](std::size_t i) {
        ++wanted;
        chosen += part.holds(i);
        return part.holds(i);
    };
    const conformance::Report report = run_watched(subjects, options);
    if (report.interrupted)
    {
        fmt::print(stderr, "regain: stopped, '{}' was not written: run the part again\n",
                   file.string());
        return kInterrupted;
    }
    write_conform_part(file, report, job, part);
    report_part(part, file, chosen, wanted, "subjects", report.seconds, a.json_on_output());
    return kDone;
}

int run_once(const Arguments& a, const Subjects& subjects)
{
    ReportFiles files = a.files;
    if (a.json_on_output()) files.json.clear();
    const std::optional<Part> part = a.parts.chosen();
    const JobDescription job = job_of(a);
    if (part) return run_part(a, subjects, *part, job);
    require_writable(files);
    const conformance::Report report =
        a.parts.merges() ? merge_conform_parts(a.parts.merged, job, subjects.all())
                         : run_watched(subjects, a.options);
    return report_on(report, files, a.json_on_output());
}

int run_conform(Arguments& a)
{
    if (const std::string with = a.parts.given(); !with.empty())
        if (a.list || a.list_checks || a.repetitions > 0)
            throw BadInput(
                fmt::format("{} does not go with --list, --list-checks and --repeat", with));
    if (a.list_checks)
    {
        for (const conformance::CheckTitle& c : conformance::all_checks())
            fmt::print("{:<4} {}{}\n", c.id, c.title, c.by_chance ? " (decided by chance)" : "");
        return kDone;
    }
    const Subjects subjects(a.objects);
    if (a.list)
    {
        for (const auto* s : subjects.all()) fmt::print("{}\n", s->name());
        return kDone;
    }
    a.options.tier = a.tier == "commit" ? conformance::Tier::commit : conformance::Tier::thorough;
    for (const std::string& object : a.objects) a.options.command += " " + quoted(object);
    return a.repetitions > 0 ? run_repeatedly(a, subjects) : run_once(a, subjects);
}

}  // namespace

void add_conform(CLI::App& app, int& exit_code)
{
    CLI::App* command = app.add_subcommand(
        "conform", "hold closures to what they promise: the library's, or a shared object's");
    command->footer(help_footer);
    auto a = std::make_shared<Arguments>();
    command
        ->add_option("SHARED_OBJECT", a->objects,
                     "closures from elsewhere (default: the library's)")
        ->type_name("");
    command
        ->add_option("--subject", a->options.subject,
                     "only this subject, or those with it in their names")
        ->type_name("TEXT");
    command->add_option("--check", a->options.checks, "only these checks")->type_name("ID ...");
    command->add_option("--setting", a->options.setting, "only this setting, as a failure names it")
        ->type_name("TEXT");
    command->add_option("--tier", a->tier, "commit (default): minutes; thorough: an hour")
        ->type_name("commit|thorough")
        ->check(CLI::IsMember({"commit", "thorough"}));
    command->add_option("--seed-salt", a->options.salt, "other random numbers for everything")
        ->type_name("N")
        ->check(CLI::NonNegativeNumber);  // or -1 would be a large number
    command->add_option("--repeat", a->repetitions, "run N times, and count false alarms")
        ->type_name("N")
        ->check(CLI::Range(1, 1000000));
    command->add_option("--threads", a->options.threads, "default: one a processor")
        ->type_name("N")
        ->check(CLI::Range(1, 4096));
    command->add_option("--junit", a->files.junit, "the report as JUnit XML")->type_name("FILE");
    // A flag with a value, for an option would take the shared object that comes next to be one.
    command->add_flag("--json", a->files.json,
                      "the report as JSON, on standard output or in --json=FILE");
    command->add_option("--markdown", a->files.markdown, "the report as a table")
        ->type_name("FILE");
    command
        ->add_option(
            "--histograms", a->files.histograms,
            "EXR and PNG of samples that do not follow the pdf: found, expected, difference")
        ->type_name("FOLDER");
    declare(a->parts, *command);
    command->add_flag("--list", a->list, "list the subjects");
    command->add_flag("--list-checks", a->list_checks, "list the checks");
    command->callback(
        [a, &exit_code] { exit_code = run_reporting([&] { return run_conform(*a); }); });
}

}  // namespace regain::tools
