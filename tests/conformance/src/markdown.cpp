// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "describe.h"

#include <regain/conformance/run.h>

#include <algorithm>
#include <ostream>

REGAIN_NAMESPACE_BEGIN
namespace conformance {
namespace {

std::string cell(const Verdict& v)
{
    switch (v.kind)
    {
        case Verdict::Kind::passed: return short_number(v.measured);
        case Verdict::Kind::failed: return "**FAILED** " + short_number(v.measured);
        case Verdict::Kind::not_applicable: break;
    }
    return "-";
}

bool was_asked_for(const Report& report, const std::string& check)
{
    return std::any_of(report.verdicts.begin(), report.verdicts.end(),
                       [&](const Verdict& v) { return v.check == check; });
}

}  // namespace

void write_markdown(std::ostream& out, const Report& report)
{
    std::vector<CheckTitle> columns;
    for (const CheckTitle& c : all_checks())
        if (was_asked_for(report, c.id)) columns.push_back(c);

    out << counts(report) << ".\n\n| subject |";
    for (const CheckTitle& c : columns) out << " " << c.id << " |";
    out << "\n|---|" << [&] {
        std::string rule;
        for (std::size_t i = 0; i < columns.size(); ++i) rule += "---:|";
        return rule;
    }() << "\n";
    for_each_subject(report, [&](Verdicts first, Verdicts last) {
        out << "| `" << first->subject << "` |";
        for (const CheckTitle& c : columns)
        {
            const auto v =
                std::find_if(first, last, [&](const Verdict& x) { return x.check == c.id; });
            out << " " << (v == last ? "-" : cell(*v)) << " |";
        }
        out << "\n";
    });

    out << "\nEach number is what was measured where it came nearest to its bound; `-` where the "
           "check does not\napply.\n\n| check | states | decided by |\n|---|---|---|\n";
    for (const CheckTitle& c : all_checks())
        out << "| " << c.id << " | " << c.title << " | " << (c.by_chance ? "chance" : "a bound")
            << " |\n";
}

void write_markdown(const std::filesystem::path& file, const Report& report)
{
    write_text(file, [&](std::ostream& out) { write_markdown(out, report); });
}

}  // namespace conformance
REGAIN_NAMESPACE_END
