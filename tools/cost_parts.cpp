// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "cost_parts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace regain::tools {

using cost::Case;
using cost::CaseErrors;
using cost::Lobe;
using cost::LobeSet;
using cost::MethodErrors;
using cost::RunOptions;
using cost::Shape;

namespace {

std::uint64_t count(std::size_t n) { return n; }

void put_lobe(Payload& payload, const Lobe& lobe)
{
    payload.put(lobe.seen.data(), lobe.seen.size());
    for (const Shape& shape : lobe.shapes)
        for (const figures::Histogram& channel : shape)
        {
            const std::uint64_t bins = count(channel.size());
            payload.put(&bins, 1);
            payload.put(channel.data(), channel.size());
        }
}

Lobe take_lobe(PayloadReader& payload)
{
    Lobe lobe;
    payload.take(lobe.seen.data(), lobe.seen.size());
    for (Shape& shape : lobe.shapes)
        for (figures::Histogram& channel : shape)
        {
            std::uint64_t bins = 0;
            payload.take(&bins, 1);
            if (bins > 2 * figures::histogram_bins)
                throw PayloadReader::Error("a lobe has too many bins");
            channel.resize(bins);
            payload.take(channel.data(), channel.size());
        }
    return lobe;
}

void put_case(Payload& payload, const CaseErrors& errors)
{
    const std::uint64_t methods[] = {count(errors.methods.size()), errors.lobes ? 1u : 0u};
    payload.put(methods, 2);
    for (const MethodErrors& m : errors.methods)
    {
        payload.put_text(m.method);
        payload.put_text(m.refused);
        const std::uint64_t numbers[] = {count(m.table_bytes), count(m.errors.size())};
        payload.put(numbers, 2);
        payload.put(m.errors.data(), m.errors.size());
    }
    if (!errors.lobes) return;
    const LobeSet& lobes = *errors.lobes;
    payload.put_text(lobes.part.label);
    put_lobe(payload, lobes.walk);
    const std::uint64_t shown = count(lobes.methods.size());
    payload.put(&shown, 1);
    for (const auto& [method, lobe] : lobes.methods)
    {
        payload.put_text(method);
        put_lobe(payload, lobe);
    }
}

CaseErrors take_case(PayloadReader& payload, const Case& c, std::size_t methods)
{
    CaseErrors errors;
    std::uint64_t there[2];
    payload.take(there, 2);
    if (there[0] != methods) throw PayloadReader::Error("a case has not all methods");
    for (std::size_t i = 0; i < methods; ++i)
    {
        MethodErrors& m = errors.methods.emplace_back();
        m.method = payload.take_text();
        m.refused = payload.take_text();
        std::uint64_t numbers[2];
        payload.take(numbers, 2);
        m.table_bytes = numbers[0];
        if (numbers[1] != (m.refused.empty() ? c.parts.size() : 0))
            throw PayloadReader::Error("a case has not all materials");
        m.errors.resize(numbers[1]);
        payload.take(m.errors.data(), m.errors.size());
    }
    if (there[1] == 0) return errors;
    LobeSet lobes{c.kind, c.alpha, {}, {}, {}};
    const std::string label = payload.take_text();
    for (const cost::Part& part : c.parts)
        if (part.label == label) lobes.part = part;
    lobes.walk = take_lobe(payload);
    std::uint64_t shown = 0;
    payload.take(&shown, 1);
    for (; shown > 0; --shown)
    {
        std::string method = payload.take_text();
        lobes.methods.emplace_back(std::move(method), take_lobe(payload));
    }
    errors.lobes = std::move(lobes);
    return errors;
}

}  // namespace

JobDescription cost_job(const RunOptions& options)
{
    std::vector<std::string> classes, laws, methods;
    for (const cost::Class c : options.choice.classes) classes.emplace_back(name(c));
    for (const cost::Law& law : options.choice.laws) laws.push_back(law.label());
    for (const auto& method : options.choice.methods) methods.emplace_back(shaders::name(method));
    JobDescription job = describe_job("cost");
    job.add("classes", fmt::format("{}", fmt::join(classes, ", ")));
    job.add("distributions", fmt::format("{}", fmt::join(laws, ", ")));
    job.add("methods", fmt::format("{}", fmt::join(methods, ", ")));
    job.add("alpha", fmt::format("{}", fmt::join(options.choice.alphas, ", ")));
    job.add("eta", fmt::format("{}", fmt::join(options.choice.etas, ", ")));
    job.add("samples", std::to_string(options.samples));
    job.add("seed", std::to_string(options.request.seed));
    return job;
}

std::vector<Case> cases_of(const std::vector<Case>& all, const Part& part)
{
    std::vector<Case> cases;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (part.holds(i)) cases.push_back(all[i]);
    return cases;
}

void write_cost_part(const std::filesystem::path& file, const std::vector<Case>& cases,
                     const RunOptions& options, const Part& part)
{
    // What it says of libraries is what is loaded now: measuring loads more.
    const JobDescription job = cost_job(options);
    Payload payload;
    for (const CaseErrors& errors : errors_of(cases_of(cases, part), options))
        put_case(payload, errors);
    write_part(file, job, part, payload.bytes());
}

std::vector<CaseErrors> merge_cost_parts(const std::vector<std::string>& files,
                                         const std::vector<Case>& cases, const RunOptions& options)
{
    std::vector<CaseErrors> all(cases.size());
    read_parts(files, cost_job(options), [&](const Part& part, PayloadReader& payload) {
        for (std::size_t i = 0; i < cases.size(); ++i)
            if (part.holds(i)) all[i] = take_case(payload, cases[i], options.choice.methods.size());
    });
    return all;
}

}  // namespace regain::tools
