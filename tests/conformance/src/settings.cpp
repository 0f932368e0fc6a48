// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "settings.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

REGAIN_NAMESPACE_BEGIN
namespace conformance {
namespace {

constexpr double degree = 0.017453292519943295;

std::string number(double x)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", x);
    return text;
}

const char* name(Reflectance r)
{
    switch (r)
    {
        case Reflectance::white: return "white";
        case Reflectance::schlick: return "schlick";
        case Reflectance::conductor: return "conductor";
    }
    return "";
}

std::string name_of(const Reads& reads, const Parameters& p)
{
    std::string text;
    if (reads.alpha)
    {
        text += "alpha=" + number(p.alpha_x) + ",";
        if (p.alpha_y != p.alpha_x) text += "alpha_y=" + number(p.alpha_y) + ",";
    }
    if (reads.gamma) text += "gamma=" + number(p.gamma) + ",";
    if (reads.eta) text += "eta=" + number(p.eta) + ",";
    if (reads.schlick || reads.conductor) text += std::string(name(p.reflectance)) + ",";
    return text + (p.in_double ? "double" : "float");
}

// One after the other, in the order in which they are added; what a subject does not read is left
// out, and nothing is added twice.
class List
{
public:
    List(const Subject& subject) : _reads(subject.reads())
    {
        _sides = subject.make({})->traits().transmissive ? 2 : 1;
    }

    void add(Parameters p, const std::vector<double>& cosines,
             const std::vector<double>& azimuths = {0}, bool both_sides = true)
    {
        const bool narrow = p.in_double ? !_reads.twice : !_reads.single;
        if (narrow) p.in_double = !p.in_double;
        if (!_reads.alpha) p.alpha_x = p.alpha_y = 1;
        if (!_reads.two_alphas && p.alpha_x != p.alpha_y) return;
        if (p.reflectance == Reflectance::schlick && !_reads.schlick) return;
        if (p.reflectance == Reflectance::conductor && !_reads.conductor) return;
        p.gamma = std::clamp(p.gamma, _reads.lowest_gamma, _reads.highest_gamma);

        Setting s;
        s.parameters = p;
        s.parameters_name = name_of(_reads, p);
        for (const Setting& other : _settings)
            if (other.parameters_name == s.parameters_name) s.first_direction = false;
        for (double mu : cosines)
            for (double azimuth : azimuths)
                for (int side = 0; side < (both_sides ? _sides : 1); ++side)
                {
                    const double z = side ? -mu : mu;
                    s.wo = direction_at(z, azimuth * degree);
                    s.name = s.parameters_name + ",mu=" + number(z);
                    if (azimuth != 0) s.name += ",phi=" + number(azimuth);
                    const bool known =
                        std::any_of(_settings.begin(), _settings.end(),
                                    [&](const Setting& o) { return o.name == s.name; });
                    if (known) continue;
                    _settings.push_back(s);
                    s.first_direction = false;
                }
    }

