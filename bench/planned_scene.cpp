// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// A scene of polished aluminium, rough gold, clear glass, frosted glass and cotton, planned: how
// far means of 8 x 8 pixels are from those of the reference, which is the same scene at a tolerance
// of 0, and how long it takes beside the scene without compensation.
//
//   planned_scene [COSTS.json [tolerance [samples]]]
//
// COSTS.json is what `regain cost --planner-data` writes; `-`, the default, what is compiled in.
// Without more, a tolerance of 0.01 and 1024 samples a pixel, which takes some minutes. Exit code 1
// where under even light the 99th percentile of the error is beyond the tolerance, or in the studio
// its mean.
//
// Everything is rendered twice, by other random numbers: of the differences d1 and d2 of one tile
// in both, the product is on average the square of what they have in common, the error, whatever
// the noise.

#include "errors.h"
#include "figures/scenes.h"
#include "plan_report.h"
#include "preview/interrupt.h"
#include "preview/progress.h"
#include "preview/render_job.h"

#include <regain/shaders/document.h>
#include <regain/shaders/planner.h>
#include <regain/shaders/presets.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <numeric>

namespace {

using namespace regain;
using namespace regain::tools;

// The frame of `regain render` for five materials, at half its size.
constexpr int width = 600, height = 240, block = 8;

struct Shown
{
    const char *preset, *material;
};
constexpr Shown shown[] = {{"aluminium", "aluminium_polished"},
                           {"gold", "gold_rough"},
                           {"glass-crown", "glass_crown_clear"},
                           {"glass-crown", "glass_crown_frosted"},
                           {"cotton-white", "cotton_white_coarse"}};
constexpr int objects = static_cast<int>(std::size(shown));

std::vector<shaders::NamedMaterial> materials(std::optional<shaders::Compensation> method = {})
{
    shaders::DocumentSettings settings(shaders::ColorConfig::active());
    settings.folders = shaders::preset_folders();
    settings.method = method;
    std::vector<shaders::NamedMaterial> all;
    for (const Shown& s : shown)
    {
        std::vector<shaders::DocumentNote> notes;
        const auto document =
            shaders::MaterialDocument::read(shaders::document_or_preset(s.preset), settings);
        all.push_back({s.material, document.surface(s.material, notes)});
    }
    return all;
}

std::vector<shaders::VaryingTree> planned(const shaders::MethodCosts& costs, double tolerance)
{
    const auto plan = shaders::plan_scene(materials(), {tolerance, &costs});
    fmt::print("{}", as_text(plan, tolerance));
    std::vector<shaders::VaryingTree> all;
    for (const shaders::MaterialPlan& m : plan.materials) all.push_back(m.surface);
    return all;
}

std::vector<shaders::VaryingTree> uncompensated()
{
    std::vector<shaders::VaryingTree> all;
    for (shaders::NamedMaterial& m : materials(Method::none))
    {
        m.surface.tree.bind_tables();
        all.push_back(std::move(m.surface));
    }
    return all;
}

// A picture that is rendered a few samples at a time.
class Rendering
{
public:
    Rendering(const std::vector<shaders::VaryingTree>& surfaces, bool furnace, std::uint32_t seed)
        : _stage(request(seed), cell(surfaces, furnace), width, height), _film(width, height)
    {}

