// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Benchmarks of one closure.
///
/// A closure is prepared for a few points that stay in the first cache, as a renderer's is when it
/// is asked, and each answers about many directions in turn.

#pragma once

#include "benchmarks.h"
#include "inputs.h"

#include <regain/closures/closure.h>

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

namespace regain::bench {

constexpr std::size_t prepared_points = 32;

/// The Ask of asked(): one question to a prepared closure about the i-th input.
struct Eval
{
    static constexpr const char* name = "eval";
    template <class Prepared, class Real>
    static auto ask(const Prepared& p, const Directions& d, std::size_t i, const Real&)
    {
        return evaluate(p, d.wi.at<Real>(i), inputs().eval_numbers.at<Real>(i));
    }
};
struct DrawSample
{
    static constexpr const char* name = "sample";
    template <class Prepared, class Real>
    static auto ask(const Prepared& p, const Directions&, std::size_t i, const Real&)
    {
        return p.sample(inputs().sample_numbers.at<Real>(i));
    }
};
struct Pdf
{
    static constexpr const char* name = "pdf";
    template <class Prepared, class Real>
    static auto ask(const Prepared& p, const Directions& d, std::size_t i, const Real&)
    {
        return p.pdf(d.wi.at<Real>(i));
    }
};
struct AskAlbedo
{
    static constexpr const char* name = "albedo";
    template <class Prepared, class Real>
    static auto ask(const Prepared& p, const Directions&, std::size_t, const Real&)
    {
        return p.albedo();
    }
};

/// The directions that a closure of these traits is asked about.
inline const Directions& directions_of(const Traits& traits)
{
    return traits.transmissive ? inputs().around : inputs().above;
}

/// Runs f(i) over the inputs, i stepping by the points of a Real.
template <class Real, class F>
void loop(benchmark::State& state, const F& f)
{
    constexpr std::size_t step = points_of<Real>();
    std::size_t i = 0;
    for ([[maybe_unused]] auto _ : state)
    {
        benchmark::DoNotOptimize(f(i));
        i = (i + step) % input_count;
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(step));
    state.counters["points"] = static_cast<double>(step);
}

template <class Real, class Ask, class Make>
void asked(benchmark::State& state, const Make& make, float alpha)
{
    constexpr std::size_t step = points_of<Real>(), kept = prepared_points / step;
    const auto closure = make(Real(alpha));
    const Directions& directions = directions_of(closure.traits());
    std::vector<decltype(closure.prepare(Vec3<Real>()))> prepared;
    prepared.reserve(kept);
    for (std::size_t k = 0; k < kept; ++k)
        prepared.push_back(closure.prepare(directions.wo.at<Real>(k * step)));
    loop<Real>(state, [&](std::size_t i) {
        return Ask::ask(prepared[i / step % kept], directions, i, Real());
    });
}

/// Registers all questions to the closure make(alpha).
template <class Real, class Make>
void add_closure(const std::string& name, const Make& make, float alpha, std::size_t table_bytes)
{
    const std::string path = name + "/" + NumberName<Real>::value + "/";
    using benchmark::RegisterBenchmark;
    RegisterBenchmark((path + "construct").c_str(), [=](benchmark::State& state) {
        loop<Real>(state, [&](std::size_t i) { return make(inputs().alpha<Real>(alpha, i)); });
        using Closure = decltype(make(Real()));
        state.counters["closure_bytes"] = sizeof(Closure);
        state.counters["prepared_bytes"] = sizeof(typename Closure::Prepared);
        state.counters["table_bytes"] = static_cast<double>(table_bytes);
    });
    RegisterBenchmark((path + "prepare").c_str(), [=](benchmark::State& state) {
        const auto closure = make(Real(alpha));
        const Directions& directions = directions_of(closure.traits());
        loop<Real>(state,
                   [&](std::size_t i) { return closure.prepare(directions.wo.at<Real>(i)); });
    });
    RegisterBenchmark((path + "build").c_str(), [=](benchmark::State& state) {
        const Directions& directions = directions_of(make(Real(alpha)).traits());
        loop<Real>(state, [&](std::size_t i) {
            return make(inputs().alpha<Real>(alpha, i)).prepare(directions.wo.at<Real>(i));
        });
    });
    const auto add = [&](auto ask) {
        using Ask = decltype(ask);
        RegisterBenchmark((path + Ask::name).c_str(),
                          [=](benchmark::State& state) { asked<Real, Ask>(state, make, alpha); });
    };
    add(Eval());
    add(DrawSample());
    add(Pdf());
    add(AskAlbedo());
}

/// The widths that all closures are measured at.
constexpr const char* alphas[] = {"0.1", "0.5", "1"};

}  // namespace regain::bench
