// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "conform_repeat.h"

#include "json_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace regain::tools {
namespace {

// P(N >= n) of a binomial distribution, from the terms below n.
double tail(std::size_t n, std::size_t runs, double p)
{
    double below = 0;
    for (std::size_t k = 0; k < n; ++k)
    {
        const auto x = static_cast<double>(k), all = static_cast<double>(runs);
        below += std::exp(std::lgamma(all + 1) - std::lgamma(x + 1) - std::lgamma(all - x + 1) +
                          x * std::log(p) + (all - x) * std::log1p(-p));
    }
    return std::max(0.0, 1 - below);
}

void keep_those_by_chance(conformance::Options& options)
{
    std::vector<std::string> by_chance;
    for (const conformance::CheckTitle& c : conformance::all_checks())
    {
        const bool named =
            std::find(options.checks.begin(), options.checks.end(), c.id) != options.checks.end();
        if (named && !c.by_chance)
            throw std::invalid_argument(
                fmt::format("{} is not decided by chance: it says the same in every run", c.id));
        if (c.by_chance) by_chance.push_back(c.id);
    }
    if (options.checks.empty()) options.checks = by_chance;
}

}  // namespace

Repetition repeat(const std::vector<const conformance::Subject*>& subjects,
                  conformance::Options options, std::size_t runs,
                  const std::function<bool(double)>& progress)
{
    keep_those_by_chance(options);
    Repetition r;
    const auto all = static_cast<double>(runs);
    for (std::size_t i = 0; i < runs && !r.interrupted; ++i)
    {
        options.salt = i + 1;
        options.progress = [&](double done) {
            return progress((static_cast<double>(i) + done) / all);
        };
        const conformance::Report report = conformance::run(subjects, options);
        r.interrupted = report.interrupted;
        if (r.interrupted) break;
        ++r.runs;
        bool alarm = false;
        for (const conformance::Verdict& v : report.verdicts)
            for (const conformance::Failure& f : v.failures)
            {
                alarm = true;
                r.alarms.push_back({options.salt, v.subject, v.check, f.setting, f.reproduce});
            }
        r.runs_with_alarm += alarm;
    }
    r.expected = static_cast<double>(r.runs) * options.family_error;
    r.odds = tail(r.runs_with_alarm, r.runs, options.family_error);
    return r;
}

std::string text(const Repetition& r)
{
    std::string out = fmt::format(
        "{} of {} runs raised an alarm; {:.3g} expected if nothing is wrong, odds of at least as "
        "many {:.3g}{}\n",
        r.runs_with_alarm, r.runs, r.expected, r.odds, r.interrupted ? "; interrupted" : "");
    for (const Alarm& a : r.alarms)
        out += fmt::format("  run {}: {}, {}, {}\n    {}\n", a.salt, a.subject, a.check, a.setting,
                           a.reproduce);
    return out;
}

std::string json(const Repetition& r)
{
    Json alarms = Json::array();
    for (const Alarm& a : r.alarms)
        alarms.push_back({{"salt", a.salt},
                          {"subject", a.subject},
                          {"check", a.check},
                          {"setting", a.setting},
                          {"reproduce", a.reproduce}});
    return Json{{"runs", r.runs},         {"runs_with_alarm", r.runs_with_alarm},
                {"expected", r.expected}, {"odds", r.odds},
                {"alarms", alarms},       {"interrupted", r.interrupted}}
        .dump();
}

}  // namespace regain::tools
