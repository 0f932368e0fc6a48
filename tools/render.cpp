// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// `regain render`: a row of objects for each compensation method, of rising roughness or, where the
// material has none, of rising weight; by default gold widgets, as in Figure 1 of Turquin 2019.

#include "commands.h"
#include "errors.h"
#include "false_colour.h"
#include "picture.h"
#include "picture_label.h"
#include "preview/aov.h"
#include "preview/interrupt.h"
#include "preview/progress.h"
#include "preview/render_job.h"
#include "render_checks.h"
#include "render_parts.h"
#include "render_plan.h"
#include "resume_file.h"

#include <regain/closures/version.h>
#include <regain/luts/replace_file.h>
#include <regain/shaders/presets.h>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace regain::tools {

namespace {

namespace fs = std::filesystem;
using namespace preview;
using shaders::MicrofacetMaterial;

/// One row of the picture.
struct Row
{
    Row(RenderPlan& plan, const RenderOptions& options, const RowScene& scene,
        const Environment& light, int row, int height)
        : camera(scene.camera(static_cast<float>(plan.width) / static_cast<float>(height))),
          world{scene.scene(), light,  camera,
                plan.width,    height, static_cast<std::uint32_t>(options.seed),
                plan.bounces},
          integrator(plan.host, world, materials(plan, row)),
          film(plan.width, height)
    {}

    static std::vector<std::unique_ptr<BoundMaterial>> materials(RenderPlan& plan, int row)
    {
        MicrofacetMaterial floor = floor_material();
        floor.bind_tables();
        std::vector<std::unique_ptr<BoundMaterial>> all = plan.bind(row);
        all.insert(all.begin(), bind(floor));
        return all;
    }

