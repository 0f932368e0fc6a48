// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "describe.h"

#include <algorithm>
#include <ostream>

REGAIN_NAMESPACE_BEGIN
namespace conformance {
namespace {

void write_failures(std::ostream& out, const Verdict& v)
{
    out << "\nFAILED " << v.subject << ", " << v.check << ": " << v.title << "\n  at "
        << v.failures.size() << " of " << v.settings << (v.settings == 1 ? " setting" : " settings")
        << "\n";
    for (const Failure& f : v.failures)
    {
        out << "\n  " << (f.setting.empty() ? "all parameters" : f.setting) << "\n    "
            << in_short(f) << "\n";
        if (!f.detail.empty()) out << "    " << f.detail << "\n";
        out << "    " << f.reproduce << "\n";
    }
}

}  // namespace

void write_summary(std::ostream& out, const Report& report)
{
    out << counts(report) << "\n\n";
    std::size_t width = 0;
    for (const Verdict& v : report.verdicts) width = std::max(width, v.subject.size());
    for_each_subject(report, [&](Verdicts first, Verdicts last) {
        std::string passed, failed;
        for (auto v = first; v != last; ++v)
        {
            if (v->kind == Verdict::Kind::passed) passed += " " + v->check;
            if (v->kind == Verdict::Kind::failed) failed += " " + v->check;
        }
        out << first->subject << std::string(width - first->subject.size() + 2, ' ');
        if (!failed.empty()) out << "FAILED" << failed << (passed.empty() ? "" : "; ");
        if (!passed.empty()) out << "passed" << passed;
        if (failed.empty() && passed.empty()) out << "nothing applies";
        out << "\n";
    });
    for (const Verdict& v : report.verdicts)
        if (v.kind == Verdict::Kind::failed) write_failures(out, v);

    // Once more, where whoever reads failures ends.
    if (report.count(Verdict::Kind::failed) > 0) out << "\n" << counts(report) << "\n";
    out << "\n"
        << report.statistical_tests << " tests by chance, at " << short_number(report.level)
        << " each; " << short_number(report.seconds) << " s\n";
}

}  // namespace conformance
REGAIN_NAMESPACE_END
