// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "render_plan.h"

#include "render_checks.h"

#include <regain/luts/replace_file.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace regain::tools {

namespace {

namespace fs = std::filesystem;
using Imath::C3f;

// A light of 1 from everywhere, in which what keeps all energy cannot be seen.
constexpr const char* kWhite = "white";

void parse_size(const std::string& text, int* width, int* height)
{
    constexpr int kLeast = 16, kMost = 8192;
    int used = 0;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%dx%d%n%c", width, height, &used, &rest) != 2 ||
        static_cast<std::size_t>(used) != text.size() || *width < kLeast || *height < kLeast ||
        *width > kMost || *height > kMost)
        refuse("--size", text,
               fmt::format("takes WIDTHxHEIGHT in pixels, each {} to {}, for example 1440x600",
                           kLeast, kMost));
}

void check_outputs(const RenderPlan& plan)
{
    if (plan.exr.extension() != ".exr")
        refuse("-o", plan.exr.string(), "the name must end in .exr (the PNG is written beside it)");
    for (const fs::path& file : {plan.exr, plan.png}) luts::require_replaceable(file);
}

void check_view(const RenderOptions& options, const shaders::ColorConfig& config)
{
    const auto displays = config.displays();
    if (!options.display.empty() &&
        std::find(displays.begin(), displays.end(), options.display) == displays.end())
        refuse("--display", options.display,
               fmt::format("no such display in {}; there are {}", config.name(),
                           fmt::join(displays, ", ")));
    const auto views = config.views(options.display);
    if (!options.view.empty() && std::find(views.begin(), views.end(), options.view) == views.end())
        refuse("--view", options.view,
               fmt::format("no such view of that display; there are {}", fmt::join(views, ", ")));
}

preview::LatLongImage light_of(const std::string& environment)
{
    if (environment == kWhite) return {2, 1, {C3f(1.0f), C3f(1.0f)}};
    return environment.empty() ? preview::make_studio() : preview::read_latlong(environment);
}

}  // namespace

RenderPlan make_plan(const RenderOptions& options)
{
    check_count("--spp", options.samples, 1, 65536);
    check_count("--seed", options.seed, 0, 4294967295);
    check_count("--threads", options.threads, 0, 1024);
    check_count("--bounces", options.bounces, 0, 4096);
    auto config = shaders::ColorConfig::active();
    check_view(options, config);
    RenderMaterial material(options, config);

    RenderPlan plan{options.output,
                    fs::path(options.output).replace_extension(".png"),
                    std::move(material),
                    preview::host_named(options.host),
                    1440,
                    0,
                    std::move(config),
                    {},
                    0,
                    {}};
    plan.layout.objects = plan.material.objects();
    plan.layout.object = preview::object_named(options.object);
    plan.layout.transparent = plan.material.is_glass();
    plan.layout.floor = options.environment != kWhite;
    // Light takes its time to find out of glass.
    const int bounces = plan.layout.transparent ? 64 : 16;
    plan.bounces = options.bounces ? static_cast<int>(options.bounces) : bounces;

    plan.height = 300 * static_cast<int>(plan.material.methods().size());
    if (!options.size.empty()) parse_size(options.size, &plan.width, &plan.height);
    check_outputs(plan);
    plan.light = light_of(options.environment);
    return plan;
}

}  // namespace regain::tools
