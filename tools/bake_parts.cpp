// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "bake_parts.h"

#include "preview/progress.h"

#include <fmt/format.h>

#include <algorithm>

namespace regain::tools {

BakeParts::BakeParts(const std::vector<std::string>& tables)
{
    std::map<std::string, std::size_t> known;
    for (const std::string& table : tables)
    {
        luts::TableIntegrals integrals(table);
        const auto [at, is_new] = known.emplace(integrals.name(), _shared.size());
        _shared_of[table] = at->second;
        if (is_new) _shared.push_back({table, std::move(integrals), rows(), {}});
    }
}

std::size_t BakeParts::rows() const
{
    return _shared.empty() ? 0 : _shared.back().place + _shared.back().integrals.rows();
}

std::size_t BakeParts::rows_of(const Part& part) const
{
    std::size_t all = 0;
    for (const Shared& shared : _shared) all += rows_of(shared, part).size();
    return all;
}

std::vector<std::size_t> BakeParts::rows_of(const Shared& shared, const Part& part)
{
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < shared.integrals.rows(); ++i)
        // Counted through, or the first part would have every table of a single row.
        if (part.holds(shared.place + i, shared.integrals.across())) rows.push_back(i);
    return rows;
}

void BakeParts::write(const std::filesystem::path& file, const JobDescription& job,
                      const Part& part, const InterruptGuard& guard) const
{
    Payload payload;
    for (const Shared& shared : _shared)
    {
        constexpr std::uint64_t steps = 1000;
        Progress progress(fmt::format("part {} of {}", part.text(), shared.table), steps,
                          Progress::style(false));
        std::uint64_t shown = 0;
        const std::vector<double> values =
            shared.integrals.integrate(rows_of(shared, part), [&](double done) {
                const auto now = static_cast<std::uint64_t>(done * static_cast<double>(steps));
                progress.advance(now - std::min(shown, now));
                shown = now;
                return !guard.flag();
            });
        if (guard.flag()) throw luts::BakeStopped();
        payload.put(values.data(), values.size());
    }
    write_part(file, job, part, payload.bytes());
}

void BakeParts::merge(const std::vector<std::string>& files, const JobDescription& job)
{
    for (Shared& shared : _shared)
        shared.values.resize(shared.integrals.rows() * shared.integrals.length());
    read_parts(files, job, [&](const Part& part, PayloadReader& payload) {
        for (Shared& shared : _shared)
            for (const std::size_t row : rows_of(shared, part))
                payload.take(shared.values.data() + row * shared.integrals.length(),
                             shared.integrals.length());
    });
}

luts::Table BakeParts::table(const std::string& name) const
{
    return luts::bake(name, _shared[_shared_of.at(name)].values);
}

}  // namespace regain::tools
