// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/conformance/run.h>

#include "check.h"
#include "names.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <stdexcept>
#include <thread>

REGAIN_NAMESPACE_BEGIN
namespace conformance {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start)
{
    return std::chrono::duration<double>(Clock::now() - start).count();
}

// One subject at one setting, and the checks that look at it there.
struct Job
{
    const Subject* subject;
    Setting setting;
    double share;  // in the hostile inputs of the subject's family
    std::vector<std::pair<const Check*, std::size_t>> checks;  // and the verdict each adds to
};

struct Plan
{
    std::vector<Job> jobs;
    std::vector<Verdict> verdicts;
    std::size_t statistical_tests = 0;
    std::size_t subjects = 0;  // that are wanted, chosen or not
    std::size_t settings = 0;  // of these
};

bool is_wanted(const Options& options, const Check& check)
{
    return options.checks.empty() || std::find(options.checks.begin(), options.checks.end(),
                                               check.id) != options.checks.end();
}

bool applies_to(const Check& check, const Setting& setting, bool first)
{
    switch (check.scope)
    {
        case Scope::subject: return first;
        case Scope::parameters: return setting.first_direction;
        case Scope::direction: break;
    }
    return true;
}

// A whole name means that subject, though others may have it in theirs.
bool is_wanted(const Subject& subject, const std::string& text, bool is_whole_name)
{
    const std::string name = subject.name();
    return is_whole_name ? name == text : name.find(text) != std::string::npos;
}

void require_usable_names(const std::vector<const Subject*>& subjects)
{
    std::vector<std::string> names;
    for (const Subject* s : subjects)
    {
        names.push_back(s->name());
        if (const std::string why = why_unusable(names.back()); !why.empty())
            throw std::invalid_argument(why);
    }
    std::sort(names.begin(), names.end());
    const auto twice = std::adjacent_find(names.begin(), names.end());
    if (twice != names.end())
        throw std::invalid_argument("two subjects are called '" + *twice + "'");
}

// Of hostile inputs: a walk may take thousands of steps where others take one.
double appetite(const Traits& traits) { return traits.stochastic_eval ? 0.05 : 1; }

Plan plan(const std::vector<const Subject*>& subjects, const Options& options)
{
    Plan p;
    std::map<std::string, double> family_appetite;
    for (const Subject* subject : subjects)
        family_appetite[subject->family()] += appetite(subject->make({})->traits());
    const bool is_whole_name = std::any_of(subjects.begin(), subjects.end(), [&](const Subject* s) {
        return s->name() == options.subject;
    });
    for (const Subject* subject : subjects)
    {
        if (!is_wanted(*subject, options.subject, is_whole_name)) continue;
        const bool chosen = !options.chosen || options.chosen(p.subjects);
        ++p.subjects;
        const Traits traits = subject->make({})->traits();
        std::vector<std::pair<const Check*, std::size_t>> wanted;
        for (const Check& check : checks())
        {
            if (!is_wanted(options, check)) continue;
            Verdict v;
            v.subject = subject->name();
            v.check = check.id;
            v.title = check.title;
            v.reason = check.why_not(*subject, traits);
            if (v.reason.empty())
                wanted.emplace_back(&check, p.verdicts.size());
            else
                v.kind = Verdict::Kind::not_applicable;
            if (chosen) p.verdicts.push_back(v);
        }
        bool first = true;
        const double share = appetite(traits) / family_appetite[subject->family()];
        for (Setting& setting : settings_of(*subject, options.tier))
        {
            Job job{subject, std::move(setting), share, {}};
            for (const auto& [check, verdict] : wanted)
                if (applies_to(*check, job.setting, first)) job.checks.emplace_back(check, verdict);
            first = false;
            if (job.checks.empty()) continue;
            // The level is that of the whole run, whatever part of it is run again.
            for (const auto& [check, verdict] : job.checks) p.statistical_tests += check->by_chance;
            if (!options.setting.empty() && options.setting != job.setting.name) continue;
            ++p.settings;
            if (chosen) p.jobs.push_back(std::move(job));
        }
    }
    return p;
}

class Run
{
public:
    Run(Plan plan, const Options& options)
        : _plan(std::move(plan)),
          _options(options),
          _level(sidak_level(options.family_error, _plan.statistical_tests))
    {}