    std::vector<Setting> take() { return std::move(_settings); }

private:
    Reads _reads;
    int _sides;
    std::vector<Setting> _settings;
};

Parameters wide(double alpha_x, double alpha_y, double eta = 1.5)
{
    Parameters p;
    p.alpha_x = alpha_x;
    p.alpha_y = alpha_y;
    p.eta = eta;
    return p;
}
Parameters wide(double alpha) { return wide(alpha, alpha); }

Parameters in_float(Parameters p)
{
    p.in_double = false;
    return p;
}
Parameters with_gamma(Parameters p, double gamma)
{
    p.gamma = gamma;
    return p;
}
Parameters schlick(Parameters p)
{
    p.reflectance = Reflectance::schlick;
    p.F0 = Color(0.9, 0.5, 0.04);
    p.F82 = Color(0.95, 0.8, 0.5);
    return p;
}

// Long, middle and short tails, about which distributions have limits.
constexpr double middle_gamma = 1.55;

void add_commit(List& list)
{
    const auto at = [](double ax, double ay, double eta = 1.5) {
        return with_gamma(wide(ax, ay, eta), middle_gamma);
    };
    const auto every = [&](double alpha, const std::vector<double>& cosines) {
        list.add(at(alpha, alpha), cosines);
    };
    every(1e-3, {0.3, 0.02});
    every(0.04, {0.7, 0.02});
    every(0.25, {0.7, 0.3});
    every(0.81, {0.3});
    every(1, {0.7, 0.02});
    // Where the next is told from the last by nothing that the subject reads, it is not added.
    list.add(at(0.25, 0.25, 1), {0.7}, {0}, false);
    // From below, 1.5 is the inverse from above.
    list.add(at(0.25, 0.25, 1 / 1.5), {0.7}, {0}, false);
    // Long enough tails need a formula of their own at 1.
    for (double gamma : {3.0, 1.0}) list.add(with_gamma(wide(0.25), gamma), {0.3});
    for (double alpha : {0.25, 1.0})
    {
        list.add(schlick(at(alpha, alpha)), {0.7});
        list.add(gold(at(alpha, alpha)), {0.3});
    }
    list.add(schlick(at(0.25, 0.25)), {0.02});
    list.add(in_float(at(0.04, 0.04)), {0.7}, {0}, false);
    list.add(in_float(at(1, 1)), {0.7});
    list.add(in_float(at(0.25, 0.25)), {0.02});
    list.add(at(0.25, 0.0625), {0.7}, {0, 90}, false);
    list.add(at(0.25, 0.0625), {0.7}, {45});
    list.add(at(0.25, 0.0625), {0.3}, {45}, false);
    list.add(at(0.25, 1), {0.02}, {45}, false);
}

void add_thorough(List& list)
{
    const std::vector<double> cosines{1, 0.9, 0.7, 0.5, 0.3, 0.1, 0.02, 1e-3};
    for (double gamma : {middle_gamma, 0.0, 1.0, 2.0, 3.0, 1e9})
    {
        const bool first = gamma == middle_gamma;
        for (double alpha : {1e-3, 0.01, 0.04, 0.1, 0.25, 0.49, 0.81, 1.0})
            list.add(with_gamma(wide(alpha), gamma), first ? cosines : std::vector{0.7, 0.1});
        if (!first) continue;
        for (double eta : {1 / 1.5, 1.0, 1.05, 1 / 1.05, 1.33, 1 / 1.33, 2.42, 1 / 2.42, 4.0, 0.25})
            for (double alpha : {0.04, 0.25, 1.0})
                list.add(with_gamma(wide(alpha, alpha, eta), gamma), {0.9, 0.3, 0.02}, {0}, false);
        for (double alpha : {0.04, 0.25, 0.81, 1.0})
        {
            list.add(schlick(with_gamma(wide(alpha), gamma)), {0.7, 0.3, 0.02});
            list.add(gold(with_gamma(wide(alpha), gamma)), {0.7, 0.3, 0.02});
            list.add(in_float(with_gamma(wide(alpha), gamma)), {1, 0.7, 0.3, 0.02, 1e-3});
        }
        for (double ratio : {4.0, 0.25, 19.0, 100.0})
            for (double alpha : {0.25, 1.0})
                list.add(with_gamma(wide(alpha, std::min(1.0, alpha / ratio)), gamma), {0.7, 0.02},
                         {0, 45, 90}, false);
    }
}

}  // namespace

std::vector<Setting> settings_of(const Subject& subject, Tier tier)
{
    List list(subject);
    (tier == Tier::commit ? add_commit : add_thorough)(list);
    return list.take();
}

Direction direction_at(double mu, double phi)
{
    const double sine = std::sqrt((1 - mu) * (1 + mu));
    return {sine * std::cos(phi), sine * std::sin(phi), mu};
}

Parameters gold(Parameters p)
{
    p.reflectance = Reflectance::conductor;
    p.n = Color(0.16, 0.42, 1.5);
    p.k = Color(3.46, 2.35, 1.88);
    return p;
}

}  // namespace conformance
REGAIN_NAMESPACE_END
