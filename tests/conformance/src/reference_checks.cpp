// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// C9, C14, C15: against something else: all bounces simulated, the other precision, exact tables.

#include "check.h"
#include "rounding.h"

#include <algorithm>
#include <cmath>

REGAIN_NAMESPACE_BEGIN
namespace conformance {
namespace {

// --- C9 ----------------------------------------------------------------------------------------

std::string needs_a_reference(const Subject& subject, const Traits&)
{
    const Reads reads = subject.reads();
    if (!subject.reference()) return "no reference is known";
    return reads.schlick || reads.conductor || reads.eta ? "" : "it has no colour of its own";
}

// Mean weights of samples, the same random numbers for everyone.
MeanColor sampled_albedo(const TestedClosure& prepared, std::size_t n, Random random)
{
    constexpr std::size_t groups = 32;
    const std::size_t each = std::max<std::size_t>(1, n / groups);
    MeanColor mean;
    for (std::size_t g = 0; g < groups; ++g)
    {
        EvenPoints even(random.cube());
        Color reflect(0.0), transmit(0.0);
        for (std::size_t i = 0; i < each; ++i)
        {
            const Sample<double> s = prepared.sample(even.next());
            (s.transmitted ? transmit : reflect) += s.weight * (1 / static_cast<double>(each));
        }
        for (int c = 0; c < 3; ++c)
        {
            const auto k = static_cast<std::size_t>(c);
            mean.reflect[k].add(reflect[c]);
            mean.transmit[k].add(transmit[c]);
            mean.both[k].add(reflect[c] + transmit[c]);
        }
    }
    return mean;
}

// A brighter facet reflects more, compensated or not.
bool grows_with_reflectance(Bench& bench, std::string* what)
{
    if (!bench.subject().reads().schlick) return true;
    double before = -1;
    for (const double F0 : {0.04, 0.3, 0.6, 0.9})
    {
        Parameters p = bench.parameters();
        p.reflectance = Reflectance::schlick;
        p.F0 = Color(F0);
        p.F82 = Color(1.0);
        const auto closure = bench.subject().make(p);
        closure->prepare(bench.setting().wo);
        const double E = sampled_albedo(*closure, 4096, bench.random("C9 grows")).both[1].mean();
        if (!(E > before))
        {
            *what = "the albedo falls from " + shown(before) + " to " + shown(E) +
                    " where F0 rises to " + shown(F0);
            return false;
        }
        before = E;
    }
    return true;
}

std::optional<Outcome> tint_is_that_of_all_bounces(Bench& bench)
{
    const std::optional<double> bound = bench.promises().tint;
    const Parameters& p = bench.parameters();
    // White mirrors are for C8; what glass reflects and what it passes is never white.
    const bool glass = bench.subject().reads().eta;
    if (!bound || (p.reflectance == Reflectance::white && !glass)) return std::nullopt;
    const MeanColor is =
        sampled_albedo(bench.closure(), bench.effort().even_samples, bench.random("C9"));
    const MeanColor should =
        bench.reference_albedo([&](const TestedClosure& reference, const Random& random) {
            return sampled_albedo(reference, 2 * bench.effort().even_samples, random);
        });
    Outcome worst;
    worst.bound = *bound;
    const auto compare = [&](const std::array<RunningMean, 3>& found,
                             const std::array<RunningMean, 3>& wanted, const char* what) {
        for (std::size_t k = 0; k < 3; ++k)
        {
            const double off = std::abs(found[k].mean() - wanted[k].mean());
            if (off < worst.measured) continue;
            worst.measured = off;
            const double error = std::hypot(found[k].standard_error(), wanted[k].standard_error());
            worst.probability = off <= *bound ? 1
                                : error > 0   ? student_tail((off - *bound) / error, 31)
                                              : 0;
            worst.detail = "channel " + std::to_string(k) + ": " + what + shown(found[k].mean()) +
                           ", with all bounces simulated " + shown(wanted[k].mean());
        }
    };
    compare(is.both, should.both, "albedo ");
    if (glass)
    {
        // Their sum hardly knows what a facet does with them.
        compare(is.reflect, should.reflect, "reflected ");
        compare(is.transmit, should.transmit, "transmitted ");
        worst.probability = std::min(1.0, 3 * worst.probability);
    }
    if (std::string what; !grows_with_reflectance(bench, &what))
    {
        worst.probability = 0;
        worst.detail = what;
    }
    return worst;
}

// --- C14 ---------------------------------------------------------------------------------------

std::string needs_both_precisions(const Subject& subject, const Traits& traits)
{
    if (traits.stochastic_eval) return "eval is an estimate";
    const Reads reads = subject.reads();
    return reads.single && reads.twice ? "" : "it computes in one precision";
}

std::optional<Outcome> float_is_near_double(Bench& bench)
{
    // What a narrow lobe makes of a direction's rounding is no fault of its arithmetic.
    const Parameters& p = bench.parameters();
    if (!p.in_double || std::min(p.alpha_x, p.alpha_y) < 0.04) return std::nullopt;
    Parameters single = p;
    single.in_double = false;
    // Both get what float can hold.
    const auto rounded = [](double x) { return static_cast<double>(static_cast<float>(x)); };
    for (double* x : {&single.alpha_x, &single.alpha_y, &single.gamma, &single.eta})
        *x = rounded(*x);
    Parameters twice = single;
    twice.in_double = true;
    const auto a = bench.subject().make(single), b = bench.subject().make(twice);
    const bool both_sides = bench.traits().transmissive;

    Random random = bench.random("C14");
    const std::size_t n = bench.tier() == Tier::commit ? 1000 : 4000;
    // A mean of thousands of samples is asked for less often.
    const std::size_t albedo_each = bench.promises().albedo_noise > 0 ? n / 16 : 16;
    std::vector<double> off;
    double albedo_off = 0;
    Outcome o;
    for (std::size_t i = 0; i < n; ++i)
    {
        const double side = both_sides && random.bits() % 2 ? -1 : 1;
        Direction wo = direction_at(side * (0.02 + 0.98 * random.unit()), 7 * random.unit());
        for (int k = 0; k < 3; ++k) wo[k] = rounded(wo[k]);
        a->prepare(wo);
        b->prepare(wo);
        const Sample<double> s = b->sample(random.cube());
        if (!s.valid || s.delta || std::abs(s.wi.z) < 0.01) continue;
        Direction wi = s.wi;
        for (int k = 0; k < 3; ++k) wi[k] = rounded(wi[k]);
        const double f = a->eval(wi, Direction(0.5)).y, g = b->eval(wi, Direction(0.5)).y;
        if (g > 1e-3)
        {
            off.push_back(std::abs(f / g - 1));
            if (off.back() > bench.promises().single)
                off.back() = std::max(0.0, off.back() - rounding_of(*b, wi, false));
            if (off.back() > o.measured)
            {
                o.measured = off.back();
                o.detail = "wo " + shown(wo) + ", wi " + shown(wi) + ": eval " + shown(f) +
                           " in float, " + shown(g) + " in double";
            }
        }
        if (i % albedo_each == 0)
        {
            const Albedo<double> x = a->albedo(), y = b->albedo();
            albedo_off = std::max(
                {albedo_off, largest(x.reflect - y.reflect), largest(x.transmit - y.transmit)});
        }
    }
    if (off.size() < 10) return std::nullopt;
    std::sort(off.begin(), off.end());
    const double median = off[off.size() / 2], p999 = off[off.size() * 999 / 1000];
    const double p999_bound = bench.promises().single, median_bound = p999_bound / 200;
    const double albedo_bound = 1e-4 + 2 * bench.promises().albedo_noise;
    // The one that is nearest to its bound, or furthest beyond.
    o.measured = p999;
    o.bound = p999_bound;
    for (const auto& [measured, bound] :
         {std::pair(median, median_bound), std::pair(albedo_off, albedo_bound)})
        if (measured / bound > o.measured / o.bound) o.measured = measured, o.bound = bound;
    o.note = "median " + shown(median) + ", albedo " + shown(albedo_off);
    o.detail += "; median " + shown(median) + " (accepted " + shown(median_bound) + "), albedo() " +
                shown(albedo_off) + " (accepted " + shown(albedo_bound) + ")";
    o.probability =
        median <= median_bound && p999 <= p999_bound && albedo_off <= albedo_bound ? 1 : 0;
    return o;
}

// --- C15 ---------------------------------------------------------------------------------------

std::string needs_tables(const Subject& subject, const Traits&)
{
    return subject.table_errors(0).empty() ? "it looks nothing up" : "";
}

std::optional<Outcome> tables_are_exact(Bench& bench)
{
    Outcome worst;
    for (const TableError& e : bench.subject().table_errors(bench.tier() == Tier::commit ? 8 : 64))
    {
        if (e.measured > e.bound || std::isnan(e.measured)) worst.probability = 0;
        if (e.bound > 0 && worst.bound > 0 && e.measured / e.bound < worst.measured / worst.bound)
            continue;
        worst.measured = e.measured;
        worst.bound = e.bound;
        worst.detail = e.table + " at " + e.where;
    }
    return worst;
}

}  // namespace

std::vector<Check> reference_checks()
{
    return {
        {"C9", "colour is that of all bounces", Scope::direction, true, needs_a_reference,
         tint_is_that_of_all_bounces},
        {"C14", "float is near double", Scope::parameters, false, needs_both_precisions,
         float_is_near_double},
        {"C15", "tables hold what they say", Scope::subject, false, needs_tables, tables_are_exact},
    };
}

}  // namespace conformance
REGAIN_NAMESPACE_END
