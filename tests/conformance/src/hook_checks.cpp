// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// C0, C16: traits that a few calls prove or refute, and what compensation by a gain leaves alone.

#include "check.h"

#include <algorithm>
#include <cmath>

REGAIN_NAMESPACE_BEGIN
namespace conformance {
namespace {

std::string always(const Subject&, const Traits&) { return {}; }

bool equal(const Sample<double>& a, const Sample<double>& b)
{
    return a.wi == b.wi && a.pdf == b.pdf && a.valid == b.valid && a.delta == b.delta &&
           a.transmitted == b.transmitted;
}

// --- C0 ----------------------------------------------------------------------------------------

// The other traits have checks of their own: C5 the pdf, C8 energy, C10 reciprocity, C12 rotation.
std::optional<Outcome> traits_are_true(Bench& bench)
{
    TestedClosure& closure = bench.closure();
    const Traits traits = closure.traits();
    const Direction wo = bench.setting().wo;
    Random random = bench.random("C0");
    const int n = bench.tier() == Tier::commit ? 500 : 1000;
    std::string what;
    const auto complain = [&](const std::string& text) {
        if (what.empty()) what = text;
    };
    if (traits.random_numbers < 1 || traits.random_numbers > 3)
        complain("random_numbers is " + std::to_string(traits.random_numbers) +
                 "; accepted: 1 to 3");
    for (int i = 0; i < n; ++i)
    {
        const Direction u = random.cube();
        const Sample<double> s = closure.sample(u);
        if (!s.valid) continue;
        const std::string here = "u " + shown(u) + " gives wi " + shown(s.wi);
        if (s.delta && !traits.delta) complain("delta is false, but " + here + " without density");
        if (s.transmitted && !traits.transmissive)
            complain("transmissive is false, but " + here + " transmitted");
        if (s.transmitted != ((s.wi.z < 0) != (wo.z < 0)))
            complain("transmitted is wrong: " + here);
        Direction other = u;
        for (int k = traits.random_numbers; k < 3; ++k) other[k] = random.unit();
        if (traits.random_numbers < 3 && !equal(closure.sample(other), s))
            complain("random_numbers is " + std::to_string(traits.random_numbers) + ", but " +
                     here + ", and u " + shown(other) + " another");
        if (!s.delta)
        {
            const Color one = closure.eval(s.wi, random.cube()),
                        two = closure.eval(s.wi, random.cube());
            if (one != two && !traits.stochastic_eval)
                complain("stochastic_eval is false, but eval of wi " + shown(s.wi) + " is " +
                         shown(one) + " and " + shown(two));
        }
        if (!traits.transmissive)
        {
            const Direction below(s.wi.x, s.wi.y, -s.wi.z);
            if (largest(closure.eval(below, u)) != 0 || closure.pdf(below) != 0)
                complain("transmissive is false, but eval or pdf of wi " + shown(below) +
                         " is not 0");
        }
    }
    Outcome o;
    o.probability = what.empty() ? 1 : 0;
    o.measured = what.empty() ? 0 : 1;
    o.detail = what;
    return o;
}

// --- C16 ---------------------------------------------------------------------------------------

std::string needs_a_gain(const Subject& subject, const Traits&)
{
    if (subject.form() != Form::gain && subject.form() != Form::pair_gain)
        return "it is no gain on another closure";
    return subject.bare() ? "" : "the closure without its gain is not known";
}

// Directions and pdfs to the bit; values all by the same factor, of a pair's gain those of one wi.
std::optional<Outcome> a_gain_scales_and_nothing_else(Bench& bench)
{
    TestedClosure& closure = bench.closure();
    const auto bare = bench.subject().bare()->make(bench.parameters());
    bare->prepare(bench.setting().wo);
    Random random = bench.random("C16");
    const int n = bench.tier() == Tier::commit ? 1000 : 2000;
    const bool pairs = bench.subject().form() == Form::pair_gain;
    Outcome o;
    o.bound = bench.parameters().in_double ? 1e-12 : 1e-5;
    std::string what;
    Color gain(-1.0);
    const auto scaled = [&](const Color& with, const Color& without, const std::string& where) {
        for (int c = 0; c < 3; ++c)
        {
            // Denormals have few digits.
            if (without[c] < 1e-30)
            {
                if (with[c] > 1e-25 && what.empty()) what = where + ": nothing was scaled to some";
                continue;
            }
            const double factor = with[c] / without[c];
            if (gain[c] < 0) gain[c] = factor;
            const double off = std::abs(factor - gain[c]) / std::max(gain[c], 1e-30);
            if (off > o.measured)
            {
                o.measured = off;
                o.detail =
                    where + ": the factor is " + shown(factor) + ", elsewhere " + shown(gain[c]);
            }
        }
    };
    for (int i = 0; i < n; ++i)
    {
        const Direction u = random.cube();
        const Sample<double> a = closure.sample(u), b = bare->sample(u);
        if (!equal(a, b) && what.empty())
            what = "u " + shown(u) + " gives wi " + shown(a.wi) + " with pdf " + shown(a.pdf) +
                   ", without the gain wi " + shown(b.wi) + " with pdf " + shown(b.pdf);
        const Direction wi = (pairs || i % 2) && b.valid ? b.wi : random.direction();
        if (pairs) gain = Color(-1.0);
        if (closure.pdf(wi) != bare->pdf(wi) && what.empty())
            what = "the pdf of wi " + shown(wi) + " is " + shown(closure.pdf(wi)) +
                   ", without the gain " + shown(bare->pdf(wi));
        if (a.valid) scaled(a.weight, b.weight, "sample of u " + shown(u));
        scaled(closure.eval(wi, u), bare->eval(wi, u), "eval of wi " + shown(wi));
    }
    if (!what.empty()) o.detail = what;
    o.probability = what.empty() && o.measured <= o.bound ? 1 : 0;
    o.note = "gain " + shown(gain.y);
    return o;
}

}  // namespace

std::vector<Check> trait_checks()
{
    return {{"C0", "traits are true", Scope::direction, false, always, traits_are_true}};
}

std::vector<Check> hook_checks()
{
    return {{"C16", "a gain scales, and changes no direction and no pdf", Scope::direction, false,
             needs_a_gain, a_gain_scales_and_nothing_else}};
}

}  // namespace conformance
REGAIN_NAMESPACE_END
