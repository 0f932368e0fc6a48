// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "describe.h"

#include <regain/luts/replace_file.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <stdexcept>

REGAIN_NAMESPACE_BEGIN
namespace conformance {

std::string short_number(double x)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", x);
    return text;
}

std::string in_short(const Failure& f)
{
    std::string text =
        "measured " + short_number(f.measured) + ", accepted up to " + short_number(f.bound);
    if (f.probability > 0) text += "; by chance once in " + short_number(1 / f.probability);
    return text;
}

std::string counts(const Report& report)
{
    const std::size_t passed = report.count(Verdict::Kind::passed);
    std::size_t subjects = 0;
    for_each_subject(report, [&](Verdicts, Verdicts) { ++subjects; });
    return std::to_string(subjects) + (subjects == 1 ? " subject" : " subjects") + ", tier " +
           report.tier + (report.interrupted ? ", interrupted" : "") + ": " +
           std::to_string(passed) + (passed == 1 ? " check" : " checks") + " passed, " +
           std::to_string(report.count(Verdict::Kind::failed)) + " failed, " +
           std::to_string(report.count(Verdict::Kind::not_applicable)) + " not applicable";
}

void for_each_subject(const Report& report, const std::function<void(Verdicts, Verdicts)>& visit)
{
    const auto end = report.verdicts.end();
    for (auto first = report.verdicts.begin(); first != end;)
    {
        const auto last =
            std::find_if(first, end, [&](const Verdict& v) { return v.subject != first->subject; });
        visit(first, last);
        first = last;
    }
}

void write_text(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write)
{
    luts::replace_file(file, [&](const std::filesystem::path& temporary) {
        std::ofstream out(temporary, std::ios::binary);
        write(out);
        // A full disk shows only now.
        out.close();
        if (!out) throw std::runtime_error("cannot write '" + file.string() + "'");
    });
}

}  // namespace conformance
REGAIN_NAMESPACE_END
