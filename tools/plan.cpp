// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// `regain plan`: what a scene calls for, and the cheapest closures, methods and tables for that.

#include "commands.h"
#include "errors.h"
#include "plan_report.h"
#include "render_checks.h"
#include "texture_file.h"

#include <regain/shaders/document.h>
#include <regain/shaders/presets.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <map>
#include <memory>
#include <set>

namespace regain::tools {
namespace {

using namespace shaders;

struct Arguments
{
    std::vector<std::string> documents, selected, settings;
    std::string costs;
    double tolerance = 0.01;
    bool json = false;
};

std::vector<NamedMaterial> read_materials(const Arguments& a)
{
    const ColorConfig config = ColorConfig::active();
    const TextureFiles textures(config);
    DocumentSettings settings(config);
    settings.textures = textures.loader();
    settings.folders = preset_folders();
    settings.overrides = overrides_of(a.settings);

    std::vector<NamedMaterial> materials;
    std::set<std::string> said, found;
    // Overrides by their name: what was said of them, and of how many materials.
    std::map<std::string, std::pair<std::string, std::size_t>> unused;
    for (const std::string& given : a.documents)
    {
        std::vector<DocumentNote> notes;
        const auto document = MaterialDocument::read(document_or_preset(given), settings);
        for (const std::string& name : document.materials())
        {
            found.insert(name);
            const auto& wanted = a.selected;
            if (wanted.empty() || std::find(wanted.begin(), wanted.end(), name) != wanted.end())
                materials.push_back({name, document.surface(name, notes)});
        }
        for (const DocumentNote& note : notes)
            if (!note.unused.empty())
                ++unused[note.unused].second, unused[note.unused].first = note.message();
            else if (said.insert(note.message()).second)
                fmt::print(stderr, "regain: {}\n", note.message());
    }
    for (const std::string& wanted : a.selected)
        if (found.count(wanted) == 0)
            refuse("--select", wanted,
                   fmt::format("no document has a material of that name; there are {}",
                               fmt::join(found, ", ")));
    if (materials.empty()) throw BadInput("the documents have no material");
    // One that some material has is meant for that.
    for (const auto& [name, told] : unused)
        if (told.second == materials.size()) throw BadInput(told.first);
    return materials;
}

int plan(const Arguments& a)
{
    check_tolerance(a.tolerance);
    const MethodCosts costs = method_costs(a.costs);
    const ScenePlan scene = plan_scene(read_materials(a), {a.tolerance, &costs});
    if (a.json)
        fmt::print("{}\n", as_json(scene, a.tolerance).dump());
    else
        fmt::print("{}", as_text(scene, a.tolerance));
    return kDone;
}

}  // namespace

void add_plan(CLI::App& app, int& exit_code)
{
    auto a = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand(
        "plan",
        "What a scene calls for: the cheapest closures, methods and tables for a tolerance");
    command->footer(
        R"(For each material: the effects that it calls for, and of its closures the cheapest
methods of compensation that keep the predicted error of its directional albedo, in any
channel, within the tolerance. docs/planner.md says what is predicted from what.
`regain render --tolerance` renders by the same plan.

Examples:
  regain plan car.mtlx
  regain plan gold glass cotton --tolerance 0.02
  regain plan gold --select gold_rough --tolerance 0
  regain plan car.mtlx --set coat_roughness=0.4 --json
  regain cost --planner-data here.json && regain plan car.mtlx --costs here.json)");
    command
        ->add_option("DOCUMENT", a->documents,
                     "MaterialX documents, or names of presets: all of "
                     "their materials are one scene")
        ->required();
    command
        ->add_option("--tolerance", a->tolerance,
                     "largest error of the directional albedo, 0 to 1; 0 is the reference")
        ->capture_default_str();
    command->add_option("--select", a->selected, "only that material, repeated")
        ->allow_extra_args(false);
    command
        ->add_option("--set", a->settings, "INPUT=VALUE or NODE.INPUT=VALUE of documents, repeated")
        ->allow_extra_args(false);
    command->add_option("--costs", a->costs,
                        "errors and prices, a file of `regain cost --planner-data` [those that are "
                        "compiled in]");
    command->add_flag("--json", a->json, "one line of JSON on standard output");
    command->callback([a, &exit_code] {
        exit_code = run_reporting([&] {
            try
            {
                return plan(*a);
            }
            catch (const DocumentError& e)
            {
                throw BadInput(e.what());
            }
        });
    });
}

}  // namespace regain::tools
