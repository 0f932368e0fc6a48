// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Calls operations over the inputs of the benchmarks while callgrind counts instructions, one dump
// for each operation, named after it. instructions.py runs this; by itself it counts nothing.
//
//   regain_count           the operations
//   regain_count --about   how it was compiled, as JSON
//
// Each dump is of input_count calls. The operation `nothing` has the same loop, reads a direction
// and answers it: what remains of the others less that is what they take themselves.

#include "closure_list.h"
#include "inputs.h"

#include <regain/closures/closure.h>

#include <valgrind/callgrind.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <string>
#include <vector>

namespace regain::bench { namespace {

template <class T>
void consume(const T& value)
{
    asm volatile("" : : "r"(&value) : "memory");
}

template <class F>
void run(const F& f)
{
    for (std::size_t i = 0; i < input_count; ++i) consume(f(i));
}

template <class F>
void count(const std::string& operation, const F& f)
{
    run(f);  // once uncounted: what is bound or loaded at first use is no part of it
    CALLGRIND_TOGGLE_COLLECT;
    run(f);
    CALLGRIND_TOGGLE_COLLECT;
    CALLGRIND_DUMP_STATS_AT(operation.c_str());
}

// eval and sample of make(alpha), prepared for a few points; and of make(alpha) itself.
template <class Make>
void count_answers(const std::string& name, float alpha, const Make& make)
{
    constexpr std::size_t kept = 32;
    const auto closure = make(alpha);
    const Directions& d = closure.traits().transmissive ? inputs().around : inputs().above;
    std::vector<decltype(closure.prepare(Vec3<float>()))> prepared;
    for (std::size_t k = 0; k < kept; ++k) prepared.push_back(closure.prepare(d.wo.at<float>(k)));
    count(name + "/eval", [&](std::size_t i) {
        return evaluate(prepared[i % kept], d.wi.at<float>(i), inputs().eval_numbers.at<float>(i));
    });
    count(name + "/sample", [&](std::size_t i) {
        return prepared[i % kept].sample(inputs().sample_numbers.at<float>(i));
    });
}
template <class Make>
void count_building(const std::string& name, float alpha, const Make& make)
{
    const auto closure = make(alpha);
    const Directions& d = closure.traits().transmissive ? inputs().around : inputs().above;
    count(name + "/construct",
          [&](std::size_t i) { return make(inputs().alpha<float>(alpha, i)); });
    count(name + "/prepare", [&](std::size_t i) { return closure.prepare(d.wo.at<float>(i)); });
    count(name + "/build", [&](std::size_t i) {
        return make(inputs().alpha<float>(alpha, i)).prepare(d.wo.at<float>(i));
    });
}
template <class Make>
void count_all(const std::string& name, const Make& make)
{
    count_answers(name + "/0.5", 0.5f, make);
    count_building(name + "/0.5", 0.5f, make);
}

using L = Lobes<GGX, float>;

void count_mirrors(const TableSets& tables)
{
    const auto &t = tables.albedo, &later = tables.directional, &balance = tables.balanced,
               &shape = tables.tail;
    count_all("white/none", [&](float alpha) { return L::white(alpha, t); });
    count_all("schlick/none", [&](float alpha) { return L::schlick(alpha, t); });
    count_all("schlick/turquin", [&](float alpha) {
        return build_compensated([&] { return L::schlick(alpha, t); }, Method::turquin, t);
    });
    count_all("schlick/directional", [&](float alpha) {
        return build_directional([&] { return L::schlick(alpha, later); }, later);
    });
    count_all("schlick/balanced", [&](float alpha) {
        return build_balanced([&] { return L::schlick(alpha, balance); }, balance);
    });
    count_all("schlick/tail",
              [&](float alpha) { return fitted_tail(L::schlick(alpha, shape), shape); });
    count_all("conductor/none", [&](float alpha) { return L::conductor(alpha, t); });
    count_all("conductor/turquin", [&](float alpha) {
        return build_compensated([&] { return L::conductor(alpha, t); }, Method::turquin, t);
    });
}

void count_glass(const TableSets& tables)
{
    const auto correlated = [&](float alpha) {
        return L::glass(alpha, TransmissionShadowing::correlated, tables.correlated);
    };
    const auto beta = [&](float alpha) {
        return L::glass(alpha, TransmissionShadowing::beta, tables.beta_tail);
    };
    count_all("glass/none", correlated);
    count_all("glass/turquin", [&](float alpha) {
        return build_compensated([&] { return correlated(alpha); }, Method::turquin,
                                 tables.correlated, LossTables{});
    });
    count_all("glass-beta/none", beta);
    count_all("glass-beta/turquin", [&](float alpha) {
        return build_compensated([&] { return beta(alpha); }, Method::turquin, tables.beta,
                                 LossTables{});
    });
    count_all("glass-beta/tail",
              [&](float alpha) { return fitted_tail(beta(alpha), tables.beta_tail); });
}

// Walks at three widths, and what they are compared with.
void count_walks(const TableSets& tables)
{
    const auto& shape = tables.tail;
    for (const char* width : {"0.1", "0.5", "1"})
    {
        const float a = std::strtof(width, nullptr);
        const std::string at = std::string("/") + width;
        const Color3<float> one(1);
        if (a != 0.5f)
        {
            count_answers("schlick/none" + at, a,
                          [&](float alpha) { return L::schlick(alpha, tables.albedo); });
            count_answers("glass-beta/none" + at, a, [&](float alpha) {
                return L::glass(alpha, TransmissionShadowing::beta, tables.beta);
            });
        }
        count_answers("schlick/walk" + at, a, [&](float alpha) {
            const auto once = L::schlick(alpha, shape);
            return Walk(once.distribution(), once.fresnel(), 1, tables.albedo);
        });
        count_answers("schlick/walk-bounded" + at, a, [&](float alpha) {
            const auto once = L::schlick(alpha, shape);
            return BoundedWalk(once.distribution(), once.fresnel(), 1, shape);
        });
        count_answers("glass-beta/walk" + at, a, [&](float alpha) {
            return DielectricWalk<GGX<float>>(L::D(alpha), L::eta());
        });
        count_answers("glass-beta/walk-bounded" + at, a, [&](float alpha) {
            return BoundedDielectricWalk<GGX<float>>(L::D(alpha), L::eta(), one, one, 1,
                                                     tables.beta, shape);
        });
    }
}

void count_look_ups(const TableSets& tables)
{
    const TableAxes<float> axes(L::D(0.5f));
    count("look-up/E_ss",
          [&](std::size_t i) { return tables.albedo.albedo(axes, inputs().above.wo.z[i]); });
    count("look-up/E_S", [&](std::size_t i) {
        return tables.correlated.albedo(0.5f, 1.5f, inputs().above.wo.z[i]);
    });
}

void count_everything()
{
    const TableSets tables("ggx");
    count("nothing", [](std::size_t i) { return inputs().above.wi.at<float>(i); });
    count_mirrors(tables);
    count_glass(tables);
    count_walks(tables);
    count_look_ups(tables);
}

}}  // namespace regain::bench

int main(int argc, char** argv)
{
    if (argc == 2 && std::strcmp(argv[1], "--about") == 0)
    {
        std::printf("{\"compiler\": \"%s\", \"flags\": \"%s\", \"calls\": %d}\n",
                    REGAIN_BENCH_COMPILER, REGAIN_BENCH_FLAGS,
                    static_cast<int>(regain::bench::input_count));
        return 0;
    }
    if (argc > 1)
    {
        std::fprintf(stderr, "regain_count: '%s' is no option; accepted: --about\n", argv[1]);
        return 2;
    }
    try
    {
        regain::bench::count_everything();
    }
    catch (const std::exception& e)
    {
        std::fprintf(stderr, "regain_count: %s\n", e.what());
        return 2;
    }
    return 0;
}
