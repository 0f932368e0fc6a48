// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "render_material.h"

#include "preview/cloth.h"
#include "render_checks.h"

#include <regain/shaders/metals.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <stdexcept>

namespace regain::tools {

using shaders::Compensation;
using shaders::DistributionKind;
using shaders::InterfaceSurface;
using shaders::MicrofacetMaterial;
using shaders::SheenSurface;

namespace {

constexpr const char* mode_names[] = {"R", "T", "RT"};
static_assert(int(ScatterMode::R) == 0 && int(ScatterMode::T) == 1 && int(ScatterMode::RT) == 2);
constexpr const char* shadowing_names[] = {"correlated", "beta"};
static_assert(int(TransmissionShadowing::correlated) == 0 && int(TransmissionShadowing::beta) == 1);

std::vector<Compensation> methods_of(const std::string& wanted, const Compensation& recommended)
{
    if (wanted.empty())
    {
        const auto* gain = std::get_if<Method>(&recommended);
        if (gain && *gain == Method::none) return {recommended};
        return {Method::none, recommended};
    }
    return methods_named(wanted);
}

// As much of an interface as decides about its method; one whose form of shadowing nobody asks for
// has the walk's.
InterfaceSurface shown_for_recommendation(const RenderOptions& options)
{
    InterfaceSurface glass;
    glass.thin_walled = options.thin_walled;
    if (options.transmission_shadowing.value_or("beta") == "beta")
        glass.shadowing = TransmissionShadowing::beta;
    return glass;
}

// A walk is what the beta form is the first bounce of, and a tail goes on from there.
bool needs_beta(const std::vector<Compensation>& methods)
{
    return std::any_of(methods.begin(), methods.end(), [](const Compensation& method) {
        return std::holds_alternative<shaders::RandomWalk>(method) ||
               std::holds_alternative<shaders::Tail>(method);
    });
}

}  // namespace

RenderMaterial::RenderMaterial(const RenderOptions& options, const shaders::ColorConfig& config)
    : _name(options.material)
{
    constexpr const char* names[] = {"metal", "glass", "sheen"};
    enum class Kind { metal, glass, sheen };
    const auto kind = chosen<Kind>("--material", options.material, "material", names);
    check_belongings(options);
    if (kind == Kind::sheen) _material.surface = SheenSurface{};
    if (kind == Kind::glass) _material.surface = shown_for_recommendation(options);
    _methods = methods_of(options.method, shaders::recommended_compensation(_material.surface));
    if (kind == Kind::sheen)
        read_sheen(options);
    else
    {
        read_facets(options);
        if (kind == Kind::glass)
            read_glass(options);
        else
            read_metal(options, config);
    }
    check_methods();
}

void RenderMaterial::read_metal(const RenderOptions& options, const shaders::ColorConfig& config)
{
    _metal = options.metal.value_or("gold");
    shaders::MetalIndex index;
    try
    {
        index = shaders::metal_index(_metal, config);
    }
    catch (const std::invalid_argument& e)
    {
        refuse("--metal", _metal, e.what());
    }
    if (index.out_of_gamut)
        fmt::print(stderr,
                   "regain: {} reflects a colour outside the working space {}; one near it was "
                   "used instead\n",
                   _metal, config.scene_linear());
    _material.surface =
        shaders::ConductorSurface{shaders::ColorD(index.n), shaders::ColorD(index.k)};
}

void RenderMaterial::read_glass(const RenderOptions& options)
{
    InterfaceSurface glass;
    glass.eta = options.ior.value_or(glass.eta);
    check_number("--ior", glass.eta, 0.1, 10);
    glass.thin_walled = options.thin_walled;
    if (options.scatter_mode)
        glass.mode =
            chosen<ScatterMode>("--scatter-mode", *options.scatter_mode, "mode", mode_names);

    if (needs_beta(_methods)) glass.shadowing = TransmissionShadowing::beta;
    if (const auto& given = options.transmission_shadowing)
    {
        const auto shadowing = chosen<TransmissionShadowing>("--transmission-shadowing", *given,
                                                             "form", shadowing_names);
        if (glass.thin_walled)
            refuse("--transmission-shadowing", *given,
                   "does not go with --thin-walled: a sheet transmits as it reflects, and has no "
                   "form to choose");
        if (glass.mode == ScatterMode::R)
            refuse("--transmission-shadowing", *given,
                   "does not go with --scatter-mode R, which transmits nothing; accepted: T, RT");
        if (needs_beta(_methods) && shadowing != TransmissionShadowing::beta)
            refuse("--transmission-shadowing", *given,
                   fmt::format("does not go with --method {}; accepted: beta",
                               shaders::name(_methods.back())));
        glass.shadowing = shadowing;
    }
    _material.surface = glass;
}

void RenderMaterial::read_sheen(const RenderOptions& options)
{
    _varied =
        options.weights.empty() ? std::vector<double>{0, 0.25, 0.5, 0.75, 1} : options.weights;
    check_list("--weight", _varied);
    _base = options.base.value_or(preview::Cloth::dark);
    check_number("--base", _base, 0, 1);
    _material.surface = SheenSurface{};
}

void RenderMaterial::read_facets(const RenderOptions& options)
{
    _varied =
        options.alphas.empty() ? std::vector<double>{0.05, 0.2, 0.4, 0.6, 0.8, 1} : options.alphas;
    check_list("--alpha", _varied, " (mirror)");
    _alpha_ratio = options.alpha_ratio.value_or(1);
    check_number("--alpha-ratio", _alpha_ratio, 0.01, 100);

    const std::string given = options.distribution.value_or("ggx");
    const auto kind = shaders::distribution_named(given);
    if (!kind)
        refuse("--distribution", given, "no such distribution; there are ggx, beckmann, gtr, std");
    _material.distribution = *kind;
    if (!options.gamma) return;
    _material.gamma = *options.gamma;
    const std::string gamma = fmt::format("{}", *options.gamma);
    if (!shaders::has_gamma(*kind))
        refuse("--gamma", gamma,
               fmt::format("does not go with --distribution {}; accepted: gtr, std", given));
    if (*kind == DistributionKind::gtr && !(*options.gamma > 0 && *options.gamma <= gtr_max_gamma))
        refuse("--gamma", gamma, fmt::format("gtr takes numbers above 0 up to {}", gtr_max_gamma));
    if (*kind == DistributionKind::std &&
        !(*options.gamma >= std_min_gamma && *options.gamma <= std_max_gamma))
        refuse("--gamma", gamma,
               fmt::format("std takes numbers from {} to {}", std_min_gamma, std_max_gamma));
}

void RenderMaterial::check_methods() const
{
    for (const Compensation& method : _methods)
    {
        MicrofacetMaterial material = _material;
        material.method = method;
        const auto no = [&](const std::exception& e) {
            refuse("--method", std::string(shaders::name(method)), e.what());
        };
        try
        {
            material.bind_tables();
        }
        catch (const std::invalid_argument& e)
        {
            no(e);
        }
        catch (const std::runtime_error& e)
        {
            no(e);
        }
    }
}

std::vector<std::unique_ptr<preview::BoundMaterial>> RenderMaterial::bind(
    const Compensation& method) const
{
    std::vector<std::unique_ptr<preview::BoundMaterial>> all;
    MicrofacetMaterial material = _material;
    material.method = method;
    for (const double value : _varied)
    {
        if (auto* sheen = std::get_if<SheenSurface>(&material.surface))
        {
            sheen->weight = value;
            if (_base > 0)
            {
                all.push_back(preview::bind(preview::Cloth{*sheen, _base}));
                continue;
            }
        }
        material.alpha_x = value * std::min(1.0, _alpha_ratio);
        material.alpha_y = value * std::min(1.0, 1 / _alpha_ratio);
        material.bind_tables();
        all.push_back(preview::bind(material));
    }
    return all;
}

std::vector<std::string> RenderMaterial::names() const
{
    std::vector<std::string> all;
    for (const double v : _varied) all.push_back(fmt::format("{:.4g}", v));
    return all;
}

void RenderMaterial::describe(Metadata& metadata) const
{
    auto& e = metadata.entries;
    std::vector<std::string_view> methods;
    for (const Compensation& m : _methods) methods.push_back(shaders::name(m));
    e.emplace_back("method", fmt::format("{}", fmt::join(methods, ", ")));
    e.emplace_back("material", _name);
    const std::string varied = fmt::format("{}", fmt::join(_varied, ", "));
    if (std::holds_alternative<SheenSurface>(_material.surface))
    {
        e.emplace_back("weight", varied);
        e.emplace_back("base", fmt::format("{}", _base));
        return;
    }
    if (const auto* glass = std::get_if<InterfaceSurface>(&_material.surface))
    {
        e.emplace_back("ior", fmt::format("{}", glass->eta));
        e.emplace_back("thin_walled", glass->thin_walled ? "1" : "0");
        e.emplace_back("scatter_mode", mode_names[int(glass->mode)]);
        if (!glass->thin_walled && glass->mode != ScatterMode::R)
            e.emplace_back("transmission_shadowing", shadowing_names[int(glass->shadowing)]);
    }
    else
        e.emplace_back("metal", _metal);
    e.emplace_back("distribution", shaders::name(_material.distribution));
    if (shaders::has_gamma(_material.distribution))
        e.emplace_back("gamma", fmt::format("{}", _material.gamma));
    e.emplace_back("alpha", varied);
    e.emplace_back("alpha_ratio", fmt::format("{}", _alpha_ratio));
}

}  // namespace regain::tools
