// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// What a shading point costs, by closure, method, alpha, number type and question: see
// benchmarks.h for names, performance.py for the run that docs/performance.md is made of.
//
//   regain_bench --benchmark_filter='ggx/schlick/turquin/0.5/.*/eval'

#include "benchmarks.h"
#include "table_sets.h"

#include <benchmark/benchmark.h>

#include <cstdio>
#include <exception>

#ifdef REGAIN_BENCH_AVX2
extern "C" void regain_bench_add_avx2();
#endif
#ifdef REGAIN_BENCH_AVX512
extern "C" void regain_bench_add_avx512();
#endif

namespace {

// xsimd::available_architectures() does not ask whether the system saves the registers.
void add_vectors()
{
#ifdef REGAIN_BENCH_AVX2
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) regain_bench_add_avx2();
#endif
#ifdef REGAIN_BENCH_AVX512
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512cd") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw"))
        regain_bench_add_avx512();
#endif
}

void add_all()
{
    using namespace regain;
    bench::add_microfacets<GGX, bench::Scalar>();
    bench::add_microfacets<Beckmann, bench::Scalar>();
    bench::add_microfacets<GTR, bench::Scalar>();
    bench::add_microfacets<STD, bench::Scalar>();
    bench::add_plain<bench::Scalar>();
    bench::add_look_ups<bench::Scalar>();
    bench::add_threads();
    add_vectors();
}

}  // namespace

int main(int argc, char** argv)
{
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::AddCustomContext("regain_compiler", REGAIN_BENCH_COMPILER);
    benchmark::AddCustomContext("regain_flags", REGAIN_BENCH_FLAGS);
    benchmark::AddCustomContext("regain_version", REGAIN_VERSION_STRING);
    try
    {
        add_all();
    }
    catch (const std::exception& e)
    {
        std::fprintf(stderr, "regain_bench: %s\n", e.what());
        return 2;
    }
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