    Report report()
    {
        const auto start = Clock::now();
        work();
        Report r;
        r.tier = _options.tier == Tier::commit ? "commit" : "thorough";
        r.interrupted = _stop;
        r.statistical_tests = _plan.statistical_tests;
        r.level = _level;
        r.verdicts = std::move(_plan.verdicts);
        for (Verdict& v : r.verdicts)
            if (v.kind == Verdict::Kind::passed && v.settings == 0)
            {
                v.kind = Verdict::Kind::not_applicable;
                v.reason = r.interrupted ? "the run was interrupted before"
                                         : "no setting was looked at that it could be told of";
            }
        r.seconds = seconds_since(start);
        return r;
    }

private:
    void work()
    {
        const auto processors = std::max(1u, std::thread::hardware_concurrency());
        const auto wanted =
            _options.threads > 0 ? static_cast<unsigned>(_options.threads) : processors;
        std::vector<std::thread> threads;
        std::condition_variable ended;
        unsigned running = wanted;
        for (unsigned i = 0; i < wanted; ++i)
            threads.emplace_back([&] {
                take_jobs();
                const std::lock_guard<std::mutex> lock(_mutex);
                --running;
                ended.notify_all();
            });
        try
        {
            std::unique_lock<std::mutex> lock(_mutex);
            while (running > 0)
            {
                ended.wait_for(lock, std::chrono::milliseconds(100));
                if (!_options.progress) continue;
                const double done =
                    static_cast<double>(_done) /
                    static_cast<double>(std::max<std::size_t>(1, _plan.jobs.size()));
                lock.unlock();
                if (!_options.progress(done)) _stop = true;
                lock.lock();
            }
        }
        catch (...)
        {
            _stop = true;
            for (std::thread& t : threads) t.join();
            throw;
        }
        for (std::thread& t : threads) t.join();
        if (_failure) std::rethrow_exception(_failure);
    }

    void take_jobs()
    {
        try
        {
            for (std::size_t i; !_stop && (i = _next++) < _plan.jobs.size(); ++_done)
                look(_plan.jobs[i]);
        }
        catch (...)
        {
            const std::lock_guard<std::mutex> lock(_mutex);
            if (!_failure) _failure = std::current_exception();
            _stop = true;
        }
    }

    void look(const Job& job)
    {
        Bench bench(*job.subject, job.setting, job.share, _options, false, _stop, _memory);
        std::optional<Bench> second;
        for (const auto& [check, verdict] : job.checks)
        {
            const auto start = Clock::now();
            std::optional<Outcome> outcome = check->run(bench);
            if (outcome && check->by_chance && outcome->probability < _level)
            {
                if (!second)
                    second.emplace(*job.subject, job.setting, job.share, _options, true, _stop,
                                   _memory);
                outcome = check->run(*second);
            }
            if (outcome && !_stop)
                note(*check, job.setting, verdict, *outcome, seconds_since(start));
        }
    }

    void note(const Check& check, const Setting& setting, std::size_t verdict, const Outcome& o,
              double seconds)
    {
        const bool failed = check.by_chance ? o.probability < _level : o.probability < 1;
        const std::lock_guard<std::mutex> lock(_mutex);
        Verdict& v = _plan.verdicts[verdict];
        ++v.settings;
        v.seconds += seconds;
        const auto nearness = [](double measured, double bound) {
            return bound > 0 ? measured / bound : measured;
        };
        const std::string name = check.scope == Scope::subject      ? ""
                                 : check.scope == Scope::parameters ? setting.parameters_name
                                                                    : setting.name;
        const double near = nearness(o.measured, o.bound), before = nearness(v.measured, v.bound);
        // Jobs end in any order; what is said of them does not depend on it.
        if (v.settings == 1 || near > before || (near == before && name < v.worst))
        {
            v.measured = o.measured;
            v.bound = o.bound;
            v.worst = name;
            v.note = o.note;
        }
        if (!failed) return;
        v.kind = Verdict::Kind::failed;
        v.failures.push_back(
            {name, o.measured, o.bound, check.by_chance ? o.probability : 0, o.detail,
             _options.command + " --subject " + v.subject + " --check " + check.id +
                 " --setting '" + setting.name + "'" +
                 (_options.tier == Tier::thorough ? " --tier thorough" : "") +
                 (_options.salt ? " --seed-salt " + std::to_string(_options.salt) : ""),
             o.histogram});
        std::sort(v.failures.begin(), v.failures.end(),
                  [](const Failure& a, const Failure& b) { return a.setting < b.setting; });
    }

    Plan _plan;
    const Options& _options;
    double _level;
    std::atomic<std::size_t> _next{0}, _done{0};
    std::atomic<bool> _stop{false};
    Memory _memory;
    std::mutex _mutex;
    std::exception_ptr _failure;
};

}  // namespace

std::vector<CheckTitle> all_checks()
{
    std::vector<CheckTitle> titles;
    for (const Check& c : checks()) titles.push_back({c.id, c.title, c.by_chance});
    return titles;
}

Report run(const std::vector<const Subject*>& subjects, const Options& options)
{
    for (const std::string& id : options.checks)
        if (std::none_of(checks().begin(), checks().end(),
                         [&](const Check& c) { return c.id == id; }))
        {
            std::string known;
            for (const Check& c : checks()) known += std::string(known.empty() ? "" : ", ") + c.id;
            throw std::invalid_argument("no check is called '" + id + "'; there are " + known);
        }
    require_usable_names(subjects);
    Plan p = plan(subjects, options);
    if (p.settings == 0)
        throw std::invalid_argument(
            "nothing to run: no subject's name has '" + options.subject + "' in it" +
            (options.setting.empty() ? "" : " and the setting '" + options.setting + "'"));
    return Run(std::move(p), options).report();
}

std::size_t Report::count(Verdict::Kind kind) const
{
    return static_cast<std::size_t>(std::count_if(
        verdicts.begin(), verdicts.end(), [kind](const Verdict& v) { return v.kind == kind; }));
}

}  // namespace conformance
REGAIN_NAMESPACE_END
