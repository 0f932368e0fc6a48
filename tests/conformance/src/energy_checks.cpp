// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// C6, C7, C8, C17: how much energy leaves.

#include "check.h"

#include <algorithm>
#include <cmath>

REGAIN_NAMESPACE_BEGIN
namespace conformance {
namespace {

std::string needs_nothing(const Subject&, const Traits&) { return {}; }

// A mean that is known with an error, or without.
struct Energy
{
    double value;
    const RunningMean* mean;  // null: without
    double error;             // of an integral

    double beyond(double expected, double bound) const
    {
        if (mean) return tail_beyond(*mean, expected, bound);
        return std::abs(value - expected) <= bound + error ? 1 : 0;
    }
};

// What leaves in all, by the best there is: the integral of eval, or samples.
Energy total_energy(const Survey& s, std::size_t channel)
{
    if (!s.traits.stochastic_eval && s.resolved)
        return {s.total()[static_cast<int>(channel)], nullptr, s.error};
    return {s.weight.both[channel].mean(), &s.weight.both[channel], 0};
}

std::string needs_own_values(const Subject& subject, const Traits&)
{
    if (subject.form() == Form::gain && subject.bare())
        return "C3 and C16 say it of its weights and values, and this of " + subject.bare()->name();
    return {};
}

// --- C6 ----------------------------------------------------------------------------------------

// Samples of the closure and of the whole sphere, each weighed against both densities (the balance
// heuristic, Veach 1997, Section 9.2.2): what a renderer does with a light that is everywhere.
MeanColor by_both(Bench& bench)
{
    constexpr std::size_t groups = 32;
    constexpr double even = 0.07957747154594767;  // 1 / (4 pi)
    TestedClosure& closure = bench.closure();
    Random random = bench.random("C6");
    const Direction wo = bench.setting().wo;
    const std::size_t each = bench.effort().estimates / groups / 2;
    const double share = 1 / static_cast<double>(each);
    MeanColor out;
    for (std::size_t g = 0; g < groups; ++g)
    {
        EvenPoints lobe(random.cube()), sphere(random.cube());
        Color reflect(0.0), transmit(0.0);
        for (std::size_t i = 0; i < each; ++i)
        {
            const Sample<double> s = closure.sample(lobe.next());
            if (s.valid)
                (s.transmitted ? transmit : reflect) +=
                    s.weight * (share * (s.delta ? 1 : s.pdf / (s.pdf + even)));
            const Direction v = sphere.next();
            const double z = 2 * v.x - 1;
            const Direction wi = direction_at(z, 6.283185307179586 * v.y);
            const Color f = closure.eval(wi, random.cube());
            ((z < 0) == (wo.z < 0) ? reflect : transmit) += f * (share / (closure.pdf(wi) + even));
        }
        for (int c = 0; c < 3; ++c)
        {
            const auto k = static_cast<std::size_t>(c);
            out.reflect[k].add(reflect[c]);
            out.transmit[k].add(transmit[c]);
            out.both[k].add(reflect[c] + transmit[c]);
        }
    }
    return out;
}

std::optional<Outcome> estimators_agree(Bench& bench)
{
    constexpr double bound = 2e-3;
    constexpr int comparisons = 12;
    const Survey& s = bench.survey();
    if (!s.traits.stochastic_eval && !s.resolved) return std::nullopt;
    const bool estimated = s.traits.stochastic_eval;
    const MeanColor both = by_both(bench);
    const MeanColor means = estimated
                                ? estimated_integrals(bench.closure(), s, bench.effort().estimates,
                                                      bench.random("C6 estimates").bits())
                                : MeanColor{};
    const Color reflected = s.reflected(), transmitted = s.transmitted();

    Outcome worst;
    worst.bound = bound;
    const auto compare = [&](const RunningMean& mean, double value, const RunningMean* of_value,
                             const char* how, const char* where, int channel) {
        const double off = std::abs(mean.mean() - value);
        // The error of the integral, where it is an estimate itself, adds to that of the mean.
        double p = 1;
        if (const double beyond = off - bound; !(beyond <= 0))
        {
            const double error =
                std::hypot(mean.standard_error(), of_value ? of_value->standard_error() : s.error);
            p = error > 0 ? student_tail(beyond / error, 31) : 0;
            if (std::isnan(off)) p = 0;
        }
        p = std::min(1.0, p * comparisons);
        if (!(off <= worst.measured) || p < worst.probability)
        {
            worst.measured = off;
            worst.probability = std::min(worst.probability, p);
            worst.detail = std::string(where) + ", channel " + std::to_string(channel) + ": " +
                           how + " " + shown(mean.mean()) + " +- " + shown(mean.standard_error()) +
                           ", integral of eval " + shown(value);
        }
    };
    for (int c = 0; c < 3; ++c)
    {
        const auto k = static_cast<std::size_t>(c);
        const RunningMean *r = &means.reflect[k], *t = &means.transmit[k];
        const double R = estimated ? r->mean() : reflected[c],
                     T = estimated ? t->mean() : transmitted[c];
        if (!estimated) r = t = nullptr;
        compare(s.weight.reflect[k], R, r, "mean weight", "reflected", c);
        compare(s.weight.transmit[k], T, t, "mean weight", "transmitted", c);
        compare(both.reflect[k], R, r, "both samplers", "reflected", c);
        compare(both.transmit[k], T, t, "both samplers", "transmitted", c);
    }
    return worst;
}

// --- C7 ----------------------------------------------------------------------------------------

std::optional<Outcome> no_energy_is_made(Bench& bench)
{
    const std::optional<double> promised = bench.promises().surplus;
    if (!promised) return std::nullopt;
    const Survey& s = bench.survey();
    const double surplus = *promised + (bench.parameters().in_double ? 0 : 2e-4);
    Outcome worst;
    worst.measured = -1;
    worst.bound = surplus;
    for (std::size_t k = 0; k < 3; ++k)
    {
        const Energy e = total_energy(s, k);
        if (e.value - 1 <= worst.measured) continue;
        worst.measured = e.value - 1;
        const bool holds = e.value <= 1 + surplus;
        worst.probability = holds ? 1 : std::isnan(e.value) ? 0 : e.beyond(1, surplus);
        worst.detail = "the albedo of channel " + std::to_string(k) + " is " + shown(e.value);
    }
    return worst;
}

// --- C8 ----------------------------------------------------------------------------------------

std::string needs_preserving(const Subject&, const Traits& traits)
{
    return traits.energy_preserving ? "" : "it is not declared to preserve energy";
}

std::optional<Outcome> all_energy_is_kept(Bench& bench)
{
    const std::optional<double> bound = bench.promises().furnace;
    const bool white = bench.parameters().reflectance == Reflectance::white;
    if (!bound || !white || !bench.traits().energy_preserving) return std::nullopt;
    const Survey& s = bench.survey();
    Outcome worst;
    worst.bound = *bound;
    for (std::size_t k = 0; k < 3; ++k)
    {
        const Energy e = total_energy(s, k);
        const double off = std::abs(e.value - 1);
        if (off < worst.measured) continue;
        worst.measured = off;
        worst.probability = e.beyond(1, *bound);
        worst.detail = "the albedo of channel " + std::to_string(k) + " is " + shown(e.value);
    }
    return worst;
}

// --- C17 ---------------------------------------------------------------------------------------

// A host that lays the closure over a white diffuse base gives the base what albedo() leaves:
// f + (1 - E) / pi cos. Its furnace is off by as much as albedo() is.
std::optional<Outcome> layers_neither_gain_nor_lose(Bench& bench)
{
    const std::optional<double> bound = bench.promises().albedo;
    if (!bound) return std::nullopt;
    const Survey& s = bench.survey();
    const Albedo<double> said = bench.closure().albedo();
    Outcome worst;
    worst.bound = *bound;
    for (std::size_t k = 0; k < 3; ++k)
    {
        const int c = static_cast<int>(k);
        const Energy e = total_energy(s, k);
        const double all = said.reflect[c] + said.transmit[c], off = std::abs(e.value - all);
        if (off < worst.measured) continue;
        worst.measured = off;
        worst.probability = e.beyond(all, *bound);
        worst.detail = "albedo() says " + shown(all) + " in channel " + std::to_string(k) +
                       ", what leaves is " + shown(e.value) + ": the furnace of a layer is " +
                       shown(1 + e.value - all);
    }
    return worst;
}

}  // namespace

std::vector<Check> energy_checks()
{
    return {
        {"C6", "three estimators of the albedo agree", Scope::direction, true, needs_own_values,
         estimators_agree},
        {"C7", "no energy is made", Scope::direction, true, needs_nothing, no_energy_is_made},
        {"C8", "with F = 1 no energy is lost", Scope::direction, true, needs_preserving,
         all_energy_is_kept},
        {"C17", "layered by its albedo, nothing is gained or lost", Scope::direction, true,
         needs_nothing, layers_neither_gain_nor_lose},
    };
}

}  // namespace conformance
REGAIN_NAMESPACE_END