    // Seconds that it takes.
    double go_on_to(int samples, const std::atomic<bool>& stop)
    {
        preview::RenderJob job;
        job.targets.push_back({&_stage.integrator(), &_film});
        job.samples = samples;
        job.stop = &stop;
        const auto start = std::chrono::steady_clock::now();
        if (!preview::render(job)) throw figures::Stopped();
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    // Of a block of pixels.
    std::array<double, 3> mean(int x0, int y0) const
    {
        std::array<double, 3> sum{};
        for (int y = y0; y < y0 + block; ++y)
            for (int x = x0; x < x0 + block; ++x)
                for (unsigned c = 0; c < 3; ++c)
                    sum[c] += double(_film.mean(x, y)[c]) / (block * block);
        return sum;
    }

private:
    static figures::Request request(std::uint32_t seed)
    {
        figures::Request r;
        r.seed = seed;
        return r;
    }
    static figures::Cell cell(const std::vector<shaders::VaryingTree>& surfaces, bool furnace)
    {
        figures::Cell c;
        c.layout.objects = objects;
        c.layout.object = preview::Object::sphere;
        c.layout.transparent = true;
        c.layout.floor = !furnace;
        c.white_furnace = furnace;
        c.object = [&surfaces](int i) {
            return preview::bind(surfaces[static_cast<std::size_t>(i)]);
        };
        return c;
    }

    figures::CellStage _stage;
    preview::Film _film;
};

double number(const char* text)
{
    char* end = nullptr;
    const double x = std::strtod(text, &end);
    if (end == text || *end != 0) throw BadInput(fmt::format("tolerance {}: takes 0 to 1", text));
    return x;
}

double quantile(std::vector<double> all, double q)
{
    const auto at = all.begin() + static_cast<std::ptrdiff_t>(q * double(all.size() - 1));
    std::nth_element(all.begin(), at, all.end());
    return *at;
}

double mean(const std::vector<double>& all)
{
    return std::accumulate(all.begin(), all.end(), 0.0) / double(all.size());
}

struct Found
{
    double error = 0, percentile = 0;     // mean and 99th percentile of tiles, largest channel
    double noise = 0;                     // of a tile, one sigma, mean
    double time = 0, reference_time = 0;  // over that without compensation, medians
};

Found compared(const std::vector<shaders::VaryingTree>& none,
               const std::vector<shaders::VaryingTree>& plan,
               const std::vector<shaders::VaryingTree>& reference, bool furnace, int samples,
               const InterruptGuard& guard)
{
    // Without compensation it is only timed.
    Rendering bare(none, furnace, 5), a[2] = {{plan, furnace, 1}, {plan, furnace, 2}},
                                      r[2] = {{reference, furnace, 1}, {reference, furnace, 2}};
    constexpr int turns = 32;
    Progress progress(furnace ? "under even light" : "in the studio", turns,
                      Progress::style(false));
    std::vector<double> times, reference_times;
    const int each = (samples + turns - 1) / turns;
    for (int turn = 1; turn <= turns; ++turn)
    {
        const int to = each * turn;
        // In turns, so that a slow moment of the machine meets all of them.
        const double of_none = bare.go_on_to(to, guard.flag()),
                     of_plan = a[0].go_on_to(to, guard.flag()),
                     of_reference = r[0].go_on_to(to, guard.flag());
        times.push_back(of_plan / of_none);
        reference_times.push_back(of_reference / of_none);
        a[1].go_on_to(to, guard.flag());
        r[1].go_on_to(to, guard.flag());
        progress.advance();
    }
    std::vector<double> errors, noises;
    // The picture is bright where the light itself is seen, so errors are over its mean.
    double light = 0;
    for (int y = 0; y < height; y += block)
        for (int x = 0; x < width; x += block)
        {
            double worst = 0, noise = 0;
            const auto a1 = a[0].mean(x, y), a2 = a[1].mean(x, y), r1 = r[0].mean(x, y),
                       r2 = r[1].mean(x, y);
            for (std::size_t c = 0; c < 3; ++c)
            {
                const double d1 = a1[c] - r1[c], d2 = a2[c] - r2[c];
                worst = std::max(worst, std::sqrt(std::max(0.0, d1 * d2)));
                noise = std::max(noise, std::abs(d1 - d2) / 2);
                light += (r1[c] + r2[c]) / 6;
            }
            errors.push_back(worst);
            noises.push_back(noise);
        }
    light /= double(errors.size());
    for (auto* all : {&errors, &noises})
        for (double& x : *all) x /= light;
    return {mean(errors), quantile(errors, 0.99), mean(noises), quantile(times, 0.5),
            quantile(reference_times, 0.5)};
}

}  // namespace

int main(int argc, char** argv)
try
{
    const std::string file = argc > 1 && std::string(argv[1]) != "-" ? argv[1] : "";
    const auto costs = method_costs(file);
    if (costs.empty()) throw BadInput("no costs are compiled in; name a file of them");
    const double tolerance = argc > 2 ? number(argv[2]) : 0.01;
    check_tolerance(tolerance);
    const int samples = argc > 3 ? std::atoi(argv[3]) : 1024;
    if (samples < 1) throw BadInput(fmt::format("{} samples: takes 1 and more", argv[3]));

    const auto none = uncompensated(), plan = planned(costs, tolerance),
               reference = planned(costs, 0);
    const InterruptGuard guard;
    bool within = true;
    for (const bool furnace : {true, false})
    {
        const Found f = compared(none, plan, reference, furnace, samples, guard);
        fmt::print(
            "{}: error of {} x {} pixels, over the picture's mean: mean {:.4f}, 99th percentile "
            "{:.4f}; "
            "noise {:.4f}; time over that without compensation {:.3f}, of the reference "
            "{:.3f}\n",
            furnace ? "under even light" : "in the studio", block, block, f.error, f.percentile,
            f.noise, f.time, f.reference_time);
        // Under even light what is seen is the albedo, which is what was promised; lamps show the
        // shape of lobes, too.
        within = within && (furnace ? f.percentile : f.error) <= tolerance;
    }
    return within ? 0 : 1;
}
catch (const figures::Stopped&)
{
    return 130;
}
catch (const std::exception& e)
{
    fmt::print(stderr, "planned_scene: {}\n", e.what());
    return 2;
}
