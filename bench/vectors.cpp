// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Entry of the library of one vector type, of which the program calls nothing on a processor that
// lacks the instructions.

#include "benchmarks.h"

#include "table_sets.h"

extern "C" __attribute__((visibility("default"))) void REGAIN_BENCH_ENTRY()
{
    using namespace regain;
    bench::add_microfacets<GGX, bench::Vector>();
    bench::add_microfacets<Beckmann, bench::Vector>();
    bench::add_plain<bench::Vector>();
    bench::add_look_ups<bench::Vector>();
}
