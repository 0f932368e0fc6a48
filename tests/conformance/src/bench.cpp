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

}  // namespace

Effort Bench::effort() const
{
    Effort e;
    if (tier() == Tier::thorough)
    {
        e = e.times(8);
    }
    return _second_look ? e.times(second_look_factor) : e;
}

std::size_t Bench::hostile_inputs() const
{
    const std::size_t family = tier() == Tier::commit ? 1'000'000 : 100'000'000;
    return family / std::max<std::size_t>(1, _siblings) + 1;
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

const Survey& Bench::survey()
{
    if (!_survey)
        _survey = conformance::survey(closure(), _setting.wo, effort(), random("survey").bits());
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
