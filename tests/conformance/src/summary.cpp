// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/conformance/report.h>

#include <cstdio>
#include <ostream>

REGAIN_NAMESPACE_BEGIN
namespace conformance {
namespace {

std::string short_number(double x)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", x);
    return text;
}

}  // namespace

void write_summary(std::ostream& out, const Report& report)
{
    std::string subject;
    for (const Verdict& v : report.verdicts)
    {
        if (v.subject != subject) out << (subject.empty() ? "" : "\n") << v.subject << ":";
        subject = v.subject;
        const bool failed = v.kind == Verdict::Kind::failed;
        if (v.kind == Verdict::Kind::not_applicable) continue;
        out << " " << v.check << (failed ? " FAILED" : "") << " " << short_number(v.measured) << "/"
            << short_number(v.bound);
    }
    out << "\n";
    for (const Verdict& v : report.verdicts)
    {
        if (v.kind != Verdict::Kind::failed) continue;
        out << "\nFAILED " << v.subject << ", " << v.check << ": " << v.title << "; "
            << v.failures.size() << " of " << v.settings << " settings\n";
        std::size_t shown = 0;
        for (const Failure& f : v.failures)
        {
            if (++shown > 5)
            {
                out << "  and " << v.failures.size() - 5 << " more\n";
                break;
            }
            out << "  " << f.setting << ": " << short_number(f.measured) << ", accepted up to "
                << short_number(f.bound);
            if (f.probability > 0) out << ", by chance once in " << short_number(1 / f.probability);
            out << "\n    " << f.detail << "\n    " << f.reproduce << "\n";
        }
    }
    out << "\n"
        << report.count(Verdict::Kind::passed) << " passed, " << report.count(Verdict::Kind::failed)
        << " failed, " << report.count(Verdict::Kind::not_applicable) << " not applicable; "
        << report.statistical_tests << " tests by chance at " << short_number(report.level)
        << " each; " << short_number(report.seconds) << " s"
        << (report.interrupted ? "; interrupted" : "") << "\n";
}

}  // namespace conformance
REGAIN_NAMESPACE_END
