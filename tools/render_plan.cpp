// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "render_plan.h"

#include "errors.h"
#include "preview/plugin_material.h"
#include "render_checks.h"

#include <regain/luts/replace_file.h>

#include <algorithm>
#include <cmath>
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

namespace {

std::vector<std::string> aovs_named(const std::string& list)
{
    constexpr const char* known[] = {"albedo", "gain", "lobe", "method"};
    std::vector<std::string> aovs;
    for (std::size_t from = 0; from < list.size();)
    {
        const std::size_t to = std::min(list.find(',', from), list.size());
        const std::string one = list.substr(from, to - from);
        if (std::none_of(std::begin(known), std::end(known),
                         [&](const char* name) { return one == name; }))
            refuse("--aov", one,
                   fmt::format("no such layer; there are {}", fmt::join(known, ", ")));
        if (std::find(aovs.begin(), aovs.end(), one) == aovs.end()) aovs.push_back(one);
        from = to + 1;
    }
    return aovs;
}

// Documents and plug-ins say themselves what all these would.
void require_alone(const RenderOptions& o, const char* with)
{
    const auto refuse_where = [&](bool given, const char* option) {
        if (given) throw BadInput(fmt::format("{}: does not go with {}", option, with));
    };
    refuse_where(o.material != "metal", "--material");
    refuse_where(o.metal.has_value(), "--metal");
    refuse_where(o.ior.has_value(), "--ior");
    refuse_where(o.thin_walled, "--thin-walled");
    refuse_where(o.scatter_mode.has_value(), "--scatter-mode");
    refuse_where(o.transmission_shadowing.has_value(), "--transmission-shadowing");
    refuse_where(!o.weights.empty(), "--weight");
    refuse_where(o.base.has_value(), "--base");
    refuse_where(!o.alphas.empty(), "--alpha");
    refuse_where(o.alpha_ratio.has_value(), "--alpha-ratio");
    refuse_where(o.distribution.has_value(), "--distribution");
    refuse_where(o.gamma.has_value(), "--gamma");
}

void add_plugin(const RenderOptions& options, RenderPlan& plan)
{
    constexpr const char* with = "--plugin, whose parameters are set by --set NAME=VALUE";
    require_alone(options, with);
    if (!options.method.empty()) throw BadInput(fmt::format("--method: does not go with {}", with));
    if (!options.documents.empty())
        throw BadInput(
            fmt::format("{}: documents do not go with --plugin", options.documents.front()));
    preview::PluginMaterial loaded = preview::load_plugin(options.plugin, options.settings);
    if (options.host && *options.host != preview::name(loaded.host))
        refuse("--host", *options.host,
               fmt::format("the plug-in {} is for the host {}", options.plugin,
                           preview::name(loaded.host)));
    plan.host = loaded.host;
    plan.plugin = std::move(loaded.material);
    plan.plugin_name = loaded.name;
}

}  // namespace

int RenderPlan::rows() const
{
    if (plugin) return 1;
    return documents.empty() ? static_cast<int>(material.methods().size()) : documents.rows();
}

int RenderPlan::longest_row() const
{
    int longest = 0;
    for (int row = 0; row < rows(); ++row) longest = std::max(longest, layout_of(row).objects);
    return longest;
}

preview::RowLayout RenderPlan::layout_of(int row) const
{
    preview::RowLayout one = layout;
    one.objects = plugin ? 1 : documents.empty() ? material.objects() : documents.objects(row);
    return one;
}

std::vector<std::unique_ptr<preview::BoundMaterial>> RenderPlan::bind(int row)
{
    if (!documents.empty()) return documents.bind(row);
    if (!plugin) return material.bind(material.methods()[static_cast<std::size_t>(row)]);
    std::vector<std::unique_ptr<preview::BoundMaterial>> all;
    all.push_back(std::move(plugin));
    return all;
}

std::vector<std::string> RenderPlan::names(int row) const
{
    if (!documents.empty()) return documents.names(row);
    if (!plugin_name.empty()) return {plugin_name};
    std::vector<std::string> all = material.names();
    const std::string method(shaders::name(material.methods()[static_cast<std::size_t>(row)]));
    for (std::string& name : all) name = method + " " + name;
    return all;
}

