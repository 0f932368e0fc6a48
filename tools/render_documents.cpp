// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "render_documents.h"

#include "errors.h"
#include "plan_report.h"
#include "render_checks.h"
#include "texture_file.h"

#include <regain/shaders/document.h>
#include <regain/shaders/presets.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>

namespace regain::tools {

using shaders::DocumentError;
using shaders::DocumentNote;
using shaders::DocumentSettings;
using shaders::MaterialDocument;
using shaders::VaryingTree;

namespace {

bool lets_through(const VaryingTree& surface)
{
    if (!surface.is_all_there()) return true;
    for (int k = 0; k < surface.lobes(); ++k)
    {
        const auto& material = surface.tree.material(k);
        if (const auto* m = std::get_if<shaders::MicrofacetMaterial>(&material))
        {
            const auto* i = std::get_if<shaders::InterfaceSurface>(&m->surface);
            if (i && i->mode != ScatterMode::R) return true;
            continue;
        }
        const auto& plain = std::get<shaders::PlainMaterial>(material).surface;
        if (std::holds_alternative<shaders::TranslucentSurface>(plain) ||
            std::holds_alternative<shaders::TransparentSurface>(plain))
            return true;
    }
    return false;
}

}  // namespace

namespace {

struct Wedge
{
    std::string input;
    std::vector<double> values;
};

Wedge read_wedge(const std::string& text)
{
    const auto wrong = [&] {
        refuse("--wedge", text,
               "takes INPUT=FROM..TO:N with N from 2 to 16, for example roughness=0.1..1:8");
    };
    const auto equals = text.find('='), dots = text.find("..", equals == text.npos ? 0 : equals),
               colon = text.find(':', dots == text.npos ? 0 : dots);
    if (equals == text.npos || equals == 0 || dots == text.npos || colon == text.npos) wrong();
    const auto number = [&](std::size_t from, std::size_t to) {
        const std::string part = text.substr(from, to - from);
        char* end = nullptr;
        const double v = std::strtod(part.c_str(), &end);
        if (part.empty() || *end != 0 || !std::isfinite(v)) wrong();
        return v;
    };
    const double from = number(equals + 1, dots), to = number(dots + 2, colon),
                 n = number(colon + 1, text.size());
    if (!(n >= 2 && n <= 16) || n != std::floor(n)) wrong();
    Wedge wedge{text.substr(0, equals), {}};
    for (int i = 0; i < static_cast<int>(n); ++i)
        wedge.values.push_back(from + (to - from) * i / (n - 1));
    return wedge;
}

std::string shown(std::string name)
{
    std::replace(name.begin(), name.end(), '_', ' ');
    return name;
}

}  // namespace

RenderDocuments::RenderDocuments(const RenderOptions& options, const shaders::ColorConfig& config)
    : _given(options.documents),
      _method(options.method),
      _set(fmt::format("{}", fmt::join(options.settings, " "))),
      _wedge(options.wedge),
      _tolerance(options.tolerance)
{
    check_count("--columns", options.columns, 1, 16);
    shaders::MethodCosts costs;
    if (_tolerance)
    {
        check_tolerance(*_tolerance);
        if (!options.method.empty())
            refuse("--tolerance", fmt::format("{:g}", *_tolerance),
                   "does not go with --method, which it chooses");
        costs = method_costs(options.costs);
    }
    const TextureFiles textures(config);
    DocumentSettings settings(config);
    settings.textures = textures.loader();
    settings.folders = shaders::preset_folders();
    settings.overrides = overrides_of(options.settings);
    Wedge wedge;
    if (!options.wedge.empty()) wedge = read_wedge(options.wedge);

    std::vector<std::optional<shaders::Compensation>> methods;
    for (const auto& method : methods_named(options.method)) methods.emplace_back(method);
    if (methods.empty()) methods.emplace_back();
    std::set<std::string> said, found;
    int objects = 0;
    // Overrides by their name: what was said of them, and of how many objects.
    std::map<std::string, std::pair<std::string, int>> unused;
    for (const auto& method : methods)
    {
        settings.method = method;
        const std::string prefix =
            methods.size() > 1 ? std::string(shaders::name(*method)) + " " : "";
        Row row;
        for (const std::string& given : options.documents) try
            {
                const auto file = shaders::document_or_preset(given);
                std::vector<DocumentNote> notes;
                const auto document = MaterialDocument::read(file, settings);
                for (const std::string& name : document.materials())
                {
                    const auto& selected = options.selected;
                    if (!selected.empty() &&
                        std::find(selected.begin(), selected.end(), name) == selected.end())
                        continue;
                    if (found.insert(name).second) _names.push_back(name);
                    const auto add = [&](const MaterialDocument& d, const std::string& label) {
                        if (++objects > most_objects)
                            throw BadInput(
                                fmt::format("more than {} objects; --select NAME chooses materials",
                                            most_objects));
                        Surface s{prefix + label, d.surface(name, notes)};
                        if (_tolerance)
                            plan(s, costs);
                        else
                            s.tree.tree.bind_tables();
                        _is_transparent = _is_transparent || lets_through(s.tree);
                        row.push_back(std::move(s));
                    };
                    if (wedge.values.empty())
                    {
                        add(document, shown(name));
                        continue;
                    }
                    for (const double v : wedge.values)
                    {
                        DocumentSettings with = settings;
                        with.overrides.insert(with.overrides.begin(),
                                              {wedge.input, fmt::format("{:.9g}", v)});
                        add(MaterialDocument::read(file, with),
                            fmt::format("{} {:.3g}", shown(wedge.input), v));
                    }
                    arrange(std::move(row), true, static_cast<int>(wedge.values.size()));
                    row.clear();
                }
                for (const DocumentNote& note : notes)
                    if (!note.unused.empty())
                        ++unused[note.unused].second, unused[note.unused].first = note.message();
                    else if (said.insert(note.message()).second)
                        fmt::print(stderr, "regain: {}\n", note.message());
            }
            catch (const DocumentError& e)
            {
                throw BadInput(e.what());
            }
        arrange(std::move(row), methods.size() > 1, static_cast<int>(options.columns));
    }
    for (const std::string& wanted : options.selected)
        if (found.count(wanted) == 0)
            refuse("--select", wanted, "no document has a material of that name");
    if (_rows.empty()) throw BadInput("the documents have no material");
    // One that some material has is meant for that.
    for (const auto& [name, told] : unused)
        if (told.second == objects) throw BadInput(told.first);
}

void RenderDocuments::plan(Surface& surface, const shaders::MethodCosts& costs)
{
    shaders::ScenePlan scene =
        shaders::plan_scene({{surface.label, std::move(surface.tree)}}, {*_tolerance, &costs});
    shaders::MaterialPlan& material = scene.materials.front();
    if (_planned.empty())
        for (const std::string& note : scene.notes) fmt::print(stderr, "regain: {}\n", note);
    _planned.push_back(fmt::format("{}: {}", material.name, chosen_methods(material)));
    if (material.is_known && !material.is_within)
        fmt::print(stderr, "regain: {}: no choice keeps the tolerance; it may be off by {:.2g}\n",
                   material.name, material.error);
    surface.tree = std::move(material.surface);
}

// Rows are as even as they can be; those that are apart are no longer than they have to be.
void RenderDocuments::arrange(Row all, bool apart, int columns)
{
    const int n = static_cast<int>(all.size());
    if (n == 0) return;
    const int rows = apart && n <= 16 ? 1 : (n + columns - 1) / columns;
    for (int r = 0; r < rows; ++r)
    {
        Row row;
        for (int i = n * r / rows; i < n * (r + 1) / rows; ++i)
            row.push_back(std::move(all[static_cast<std::size_t>(i)]));
        _rows.push_back(std::move(row));
    }
}

std::vector<std::unique_ptr<preview::BoundMaterial>> RenderDocuments::bind(int row) const
{
    std::vector<std::unique_ptr<preview::BoundMaterial>> all;
    for (const Surface& s : _rows[static_cast<std::size_t>(row)])
        all.push_back(preview::bind(s.tree));
    return all;
}

std::vector<std::string> RenderDocuments::names(int row) const
{
    std::vector<std::string> all;
    for (const Surface& s : _rows[static_cast<std::size_t>(row)]) all.push_back(s.label);
    return all;
}

void RenderDocuments::describe(Metadata& metadata) const
{
    auto& e = metadata.entries;
    e.emplace_back("documents", fmt::format("{}", fmt::join(_given, ", ")));
    e.emplace_back("materials", fmt::format("{}", fmt::join(_names, ", ")));
    if (_tolerance)
    {
        e.emplace_back("tolerance", fmt::format("{:g}", *_tolerance));
        e.emplace_back("method", fmt::format("{}", fmt::join(_planned, "; ")));
    }
    else
        e.emplace_back("method", _method.empty() ? "recommended" : _method);
    if (!_set.empty()) e.emplace_back("set", _set);
    if (!_wedge.empty()) e.emplace_back("wedge", _wedge);
}

}  // namespace regain::tools
