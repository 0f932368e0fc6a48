// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// `regain render`: a row of objects of rising roughness for each compensation method; by default
// gold widgets, as in Figure 1 of Turquin 2019.

#include "commands.h"
#include "errors.h"
#include "picture.h"
#include "preview/interrupt.h"
#include "preview/progress.h"
#include "preview/render_job.h"
#include "preview/row.h"

#include <regain/closures/version.h>
#include <regain/luts/replace_file.h>
#include <regain/shaders/color_config.h>
#include <regain/shaders/metals.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace regain::tools {

namespace {

namespace fs = std::filesystem;
using namespace preview;
using Imath::C3f;
using shaders::Compensation;
using shaders::MicrofacetMaterial;

// A light of 1 from everywhere, in which what keeps all energy cannot be seen.
constexpr const char* kWhite = "white";

/// What the user asked for, as given.
struct Options
{
    std::string output = "regain.exr";
    std::string method;
    std::string material = "metal";
    std::string metal = "gold";
    double ior = 1.5;
    std::string distribution = "ggx";
    double gamma = 2;
    std::string object = "widget";
    std::vector<double> alphas = {0.05, 0.2, 0.4, 0.6, 0.8, 1.0};
    std::string host = "renderman";
    std::string environment;
    std::int64_t samples = 64;
    std::int64_t seed = 1;
    std::string size;
    std::int64_t threads = 0;
    std::int64_t bounces = 0;
    std::string display, view;
    bool quiet = false, json = false;
};

/// The same, checked: whatever can be wrong with it has been found before the first ray.
struct Plan
{
    fs::path exr, png;
    std::vector<Compensation> methods;  // one row each, top first
    std::vector<float> alphas;
    Host host;
    int width, height;
    shaders::ColorConfig config;
    MicrofacetMaterial material;  // but for alpha and method
    RowLayout layout;
    int bounces;
    LatLongImage light;
};

[[noreturn]] void refuse(const std::string& option, const std::string& given,
                         const std::string& accepted)
{
    throw BadInput(fmt::format("{} {}: {}", option, given, accepted));
}

void check_range(const char* option, std::int64_t value, std::int64_t least, std::int64_t most)
{
    if (value < least || value > most)
        refuse(option, std::to_string(value), fmt::format("takes {} to {}", least, most));
}

std::vector<Compensation> methods_of(const std::string& wanted)
{
    if (wanted.empty()) return {Method::none, Method::turquin};
    if (const auto method = shaders::compensation_named(wanted)) return {*method};
    refuse("--method", wanted,
           fmt::format("no such method; there are {}",
                       fmt::join(shaders::compensation_names(), ", ")));
}

shaders::DistributionKind distribution_of(const Options& options)
{
    const auto distribution = shaders::distribution_named(options.distribution);
    if (!distribution)
        refuse("--distribution", options.distribution,
               "no such distribution; there are ggx, beckmann, gtr, std");
    if (*distribution == shaders::DistributionKind::gtr &&
        !(options.gamma > 0.0 && options.gamma <= gtr_max_gamma))
        refuse("--gamma", fmt::format("{}", options.gamma),
               fmt::format("gtr takes numbers above 0 up to {}", gtr_max_gamma));
    if (*distribution == shaders::DistributionKind::std &&
        !(options.gamma >= std_min_gamma && options.gamma <= std_max_gamma))
        refuse("--gamma", fmt::format("{}", options.gamma),
               fmt::format("std takes numbers from {} to {}", std_min_gamma, std_max_gamma));
    return *distribution;
}

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

void check_outputs(const Plan& plan)
{
    if (plan.exr.extension() != ".exr")
        refuse("-o", plan.exr.string(), "the name must end in .exr (the PNG is written beside it)");
    for (const fs::path& file : {plan.exr, plan.png}) luts::require_replaceable(file);
}

void check_view(const Options& options, const shaders::ColorConfig& config)
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

shaders::MetalColor metal_of(const std::string& name, const shaders::ColorConfig& config)
{
    try
    {
        return shaders::metal_color(name, config);
    }
    catch (const std::invalid_argument& e)
    {
        refuse("--metal", name, e.what());
    }
}

MicrofacetMaterial material_of(const Options& options, const shaders::ColorConfig& config)
{
    MicrofacetMaterial material;
    material.distribution = distribution_of(options);
    material.gamma = options.gamma;
    if (options.material == "glass")
    {
        if (!(options.ior >= 0.1 && options.ior <= 10.0))
            refuse("--ior", fmt::format("{}", options.ior), "takes numbers from 0.1 to 10");
        shaders::InterfaceSurface glass;
        glass.eta = options.ior;
        material.surface = glass;
        return material;
    }
    if (options.material != "metal")
        refuse("--material", options.material, "no such material; there are metal and glass");

    const shaders::MetalColor metal = metal_of(options.metal, config);
    if (metal.out_of_gamut)
        fmt::print(stderr,
                   "regain: {} reflects a colour outside the working space {}; it was limited to "
                   "[0, 1]\n",
                   options.metal, config.scene_linear());
    material.surface =
        shaders::SchlickSurface{shaders::ColorD(C3f(metal.F0)), shaders::ColorD(C3f(metal.F82))};
    return material;
}

/// What is wrong with the combination is found here.
void check_materials(const Plan& plan)
{
    for (const Compensation& method : plan.methods)
    {
        MicrofacetMaterial material = plan.material;
        material.method = method;
        try
        {
            material.bind_tables();
        }
        catch (const std::invalid_argument& e)
        {
            refuse("--method", std::string(shaders::name(method)), e.what());
        }
        catch (const std::runtime_error& e)
        {
            refuse("--method", std::string(shaders::name(method)), e.what());
        }
    }
}

Plan make_plan(const Options& options)
{
    check_range("--spp", options.samples, 1, 65536);
    check_range("--seed", options.seed, 0, 4294967295);
    check_range("--threads", options.threads, 0, 1024);
    check_range("--bounces", options.bounces, 0, 4096);
    if (options.alphas.empty() || options.alphas.size() > 16)
        refuse("--alpha", fmt::format("with {} values", options.alphas.size()), "takes 1 to 16");
    for (const double alpha : options.alphas)
        if (!(alpha >= 0.0 && alpha <= 1.0))
            refuse("--alpha", fmt::format("{}", alpha), "takes numbers from 0 (mirror) to 1");

    auto config = shaders::ColorConfig::active();
    check_view(options, config);
    auto material = material_of(options, config);

    Plan plan{options.output,
              fs::path(options.output).replace_extension(".png"),
              methods_of(options.method),
              {options.alphas.begin(), options.alphas.end()},
              host_named(options.host),
              1440,
              0,
              std::move(config),
              std::move(material),
              {},
              0,
              {}};
    const bool white = options.environment == kWhite;
    plan.layout.objects = static_cast<int>(plan.alphas.size());
    plan.layout.object = object_named(options.object);
    plan.layout.transparent = plan.material.is_interface();
    plan.layout.floor = !white;
    // Light takes its time to find out of glass.
    const int bounces = plan.layout.transparent ? 64 : 16;
    plan.bounces = options.bounces ? static_cast<int>(options.bounces) : bounces;

    plan.height = 300 * static_cast<int>(plan.methods.size());
    if (!options.size.empty()) parse_size(options.size, &plan.width, &plan.height);
    check_outputs(plan);
    check_materials(plan);

    if (white)
        plan.light = {2, 1, {C3f(1.0f), C3f(1.0f)}};
    else
        plan.light =
            options.environment.empty() ? make_studio() : read_latlong(options.environment);
    return plan;
}

/// One row of the picture.
struct Row
{
    Row(const Plan& plan, const Options& options, const RowScene& scene, const Environment& light,
        const Compensation& method, int height)
        : camera(scene.camera(static_cast<float>(plan.width) / static_cast<float>(height))),
          integrator(plan.host,
                     World{scene.scene(), light, camera, plan.width, height,
                           static_cast<std::uint32_t>(options.seed), plan.bounces},
                     materials(plan, method)),
          film(plan.width, height)
    {}

