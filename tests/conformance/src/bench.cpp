// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "check.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

REGAIN_NAMESPACE_BEGIN
namespace conformance {
namespace {

constexpr std::size_t second_look_factor = 16;

// What the closure's weights are of those without the gain, per channel.
Color gain_of(const TestedClosure& closure, const TestedClosure& bare, Random random)
{
    Color gain(1.0), most(0.0);
    for (int i = 0; i < 64; ++i)
    {
        const Direction u = random.cube();
        const Color with = closure.sample(u).weight, without = bare.sample(u).weight;
        for (int c = 0; c < 3; ++c)
            if (without[c] > most[c]) most[c] = without[c], gain[c] = with[c] / without[c];
    }
    return gain;
}

}  // namespace

Effort Bench::effort() const
{
    // The thorough tier has ten times the settings; what a setting costs cannot grow much.
    Effort e;
    if (tier() == Tier::thorough) e.even_samples *= 2;
    return _second_look ? e.times(second_look_factor) : e;
}

std::size_t Bench::hostile_inputs() const
{
    const double family = tier() == Tier::commit ? 1e6 : 1e8;
    return static_cast<std::size_t>(std::ceil(family * _share));
}

TestedClosure& Bench::closure()
{
    if (!_closure)
    {
        _closure = _subject.make(_setting.parameters);
        _closure->prepare(_setting.wo);
    }
    return *_closure;
}

Survey Bench::new_survey(const Subject& subject, TestedClosure& closure) const
{
    return conformance::survey(closure, _setting.wo, parameters().in_double, effort(),
                               random_of(name_of(subject, "survey")).bits());
}

Survey Bench::survey_of_gain()
{
    const Subject& subject = *_subject.bare();
    const auto bare = subject.make(parameters());
    bare->prepare(_setting.wo);
    Survey s = _memory.surveys.of(name_of(subject, "survey"), [&] {
        Survey fresh = new_survey(subject, *bare);
        fresh.cells = nullptr;
        return fresh;
    });
    s.traits = traits();
    s.scale_by(gain_of(closure(), *bare, random("gain")));
    return s;
}

const Survey& Bench::survey()
{
    if (_survey) return *_survey;
    if (_subject.form() == Form::gain && _subject.bare()) return _survey.emplace(survey_of_gain());
    _survey = new_survey(_subject, closure());
    // For gains on it.
    if (_subject.form() == Form::none)
        _memory.surveys.of(name_of(_subject, "survey"), [&] {
            Survey energies = *_survey;
            energies.cells = nullptr;
            return energies;
        });
    return *_survey;
}

std::string Bench::name_of(const Subject& subject, std::string_view check) const
{
    return subject.name() + ":" + std::string(check) + ":" + _setting.name +
           (_second_look ? ":second" : "");
}

Outcome Outcome::within(double measured, double bound, std::string detail)
{
    Outcome o;
    o.measured = measured;
    o.bound = bound;
    o.probability = measured <= bound ? 1 : 0;  // NaN fails
    o.detail = std::move(detail);
    return o;
}

const std::vector<Check>& checks()
{
    static const std::vector<Check> all = [] {
        std::vector<Check> list;
        for (const auto& some :
             {trait_checks(), normals_checks(), totality_checks(), pdf_checks(), energy_checks(),
              reference_checks(), symmetry_checks(), limit_checks(), hook_checks()})
            list.insert(list.end(), some.begin(), some.end());
        // By number.
        std::sort(list.begin(), list.end(), [](const Check& a, const Check& b) {
            return std::atoi(a.id + 1) < std::atoi(b.id + 1);
        });
        return list;
    }();
    return all;
}

std::string shown(double x)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", x);
    return text;
}
std::string shown(const Direction& w)
{
    return "[" + shown(w.x) + ", " + shown(w.y) + ", " + shown(w.z) + "]";
}
std::string shown(const Color& c) { return shown(Direction(c.x, c.y, c.z)); }

double largest(const Color& c)
{
    const double most = std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z)});
    return std::isnan(c.x) || std::isnan(c.y) || std::isnan(c.z) ? std::nan("") : most;
}

}  // namespace conformance
REGAIN_NAMESPACE_END
