// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "run.h"

#include "../errors.h"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace regain::tools::cost {
namespace {

using figures::Clocked;
using figures::Stopped;
using figures::Times;

// How many more samples the walk takes, for its albedo and for its shape; a method whose eval is an
// estimate takes half of the latter.
constexpr std::uint64_t walk_factor = 4, shape_factor = 16;

// Widths whose lobes are shown.
constexpr double shown_alphas[] = {0.5, 1};

struct MethodTimes
{
    Times times, to_none, to_white;
};
using CaseTimes = std::vector<MethodTimes>;  // by method

Surface with_method(Surface surface, const shaders::Compensation& method)
{
    surface.material.method = method;
    return surface;
}

// Of each class one material: the metal that loses nothing, gold, the middle eta.
bool is_shown(const Case& c, const Part& part, const RunOptions& options)
{
    if (c.law.label() != options.choice.laws.front().label()) return false;
    if (std::find(std::begin(shown_alphas), std::end(shown_alphas), c.alpha) ==
        std::end(shown_alphas))
        return false;
    switch (c.kind)
    {
        case Class::metal: return part.axis == 1;
        case Class::coloured: return part.axis == 0;
        default: return part.axis == 1.5;
    }
}

// Cells of bins are fine enough for the width of a lobe.
int cells_for(double alpha) { return alpha < 0.2 ? 16 : 8; }

CaseErrors errors_of_case(const Case& c, const RunOptions& options)
{
    const std::uint64_t seed = options.request.seed;
    const auto stopped = [&] { return options.request.stopped(); };
    CaseErrors result;
    const int cells = cells_for(c.alpha);
    const Effort of_walk{walk_factor * options.samples, shape_factor * options.samples, cells},
        of_method{options.samples, shape_factor / 2 * options.samples, cells};
    Lobe walk = measured(*make_reference(c.surface), c.side, of_walk, seed + 1000, stopped);
    if (c.surface.base) add_base(walk, *c.surface.base);
    for (const Part& part : c.parts)
        if (is_shown(c, part, options)) result.lobes = LobeSet{c.kind, c.alpha, part, walk, {}};
    for (const shaders::Compensation& method : options.choice.methods)
    {
        MethodErrors m;
        m.method = shaders::name(method);
        try
        {
            const Bound bound = make_subject(with_method(c.surface, method));
            m.table_bytes = bound.table_bytes;
            const Lobe lobe = measured(*bound.subject, c.side, of_method, seed, stopped);
            for (const Part& part : c.parts) m.errors.push_back(compared(lobe, walk, part));
            if (result.lobes) result.lobes->methods.emplace_back(m.method, lobe);
        }
        catch (const BadInput& e)
        {
            m.refused = e.what();
        }
        result.methods.push_back(std::move(m));
    }
    return result;
}

Times over(const Times& a, const Times& b) { return {a.eval / b.eval, a.sample / b.sample}; }

// Directions of which wo is on one side; wi on both, of what lets light through.
figures::Inputs inputs_of(const Case& c)
{
    const bool glass = c.kind == Class::glass_outside || c.kind == Class::glass_inside;
    figures::Inputs inputs(glass);
    for (auto& wo : inputs.wo) wo.z = c.side < 0 ? -std::abs(wo.z) : std::abs(wo.z);
    return inputs;
}

CaseTimes times_of_case(const Case& c, const RunOptions& options, const CaseErrors& errors)
{
    Surface white;
    white.material.surface = shaders::SchlickSurface{};
    white.material.alpha_x = white.material.alpha_y = c.alpha;
    white.material.method = Method::none;
    const figures::Inputs inputs = inputs_of(c), above;

    CaseTimes result(errors.methods.size());
    std::vector<std::unique_ptr<Subject>> subjects;  // the white one last
    std::vector<Clocked> clocks;
    std::vector<MethodTimes*> timed;
    const MethodTimes* none = nullptr;
    for (std::size_t i = 0; i < result.size(); ++i)
    {
        if (!errors.methods[i].refused.empty()) continue;
        subjects.push_back(make_subject(with_method(c.surface, options.choice.methods[i])).subject);
        clocks.push_back(subjects.back()->clock(inputs));
        timed.push_back(&result[i]);
        if (errors.methods[i].method == "none") none = &result[i];
    }
    subjects.push_back(make_subject(white).subject);
    clocks.push_back(subjects.back()->clock(above));
    const std::vector<Times> times =
        figures::clocked(clocks, options.quick ? 9 : 31, [&] { return options.request.stopped(); });
    for (std::size_t i = 0; i < timed.size(); ++i) timed[i]->times = times[i];
    for (MethodTimes* m : timed)
    {
        m->to_white = over(m->times, times.back());
        if (none) m->to_none = over(m->times, none->times);
    }
    return result;
}

std::vector<CaseTimes> times_of(const std::vector<Case>& cases, const RunOptions& options,
                                const std::vector<CaseErrors>& errors)
{
    Progress progress("times", cases.size(), options.request.progress);
    std::vector<CaseTimes> times;
    for (std::size_t i = 0; i < cases.size(); ++i)
    {
        // Of those that are not timed the one before is as costly.
        times.push_back(cases[i].timed ? times_of_case(cases[i], options, errors[i])
                                       : times.back());
        progress.advance();
    }
    return times;
}

void add_rows(const Case& c, const CaseErrors& errors, const CaseTimes& times,
              std::vector<Row>& rows)
{
    for (std::size_t i = 0; i < errors.methods.size(); ++i)
    {
        const MethodErrors& m = errors.methods[i];
        for (std::size_t p = 0; p < c.parts.size(); ++p)
        {
            Row row;
            row.kind = c.kind;
            row.law = c.law;
            row.alpha = c.alpha;
            row.part = c.parts[p];
            row.method = m.method;
            row.refused = m.refused;
            if (m.refused.empty()) row.errors = m.errors[p];
            row.times = times[i].times;
            row.to_none = times[i].to_none;
            row.to_white = times[i].to_white;
            row.table_bytes = m.table_bytes;
            rows.push_back(std::move(row));
        }
    }
}

}  // namespace

std::vector<CaseErrors> errors_of(const std::vector<Case>& cases, const RunOptions& options)
{
    std::vector<CaseErrors> results(cases.size());
    Progress progress("errors", cases.size(), options.request.progress);
    const int cores = tbb::info::default_concurrency();
    const int threads = options.request.threads;
    tbb::task_arena arena(threads > 0 ? std::min(threads, cores) : cores);
    arena.execute([&] {
        tbb::parallel_for(
            std::size_t(0), cases.size(),
            [&](std::size_t i) {
                results[i] = errors_of_case(cases[i], options);
                progress.advance();
            },
            tbb::simple_partitioner());
    });
    return results;
}

Results results_of(const std::vector<Case>& cases, std::vector<CaseErrors> errors,
                   const RunOptions& options)
{
    const std::vector<CaseTimes> times = times_of(cases, options, errors);
    Results results;
    results.quick = options.quick;
    results.samples = options.samples;
    results.walk_samples = walk_factor * options.samples;
    results.walk_shape_samples = shape_factor * options.samples;
    results.seed = options.request.seed;
    results.threads = options.request.threads;
    results.choice = options.choice;
    for (std::size_t i = 0; i < cases.size(); ++i)
    {
        add_rows(cases[i], errors[i], times[i], results.rows);
        if (errors[i].lobes) results.lobes.push_back(std::move(*errors[i].lobes));
    }
    results.pictures =
        equal_time_scenes(options.choice, options.seconds_per_picture, options.request);
    return results;
}

}  // namespace regain::tools::cost
