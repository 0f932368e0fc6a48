// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "cases.h"

#include "../errors.h"

#include <fmt/format.h>

#include <algorithm>

namespace regain::tools::cost {

using shaders::ColorD;
using shaders::DistributionKind;

namespace {

constexpr std::array<std::array<double, 3>, 2> greys{{{0.04, 0.2, 0.5}, {0.8, 0.95, 1}}};

// Reflectance of what lies under the coat of plastic.
constexpr double base = 0.5;

std::string joined(const std::vector<std::string>& names)
{
    std::string all;
    for (const std::string& n : names) all += (all.empty() ? "" : ", ") + n;
    return all;
}

// Leaves of `all` those whose name is wanted.
template <class T, class Name>
void keep(std::vector<T>& all, const std::vector<std::string>& wanted, const char* what,
          const Name& name_of)
{
    if (wanted.empty()) return;
    std::vector<std::string> names;
    for (const T& t : all)
    {
        const std::string n(name_of(t));
        if (std::find(names.begin(), names.end(), n) == names.end()) names.push_back(n);
    }
    for (const std::string& w : wanted)
        if (std::find(names.begin(), names.end(), w) == names.end())
            throw BadInput(
                fmt::format("there is no {} '{}'; accepted: {}", what, w, joined(names)));
    all.erase(std::remove_if(all.begin(), all.end(),
                             [&](const T& t) {
                                 return std::find(wanted.begin(), wanted.end(),
                                                  std::string(name_of(t))) == wanted.end();
                             }),
              all.end());
}

struct Metal
{
    const char* label;
    std::variant<shaders::SchlickSurface, shaders::ConductorSurface> surface;
};

// n, k at 650, 550, 450 nm: Johnson and Christy 1972. The third has an edge tint that Schlick's
// term alone cannot have.
const std::vector<Metal>& coloured_metals()
{
    static const std::vector<Metal> all{
        {"gold", shaders::ConductorSurface{ColorD(0.16, 0.42, 1.5), ColorD(3.46, 2.35, 1.88)}},
        {"copper", shaders::ConductorSurface{ColorD(0.21, 1.02, 1.25), ColorD(3.67, 2.59, 2.48)}},
        {"F82", shaders::SchlickSurface{ColorD(0.9, 0.6, 0.2), ColorD(0.8, 0.9, 0.6)}},
    };
    return all;
}

class Maker
{
public:
    Maker(const Choice& choice, std::vector<Case>& all) : _choice(choice), _all(all) {}

    void metals(Case c)
    {
        for (const auto& group : greys)
        {
            c.surface.material.surface =
                shaders::SchlickSurface{ColorD(group[0], group[1], group[2])};
            c.timed = &group == greys.data();
            c.parts.clear();
            for (int k = 0; k < 3; ++k)
            {
                const double F0 = group[static_cast<std::size_t>(k)];
                c.parts.push_back({fmt::format("F0 {}", F0), F0, k, k});
            }
            _all.push_back(c);
        }
    }
    void coloured(Case c)
    {
        double place = 0;
        for (const Metal& metal : coloured_metals())
        {
            std::visit([&](const auto& s) { c.surface.material.surface = s; }, metal.surface);
            c.parts = {{metal.label, place++, 0, 2}};
            _all.push_back(c);
        }
    }
    // By the form of shadowing that the walk's first bounce has, and that all methods go with.
    void glass(Case c)
    {
        c.side = c.kind == Class::glass_inside ? -1 : 1;
        for (const double eta : _choice.etas)
        {
            c.surface.material.surface = shaders::InterfaceSurface{
                eta, ScatterMode::RT, TransmissionShadowing::beta, false, ColorD(1.0), ColorD(1.0)};
            c.parts = {{fmt::format("eta {}", eta), eta, 0, 0}};
            _all.push_back(c);
        }
    }
    void plastic(Case c)
    {
        c.surface.base = base;
        for (const double eta : _choice.etas)
        {
            c.surface.material.surface = shaders::InterfaceSurface{
                eta, ScatterMode::R, TransmissionShadowing::beta, false, ColorD(1.0), ColorD(1.0)};
            c.parts = {{fmt::format("eta {}", eta), eta, 0, 0}};
            _all.push_back(c);
        }
    }

private:
    const Choice& _choice;
    std::vector<Case>& _all;
};

}  // namespace

std::string_view name(Class c)
{
    switch (c)
    {
        case Class::metal: return "metal";
        case Class::coloured: return "coloured-metal";
        case Class::glass_outside: return "glass-outside";
        case Class::glass_inside: return "glass-inside";
        case Class::plastic: return "plastic";
    }
    return "";
}

std::string_view words(Class c)
{
    switch (c)
    {
        case Class::metal: return "metal of one grey";
        case Class::coloured: return "coloured metal";
        case Class::glass_outside: return "glass seen from outside";
        case Class::glass_inside: return "glass seen from inside";
        case Class::plastic: return "plastic";
    }
    return "";
}

std::string Law::label() const
{
    const std::string n(shaders::name(kind));
    return shaders::has_gamma(kind) ? fmt::format("{} {}", n, gamma) : n;
}

Choice everything(bool quick)
{
    Choice c;
    c.classes.assign(std::begin(all_classes), std::end(all_classes));
    // Longer and shorter tails than GGX's; an STD below 1.51 has no area.
    c.laws = {{DistributionKind::ggx, 2},
              {DistributionKind::beckmann, 2},
              {DistributionKind::gtr, 1.5},
              {DistributionKind::gtr, 3},
              {DistributionKind::std, 1.6}};
    for (const std::string_view n : shaders::compensation_names())
        c.methods.push_back(*shaders::compensation_named(n));
    c.alphas = quick ? std::vector<double>{0.1, 0.5, 1}
                     : std::vector<double>{0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 1};
    c.etas = quick ? std::vector<double>{1.5} : std::vector<double>{1.1, 1.5, 2};
    return c;
}

void keep_classes(Choice& c, const std::vector<std::string>& wanted)
{
    keep(c.classes, wanted, "class", [](Class k) { return name(k); });
}
void keep_distributions(Choice& c, const std::vector<std::string>& wanted)
{
    keep(c.laws, wanted, "distribution", [](const Law& l) { return shaders::name(l.kind); });
}
void keep_methods(Choice& c, const std::vector<std::string>& wanted)
{
    keep(c.methods, wanted, "method",
         [](const shaders::Compensation& m) { return shaders::name(m); });
}

std::vector<Case> cases_of(const Choice& choice)
{
    std::vector<Case> all;
    Maker make(choice, all);
    for (const Class kind : choice.classes)
        for (const Law& law : choice.laws)
            for (const double alpha : choice.alphas)
            {
                Case c;
                c.kind = kind;
                c.law = law;
                c.alpha = alpha;
                c.surface.material.distribution = law.kind;
                c.surface.material.gamma = law.gamma;
                c.surface.material.alpha_x = c.surface.material.alpha_y = alpha;
                switch (kind)
                {
                    case Class::metal: make.metals(c); break;
                    case Class::coloured: make.coloured(c); break;
                    case Class::glass_outside:
                    case Class::glass_inside: make.glass(c); break;
                    case Class::plastic: make.plastic(c); break;
                }
            }
    return all;
}

}  // namespace regain::tools::cost
