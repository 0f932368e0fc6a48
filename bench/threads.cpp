// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The same closures asked by several threads at once: what they share are tables, which nobody
// writes to.

#include "closure_list.h"
#include "measure.h"

#include <algorithm>
#include <thread>

namespace regain::bench {

namespace {

template <class Make>
void add(const std::string& name, const Make& make)
{
    const int most = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    const auto add_question = [&](auto ask) {
        using Ask = decltype(ask);
        const std::string path = "threads/" + name + "/0.5/float/" + Ask::name;
        benchmark::RegisterBenchmark(
            path.c_str(), [=](benchmark::State& state) { asked<float, Ask>(state, make, 0.5f); })
            ->ThreadRange(1, most)
            ->MinTime(0.05)  // threads take a while to meet
            ->UseRealTime();
    };
    add_question(Eval());
    add_question(DrawSample());
}

}  // namespace

void add_threads()
{
    static const TableSets tables("ggx");
    using L = Lobes<GGX, float>;
    add("ggx/white/none", [](float alpha) { return L::white(alpha, tables.albedo); });
    add("ggx/schlick/turquin", [](float alpha) {
        return compensated(L::schlick(alpha, tables.albedo), Method::turquin, tables.albedo);
    });
    add("ggx/schlick/tail",
        [](float alpha) { return fitted_tail(L::schlick(alpha, tables.tail), tables.tail); });
    add("ggx/glass/turquin", [](float alpha) {
        return compensated(L::glass(alpha, TransmissionShadowing::correlated, tables.correlated),
                           Method::turquin, tables.correlated);
    });
    add("ggx/schlick/walk-bounded", [](float alpha) {
        const auto once = L::schlick(alpha, tables.tail);
        return BoundedWalk(once.distribution(), once.fresnel(), 1, tables.tail);
    });
}

}  // namespace regain::bench
