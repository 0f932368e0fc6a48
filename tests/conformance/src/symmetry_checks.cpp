// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// C10, C12: what does not change when directions change places, or turn together.

#include "check.h"
#include "rounding.h"

#include <algorithm>
#include <cmath>

REGAIN_NAMESPACE_BEGIN
namespace conformance {
namespace {

std::string always(const Subject&, const Traits&) { return {}; }

// Half of the directions grazing.
Direction from_anywhere(Random& random, bool both_sides)
{
    const double mu = std::pow(random.unit(), 2) * 0.999 + 1e-3;
    const double side = both_sides && random.bits() % 2 ? -1 : 1;
    return direction_at(side * mu, 7 * random.unit());
}

// Another direction with which the closure has something to say: one of its own, most often.
Direction partner(const TestedClosure& prepared, Random& random)
{
    if (random.bits() % 4 == 0) return random.direction();
    const Sample<double> s = prepared.sample(random.cube());
    return s.valid && !s.delta ? s.wi : random.direction();
}

// --- C10 ---------------------------------------------------------------------------------------

// f(wo, wi) over what it should be where wo and wi change places: 1, or the squared ratio of
// indices across an interface (Walter et al. 2007, Section 4; as energy, so that it is eta_o^2).
double exchange(const Subject& subject, const Parameters& p, const Direction& wo,
                const Direction& wi)
{
    const Reads reads = subject.reads();
    if (!reads.eta || reads.one_medium || (wo.z < 0) == (wi.z < 0)) return 1;
    return wo.z > 0 ? p.eta * p.eta : 1 / (p.eta * p.eta);
}

std::optional<Outcome> changes_places(Bench& bench)
{
    const Parameters& p = bench.parameters();
    if (!p.in_double && bench.subject().reads().twice) return std::nullopt;
    TestedClosure& closure = bench.closure();
    const Traits traits = closure.traits();
    if (traits.stochastic_eval) return std::nullopt;
    Random random = bench.random("C10");
    const int n = bench.tier() == Tier::commit ? 2000 : 4000;
    Outcome o;
    o.bound = p.in_double ? 1e-4 : 1e-2;
    int compared = 0;
    for (int i = 0; i < n; ++i)
    {
        const Direction wo = from_anywhere(random, traits.transmissive);
        closure.prepare(wo);
        const Direction wi = partner(closure, random);
        if (std::abs(wi.z) < 1e-4) continue;
        const Color there = closure.eval(wi, Direction(0.5)) * (1 / std::abs(wi.z));
        closure.prepare(wi);
        const Color back = closure.eval(wo, Direction(0.5)) *
                           (exchange(bench.subject(), p, wo, wi) / std::abs(wo.z));
        compared += there.y > 0 || back.y > 0;
        for (int c = 0; c < 3; ++c)
            if (const double d = difference(there[c], back[c]); d > o.measured)
            {
                o.measured = d;
                o.detail = "wo " + shown(wo) + ", wi " + shown(wi) + ": f " + shown(there) +
                           ", with places changed " + shown(back);
            }
    }
    closure.prepare(bench.setting().wo);
    if (compared == 0) return std::nullopt;
    if (traits.reciprocal)
        o.probability = o.measured <= o.bound ? 1 : 0;
    else
        o.note = o.measured <= o.bound ? "not declared to be reciprocal, but is" : "not reciprocal";
    return o;
}

bool tells(const Sample<double>& s) { return s.valid && !s.delta && std::abs(s.wi.z) >= 0.02; }

// The same of an estimate: means of as many estimates from either end.
std::optional<Outcome> changes_places_on_average(Bench& bench)
{
    const Parameters& p = bench.parameters();
    TestedClosure& closure = bench.closure();
    const Traits traits = closure.traits();
    if (!traits.stochastic_eval || !traits.reciprocal || !p.in_double) return std::nullopt;
    // Of narrow lobes, estimates are rarely large, and their errors cannot be told from a sample.
    if (bench.subject().reads().alpha && std::min(p.alpha_x, p.alpha_y) < 0.2) return std::nullopt;
    Random random = bench.random("C10");
    const std::size_t n = bench.effort().estimates / 16;
    constexpr int pairs = 8;
    Outcome o;
    o.bound = 1e-4;
    for (int i = 0; i < pairs; ++i)
    {
        // From grazing to upright, from either side.
        const double place = (i / 2 + random.unit()) / (pairs / 2);
        const double mu = 0.05 + 0.95 * place * place;
        const Direction wo =
            direction_at(traits.transmissive && i % 2 ? -mu : mu, 7 * random.unit());
        closure.prepare(wo);
        // A direction of its own: of others the mean is that of a few rare estimates, whose error
        // the many do not tell.
        Sample<double> s = closure.sample(random.cube());
        for (int tries = 0; tries < 16 && !tells(s); ++tries) s = closure.sample(random.cube());
        if (!tells(s)) continue;
        const Direction wi = s.wi;
        RunningMean there, back;
        for (std::size_t k = 0; k < n; ++k)
            there.add(closure.eval(wi, random.cube()).y / std::abs(wi.z));
        closure.prepare(wi);
        const double factor = exchange(bench.subject(), p, wo, wi);
        for (std::size_t k = 0; k < n; ++k)
            back.add(closure.eval(wo, random.cube()).y * factor / std::abs(wo.z));
        const double error = std::hypot(there.standard_error(), back.standard_error());
        const double size = std::max(std::abs(there.mean()), std::abs(back.mean()));
        const double off = std::abs(there.mean() - back.mean()), beyond = off - o.bound * size;
        double chance = 1;
        if (!(beyond <= 0))
            chance = error > 0 ? student_tail(beyond / error, static_cast<double>(n)) : 0;
        chance = std::min(1.0, pairs * chance);
        if (chance > o.probability || off <= o.measured * size) continue;
        o.probability = chance;
        o.measured = off / size;
        o.detail = "wo " + shown(wo) + ", wi " + shown(wi) + ": f " + shown(there.mean()) +
                   ", with places changed " + shown(back.mean()) + ", error " + shown(error);
    }
    closure.prepare(bench.setting().wo);
    return o;
}

std::optional<Outcome> is_reciprocal(Bench& bench)
{
    return bench.traits().stochastic_eval ? changes_places_on_average(bench)
                                          : changes_places(bench);
}

// --- C12 ---------------------------------------------------------------------------------------

std::string needs_a_value(const Subject&, const Traits& traits)
{
    return traits.stochastic_eval ? "eval is an estimate" : "";
}

Direction turned(const Direction& w, double phi)
{
    return {w.x * std::cos(phi) - w.y * std::sin(phi), w.x * std::sin(phi) + w.y * std::cos(phi),
            w.z};
}

std::optional<Outcome> symmetries_hold(Bench& bench)
{
    const Parameters& p = bench.parameters();
    const Traits traits = bench.traits();
    TestedClosure& closure = bench.closure();
    // Narrow lobes multiply the rounding of the directions that are turned.
    if (!p.in_double && std::min(p.alpha_x, p.alpha_y) < 0.04) return std::nullopt;
    Parameters swapped = p;
    std::swap(swapped.alpha_x, swapped.alpha_y);
    const auto exchanged = bench.subject().make(swapped);
    const bool has_no_other_axes = bench.subject().reads().two_alphas || !traits.anisotropic;

    Random random = bench.random("C12");
    const int n = bench.tier() == Tier::commit ? 500 : 1000;
    Outcome o;
    o.bound = p.in_double ? 1e-5 : 2e-3;
    const auto compare = [&](TestedClosure& other, const Direction& wo, const Direction& wi,
                             const Direction& wo2, const Direction& wi2, const char* what) {
        closure.prepare(wo);
        other.prepare(wo2);
        double f = closure.eval(wi, Direction(0.5)).y, pdf = closure.pdf(wi);
        // One closure may be both.
        other.prepare(wo2);
        const double f2 = other.eval(wi2, Direction(0.5)).y, pdf2 = other.pdf(wi2);
        double off = std::max(difference(f, f2), difference(pdf, pdf2));
        if (off > o.bound) off = std::max(0.0, off - rounding_of(other, wi2, p.in_double));
        if (off <= o.measured) return;
        o.measured = off;
        o.detail = std::string(what) + ": wo " + shown(wo) + ", wi " + shown(wi) + " eval " +
                   shown(f) + ", pdf " + shown(pdf) + "; wo " + shown(wo2) + ", wi " + shown(wi2) +
                   " eval " + shown(f2) + ", pdf " + shown(pdf2);
    };
    const auto same = bench.subject().make(p);
    for (int i = 0; i < n; ++i)
    {
        const Direction wo = from_anywhere(random, traits.transmissive);
        closure.prepare(wo);
        const Direction wi = partner(closure, random);
        if (std::abs(wi.z) < 1e-3) continue;
        if (!traits.anisotropic)
        {
            const double phi = 7 * random.unit();
            compare(*same, wo, wi, turned(wo, phi), turned(wi, phi), "turned together");
        }
        compare(*same, wo, wi, {-wo.x, wo.y, wo.z}, {-wi.x, wi.y, wi.z}, "mirrored");
        // A grain that the closure has of its own stays where it is.
        if (has_no_other_axes)
            compare(*exchanged, wo, wi, {wo.y, wo.x, wo.z}, {wi.y, wi.x, wi.z}, "axes exchanged");
    }
    closure.prepare(bench.setting().wo);
    o.probability = o.measured <= o.bound ? 1 : 0;
    return o;
}

}  // namespace

std::vector<Check> symmetry_checks()
{
    return {
        {"C10", "wo and wi can change places", Scope::parameters, true, always, is_reciprocal},
        {"C12", "turned, mirrored or with exchanged axes it is the same", Scope::parameters, false,
         needs_a_value, symmetries_hold},
    };
}

}  // namespace conformance
REGAIN_NAMESPACE_END
