// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "bake_table.h"

#include "preview/progress.h"

#include <regain/luts/bake.h>

#include <algorithm>
#include <stdexcept>

namespace regain::tools {

luts::Table bake_showing(const std::string& name, const InterruptGuard& guard)
{
    constexpr std::uint64_t steps = 1000;
    Progress progress("baking " + name, steps, Progress::style(false));
    std::uint64_t shown = 0;
    luts::Table table = luts::bake(name, [&](double done) {
        const auto now = static_cast<std::uint64_t>(done * static_cast<double>(steps));
        progress.advance(now - std::min(shown, now));
        shown = now;
        return !guard.flag();
    });
    // A table may be too small to ask often.
    if (guard.flag()) throw luts::BakeStopped();
    return table;
}

bool is_table(const std::string& name)
{
    try
    {
        luts::require_bakeable(name);
        return true;
    }
    catch (const std::invalid_argument&)
    {
        return false;
    }
}

}  // namespace regain::tools