    static std::vector<MicrofacetMaterial> materials(const Plan& plan, const Compensation& method)
    {
        std::vector<MicrofacetMaterial> all{floor_material()};
        for (const float alpha : plan.alphas)
        {
            MicrofacetMaterial material = plan.material;
            material.alpha_x = material.alpha_y = static_cast<double>(alpha);
            material.method = method;
            all.push_back(material);
        }
        return all;
    }

    Camera camera;
    RowIntegrator integrator;
    Film film;
};

Picture stack(const std::deque<Row>& rows, int width)
{
    Picture picture;
    picture.width = width;
    for (const Row& row : rows)
    {
        picture.height += row.film.height();
        for (int y = 0; y < row.film.height(); ++y)
            for (int x = 0; x < width; ++x) picture.pixels.push_back(row.film.mean(x, y));
    }
    return picture;
}

Metadata describe(const Plan& plan, const Options& options, bool whole, double samples)
{
    std::vector<std::string_view> methods;
    for (const Compensation& m : plan.methods) methods.push_back(shaders::name(m));
    Metadata metadata;
    auto& e = metadata.entries;
    e.emplace_back("version", REGAIN_VERSION_STRING);
    e.emplace_back("method", fmt::format("{}", fmt::join(methods, ", ")));
    e.emplace_back("material", options.material);
    if (plan.material.is_interface())
        e.emplace_back("ior", fmt::format("{}", options.ior));
    else
        e.emplace_back("metal", options.metal);
    e.emplace_back("distribution", options.distribution);
    if (shaders::has_gamma(plan.material.distribution))
        e.emplace_back("gamma", fmt::format("{}", options.gamma));
    e.emplace_back("alpha", fmt::format("{}", fmt::join(plan.alphas, ", ")));
    e.emplace_back("host", preview::name(plan.host));
    e.emplace_back("object", preview::name(plan.layout.object));
    e.emplace_back("bounces", std::to_string(plan.bounces));
    e.emplace_back("environment", options.environment.empty() ? "studio" : options.environment);
    e.emplace_back("seed", std::to_string(options.seed));
    e.emplace_back("spp", whole ? std::to_string(options.samples) : fmt::format("{:.2f}", samples));
    e.emplace_back("partial", whole ? "0" : "1");
    return metadata;
}

int render_command(const Options& options)
{
    const auto start = std::chrono::steady_clock::now();
    Plan plan = make_plan(options);
    const Environment light(std::move(plan.light));
    const RowScene scene(plan.layout);

    std::deque<Row> rows;
    const int count = static_cast<int>(plan.methods.size());
    for (int i = 0; i < count; ++i)
    {
        const int height = plan.height * (i + 1) / count - plan.height * i / count;
        rows.emplace_back(plan, options, scene, light, plan.methods[static_cast<std::size_t>(i)],
                          height);
    }

    RenderJob job;
    for (Row& row : rows) job.targets.push_back({&row.integrator.get(), &row.film});
    job.samples = static_cast<int>(options.samples);
    job.threads = static_cast<int>(options.threads);

    // Held until the files are written: Ctrl-C then does not leave half a picture.
    const InterruptGuard interrupt;
    bool whole = false;
    {
        Progress progress("render", total_samples(job), Progress::style(options.quiet));
        job.stop = &interrupt.flag();
        job.progress = &progress;
        whole = preview::render(job);
    }

    std::uint64_t faults = 0, taken = 0;
    for (const Row& row : rows)
    {
        faults += row.film.non_finite();
        for (int y = 0; y < row.film.height(); ++y)
            for (int x = 0; x < plan.width; ++x) taken += row.film.samples(x, y);
    }
    const double samples =
        static_cast<double>(taken) / (static_cast<double>(plan.width) * plan.height);
    const Metadata metadata = describe(plan, options, whole, samples);
    const Picture picture = stack(rows, plan.width);
    write_exr(plan.exr, picture, metadata);
    write_png(plan.png, picture, plan.config, options.display, options.view);

    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (faults)
        fmt::print(stderr, "regain: {} of {} samples were not finite and count as black\n", faults,
                   taken);
    if (options.json)
    {
        const nlohmann::ordered_json summary = {
            {"exr", plan.exr.string()}, {"png", plan.png.string()}, {"width", plan.width},
            {"height", plan.height},    {"seconds", seconds},       {"spp", samples},
            {"partial", !whole},        {"non_finite", faults}};
        fmt::print("{}\n", summary.dump());
    }
    else if (!options.quiet)
        fmt::print("{}{} and {}: {} x {}, {:.4g} samples per pixel, {}\n",
                   whole ? "" : "interrupted; partial picture in ", plan.exr.string(),
                   plan.png.string(), plan.width, plan.height, samples,
                   Progress::duration(seconds));
    return whole ? kDone : kInterrupted;
}

}  // namespace

