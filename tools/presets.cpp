// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// `regain presets`: the materials that come with the library, as a list, in numbers, checked, and
// as a picture of them all.

#include "commands.h"
#include "errors.h"
#include "preset_check.h"
#include "render_options.h"

#include <regain/shaders/document.h>
#include <regain/shaders/metals.h>
#include <regain/shaders/presets.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>

namespace regain::tools {
namespace {

using Json = nlohmann::ordered_json;
using namespace shaders;

struct Arguments
{
    std::vector<std::string> names;
    std::string kind;
    bool json = false;
    RenderOptions render;
};

Json as_json(const ColorD& c) { return {c.x, c.y, c.z}; }

struct Describe
{
    Json operator()(const SchlickSurface& s) const
    {
        return {{"closure", "generalized_schlick"},
                {"F0", as_json(s.F0)},
                {"F82", as_json(s.F82)},
                {"F90", as_json(s.F90)}};
    }
    Json operator()(const ConductorSurface& s) const
    {
        return {{"closure", "conductor"}, {"n", as_json(s.n)}, {"k", as_json(s.k)}};
    }
    Json operator()(const InterfaceSurface& s) const
    {
        constexpr const char* modes[] = {"R", "T", "RT"};
        return {{"closure", "dielectric"},
                {"eta", s.eta},
                {"scatter_mode", modes[int(s.mode)]},
                {"thin_walled", s.thin_walled},
                {"reflection_tint", as_json(s.reflection_tint)},
                {"transmission_tint", as_json(s.transmission_tint)}};
    }
    Json operator()(const SheenSurface& s) const
    {
        return {{"closure", "sheen"}, {"color", as_json(s.color)}, {"weight", s.weight}};
    }
    Json operator()(const MicrofacetMaterial& m) const
    {
        Json j = std::visit(*this, m.surface);
        j["distribution"] = name(m.distribution);
        j["alpha"] = {m.alpha_x, m.alpha_y};
        j["method"] = name(m.method);
        return j;
    }
    Json operator()(const PlainMaterial& m) const
    {
        constexpr const char* closures[] = {"oren_nayar_diffuse", "burley_diffuse", "subsurface",
                                            "translucent",        "transparent",    "sheen"};
        Json j{{"closure", closures[m.surface.index()]}};
        std::visit([&](const auto& s) { j["color"] = as_json(s.color); }, m.surface);
        return j;
    }
};

Json describe(const std::string& preset, const DocumentSettings& settings)
{
    const auto file = preset_file(preset);
    const auto document = MaterialDocument::read(file, settings);
    Json j{{"preset", preset}, {"file", file.string()}, {"materials", Json::array()}};
    for (const std::string& material : document.materials())
    {
        std::vector<DocumentNote> notes;
        const VaryingTree surface = document.surface(material, notes);
        Json one{{"name", material},
                 {"doc", document.attribute(material, "doc")},
                 {"kind", document.attribute(material, "kind")},
                 {"source", document.attribute(material, "source")},
                 {"closures", Json::array()}};
        for (int k = 0; k < surface.lobes(); ++k)
            one["closures"].push_back(std::visit(Describe{}, surface.tree.material(k)));
        for (const DocumentNote& note : notes) one["notes"].push_back(note.message());
        j["materials"].push_back(std::move(one));
    }
    const auto metals = metal_names();
    if (std::find(metals.begin(), metals.end(), preset) != metals.end())
    {
        const MetalColor color = metal_color(preset, settings.config);
        const MetalIndex index = metal_index(preset, settings.config);
        j["metal"] = {{"working_space", settings.config.scene_linear()},
                      {"F0", as_json(ColorD(color.F0))},
                      {"F82", as_json(ColorD(color.F82))},
                      {"n", as_json(ColorD(index.n))},
                      {"k", as_json(ColorD(index.k))},
                      {"out_of_gamut", color.out_of_gamut}};
    }
    return j;
}

std::string numbers(const Json& j)
{
    if (!j.is_array()) return j.is_string() ? j.get<std::string>() : j.dump();
    std::vector<std::string> all;
    for (const Json& x : j) all.push_back(fmt::format("{:.4g}", x.get<double>()));
    return fmt::format("{}", fmt::join(all, " "));
}

void print(const Json& j)
{
    fmt::print("{} ({})\n", j["preset"].get<std::string>(), j["file"].get<std::string>());
    if (j.contains("metal"))
    {
        fmt::print("  in {}:", j["metal"]["working_space"].get<std::string>());
        for (const char* what : {"F0", "F82", "n", "k"})
            fmt::print("  {} {}", what, numbers(j["metal"][what]));
        fmt::print("{}\n", j["metal"]["out_of_gamut"] ? "; its F0 is limited to that" : "");
    }
    std::string source;
    for (const Json& material : j["materials"])
    {
        if (material["source"] != source)
        {
            source = material["source"].get<std::string>();
            fmt::print("  {}\n", source);
        }
        fmt::print("  {}: {} ({})\n", material["name"].get<std::string>(),
                   material["doc"].get<std::string>(), material["kind"].get<std::string>());
        for (const Json& closure : material["closures"])
        {
            fmt::print("    {}", closure["closure"].get<std::string>());
            for (const auto& [key, value] : closure.items())
                if (key != "closure") fmt::print("  {} {}", key, numbers(value));
            fmt::print("\n");
        }
    }
}

std::vector<std::string> wanted(const Arguments& a)
{
    if (a.names.empty()) return preset_names();
    for (const std::string& name : a.names) preset_file(name);
    return a.names;
}

// Of a preset what the list says: the first of its materials.
Json summary(const std::string& preset, const DocumentSettings& settings)
{
    const auto document = MaterialDocument::read(preset_file(preset), settings);
    const std::string first = document.materials().at(0);
    std::string doc = document.attribute(first, "doc");
    if (const auto comma = doc.rfind(','); comma != std::string::npos) doc.resize(comma);
    return {{"preset", preset},
            {"kind", document.attribute(first, "kind")},
            {"doc", doc},
            {"materials", document.materials()}};
}

int list(const Arguments& a, const DocumentSettings& settings)
{
    std::vector<std::string> kinds;
    std::size_t count = 0, materials = 0;
    for (const std::string& preset : preset_names())
    {
        const Json j = summary(preset, settings);
        kinds.push_back(j["kind"].get<std::string>());
        if (!a.kind.empty() && j["kind"] != a.kind) continue;
        ++count;
        materials += j["materials"].size();
        if (a.json)
            fmt::print("{}\n", j.dump());
        else
            fmt::print("{:<28} {:<10} {}\n", preset, j["kind"].get<std::string>(),
                       j["doc"].get<std::string>());
    }
    std::sort(kinds.begin(), kinds.end());
    kinds.erase(std::unique(kinds.begin(), kinds.end()), kinds.end());
    if (count == 0)
        throw BadInput(fmt::format("--kind '{}': no preset is of that kind; there are {}", a.kind,
                                   fmt::join(kinds, ", ")));
    if (!a.json) fmt::print("{} presets, {} materials\n", count, materials);
    return kDone;
}

int show(const Arguments& a, const DocumentSettings& settings)
{
    for (const std::string& preset : wanted(a))
    {
        const Json j = describe(preset, settings);
        if (a.json)
            fmt::print("{}\n", j.dump());
        else
            print(j);
    }
    return kDone;
}

int check(const Arguments& a, const DocumentSettings& settings)
{
    const auto presets = wanted(a);
    std::size_t bad = 0;
    for (const std::string& preset : presets)
    {
        const auto faults = preset_faults(preset, settings);
        bad += !faults.empty();
        if (a.json)
            fmt::print("{}\n", Json{{"preset", preset}, {"faults", faults}}.dump());
        else
            for (const std::string& fault : faults) fmt::print("{}: {}\n", preset, fault);
    }
    if (!a.json) fmt::print("{} presets checked, {} with faults\n", presets.size(), bad);
    return bad ? kCheckFailed : kDone;
}

// One object for each, of the second of its roughnesses where there are so many.
int sheet(const Arguments& a, const DocumentSettings& settings)
{
    RenderOptions options = a.render;
    for (const std::string& preset : wanted(a))
    {
        const Json j = summary(preset, settings);
        if (!a.kind.empty() && j["kind"] != a.kind) continue;
        const auto& materials = j["materials"];
        options.documents.push_back(preset);
        options.selected.push_back(materials[materials.size() > 2 ? 1 : 0].get<std::string>());
    }
    if (options.documents.empty())
        throw BadInput(fmt::format("--kind '{}': no preset is of that kind", a.kind));
    options.labels = true;
    const auto rows = (static_cast<std::int64_t>(options.documents.size()) + options.columns - 1) /
                      options.columns;
    if (options.size.empty())
        options.size = fmt::format("{}x{}", 180 * options.columns, 200 * rows);
    return render(options);
}

}  // namespace

void add_presets(CLI::App& app, int& exit_code)
{
    auto a = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand(
        "presets", "The materials that come with the library: list, show, check, contact sheet");
    command->require_subcommand(1);
    command->footer(R"(Presets are MaterialX documents; regain render takes their names. Those of
REGAIN_PRESETS=FOLDER come first.

Examples:
  regain presets list --kind metal
  regain presets show gold diamond
  regain presets check
  regain presets sheet -o presets.exr --spp 64)");
    const auto run = [a, &exit_code](int (*what)(const Arguments&, const DocumentSettings&)) {
        exit_code = run_reporting([&] {
            try
            {
                return what(*a, DocumentSettings(ColorConfig::active()));
            }
            catch (const DocumentError& e)
            {
                throw BadInput(e.what());
            }
        });
    };
    CLI::App* one = command->add_subcommand("list", "names, kinds and what they are");
    one->add_option("--kind", a->kind, "only these: metal, glass, liquid, gem, plastic ...");
    one->add_flag("--json", a->json, "a line of JSON each");
    one->callback([run] { run(&list); });

    one = command->add_subcommand("show", "closures and numbers in the working space, and sources");
    one->add_option("NAME", a->names, "presets [all]");
    one->add_flag("--json", a->json, "a line of JSON each");
    one->callback([run] { run(&show); });

    one = command->add_subcommand("check", "hold them to what can be; exit code 1 where they fail");
    one->add_option("NAME", a->names, "presets [all]");
    one->add_flag("--json", a->json, "a line of JSON each");
    one->callback([run] { run(&check); });

    a->render.output = "presets.exr";
    a->render.object = "sphere";
    a->render.columns = 9;
    one = command->add_subcommand("sheet", "a picture of one object each, with its name");
    one->add_option("NAME", a->names, "presets [all]");
    one->add_option("--kind", a->kind, "only these");
    one->add_option("-o,--output", a->render.output, "EXR to write; the PNG goes beside it")
        ->capture_default_str();
    one->add_option("--columns", a->render.columns, "objects in a row, 1 to 16")
        ->capture_default_str();
    one->add_option("--size", a->render.size, "WIDTHxHEIGHT of the whole picture, in pixels");
    one->add_option("--object", a->render.object, "widget, sphere, or nested")
        ->capture_default_str();
    one->add_option("--environment", a->render.environment,
                    "latitude-longitude EXR or HDR [built-in studio]");
    one->add_option("--spp", a->render.samples, "samples per pixel, 1 to 65536")
        ->capture_default_str();
    one->add_option("--view", a->render.view, "OCIO view of the PNG [the display's default]");
    one->add_option("--threads", a->render.threads, "0: one per core")->capture_default_str();
    one->add_flag("--quiet", a->render.quiet, "no progress, no summary");
    one->callback([run] { run(&sheet); });
}

}  // namespace regain::tools