RenderPlan make_plan(const RenderOptions& options)
{
    check_count("--spp", options.samples, 1, 65536);
    check_count("--seed", options.seed, 0, 4294967295);
    check_count("--threads", options.threads, 0, 1024);
    check_count("--bounces", options.bounces, 0, 4096);
    auto config = shaders::ColorConfig::active();
    check_view(options, config);
    // Documents have materials of their own; what there would be without them is not shown.
    RenderMaterial material(options.documents.empty() ? options : RenderOptions(), config);
    RenderDocuments documents;
    if (!options.documents.empty())
    {
        require_alone(options, "documents, whose materials are what they say");
        documents = RenderDocuments(options, config);
    }
    else if (!options.selected.empty())
        refuse("--select", options.selected.front(), "goes with documents alone");
    else if (options.tolerance)
        refuse("--tolerance", fmt::format("{}", *options.tolerance), "goes with documents alone");
    else if (!options.wedge.empty())
        refuse("--wedge", options.wedge, "goes with documents alone; of others --alpha is a list");

    if (!options.costs.empty() && !options.tolerance)
        refuse("--costs", options.costs, "goes with --tolerance alone");

    RenderPlan plan{options.output,
                    fs::path(options.output).replace_extension(".png"),
                    std::move(material),
                    std::move(documents),
                    nullptr,
                    "",
                    preview::host_named(options.host.value_or("renderman")),
                    1440,
                    0,
                    std::move(config),
                    {},
                    0,
                    {},
                    {},
                    {}};
    if (!options.plugin.empty())
        add_plugin(options, plan);
    else if (!options.settings.empty() && options.documents.empty())
        refuse("--set", options.settings.front(), "goes with documents and --plugin alone");
    plan.layout.object = preview::object_named(options.object);
    // What a plug-in may be is not known.
    plan.layout.transparent =
        plan.plugin ||
        (plan.documents.empty() ? plan.material.is_glass() : plan.documents.is_transparent());
    const std::string environment = options.furnace ? kWhite : options.environment;
    plan.layout.floor = environment != kWhite;
    if (!(std::abs(options.turn) <= 3600))
        refuse("--turn", fmt::format("{}", options.turn), "takes degrees from -3600 to 3600");
    plan.layout.turn = static_cast<float>(options.turn * M_PI / 180);
    // Light takes its time to find out of glass.
    const int bounces = plan.layout.transparent ? 64 : 16;
    plan.bounces = options.bounces ? static_cast<int>(options.bounces) : bounces;

    plan.height = 300 * plan.rows();
    if (plan.plugin) plan.width = plan.height = 480;
    if (!plan.documents.empty()) plan.width = std::max(480, 240 * plan.longest_row());
    if (!plan.documents.empty() && plan.longest_row() == 1) plan.height = 480 * plan.rows();
    if (!options.size.empty()) parse_size(options.size, &plan.width, &plan.height);
    if (options.furnace && !options.environment.empty() && options.environment != kWhite)
        refuse("--environment", options.environment, "does not go with --furnace, which is white");
    if (!(std::abs(options.rotate) <= 3600))
        refuse("--rotate", fmt::format("{}", options.rotate), "takes degrees from -3600 to 3600");
    if (options.scale && !(*options.scale > 0 && *options.scale <= 1e6))
        refuse("--scale", fmt::format("{}", *options.scale), "takes numbers above 0 up to 1e6");
    if (!options.difference.empty())
    {
        plan.reference = read_picture(options.difference);
        if (plan.reference.width != plan.width || plan.reference.height != plan.height)
            refuse("--difference", options.difference,
                   fmt::format("is {} x {}, and the picture {} x {}", plan.reference.width,
                               plan.reference.height, plan.width, plan.height));
    }
    plan.aovs = aovs_named(options.aovs);
    if (!plan.aovs.empty() && plan.plugin)
        refuse("--aov", options.aovs, "does not go with --plugin, which does not say");
    check_outputs(plan);
    plan.light = light_of(environment);
    return plan;
}

}  // namespace regain::tools
