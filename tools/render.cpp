// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// `regain render`: a row of objects for each compensation method, of rising roughness or, where the
// material has none, of rising weight; by default gold widgets, as in Figure 1 of Turquin 2019.

#include "commands.h"
#include "errors.h"
#include "picture.h"
#include "picture_label.h"
#include "preview/interrupt.h"
#include "preview/progress.h"
#include "preview/render_job.h"
#include "render_plan.h"

#include <regain/closures/version.h>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

namespace regain::tools {

namespace {

using namespace preview;
using shaders::MicrofacetMaterial;

/// One row of the picture.
struct Row
{
    Row(RenderPlan& plan, const RenderOptions& options, const RowScene& scene,
        const Environment& light, int row, int height)
        : camera(scene.camera(static_cast<float>(plan.width) / static_cast<float>(height))),
          integrator(plan.host,
                     World{scene.scene(), light, camera, plan.width, height,
                           static_cast<std::uint32_t>(options.seed), plan.bounces},
                     materials(plan, row)),
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
    e.emplace_back("environment", options.environment.empty() ? "studio" : options.environment);
    e.emplace_back("seed", std::to_string(options.seed));
    e.emplace_back("spp", whole ? std::to_string(options.samples) : fmt::format("{:.2f}", samples));
    e.emplace_back("partial", whole ? "0" : "1");
    return metadata;
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
    int below = 0;
    for (std::size_t r = 0; r < rows.size(); ++r)
    {
        const int height = rows[r].film.height();
        const float aspect = static_cast<float>(plan.width) / static_cast<float>(height);
        const auto names = plan.names(static_cast<int>(r));
        const int room = plan.width / static_cast<int>(names.size());
        for (std::size_t i = 0; i < names.size(); ++i)
        {
            // A letter is about 0.6 times as wide as it is high.
            const double fits = 1.5 * room / double(std::max<std::size_t>(names[i].size(), 8));
            const int size = static_cast<int>(std::clamp(fits, 6.0, 0.07 * height));
            const float across = scenes[r].across(static_cast<int>(i), aspect);
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
    RenderPlan plan = make_plan(options);
    const Environment light(std::move(plan.light));

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
    Picture picture = stack(rows, plan.width);
    if (options.labels) label(picture, plan, rows, scenes);
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

void add_render(CLI::App& app, int& exit_code)
{
    auto options = std::make_shared<RenderOptions>();
    CLI::App* command = app.add_subcommand(
        "render",
        "Look-dev picture of a row of metal, glass or cloth objects: EXR, and a PNG for the "
        "display");
    declare(*options, *command);
    command->callback(
        [options, &exit_code] { exit_code = run_reporting([&] { return render(*options); }); });
}

}  // namespace regain::tools