void add_render(CLI::App& app, int& exit_code)
{
    auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "render",
        "Look-dev picture of a row of metal or glass objects: EXR, and a PNG for the display");
    command->footer(
        R"(Without options: gold of rising roughness, without compensation (top) and with
the method turquin (bottom), as in Figure 1 of Turquin 2019. Ctrl-C writes what
there is, marked with regain:partial = 1.

Examples:
  regain render
  regain render --metal copper --alpha 0.1,0.5,1 --size 900x640 -o copper.exr
  regain render --method series --environment studio.hdr --spp 256
  regain render --host clarisse --view raw --json
  regain render --material glass --ior 1.5 --object sphere --alpha 0,0.2,0.5
  regain render --material glass --object nested --environment white --method turquin
  regain render --distribution gtr --gamma 1.5 --method walk)");
    Options& o = *options;
    command->add_option("-o,--output", o.output, "EXR to write; the PNG goes beside it")
        ->capture_default_str();
    command->add_option("--method", o.method,
                        "one row with this compensation method, instead of none above turquin");
    command->add_option("--material", o.material, "metal or glass")->capture_default_str();
    command->add_option("--ior", o.ior, "of glass: index inside over index outside, 0.1 to 10")
        ->capture_default_str();
    command->add_option("--metal", o.metal, "gold, silver, copper, aluminium or brass")
        ->capture_default_str();
    command->add_option("--alpha", o.alphas, "microfacet widths, one widget each, 0 to 1")
        ->delimiter(',')
        ->capture_default_str();
    command->add_option("--distribution", o.distribution, "of facets: ggx, beckmann, gtr or std")
        ->capture_default_str();
    command->add_option("--gamma", o.gamma, "tail of gtr (up to 10) and std (1.51 to 100)")
        ->capture_default_str();
    command->add_option("--object", o.object, "widget, sphere, or nested (a sphere in a sphere)")
        ->capture_default_str();
    command->add_option("--host", o.host, "renderman (batched) or clarisse (one point)")
        ->capture_default_str();
    command->add_option("--environment", o.environment,
                        "latitude-longitude EXR or HDR that lights the scene, or white: 1 from "
                        "everywhere, and no floor [built-in studio]");
    command->add_option("--spp", o.samples, "samples per pixel, 1 to 65536")->capture_default_str();
    command->add_option("--seed", o.seed, "of the random numbers")->capture_default_str();
    command->add_option("--bounces", o.bounces, "at most, per path [16; 64 for glass]");
    command->add_option("--size", o.size, "WIDTHxHEIGHT of the whole picture, in pixels");
    command->add_option("--threads", o.threads, "0: one per core; never changes the picture")
        ->capture_default_str();
    command->add_option("--display", o.display, "OCIO display of the PNG [the config's default]");
    command->add_option("--view", o.view, "OCIO view of the PNG [the display's default]");
    command->add_flag("--quiet", o.quiet, "no progress, no summary");
    command->add_flag("--json", o.json, "summary as one line of JSON on standard output");
    command->callback([options, &exit_code] {
        exit_code = run_reporting([&] { return render_command(*options); });
    });
}

}  // namespace regain::tools
