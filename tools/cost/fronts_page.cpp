// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "fronts_page.h"

#include "machine.h"

#include <regain/closures/version.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace regain::tools::cost {
namespace {

const Front* find(const std::vector<Front>& fronts, Class kind, const Law& law, const Band& band)
{
    const auto at = std::find_if(fronts.begin(), fronts.end(), [&](const Front& f) {
        return f.kind == kind && f.law.label() == law.label() && f.band.name == band.name;
    });
    return at == fronts.end() ? nullptr : &*at;
}

// "`none` 0.69 / 1.00, `directional` < 0.003 / 1.65"
std::string cell(const Front* f)
{
    if (!f) return "";
    std::vector<std::string> points;
    for (const std::size_t i : f->front)
    {
        const Point& p = f->points[i];
        points.push_back(fmt::format("`{}` {}{:.2g} / {:.2f}", p.method,
                                     p.error > f->floor ? "" : "< ", p.error, p.time));
    }
    return fmt::format("{}", fmt::join(points, "<br>"));
}

std::string table(const Results& results, const std::vector<Front>& fronts, const Law& law)
{
    std::string out = "| |";
    for (const Band& band : bands) out += fmt::format(" {} |", band.words);
    out += "\n|---|---|---|---|\n";
    for (const Class kind : results.choice.classes)
    {
        out += fmt::format("| {} |", words(kind));
        for (const Band& band : bands)
            out += fmt::format(" {} |", cell(find(fronts, kind, law, band)));
        out += "\n";
    }
    return out;
}

}  // namespace

std::string fronts_page(const Results& results, const std::vector<Front>& fronts)
{
    std::string out = fmt::format(
        "<!-- SPDX-License-Identifier: Apache-2.0 -->\n"
        "<!-- Copyright Contributors to the Regain project -->\n\n"
        "# Which methods are worth their time\n\n"
        "`regain cost` writes this page; nobody edits it. In each cell are the methods than which "
        "none is both as fast and as near, from fast to near: the largest error of the albedo / "
        "the time of an eval and a sample over those of `none`. `<`: the error drowns in the noise "
        "of the run. [cost.md](cost.md) explains the numbers.\n\n"
        "Regain {}, {}, {}; {} samples for each direction{}.\n",
        REGAIN_VERSION_STRING, processor(), compiler(), results.samples,
        results.quick ? ", a quick run" : "");
    for (const Law& law : results.choice.laws)
    {
        out += fmt::format("\n## {}\n\n{}", law.label(), table(results, fronts, law));
        for (const Front& f : fronts)
            if (f.law.label() == law.label()) out += fmt::format("\n{}\n", f.sentence);
    }
    return out;
}

}  // namespace regain::tools::cost
