// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// What a shading point costs, in nanoseconds a call, scalar float: preparing a closure for a wo
// (with and without compensation), eval, sample and pdf. The bare white GGX is what ratios are
// taken to.
//
//   regain_bench --benchmark_repetitions=9 --benchmark_report_aggregates_only=true

#include <regain/closures/compensated.h>
#include <regain/closures/conductor.h>
#include <regain/closures/constant_fresnel.h>
#include <regain/closures/generalized_schlick.h>
#include <regain/luts/builtin.h>

#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <vector>

using namespace regain;

namespace {

// Directions and random numbers in an order that no branch predictor learns.
struct Inputs
{
    static constexpr std::size_t count = 4096;
    std::vector<Vec3<float>> wo, wi;
    std::vector<Vec2<float>> u;

    Inputs()
    {
        std::mt19937 random(1);
        std::uniform_real_distribution<float> unit(0.001f, 0.999f);
        const auto direction = [&] {
            const float z = unit(random), phi = 6.2831853f * unit(random), s = std::sqrt(1 - z * z);
            return Vec3<float>(s * std::cos(phi), s * std::sin(phi), z);
        };
        for (std::size_t i = 0; i < count; ++i)
        {
            wo.push_back(direction());
            wi.push_back(direction());
            u.emplace_back(unit(random), unit(random));
        }
    }
};

const Inputs& inputs()
{
    static const Inputs all;
    return all;
}

auto white(float alpha)
{
    return MicrofacetReflection<GGX<float>, ConstantFresnel<float>>(GGX<float>(alpha),
                                                                    ConstantFresnel<float>());
}
auto f82(float alpha)
{
    return GeneralizedSchlick<float>(
        GGX<float>(alpha), SchlickFresnel<float>({0.94f, 0.77f, 0.37f}, {0.98f, 0.95f, 0.75f}));
}
auto exact(float alpha)
{
    return Conductor<float>(GGX<float>(alpha),
                            ConductorFresnel<float>({0.16f, 0.42f, 1.5f}, {3.46f, 2.35f, 1.88f}));
}

template <class Make>
void build_and_prepare(benchmark::State& state, Make make)
{
    std::size_t i = 0;
    for (auto _ : state)
    {
        const auto closure = make(0.1f + 0.0001f * float(i));
        benchmark::DoNotOptimize(closure.prepare(inputs().wo[i]));
        i = (i + 1) % Inputs::count;
    }
}

template <class Make, class Ask>
void ask(benchmark::State& state, Make make, Ask question)
{
    const auto closure = make(0.5f);
    std::vector<decltype(closure.prepare(inputs().wo[0]))> prepared;
    for (const auto& wo : inputs().wo) prepared.push_back(closure.prepare(wo));
    std::size_t i = 0;
    for (auto _ : state)
    {
        benchmark::DoNotOptimize(question(prepared[i], i));
        i = (i + 1) % Inputs::count;
    }
}

template <class Make>
void add(const std::string& name, Make make)
{
    benchmark::RegisterBenchmark((name + "/build+prepare").c_str(),
                                 [=](benchmark::State& s) { build_and_prepare(s, make); });
    benchmark::RegisterBenchmark((name + "/eval").c_str(), [=](benchmark::State& s) {
        ask(s, make, [](const auto& p, std::size_t i) { return p.eval(inputs().wi[i]); });
    });
    benchmark::RegisterBenchmark((name + "/sample").c_str(), [=](benchmark::State& s) {
        ask(s, make, [](const auto& p, std::size_t i) { return p.sample(inputs().u[i]); });
    });
    benchmark::RegisterBenchmark((name + "/pdf").c_str(), [=](benchmark::State& s) {
        ask(s, make, [](const auto& p, std::size_t i) { return p.pdf(inputs().wi[i]); });
    });
}

}  // namespace

int main(int argc, char** argv)
{
    add("white GGX", white);
    add("F82 metal", f82);
    for (Method method : {Method::turquin, Method::series})
        add("F82 metal, " + std::string(name(method)),
            [method](float alpha) { return compensated(f82(alpha), method, luts::ggx_tables()); });
    add("n, k metal", exact);
    add("n, k metal, turquin",
        [](float alpha) { return compensated(exact(alpha), Method::turquin, luts::ggx_tables()); });
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