    Camera camera;
    World world;
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

Metadata describe(const RenderPlan& plan, const RenderOptions& options, bool whole, double samples)
{
    Metadata metadata;
    auto& e = metadata.entries;
    e.emplace_back("version", REGAIN_VERSION_STRING);
    if (!plan.documents.empty())
        plan.documents.describe(metadata);
    else if (plan.plugin_name.empty())
        plan.material.describe(metadata);
    else
    {
        e.emplace_back("plugin", plan.plugin_name);
        e.emplace_back("settings", fmt::format("{}", fmt::join(options.settings, " ")));
    }
    e.emplace_back("host", preview::name(plan.host));
    e.emplace_back("object", preview::name(plan.layout.object));
    e.emplace_back("bounces", std::to_string(plan.bounces));
    e.emplace_back("environment", options.furnace               ? "white"
                                  : options.environment.empty() ? "studio"
                                                                : options.environment);
    if (options.rotate != 0) e.emplace_back("rotate", fmt::format("{}", options.rotate));
    if (options.turn != 0) e.emplace_back("turn", fmt::format("{}", options.turn));
    e.emplace_back("seed", std::to_string(options.seed));
    e.emplace_back("spp", whole ? std::to_string(options.samples) : fmt::format("{:.2f}", samples));
    e.emplace_back("partial", whole ? "0" : "1");
    return metadata;
}

// All that decides the picture, but what is in files.
std::vector<std::pair<std::string, std::string>> decisive(const RenderPlan& plan,
                                                          const RenderOptions& options)
{
    std::vector<std::pair<std::string, std::string>> all{
        {"size", fmt::format("{}x{}", plan.width, plan.height)}};
    for (const auto& entry : describe(plan, options, true, 0).entries)
        if (entry.first != "partial") all.push_back(entry);
    if (!plan.documents.empty()) all.emplace_back("columns", std::to_string(options.columns));
    return all;
}

// What may be gone on with, with more samples, too.
std::string job_of(const RenderPlan& plan, const RenderOptions& options)
{
    std::string job;
    for (const auto& [name, value] : decisive(plan, options))
        if (name != "spp") job += fmt::format("{}{}: {}", job.empty() ? "" : "; ", name, value);
    for (const std::string& document : options.documents)
    {
        std::error_code ec;
        const auto size = fs::file_size(document, ec);
        if (ec) continue;
        job += fmt::format("; {} of {} bytes, {}", document, size,
                           fs::last_write_time(document, ec).time_since_epoch().count());
    }
    return job;
}

// What parts are put together of: to the bit, and where files may have come from elsewhere.
JobDescription job_of_parts(const RenderPlan& plan, const RenderOptions& options)
{
    JobDescription job = describe_job("render");
    for (const auto& [name, value] : decisive(plan, options))
        if (name != "version") job.add(name, value);
    for (const std::string& document : options.documents)
        job.add_contents("contents of " + document, shaders::document_or_preset(document));
    if (!options.plugin.empty()) job.add_contents("contents of the plug-in", options.plugin);
    // Without a floor the light is white, and no file.
    if (!options.environment.empty() && plan.layout.floor)
        job.add_contents("contents of the environment", options.environment);
    return job;
}

fs::path part_file_of(const RenderPlan& plan, const Part& part)
{
    return part_file_name(fs::path(plan.exr).replace_extension(), part);
}

// Tells what the numbers of two of them mean.
std::vector<Layer> layers_of(const RenderPlan& plan, const RenderOptions& options,
                             const std::deque<Row>& rows, Metadata& metadata)
{
    std::vector<Layer> layers;
    for (const std::string& name : plan.aovs)
        layers.push_back({name, name == "albedo" || name == "gain" ? 3 : 1, {}});
    if (layers.empty()) return layers;
    for (const Row& row : rows)
    {
        const int samples = static_cast<int>(std::min<std::int64_t>(options.samples, 16));
        const AovPictures aovs = aov_pictures(row.world, row.integrator.materials(), samples);
        for (Layer& layer : layers)
        {
            if (layer.channels == 1)
            {
                const auto& values = layer.name == "lobe" ? aovs.lobe : aovs.method;
                layer.values.insert(layer.values.end(), values.begin(), values.end());
                continue;
            }
            for (const Imath::C3f& c : layer.name == "albedo" ? aovs.albedo : aovs.gain)
                for (int k = 0; k < 3; ++k) layer.values.push_back(c[k]);
        }
    }
    const auto listed = [](const auto& names) {
        std::vector<std::string> all{"0 none"};
        for (const auto& name : names) all.push_back(fmt::format("{} {}", all.size(), name));
        return fmt::format("{}", fmt::join(all, ", "));
    };
    for (const Layer& layer : layers)
    {
        if (layer.name == "lobe") metadata.entries.emplace_back("lobes", listed(lobe_names()));
        if (layer.name == "method")
            metadata.entries.emplace_back("methods", listed(shaders::compensation_names()));
    }
    return layers;
}

// Below every object what it is.
void label(Picture& picture, const RenderPlan& plan, const std::deque<Row>& rows,
           const std::deque<RowScene>& scenes)
{
    if (label_font().empty())
    {
        fmt::print(stderr,
                   "regain: there is no font for --labels; the environment variable REGAIN_FONT "
                   "names one\n");
        return;
    }
    // Of one size, which three of four names fit; longer ones are smaller. A letter is about 0.6
    // times as wide as it is high.
    const auto fit = [&](const std::string& name, std::size_t objects) {
        return 1.5 * plan.width / static_cast<double>(objects) /
               static_cast<double>(std::max<std::size_t>(name.size(), 8));
    };
    std::vector<double> fits;
    for (std::size_t r = 0; r < rows.size(); ++r)
    {
        const auto names = plan.names(static_cast<int>(r));
        for (const std::string& name : names) fits.push_back(fit(name, names.size()));
    }
    std::sort(fits.begin(), fits.end());
    const double common = std::min(fits[fits.size() / 4], 0.07 * rows.front().film.height());
    int below = 0;
    for (std::size_t r = 0; r < rows.size(); ++r)
    {
        const int height = rows[r].film.height();
        const float aspect = static_cast<float>(plan.width) / static_cast<float>(height);
        const auto names = plan.names(static_cast<int>(r));
        for (std::size_t i = 0; i < names.size(); ++i)
        {
            const float across = scenes[r].across(static_cast<int>(i), aspect);
            const int size =
                static_cast<int>(std::max(std::min(common, fit(names[i], names.size())), 7.0));
            set_label(picture, names[i], static_cast<int>(across * float(plan.width)),
                      below + height - height / 20, size);
        }
        below += height;
    }
}

}  // namespace

int render(const RenderOptions& options)
{
    const auto start = std::chrono::steady_clock::now();
    const std::optional<Part> part = options.parts.chosen();
    RenderPlan plan = make_plan(options);
    if (part) luts::require_replaceable(part_file_of(plan, *part));
    // Described before there is work, which may load more libraries.
    JobDescription parts_job;
    if (part || options.parts.merges()) parts_job = job_of_parts(plan, options);
    const Environment light(std::move(plan.light), static_cast<float>(options.rotate * M_PI / 180));

    std::deque<RowScene> scenes;
    std::deque<Row> rows;
    const int count = plan.rows();
    for (int i = 0; i < count; ++i)
    {
        const int height = plan.height * (i + 1) / count - plan.height * i / count;
        scenes.emplace_back(plan.layout_of(i));
        rows.emplace_back(plan, options, scenes.back(), light, i, height);
    }

    RenderJob job;
    job.part = part.value_or(Part());
    for (Row& row : rows) job.targets.push_back({&row.integrator.get(), &row.film});
    job.samples = static_cast<int>(options.samples);
    job.threads = static_cast<int>(options.threads);

    const fs::path resume = fs::path(plan.exr).replace_extension(".resume.exr");
    const std::string identity = job_of(plan, options);
    std::vector<Film*> films;
    for (Row& row : rows) films.push_back(&row.film);
    if (options.resume && fs::exists(resume)) read_resume_file(resume, films, identity);

    // Held until the files are written: Ctrl-C then does not leave half a picture.
    const InterruptGuard interrupt;
    bool whole = options.parts.merges();
    if (whole)
        merge_render_parts(options.parts.merged, films, parts_job);
    else
    {
        Progress progress("render", total_samples(job), Progress::style(options.quiet));
        job.stop = &interrupt.flag();
        job.progress = &progress;
        whole = preview::render(job);
    }

    const auto seconds_so_far = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    if (part)
    {
        const fs::path file = part_file_of(plan, *part);
        if (!whole)
        {
            fmt::print(stderr, "regain: stopped, '{}' was not written: run the part again\n",
                       file.string());
            return kInterrupted;
        }
        write_render_part(file, films, parts_job, *part);
        if (!options.quiet || options.json)
            report_part(*part, file, tiles_of(films, *part).size(), tiles_of(films).size(), "tiles",
                        seconds_so_far(), options.json);
        return kDone;
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
    Metadata metadata = describe(plan, options, whole, samples);
    const std::vector<Layer> layers = layers_of(plan, options, rows, metadata);
    Picture picture = stack(rows, plan.width);
    if (options.labels) label(picture, plan, rows, scenes);
    write_exr(plan.exr, picture, metadata, layers);
    if (options.furnace)
    {
        const Picture white{picture.width, picture.height,
                            std::vector<Imath::C3f>(picture.pixels.size(), Imath::C3f(1.0f))};
        write_png(plan.png, false_colour(picture, white, options.scale.value_or(0.05)));
    }
    else
        write_png(plan.png, picture, plan.config, options.display, options.view);
    const bool compared = !plan.reference.pixels.empty();
    Difference difference;
    if (compared)
    {
        const Picture shown = as_written(picture);
        difference = difference_of(shown, plan.reference);
        const double scale = options.scale.value_or(std::max(difference.most, 1e-6));
        write_png(fs::path(plan.exr).replace_extension(".difference.png"),
                  false_colour(shown, plan.reference, scale));
    }

    if (whole)
    {
        std::error_code ec;
        if (options.resume) fs::remove(resume, ec);
    }
    else
        write_resume_file(resume, {films.begin(), films.end()}, identity);

    const double seconds = seconds_so_far();
    if (faults)
        fmt::print(stderr, "regain: {} of {} samples were not finite and count as black\n", faults,
                   taken);
    if (options.json)
    {
        nlohmann::ordered_json summary = {{"exr", plan.exr.string()}, {"png", plan.png.string()},
                                          {"width", plan.width},      {"height", plan.height},
                                          {"seconds", seconds},       {"spp", samples},
                                          {"partial", !whole},        {"non_finite", faults}};
        if (compared)
        {
            summary["largest_difference"] = difference.most;
            summary["rms_difference"] = difference.rms;
        }
        fmt::print("{}\n", summary.dump());
    }
    else if (!options.quiet)
    {
        if (compared)
            fmt::print("difference from {}: largest {:.4g}, rms {:.4g}\n", options.difference,
                       difference.most, difference.rms);
        fmt::print("{}{} and {}: {} x {}, {:.4g} samples per pixel, {}\n",
                   whole ? "" : "interrupted (--resume goes on); partial picture in ",
                   plan.exr.string(), plan.png.string(), plan.width, plan.height, samples,
                   Progress::duration(seconds));
    }
    return whole ? kDone : kInterrupted;
}

namespace {

bool is_whole(const fs::path& exr)
{
    std::error_code ec;
    return fs::exists(exr, ec) && text_attribute(exr, "regain:partial") == "0";
}

int render_turntable(const RenderOptions& options)
{
    if (options.turntable < 2 || options.turntable > 9999)
        refuse("--turntable", std::to_string(options.turntable), "takes 2 to 9999");
    for (std::int64_t i = 0; i < options.turntable; ++i)
    {
        RenderOptions one = options;
        one.turn =
            options.turn + 360.0 * static_cast<double>(i) / static_cast<double>(options.turntable);
        one.output =
            fs::path(options.output).replace_extension(fmt::format(".{:04}.exr", i + 1)).string();
        if (options.resume && is_whole(one.output)) continue;
        if (const int code = render(one); code != kDone) return code;
    }
    return kDone;
}

std::vector<fs::file_time_type> times_of(const std::vector<std::string>& files)
{
    std::vector<fs::file_time_type> times;
    for (const std::string& file : files)
    {
        std::error_code ec;
        times.push_back(fs::last_write_time(file, ec));
    }
    return times;
}

// A document that is wrong, or gone, may be mended: it is said, and waited for.
int watch(const RenderOptions& options)
{
    if (options.documents.empty())
        refuse("--watch", "", "goes with documents alone: there is nothing else to change");
    for (;;)
    {
        const auto seen = times_of(options.documents);
        const int code = run_reporting([&] { return render(options); });
        if (code == kInterrupted) return code;
        const InterruptGuard interrupt;
        while (times_of(options.documents) == seen)
        {
            if (interrupt.flag()) return kInterrupted;
            std::this_thread::sleep_for(std::chrono::milliseconds(200));
        }
    }
}

int render_all(const RenderOptions& options)
{
    const std::string with = options.parts.given();
    if (!with.empty())
    {
        if (options.turntable != 0)
            refuse("--turntable", std::to_string(options.turntable),
                   "does not go with " + with + "; each of its pictures is one of --turn");
        if (options.watch) refuse("--watch", "", "does not go with " + with);
        if (options.resume)
            refuse("--resume", "",
                   "does not go with " + with + ": a part that was stopped is run again");
    }
    if (options.turntable != 0 && options.watch)
        refuse("--watch", "", "does not go with --turntable");
    if (options.watch) return watch(options);
    return options.turntable != 0 ? render_turntable(options) : render(options);
}

}  // namespace

void add_render(CLI::App& app, int& exit_code)
{
    auto options = std::make_shared<RenderOptions>();
    CLI::App* command = app.add_subcommand(
        "render",
        "Look-dev picture of a row of metal, glass or cloth objects: EXR, and a PNG for the "
        "display");
    declare(*options, *command);
    command->callback(
        [options, &exit_code] { exit_code = run_reporting([&] { return render_all(*options); }); });
}

}  // namespace regain::tools
